//! Polygons of any size become triangles; OBJ, PLY and STL share this.
//!
//! A strictly convex polygon is fanned from its first corner, which is what everybody expects of a quad. Any other is
//! cut by [`ear_clip`]. Either way a polygon of n corners becomes n - 2 triangles with the polygon's own winding, and
//! every corner is a corner of some triangle, so that neighbours' edges still meet.

mod ear_clip;
mod flatten;

use crate::Error;
use crate::limits::Budget;
use crate::note::counted;
use ear_clip::EarClipper;

/// Polygons in a row.
#[derive(Clone, Debug)]
pub(crate) struct Polygons<C> {
    corners: Vec<C>,
    sizes: Vec<u32>,
    /// How many had fewer than three corners and were passed over.
    pub(crate) too_small: usize,
}

impl<C> Default for Polygons<C> {
    fn default() -> Self {
        Self { corners: Vec::new(), sizes: Vec::new(), too_small: 0 }
    }
}

impl<C: Copy> Polygons<C> {
    pub(crate) fn reserve(&mut self, polygons: usize) {
        self.corners.reserve(polygons.saturating_mul(3));
        self.sizes.reserve(polygons);
    }

    /// Adds a polygon.
    pub(crate) fn push(&mut self, corners: impl IntoIterator<Item = C>) {
        let before = self.corners.len();
        self.corners.extend(corners);
        match self.corners.len() - before {
            size @ 3.. => self.sizes.push(size as u32),
            _ => {
                self.corners.truncate(before);
                self.too_small += 1;
            }
        }
    }

    pub(crate) fn corners(&self) -> &[C] {
        &self.corners
    }

    pub(crate) fn corners_mut(&mut self) -> &mut [C] {
        &mut self.corners
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.sizes.is_empty()
    }

    /// The number of the polygon that holds the corner number `at`, for messages.
    pub(crate) fn polygon_of_corner(&self, at: usize) -> usize {
        let mut ends = self.sizes.iter().scan(0, |end, &size| {
            *end += size as usize;
            Some(*end)
        });
        ends.position(|end| at < end).unwrap_or(self.sizes.len())
    }

    /// All polygons' triangles, and how many polygons were fanned although they are not convex, because the file's
    /// [`steps_allowed`] were used up.
    pub(crate) fn triangulate(
        &self,
        position: impl Fn(C) -> [f32; 3],
        budget: &mut Budget,
    ) -> Result<(Vec<[C; 3]>, usize), Error> {
        let count = self.corners.len() - 2 * self.sizes.len();
        budget.triangles(count as u64)?;
        let mut triangles = Vec::with_capacity(count);
        let mut clipper = EarClipper::default();
        let mut points = Vec::new();
        let mut gave_up = 0;
        let mut rest = &self.corners[..];
        for &size in &self.sizes {
            let (corners, behind) = rest.split_at(size as usize);
            rest = behind;
            if let [a, b, c] = *corners {
                triangles.push([a, b, c]);
                continue;
            }
            let flat = flatten::flatten(corners.iter().map(|&c| position(c)), &mut points);
            if !flat || flatten::is_strictly_convex(&points) {
                triangles.extend((1..corners.len() - 1).map(|i| [corners[0], corners[i], corners[i + 1]]));
                continue;
            }
            let emit = |t: [u32; 3]| triangles.push(t.map(|i| corners[i as usize]));
            gave_up += usize::from(!clipper.clip(&points, &mut budget.polygon_steps, emit));
        }
        Ok((triangles, gave_up))
    }
}

/// How many steps the polygons of a file of so many bytes may take: seconds at most, and far more than any but a file
/// made for the purpose needs.
pub(crate) fn steps_allowed(bytes: usize) -> u64 {
    (1 << 26) + 8 * bytes as u64
}

/// Notes of what happened to a file's polygons.
pub(crate) fn notes(too_small: usize, gave_up: usize, notes: &mut Vec<String>) {
    if too_small > 0 {
        let faces = counted(too_small, "face", "faces");
        notes.push(format!("{faces} with fewer than three corners skipped"));
    }
    if gave_up > 0 {
        let polygons = counted(gave_up, "very large polygon", "very large polygons");
        notes.push(format!("{polygons} drawn as a fan, although not convex"));
    }
}

#[cfg(test)]
mod tests;
