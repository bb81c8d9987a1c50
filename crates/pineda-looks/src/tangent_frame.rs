//! Normal textures: which way their x and y point on a surface, and the normal that they make.
//!
//! x points to where the first texture coordinate grows, and y against where the second one does, for images begin at the top. A model may say so itself by its tangents (made as MikkTSpace makes them: glTF specification, 3.7.2.1). Where it does
//! not, the directions follow from how place and coordinates change from pixel to pixel (Schüler 2006, "Followup: Normal Mapping Without Precomputed Tangents"); three.js does the same.

use pineda::{Lanes, Real, Vec2, Vec3, Vec4, shader};

/// A normal in world space from one that a texture has, `2 rgb - 1` with x and y scaled, in the frame of the model's own tangent. Normal and tangent are as interpolated.
#[shader]
pub(crate) fn from_tangent<L: Lanes>(texel: Vec3<L>, normal: Vec3<L>, tangent: Vec4<L>) -> Vec3<L> {
    let normal = normal.normalize();
    let along = Vec3::new(tangent.x, tangent.y, tangent.z);
    let length = along.length_squared();
    let along = along * length.gt(0.0).select(length.inverse_sqrt(), 0.0);
    let across = normal.cross(along) * tangent.w;
    (along * texel.x + across * texel.y + normal * texel.z).normalize()
}

/// How place and texture coordinates change from a pixel to its right-hand neighbour, and to the one below.
#[derive(Clone, Copy)]
pub(crate) struct Slopes<L: Lanes> {
    pub(crate) position: [Vec3<L>; 2],
    pub(crate) uv: [Vec2<L>; 2],
}

/// The same without a tangent. `facing` is the interpolated normal turned towards the eye by 1 or -1. Where coordinates do not change, the normal stays as it is.
#[shader]
pub(crate) fn from_slopes<L: Lanes>(texel: Vec3<L>, normal: Vec3<L>, facing: Real<L>, slopes: Slopes<L>) -> Vec3<L> {
    let normal = normal.normalize();
    let ([right, down], [uv_right, uv_down]) = (slopes.position, slopes.uv);
    let towards_eye = normal * facing;
    // Perpendicular to the one, so that only the other's change counts.
    let (a, b) = (towards_eye.cross(down), right.cross(towards_eye));
    let along = a * uv_right.x + b * uv_down.x;
    let across = -(a * uv_right.y + b * uv_down.y);
    let longest = along.length_squared().max(across.length_squared());
    let scale = longest.gt(0.0).select(longest.inverse_sqrt(), 0.0);
    (along * (texel.x * scale) + across * (texel.y * scale) + normal * texel.z).normalize()
}
