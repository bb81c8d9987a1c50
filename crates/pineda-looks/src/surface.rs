//! What the shaders draw, and what they know of it at each pixel.

use pineda::{Fragment, Lanes, Mat4, Shader, Vec2, Vec3, Vec4, shader, varyings};

/// A corner of triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// World space.
    pub position: [f32; 3],
    /// World space, of length 1.
    pub normal: [f32; 3],
    /// The direction in which the first texture coordinate grows, in world space, of length 1, and the bitangent's sign; all 0 if unknown.
    pub tangent: [f32; 4],
    /// Two sets of texture coordinates.
    pub uvs: [[f32; 2]; 2],
    /// Linear light, straight alpha; multiplies the base colour.
    pub color: [f32; 4],
}

impl Default for Vertex {
    /// White, at the origin, without a normal.
    fn default() -> Self {
        Self { position: [0.0; 3], normal: [0.0; 3], tangent: [0.0; 4], uvs: [[0.0; 2]; 2], color: [1.0; 4] }
    }
}

varyings! {
    /// A surface at a pixel.
    pub struct Surface {
        /// World space.
        pub position: Vec3,
        /// World space, interpolated: not quite of length 1.
        pub normal: Vec3,
        /// The vertex colour, in linear light, with straight alpha.
        pub color: Vec4,
        /// The first set of texture coordinates.
        pub uv: Vec2,
        /// The second set.
        pub uv_1: Vec2,
    }
}

/// The vertex stage that the shaders share which know a [`Surface`].
#[shader]
pub(crate) fn surface(clip_from_world: Mat4, vertex: &Vertex) -> (Vec4, Surface) {
    let position = Vec3::from(vertex.position);
    let [uv, uv_1] = vertex.uvs;
    let varyings = Surface {
        position,
        normal: vertex.normal.into(),
        color: vertex.color.into(),
        uv: uv.into(),
        uv_1: uv_1.into(),
    };
    (clip_from_world * position.extend(1.0), varyings)
}

/// The unit normal of the side that is seen.
#[shader]
pub(crate) fn seen_normal<L: Lanes, S: Shader>(f: &Fragment<L, S>, interpolated: Vec3<L>) -> Vec3<L> {
    seen::<L, S>(f, interpolated.normalize())
}

/// A normal, turned to the side that is seen.
#[shader]
pub(crate) fn seen<L: Lanes, S: Shader>(f: &Fragment<L, S>, normal: Vec3<L>) -> Vec3<L> {
    f.front_facing().select(normal, -normal)
}
