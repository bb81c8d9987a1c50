//! A model's own cameras and lights.

use std::sync::Arc;

use crate::vector::{Vec3, cross, normalize};

/// A camera that the file brings along.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// The file's name for it, or for its node; may be empty.
    pub name: Arc<str>,
    /// Where it is, in world space.
    pub eye: [f64; 3],
    /// Where it looks, in world space; of length 1.
    pub forward: [f64; 3],
    /// Which way is up in the picture, in world space; of length 1 and perpendicular to `forward`.
    pub up: [f64; 3],
    /// What it sees.
    pub projection: Projection,
}

/// What a camera sees (glTF specification, 3.10.3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Far things are smaller.
    Perspective {
        /// The vertical angle of view in radians, within 0 to pi.
        fov_y: f64,
        /// Width by height that the camera is meant for; `None` for any picture's.
        aspect: Option<f64>,
        /// Distance of the near plane, above 0.
        near: f64,
        /// Distance of the far plane, beyond the near one; `None` for infinity.
        far: Option<f64>,
    },
    /// All things keep their size.
    Orthographic {
        /// Half the width of what is seen.
        x_mag: f64,
        /// Half the height of what is seen.
        y_mag: f64,
        /// Distance of the near plane, 0 or more.
        near: f64,
        /// Distance of the far plane, beyond the near one.
        far: f64,
    },
}

/// A light that the file brings along (KHR_lights_punctual).
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// The file's name for it, or for its node; may be empty.
    pub name: Arc<str>,
    /// Linear light.
    pub color: [f32; 3],
    /// In lux (lm/m^2) for a directional light, in candela (lm/sr) for the others.
    pub intensity: f32,
    /// Beyond this distance in world space there is no light; infinite for the plain law of the inverse square.
    pub range: f32,
    /// In world space. Of no meaning for a directional light.
    pub position: [f64; 3],
    /// Where the light goes, in world space; of length 1. Of no meaning for a point light.
    pub direction: [f64; 3],
    /// Its kind.
    pub kind: LightKind,
}

/// A kind of light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightKind {
    /// From infinitely far away.
    Directional,
    /// In all directions from one place.
    Point,
    /// In a cone from one place; full within the inner angle, none beyond the outer one.
    Spot {
        /// From the axis, in radians; 0 or more.
        inner_cone_angle: f64,
        /// From the axis, in radians; beyond the inner one, at most half pi.
        outer_cone_angle: f64,
    },
}

/// Unit vectors forward and up of what looks along -z with y up, given the images of y and z; of a map that flattens
/// space, some.
pub(crate) fn forward_and_up(y: Vec3, z: Vec3) -> (Vec3, Vec3) {
    let forward = normalize(z.map(|c| -c)).unwrap_or([0.0, 0.0, -1.0]);
    let others = [y, [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]];
    let right = others.into_iter().find_map(|up| normalize(cross(forward, up))).unwrap_or([1.0, 0.0, 0.0]);
    (forward, normalize(cross(right, forward)).unwrap_or([0.0, 1.0, 0.0]))
}
