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
        let forward = direction(subtract(target, eye), 0.0).unwrap_or([0.0, 0.0, -1.0]);
        let right = direction(up, 0.0)
            .and_then(|up| direction(cross(forward, up), PARALLEL))
            .or_else(|| direction(cross(forward, farthest_axis(forward)), 0.0))
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

/// The sine of the angle up to which two directions count as parallel: less is the rounding of f32 coordinates.
const PARALLEL: f64 = 1e-7;

/// The vector of length 1 in the direction of `v`; `None` if `v` is no longer than `least`, or not finite.
fn direction(v: [f64; 3], least: f64) -> Option<[f64; 3]> {
    let length = dot(v, v).sqrt();
    (length > least && length.is_finite()).then(|| v.map(|x| x / length))
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::Scalar;
    use crate::math::{Vec3, Vec4};

    const UP: [f32; 3] = [0.0, 1.0, 0.0];

    fn map(m: Mat4, point: [f32; 3]) -> [f32; 4] {
        let v: Vec4<Scalar> = m * Vec3::from(point).extend(1.0);
        v.into()
    }

    #[test]
    fn look_at_puts_the_target_on_the_negative_z_axis_and_up_above_it() {
        let view = Mat4::look_at([5.0, 0.0, 0.0], [0.0; 3], UP);
        assert_eq!(map(view, [5.0, 0.0, 0.0]), [0.0, 0.0, 0.0, 1.0], "the eye");
        assert_eq!(map(view, [0.0; 3]), [0.0, 0.0, -5.0, 1.0], "the target");
        assert_eq!(map(view, UP), [0.0, 1.0, -5.0, 1.0], "up is up");
        // Seen from +x towards -x with y up, -z is to the right.
        assert_eq!(map(view, [0.0, 0.0, -1.0])[0], 1.0);
    }

    #[test]
    fn look_at_is_a_rotation_whatever_it_is_given() {
        for (eye, target, up) in [
            ([0.0; 3], [0.0; 3], UP),
            ([1.0, 2.0, 3.0], [1.0, 2.0, 3.0], [0.0; 3]),
            ([0.0; 3], [0.0, 5.0, 0.0], UP),
            ([0.1, 0.2, 0.3], [1.1, 2.2, 3.3], [1.0, 2.0, 3.0]),
            ([0.0; 3], [1.0, 1.0, 1.0], [-3.0, -3.0, -3.0]),
            ([0.0; 3], [1e-38, 0.0, 0.0], [0.0, 1e30, 0.0]),
            ([3e38, 0.0, 0.0], [-3e38, 0.0, 0.0], UP),
        ] {
            let Mat4([x, y, z, _]) = Mat4::look_at(eye, target, up);
            // The columns' first three elements are the rows of the rotation's inverse.
            let rows = [[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]].map(|row| row.map(f64::from));
            for (i, row) in rows.iter().enumerate() {
                for (k, other) in rows.iter().enumerate() {
                    let product = dot(*row, *other) - f64::from(u8::from(i == k));
                    assert!(product.abs() < 1e-6, "{eye:?} {target:?} {up:?}: rows {i} and {k}");
                }
            }
            assert!(dot(cross(rows[0], rows[1]), rows[2]) > 0.999, "right-handed");
        }
    }

    #[test]
    fn projections_map_near_to_0_and_far_to_1() {
        for (near, far) in [(0.5, 100.0), (100.0, 0.5), (1.0, f32::INFINITY), (f32::INFINITY, 1.0)] {
            let camera = Mat4::perspective(1.2, 2.0, near, far);
            for (distance, depth) in [(near, 0.0), (far, 1.0)] {
                let distance = if distance.is_finite() { distance } else { 1e30 };
                let [_, _, z, w] = map(camera, [0.0, 0.0, -distance]);
                assert_eq!(w, distance);
                assert!((z / w - depth).abs() < 1e-6, "{near} to {far}: {z} / {w} at {distance}");
            }
        }
        let camera = Mat4::orthographic(-2.0, 6.0, -1.0, 3.0, 1.0, 9.0);
        assert_eq!(map(camera, [-2.0, -1.0, -1.0]), [-1.0, -1.0, 0.0, 1.0]);
        assert_eq!(map(camera, [6.0, 3.0, -9.0]), [1.0, 1.0, 1.0, 1.0]);
        assert_eq!(map(camera, [2.0, 1.0, -5.0]), [0.0, 0.0, 0.5, 1.0]);
    }

    #[test]
    fn perspective_has_its_field_of_view_from_border_to_border() {
        let camera = Mat4::perspective(core::f32::consts::FRAC_PI_2, 2.0, 1.0, 10.0);
        let [x, y, _, w] = map(camera, [4.0, 2.0, -2.0]);
        assert!((x / w - 1.0).abs() < 1e-6 && (y / w - 1.0).abs() < 1e-6, "{x} {y} {w}");
    }

    #[test]
    fn degenerate_projections_do_not_panic() {
        for x in [0.0, -1.0, f32::NAN, f32::INFINITY, f32::MAX] {
            let _ = Mat4::perspective(x, x, x, x);
            let _ = Mat4::orthographic(x, x, x, x, x, x);
            let _ = Mat4::look_at([x; 3], [x; 3], [x; 3]);
        }
    }
}
