//! Framing by what is seen: the camera moves until the silhouette fits the picture.
//!
//! The direction of the view and the lens stay. In the camera's own axes (x right, y up, z back) an eye e sees a point p within borders of slope t if
//!
//! ```text
//!  (p.x - e.x) <= t (e.z - p.z)        e.x + t e.z >=  p.x + t p.z
//! -(p.x - e.x) <= t (e.z - p.z)   or  -e.x + t e.z >= -p.x + t p.z
//! ```
//!
//! and likewise for y. So of all points only the largest `x + t z`, `-x + t z`, `y + t z` and `-y + t z` count, and the nearest eye that satisfies all four follows at once.

use crate::vector::{Vec3, add, cross, dot, normalize, scale, sub, widen};
use crate::{Framing, Lens, Scene};

/// How much of the picture's width or height the silhouette takes: 2 % stay free on each side.
const FILLED: f64 = 0.96;

impl Framing {
    /// The same view of `scene`, as near as all of its triangles, lines and points are still in a picture of this aspect (width over height), and no silhouette off its middle. Near and far plane
    /// are what it needs.
    ///
    /// A scene that is seen as a single point leaves the framing as it is.
    #[must_use]
    pub fn tightened(&self, scene: &Scene, aspect: f64) -> Self {
        let back = normalize(sub(self.eye, self.target)).unwrap_or([0.0, 0.0, 1.0]);
        let right = normalize(cross(self.up, back)).unwrap_or([1.0, 0.0, 0.0]);
        let up = cross(back, right);
        let slope = match self.lens {
            Lens::Perspective { fov_y } => libm::tan(fov_y / 2.0) * FILLED,
            Lens::Orthographic { .. } => 0.0,
        };
        let mut extent = Extent::new([slope * aspect, slope]);
        for object in &scene.objects {
            let mut is_named = vec![false; object.vertices.len()];
            object.indices().for_each(|index| is_named[index as usize] = true);
            for (vertex, _) in object.vertices.iter().zip(&is_named).filter(|(_, is_named)| **is_named) {
                let p = sub(widen(vertex.position), self.target);
                if p.iter().all(|c| c.is_finite()) {
                    extent.add([dot(p, right), dot(p, up), dot(p, back)]);
                }
            }
        }
        let [near_z, far_z] = [extent.nearest, extent.farthest];
        let [x, y] = extent.borders.map(|[low, high]| (high - low) / 2.0);
        let [width, height] = extent.borders.map(|[low, high]| (high + low) / 2.0);
        let spread = larger(width - slope * aspect * far_z, height - slope * far_z);
        let size = larger(spread, near_z - far_z);
        if !(size > 0.0 && size.is_finite()) {
            return *self;
        }
        let (z, lens) = match self.lens {
            // An eye on what it sees would have no near plane.
            Lens::Perspective { .. } => {
                (larger(larger(width / (slope * aspect), height / slope), near_z + 0.01 * size), self.lens)
            }
            Lens::Orthographic { .. } => {
                let half_height = larger(larger(width / aspect, height), 1e-6 * size) / FILLED;
                (near_z + size, Lens::Orthographic { half_height })
            }
        };
        let place = |z: f64| add(self.target, add(add(scale(right, x), scale(up, y)), scale(back, z)));
        let middle = (near_z + far_z) / 2.0;
        Self {
            eye: place(z),
            target: place(middle),
            up: self.up,
            lens,
            near: 0.95 * (z - near_z),
            far: 1.05 * (z - far_z) + 0.01 * (z - near_z),
        }
    }
}

/// The outermost points, in the camera's axes.
struct Extent {
    slopes: [f64; 2],
    /// Of x and of y: the largest of `-x + t z`, and of `x + t z`.
    borders: [[f64; 2]; 2],
    nearest: f64,
    farthest: f64,
}

impl Extent {
    fn new(slopes: [f64; 2]) -> Self {
        let none = f64::NEG_INFINITY;
        Self { slopes, borders: [[none; 2]; 2], nearest: none, farthest: f64::INFINITY }
    }

    fn add(&mut self, p: Vec3) {
        for axis in 0..2 {
            let behind = self.slopes[axis] * p[2];
            let [low, high] = self.borders[axis];
            self.borders[axis] = [larger(low, behind - p[axis]), larger(high, behind + p[axis])];
        }
        self.nearest = larger(self.nearest, p[2]);
        self.farthest = if p[2] < self.farthest { p[2] } else { self.farthest };
    }
}

fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Bounds, Object, Vertex, View};

    fn triangle(corners: [[f32; 3]; 3]) -> Scene {
        let object =
            Object { vertices: corners.map(Vertex::at).to_vec(), triangles: vec![[0, 1, 2]], ..Object::default() };
        Scene { objects: vec![object], ..Scene::default() }
    }

    /// Where the corners are in the picture, -1 to 1 both ways.
    fn projected(scene: &Scene, framing: &Framing, aspect: f64) -> Vec<[f64; 2]> {
        let back = normalize(sub(framing.eye, framing.target)).unwrap();
        let right = normalize(cross(framing.up, back)).unwrap();
        let up = cross(back, right);
        let project = |vertex: &Vertex| {
            let p = sub(widen(vertex.position), framing.eye);
            let distance = -dot(p, back);
            assert!(framing.near < distance && distance < framing.far, "{framing:?}");
            let half = match framing.lens {
                Lens::Perspective { fov_y } => distance * libm::tan(fov_y / 2.0),
                Lens::Orthographic { half_height } => half_height,
            };
            [dot(p, right) / (half * aspect), dot(p, up) / half]
        };
        scene.objects[0].vertices.iter().map(project).collect()
    }

    #[test]
    fn tight_silhouettes_touch_two_borders_and_are_in_the_middle() {
        let scene = triangle([[5.0, 0.0, 0.0], [8.0, 0.5, -4.0], [6.0, 2.0, 1.0]]);
        for orthographic in [false, true] {
            for aspect in [0.4, 1.0, 2.5] {
                for azimuth in [0.0, 40.0, 170.0] {
                    let view = View { azimuth, aspect, orthographic, ..View::default() };
                    let framing = Framing::new(&Bounds::of(&scene).unwrap(), &view).unwrap();
                    let tight = framing.tightened(&scene, aspect);
                    let corners = projected(&scene, &tight, aspect);
                    let most = |axis: usize, sign: f64| corners.iter().fold(-9.0, |m, c| larger(m, sign * c[axis]));
                    let [x, y] = [0, 1].map(|axis| [most(axis, -1.0), most(axis, 1.0)]);
                    let touches = |[low, high]: [f64; 2]| (low - FILLED).abs() < 1e-9 && (high - FILLED).abs() < 1e-9;
                    assert!(touches(x) || touches(y), "{view:?}: {corners:?}");
                    assert!([x, y].as_flattened().iter().all(|c| *c < FILLED + 1e-9), "{view:?}: {corners:?}");
                }
            }
        }
    }

    #[test]
    fn tight_framing_of_a_point_is_what_it_was() {
        let scene = triangle([[1.0; 3]; 3]);
        let framing = Framing::new(&Bounds::of(&scene).unwrap(), &View::default()).unwrap();
        assert_eq!(framing.tightened(&scene, 1.0), framing);
    }
}
