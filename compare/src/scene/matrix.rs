//! Just enough camera for the scenes. Matrices are rows, applied to column vectors.

use super::Size;

/// A matrix as rows.
pub(crate) type Matrix = [[f32; 4]; 4];

/// Leaves positions as they are: the scene is given in clip space.
pub(super) const IDENTITY: Matrix =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

/// A camera on the z axis at `distance` from the origin, looking at it along -z, y up. `fov_y` is in radians.
pub(super) fn camera_on_z(distance: f32, fov_y: f32, [width, height]: Size, near: f32, far: f32) -> Matrix {
    let aspect = width as f32 / height as f32;
    let focal = 1.0 / libm::tanf(0.5 * fov_y);
    let depth = far / (near - far);
    [
        [focal / aspect, 0.0, 0.0, 0.0],
        [0.0, focal, 0.0, 0.0],
        [0.0, 0.0, depth, depth * (near - distance)],
        [0.0, 0.0, -1.0, distance],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_is_depth_zero_and_far_is_depth_one() {
        let matrix = camera_on_z(10.0, 0.7, [1920, 1080], 2.0, 20.0);
        for (z, expected) in [(8.0, 0.0), (-10.0, 1.0)] {
            let clip_z = matrix[2][2] * z + matrix[2][3];
            let clip_w = matrix[3][2] * z + matrix[3][3];
            assert!((clip_z / clip_w - expected).abs() < 1e-6);
        }
    }
}
