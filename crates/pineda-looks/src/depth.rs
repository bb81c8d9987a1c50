//! Distance as a grey value.

use crate::Vertex;
use pineda::{Fragment, Lanes, Mat4, Real, Rgba, Scalar, Shader, Vec3, Vec4, shader};

/// The eye distance along the view axis as a grey: 0 at `near`, 1 at `far`, linear between them.
///
/// The distance is clip space's w, so `clip_from_world` must be a perspective camera's. (Depth in the sense of the depth
/// test is another number, not linear in the distance: [`Target::depth`](pineda::Target) holds that.) Draw it to
/// `Rgba32F`: 8 bits are too few for it.
#[derive(Clone, Debug, PartialEq)]
pub struct Depth {
    /// World space to clip space.
    pub clip_from_world: Mat4,
    /// The distance that becomes 0.
    pub near: f32,
    /// The distance that becomes 1.
    pub far: f32,
}

#[shader]
impl Shader for Depth {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Real<L>;

    fn vertex(&self, vertex: &Vertex) -> (Vec4, Real<Scalar>) {
        let clip = self.clip_from_world * Vec3::from(vertex.position).extend(1.0);
        (clip, clip.w)
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        Rgba::gray((f.varyings() - self.near) / (self.far - self.near))
    }
}
