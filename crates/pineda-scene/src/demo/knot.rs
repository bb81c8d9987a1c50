//! A tube along a (2, 3) torus knot, standing upright.

use std::f64::consts::TAU;

use super::{Surface, grid, vertex};
use crate::color::srgb8_table;
use crate::vector::{Vec3, add, cross, dot, normalize, scale, sub};

/// The curve runs twice around a ring and three times around the ring's own tube.
pub(super) struct Knot {
    /// Radius of the ring.
    pub(super) ring: f64,
    /// How far the curve leaves it.
    pub(super) wave: f64,
    /// Radius of the tube along the curve.
    pub(super) tube: f64,
    /// By how much it is turned around the vertical, in radians.
    pub(super) turn: f64,
    /// Along the curve.
    pub(super) segments: u32,
    /// Around the tube.
    pub(super) sides: u32,
}

/// Along the knot, evenly, and round again; sRGB.
const PALETTE: [[u8; 3]; 6] = [
    [0xff, 0x7a, 0x59],
    [0xff, 0xb3, 0x47],
    [0xff, 0x8f, 0x6b],
    [0xe8, 0x4a, 0x7f],
    [0x8e, 0x4e, 0xc6],
    [0xe0, 0x4f, 0x8a],
];

impl Knot {
    /// The tube's surface; the lowest point is at height 0.
    pub(super) fn object(&self) -> Surface {
        let mut vertices = Vec::with_capacity((self.segments * self.sides) as usize);
        let height = self.height();
        for segment in 0..self.segments {
            let t = f64::from(segment) / f64::from(self.segments);
            let (center, tangent) = self.curve(TAU * t);
            // The frame follows the direction away from the ring's middle line, which never is along the curve and
            // comes back to itself after one round, so the tube closes without a twist.
            let outwards = sub(center, self.ring_point(TAU * t));
            let normal = direction(sub(outwards, scale(tangent, dot(outwards, tangent))));
            let binormal = cross(tangent, normal);
            let color = color_along(t);
            for side in 0..self.sides {
                let angle = TAU * f64::from(side) / f64::from(self.sides);
                let out = add(scale(normal, libm::cos(angle)), scale(binormal, libm::sin(angle)));
                let [x, y, z] = self.turned(add(center, scale(out, self.tube)));
                vertices.push(vertex([x, y + height, z], self.turned(out), color));
            }
        }
        // The lowest vertex is a little above the surface's lowest point, and is to touch the floor.
        let lowest =
            vertices.iter().fold(f32::INFINITY, |low, v| if v.position[1] < low { v.position[1] } else { low });
        for vertex in &mut vertices {
            vertex.position[1] -= lowest;
        }
        (vertices, grid(self.segments, self.sides, true))
    }

    /// Points along the middle of the tube.
    pub(super) fn center_line(&self, points: u32) -> Vec<Vec3> {
        let height = self.height();
        let point = |i: u32| {
            let [x, y, z] = self.turned(self.curve(TAU * f64::from(i) / f64::from(points)).0);
            [x, y + height, z]
        };
        (0..points).map(point).collect()
    }

    /// How far the ring's centre is above the floor.
    fn height(&self) -> f64 {
        let steps = 1000;
        let heights = (0..steps).map(|i| self.curve(TAU * f64::from(i) / f64::from(steps)).0[1]);
        self.tube - heights.fold(f64::INFINITY, |low, y| if y < low { y } else { low })
    }

    /// The point of the ring next to the curve's point at `t`; the ring is upright, its axis along z.
    fn ring_point(&self, t: f64) -> Vec3 {
        let [x, y] = around(2.0 * t);
        [self.ring * x, self.ring * y, 0.0]
    }

    /// The curve and its direction at `t` in 0..TAU.
    fn curve(&self, t: f64) -> (Vec3, Vec3) {
        let [x, y] = around(2.0 * t);
        let (sin, cos) = (libm::sin(3.0 * t), libm::cos(3.0 * t));
        let radius = self.ring + self.wave * cos;
        let d_radius = -3.0 * self.wave * sin;
        let point = [radius * x, radius * y, self.wave * sin];
        // d/dt of around(2 t) is 2 (y, -x).
        let tangent = [d_radius * x + 2.0 * radius * y, d_radius * y - 2.0 * radius * x, 3.0 * self.wave * cos];
        (point, direction(tangent))
    }

    fn turned(&self, [x, y, z]: Vec3) -> Vec3 {
        let (sin, cos) = (libm::sin(self.turn), libm::cos(self.turn));
        [cos * x + sin * z, y, cos * z - sin * x]
    }
}

/// Clockwise from the top, so that one of the three lobes points up and the knot stands on the other two.
fn around(angle: f64) -> [f64; 2] {
    [libm::sin(angle), libm::cos(angle)]
}

fn direction(v: Vec3) -> Vec3 {
    normalize(v).expect("the knot has neither cusps nor points on its ring")
}

/// The palette, blended smoothly in linear light; `t` in 0..1.
fn color_along(t: f64) -> [f32; 4] {
    let at = t * PALETTE.len() as f64;
    let first = at as usize;
    let t = at - first as f64;
    let t = t * t * (3.0 - 2.0 * t);
    let linear = |index: usize| PALETTE[index % PALETTE.len()].map(|code| f64::from(srgb8_table()[usize::from(code)]));
    let (from, to) = (linear(first), linear(first + 1));
    let mix = |i: usize| (from[i] + t * (to[i] - from[i])) as f32;
    [mix(0), mix(1), mix(2), 1.0]
}
