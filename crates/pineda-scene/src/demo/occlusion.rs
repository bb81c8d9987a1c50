//! Contact shadows in vertex colours: how much of the sky a point does not see, without casting a ray.
//!
//! A ball of radius r at the distance d, at the angle a from the normal, hides the part cos a (r / d)^2 of the light
//! from an even sky (Iñigo Quílez, "sphere ambient occlusion"). A short piece of a tube hides what a flat one of its
//! width would: its area over pi d^2, times the cosine.

use std::f64::consts::PI;

use crate::Vertex;
use crate::vector::{Vec3, length, sub, widen};

/// What stands on the floor y = 0.
#[derive(Default)]
pub(super) struct Occluders {
    parts: Vec<Part>,
}

struct Part {
    center: Vec3,
    /// The part of the sky that it hides at the distance 1, straight above.
    size: f64,
}

/// How dark a point is that sees nothing of the sky: other lights reach it.
const DARKEST: f64 = 0.25;

impl Occluders {
    pub(super) fn add_ball(&mut self, center: Vec3, radius: f64) {
        self.parts.push(Part { center, size: radius * radius });
    }

    /// A closed tube around the points of `line`.
    pub(super) fn add_tube(&mut self, line: &[Vec3], radius: f64) {
        for (i, &center) in line.iter().enumerate() {
            let step = length(sub(line[(i + 1) % line.len()], center));
            self.parts.push(Part { center, size: 2.0 * radius * step / PI });
        }
    }

    /// Darkens those vertices of the floor, level and at height 0, that see the occluders.
    pub(super) fn darken_floor(&self, vertices: &mut [Vertex]) {
        for vertex in vertices.iter_mut().filter(|v| v.position[1] == 0.0 && v.normal == [0.0, 1.0, 0.0]) {
            let point = widen(vertex.position);
            // Hidden parts overlap at random, so what is seen is a product.
            let seen = self.parts.iter().fold(1.0, |seen, part| {
                let to_center = sub(part.center, point);
                let distance = length(to_center);
                let hidden = part.size * to_center[1] / (distance * distance * distance);
                seen * (1.0 - if hidden < 1.0 { hidden } else { 1.0 })
            });
            darken(vertex, seen);
        }
    }
}

/// Darkens what stands on the floor: a normal that points down sees the floor in place of the sky, which is bright
/// itself, except close to it, where the thing's own shadow is.
pub(super) fn darken_above_floor(vertices: &mut [Vertex]) {
    /// Height at which half of the floor's light is back.
    const HALF: f64 = 0.08;
    for vertex in vertices {
        let height = f64::from(vertex.position[1]);
        let towards_floor = (1.0 - f64::from(vertex.normal[1])) / 2.0;
        let shadow = HALF / (HALF + if height > 0.0 { height } else { 0.0 });
        darken(vertex, 1.0 - towards_floor * shadow);
    }
}

fn darken(vertex: &mut Vertex, seen: f64) {
    let light = (DARKEST + (1.0 - DARKEST) * seen) as f32;
    for channel in &mut vertex.color[..3] {
        *channel *= light;
    }
}
