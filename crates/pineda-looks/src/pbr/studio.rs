//! A photographer's studio, as what can be seen in each direction: soft boxes in a dim room.
//!
//! ```text
//!               top                      seen from above, the camera below:
//!     ______________________
//!    |   /key/       |rim|  |               rim
//!    |  /   /        |   |  |            .-------.
//!    |                      |       key /  model  \ fill
//!    |        model         |           \         /
//!    |______________________|            '-------'
//!          bright floor                     eye
//! ```
//!
//! Light comes in a few large, soft-edged areas, dark between them: it is the reflections of these that show how a thing is curved and how it shines.

use pineda::{Lanes, Rgba, Splat, Vec3, shader};

/// A luminous rectangle, infinitely far away.
#[derive(Clone, Copy, Debug)]
pub(super) struct SoftBox {
    /// Towards its middle, of length 1.
    toward: [f32; 3],
    /// Half its width and height at distance 1.
    half_size: [f32; 2],
    /// How much of that the soft border takes.
    softness: f32,
    /// Linear light.
    color: [f32; 3],
}

/// Towards the key light.
pub(super) const KEY: [f32; 3] = [-0.528_2, 0.699_0, 0.481_9];

/// What shines, in a frame in which the camera looks along -z and y is up.
pub(super) const BOXES: [SoftBox; 5] = [
    // The key light comes first: it shines by itself, too, with a shadow.
    SoftBox { toward: KEY, half_size: [0.42, 0.55], softness: 0.25, color: [11.0, 10.6, 10.0] },
    SoftBox { toward: [0.0, 1.0, 0.0], half_size: [0.9, 0.7], softness: 0.5, color: [1.0, 1.02, 1.06] },
    SoftBox { toward: [0.894_4, 0.178_9, 0.409_9], half_size: [0.28, 0.75], softness: 0.3, color: [2.2, 2.35, 2.6] },
    SoftBox { toward: [0.686_4, 0.343_2, -0.641_1], half_size: [0.16, 0.7], softness: 0.3, color: [7.0, 7.2, 7.6] },
    SoftBox { toward: [-0.842_2, 0.187_2, -0.505_4], half_size: [0.14, 0.6], softness: 0.3, color: [4.0, 4.1, 4.3] },
];

/// The room: its walls at the height of the eye, its ceiling, and its floor.
const WALLS: [f32; 3] = [0.25, 0.255, 0.27];
const CEILING: [f32; 3] = [0.36, 0.375, 0.40];
const FLOOR: [f32; 3] = [0.36, 0.35, 0.34];

/// Radiance by direction, from the soft box numbered `first` on.
#[derive(Debug)]
pub(super) struct Studio {
    pub(super) first: usize,
}

impl Studio {
    #[shader(apart(direction))]
    pub(super) fn color<L: Lanes>(&self, direction: Vec3<L>) -> Rgba<L> {
        let direction = direction.normalize();
        let up = direction.y.max(0.0);
        let down = (-direction.y).max(0.0);
        let mut light = WALLS.splat(direction.lanes()).mix(CEILING, up * (2.0 - up)).mix(FLOOR, down.sqrt());
        for soft_box in &BOXES[self.first..] {
            light += shine(*soft_box, direction);
        }
        Rgba::opaque(light)
    }
}

/// What a soft box adds in a direction.
#[shader]
fn shine<L: Lanes>(soft_box: SoftBox, direction: Vec3<L>) -> Vec3<L> {
    let SoftBox { toward: [x, y, z], half_size: [width, height], softness, color } = soft_box;
    // Upright, but for what hangs from the ceiling.
    let right = if y > 0.99 { [1.0, 0.0, 0.0] } else { [z, 0.0, -x].map(|c: f32| c / (x * x + z * z).sqrt()) };
    let up = [y * right[2] - z * right[1], z * right[0] - x * right[2], x * right[1] - y * right[0]];
    let ahead = direction.dot([x, y, z]).max(1e-3);
    let across = (direction.dot(right) / ahead).abs() / width;
    let above = (direction.dot(up) / ahead).abs() / height;
    let strength = (1.0 - across.smoothstep(1.0 - softness, 1.0)) * (1.0 - above.smoothstep(1.0 - softness, 1.0));
    let seen = direction.dot([x, y, z]).gt(0.0).select(strength, 0.0);
    Vec3::new(seen * color[0], seen * color[1], seen * color[2])
}

/// What the key light gives beside what can be seen of it, where it falls straight on: linear light.
pub(super) const KEY_LIGHT: [f32; 3] = [0.66, 0.64, 0.60];
