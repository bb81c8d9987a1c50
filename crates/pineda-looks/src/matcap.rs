//! A ball of clay that was lit once and for all: each normal looks as the ball does where it has that normal.
//!
//! "Material captures" are usually painted or photographed pictures of such a ball (Sloan et al. 2001, "The Lit Sphere"); this one is a formula: warm light from the upper left, cool light that comes back from the
//! lower right, a soft highlight and a darker outline. The ball turns with the eye, so that nothing of a shape is ever in the dark.

use crate::Vertex;
use crate::surface::seen_normal;
use pineda::{Fragment, Lanes, Mat4, Rgba, Scalar, Shader, Vec3, Vec4, shader, varyings};

/// Shapes, well readable, whatever their materials. Light within 0 to 1: `Rgba8Srgb`, `Rgba32F`.
#[derive(Clone, Debug, PartialEq)]
pub struct Matcap {
    /// World space to clip space.
    pub clip_from_world: Mat4,
    /// From a place towards the eye: this less w times the place. With w = 1 the eye's place; with w = 0 its direction, for a parallel projection.
    pub eye: [f32; 4],
    /// Upwards in the picture, in world space.
    pub up: [f32; 3],
}

varyings! {
    /// A shape at a pixel.
    pub struct Shape {
        /// Towards the eye, in world space.
        pub to_eye: Vec3,
        /// World space, interpolated.
        pub normal: Vec3,
    }
}

/// The vertex stage of what shows shapes.
#[shader]
pub(crate) fn shape(clip_from_world: Mat4, [x, y, z, w]: [f32; 4], vertex: &Vertex) -> (Vec4, Shape) {
    let position = Vec3::from(vertex.position);
    let to_eye = Vec3::from([x, y, z]) - position * w;
    (clip_from_world * position.extend(1.0), Shape { to_eye, normal: vertex.normal.into() })
}

#[shader]
impl Shader for Matcap {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Shape<L>;

    fn vertex(&self, vertex: &Vertex) -> (Vec4, Shape<Scalar>) {
        shape(self.clip_from_world, self.eye, vertex)
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let normal = seen_normal::<L, Self>(f, f.normal);
        let back = f.to_eye.normalize();
        let right = f.splat(self.up).cross(back).normalize();
        let up = back.cross(right);
        let (x, y, z) = (normal.dot(right), normal.dot(up), normal.dot(back).max(0.0));

        let key = (y * 0.66 - x * 0.5 + z * 0.56).max(0.0);
        let bounce = (x * 0.64 - y * 0.64 + z * 0.42).max(0.0);
        let highlight = (y * 0.5 - x * 0.38 + z * 0.778).max(0.0).powi(24);
        let outline = 1.0 - z;
        let clay = f.splat([0.10, 0.065, 0.05]).mix([0.66, 0.37, 0.255], key);
        let lit = clay + f.splat([0.045, 0.075, 0.13]) * bounce + highlight * 0.22;
        Rgba::opaque((lit * (1.0 - outline * outline * 0.55)).clamp(0.0, 1.0))
    }
}
