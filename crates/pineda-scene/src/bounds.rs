//! The box around a scene.

use crate::Scene;

/// An axis-aligned box in world space, closed, never empty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The smallest x, y and z.
    pub min: [f64; 3],
    /// The largest x, y and z.
    pub max: [f64; 3],
}

impl Bounds {
    /// Around every vertex that a triangle, line or point names; vertices that are not finite are passed over. `None` if there are
    /// none, or an index is out of range.
    pub fn of(scene: &Scene) -> Option<Self> {
        let mut min = [f32::INFINITY; 3];
        let mut max = [f32::NEG_INFINITY; 3];
        for object in &scene.objects {
            for index in object.indices() {
                let position = object.vertices.get(index as usize)?.position;
                if position.iter().all(|c| c.is_finite()) {
                    for axis in 0..3 {
                        let c = position[axis];
                        min[axis] = if c < min[axis] { c } else { min[axis] };
                        max[axis] = if c > max[axis] { c } else { max[axis] };
                    }
                }
            }
        }
        (min[0] <= max[0]).then(|| Self { min: min.map(f64::from), max: max.map(f64::from) })
    }

    /// The point in the middle.
    pub fn center(&self) -> [f64; 3] {
        std::array::from_fn(|axis| (self.min[axis] + self.max[axis]) / 2.0)
    }

    /// Half the diagonal: the radius of the sphere around the centre through the corners.
    pub fn radius(&self) -> f64 {
        crate::vector::length(crate::vector::sub(self.max, self.min)) / 2.0
    }
}
