//! Surfaces of revolution around the y axis.

use std::f64::consts::{PI, TAU};

use super::{Surface, grid, vertex};
use crate::Vertex;
use crate::vector::Vec3;

/// A curve in the half plane of radius and height, from the bottom up, with its normals.
pub(super) struct Profile {
    points: Vec<ProfilePoint>,
}

struct ProfilePoint {
    radius: f64,
    height: f64,
    /// Outwards: along the radius, and up.
    normal: [f64; 2],
}

/// A ball around the origin, of `rings` rings from pole to pole.
pub(super) fn ball(radius: f64, rings: u32) -> Profile {
    let point = |ring: u32| {
        let angle = PI * (f64::from(ring) / f64::from(rings) - 0.5);
        // A pole is on the axis exactly, so that its triangles without area are known.
        let cos = if ring == 0 || ring == rings { 0.0 } else { libm::cos(angle) };
        let normal = [cos, libm::sin(angle)];
        ProfilePoint { radius: radius * normal[0], height: radius * normal[1], normal }
    };
    Profile { points: (0..=rings).map(point).collect() }
}

/// A disc with rounded rims on a wider, thinner one; `radius` is that of its level top, at height 0.
///
/// ```text
///      _______________        0
///     (               )
///     |_______________|
///    (_________________)      -height
/// ```
pub(super) fn plinth(radius: f64, height: f64) -> Profile {
    let (bevel, step) = (0.07, 0.04);
    let (foot, foot_height) = (radius + bevel + step, 2.0 * step);
    let mut profile = Profile { points: Vec::new() };
    profile.flat(0.0, foot, -height, -1.0, 2);
    profile.quarter([foot, step - height], step, -0.5);
    profile.quarter([foot, foot_height - step - height], step, 0.0);
    profile.flat(foot, radius + bevel, foot_height - height, 1.0, 2);
    profile.wall(radius + bevel, foot_height - height, -bevel);
    profile.quarter([radius, -bevel], bevel, 0.0);
    // Fine enough for shadows.
    profile.flat(radius, 0.0, 0.0, 1.0, 64);
    profile
}

impl Profile {
    /// A level ring between two radii.
    fn flat(&mut self, from: f64, to: f64, height: f64, up: f64, steps: u32) {
        for step in 0..=steps {
            let t = f64::from(step) / f64::from(steps);
            self.points.push(ProfilePoint { radius: from + t * (to - from), height, normal: [0.0, up] });
        }
    }

    /// An upright wall.
    fn wall(&mut self, radius: f64, from: f64, to: f64) {
        for height in [from, to] {
            self.points.push(ProfilePoint { radius, height, normal: [1.0, 0.0] });
        }
    }

    /// A quarter of a circle, from the angle `start` (in half turns, 0 is outwards) on upwards.
    fn quarter(&mut self, [x, y]: [f64; 2], radius: f64, start: f64) {
        const STEPS: u32 = 12;
        for step in 0..=STEPS {
            let angle = PI * (start + 0.5 * f64::from(step) / f64::from(STEPS));
            let normal = [libm::cos(angle), libm::sin(angle)];
            self.points.push(ProfilePoint { radius: x + radius * normal[0], height: y + radius * normal[1], normal });
        }
    }

    /// The surface that the profile sweeps in `sides` steps.
    pub(super) fn revolve(&self, center: Vec3, sides: u32) -> Surface {
        let directions: Vec<[f64; 2]> = (0..sides)
            .map(|side| {
                let angle = TAU * f64::from(side) / f64::from(sides);
                [libm::sin(angle), libm::cos(angle)]
            })
            .collect();
        let mut vertices = Vec::with_capacity(self.points.len() * directions.len());
        for point in &self.points {
            for [x, z] in &directions {
                let position = [center[0] + point.radius * x, center[1] + point.height, center[2] + point.radius * z];
                vertices.push(vertex(
                    position,
                    [point.normal[0] * x, point.normal[1], point.normal[0] * z],
                    Vertex::WHITE,
                ));
            }
        }
        let mut triangles = grid(self.points.len() as u32, sides, false);
        // Where the profile touches the axis or has a corner, two points of a ring or two rings are one.
        triangles.retain(|t| {
            let [a, b, c] = t.map(|v| vertices[v as usize].position);
            a != b && b != c && c != a
        });
        (vertices, triangles)
    }
}
