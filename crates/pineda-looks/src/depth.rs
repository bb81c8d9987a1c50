//! Distance as a grey value.

use crate::Vertex;
use pineda::{Fragment, Lanes, Mat4, Real, Rgba, Scalar, Shader, Vec3, Vec4, shader};

/// The eye distance along the view axis as a grey: 0 at `near`, 1 at `far`, linear between them.
///
/// (Depth in the sense of the depth test is another number, in a perspective picture not linear in the distance: [`Target::depth`](pineda::Target) holds that.) Draw it to `Rgba32F`: 8 bits are too
/// few for it.
#[derive(Clone, Debug, PartialEq)]
pub struct Depth {
    /// World space to clip space.
    pub clip_from_world: Mat4,
    /// From a place to its distance: the dot product of this with (x, y, z, 1) in world space.
    pub distance: [f32; 4],
    /// The distance that becomes 0.
    pub near: f32,
    /// The distance that becomes 1.
    pub far: f32,
}

impl Depth {
    /// With a perspective camera, whose clip space's w is the distance.
    #[must_use]
    pub fn perspective(clip_from_world: Mat4, near: f32, far: f32) -> Self {
        Self { clip_from_world, distance: clip_from_world.0.map(|column| column[3]), near, far }
    }
}

#[shader]
impl Shader for Depth {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Real<L>;

    fn vertex(&self, vertex: &Vertex) -> (Vec4, Real<Scalar>) {
        let position = Vec3::from(vertex.position).extend(1.0);
        (self.clip_from_world * position, position.dot(self.distance))
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        Rgba::gray((f.varyings() - self.near) / (self.far - self.near))
    }
}
