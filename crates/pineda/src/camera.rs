//! Views and projections: from the world to the eye, and from the eye to clip space.
//!
//! The world is right-handed. In view space the eye is at the origin and looks down -z, x is to the right and y up. Clip
//! space is the one of [`Space::Clip`](crate::Space): x right, y up, and 0 <= z <= w, near to far.

use crate::math::Mat4;

impl Mat4 {
    /// The view from `eye` towards `target`, with `up` upwards on the picture: world space to view space.
    ///
    /// `up` need be neither of length 1 nor at right angles to the view. Where it says nothing (it is parallel to the
    /// view, or zero), the world axis that is farthest from the view is taken for it; where `eye` and `target` coincide,
    /// the view is down -z. So the result is a rotation and a translation, whatever finite numbers come in.
    #[must_use]
    pub fn look_at(eye: [f32; 3], target: [f32; 3], up: [f32; 3]) -> Self {
        let (eye, target, up) = (eye.map(f64::from), target.map(f64::from), up.map(f64::from));
        let forward = direction(subtract(target, eye)).unwrap_or([0.0, 0.0, -1.0]);
        let right = direction(up)
            .and_then(|up| direction(cross(forward, up)))
            .or_else(|| direction(cross(forward, farthest_axis(forward))))
            .unwrap_or([1.0, 0.0, 0.0]);
        let up = cross(right, forward);
        Self::from_f64([
            [right[0], up[0], -forward[0], 0.0],
            [right[1], up[1], -forward[1], 0.0],
            [right[2], up[2], -forward[2], 0.0],
            [-dot(right, eye), -dot(up, eye), dot(forward, eye), 1.0],
        ])
    }

    /// A perspective projection: view space to clip space.
    ///
    /// `fov_y` is the vertical field of view in radians, between 0 and π; `aspect` is width / height of the viewport; what
    /// lies from `near` to `far` in front of the eye (both above 0) gets depths from 0 to 1. `far` may be infinite;
    /// `near > far` reverses the depths. Values outside these ranges give a matrix that shows nothing sensible (with
    /// `near == far` or a field of view of 0 its elements are not finite, and triangles are dropped), but never a panic.
    #[must_use]
    pub fn perspective(fov_y: f32, aspect: f32, near: f32, far: f32) -> Self {
        let (aspect, near, far) = (f64::from(aspect), f64::from(near), f64::from(far));
        let cotangent = 1.0 / libm::tan(f64::from(fov_y) / 2.0);
        // z = (z_scale z_view + z_offset) / -z_view: 0 at -near, 1 at -far, and the limits where one is infinite.
        let (z_scale, z_offset) = if far.is_infinite() {
            (-1.0, -near)
        } else if near.is_infinite() {
            (0.0, far)
        } else {
            (far / (near - far), near * far / (near - far))
        };
        Self::from_f64([
            [cotangent / aspect, 0.0, 0.0, 0.0],
            [0.0, cotangent, 0.0, 0.0],
            [0.0, 0.0, z_scale, -1.0],
            [0.0, 0.0, z_offset, 0.0],
        ])
    }

    /// A parallel projection: view space to clip space, with w = 1.
    ///
    /// The box from `left` to `right`, `bottom` to `top` and `near` to `far` in front of the eye fills the viewport, with
    /// depths from 0 to 1. `near > far` reverses the depths, `bottom > top` turns the picture upside down. Where two
    /// opposite borders are equal the elements are not finite, and triangles are dropped.
    #[must_use]
    pub fn orthographic(left: f32, right: f32, bottom: f32, top: f32, near: f32, far: f32) -> Self {
        let [left, right, bottom, top, near, far] = [left, right, bottom, top, near, far].map(f64::from);
        Self::from_f64([
            [2.0 / (right - left), 0.0, 0.0, 0.0],
            [0.0, 2.0 / (top - bottom), 0.0, 0.0],
            [0.0, 0.0, 1.0 / (near - far), 0.0],
            [-(right + left) / (right - left), -(top + bottom) / (top - bottom), near / (near - far), 1.0],
        ])
    }
}

/// The vector's direction; `None` if it has none worth the name. Differences and products of f32 coordinates are exact
/// to 1e-16 in f64, so that anything shorter than 1e-12 of a unit vector is rounding, not direction.
fn direction(v: [f64; 3]) -> Option<[f64; 3]> {
    // The largest component first, so that the squares neither overflow nor vanish.
    let largest = v.iter().fold(0.0, |a: f64, b| if b.abs() > a { b.abs() } else { a });
    if largest == 0.0 || !v.iter().all(|x| x.is_finite()) {
        return None;
    }
    let v = v.map(|x| x / largest);
    let length = libm::sqrt(dot(v, v));
    Some(v.map(|x| x / length))
}

/// The unit vector along the axis on which `v` is shortest.
fn farthest_axis(v: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = v.map(f64::abs);
    if x <= y && x <= z {
        [1.0, 0.0, 0.0]
    } else if y <= z {
        [0.0, 1.0, 0.0]
    } else {
        [0.0, 0.0, 1.0]
    }
}

fn subtract(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
