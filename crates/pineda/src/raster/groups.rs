//! Coverage that is known pixel by pixel, as records: those of [small triangles](SmallTriangle), each of which holds the coverage of 2 x 2 blocks.
//!
//! Groups of 8 x 8 pixels lie where 8 divides their first pixel's coordinates, and so within a tile of any size: which of them there are depends on
//! nothing but the picture. A group's depths are anchored at its first pixel's centre, and are the same for all samples of a pixel.

use super::bins::{BinEntry, Kind, Share, TileGrid};
use super::record::{DepthPlane, SmallTriangle, plane_bits};
use super::samples::SampleSet;
use crate::geometry::raster_space::{HALF_PIXEL, SUBPIXELS};

/// log2 of a group's side in pixels.
const GROUP_BITS: i32 = 3;

/// A depth that is linear over the picture, in subpixels; in f64, so that any group can have an anchor of its own.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LinearDepth {
    /// Where `z` is.
    pub(crate) at: [i32; 2],
    pub(crate) z: f64,
    pub(crate) dz_dx: f64,
    pub(crate) dz_dy: f64,
}

impl LinearDepth {
    /// The same everywhere.
    pub(crate) fn constant(z: f32) -> Self {
        Self { at: [0; 2], z: z.into(), dz_dx: 0.0, dz_dy: 0.0 }
    }

    /// From a to b, and the same across the line. They must not be the same point.
    pub(crate) fn along(a: [i32; 2], b: [i32; 2], za: f32, zb: f32) -> Self {
        let (dx, dy) = (f64::from(b[0] - a[0]), f64::from(b[1] - a[1]));
        // Integers below 2^50: exact.
        let length_squared = dx * dx + dy * dy;
        let rise = f64::from(zb) - f64::from(za);
        Self { at: a, z: za.into(), dz_dx: rise * dx / length_squared, dz_dy: rise * dy / length_squared }
    }

    /// At a place on the raster.
    pub(crate) fn at(&self, [x, y]: [i32; 2]) -> f32 {
        let distance = |to: i32, from: i32| f64::from(to - from);
        (self.z + (self.dz_dx * distance(x, self.at[0]) + self.dz_dy * distance(y, self.at[1]))) as f32
    }

    /// The plane, anchored at the first sample of group (x, y).
    fn at_group(&self, x: i32, y: i32) -> DepthPlane {
        let distance = |group: i32, from: i32| f64::from((group << GROUP_BITS) * SUBPIXELS + HALF_PIXEL - from);
        let z = self.z + (self.dz_dx * distance(x, self.at[0]) + self.dz_dy * distance(y, self.at[1]));
        let subpixels = f64::from(SUBPIXELS);
        DepthPlane { z0: z as f32, dz_dx: (self.dz_dx * subpixels) as f32, dz_dy: (self.dz_dy * subpixels) as f32 }
    }
}

/// Collects pixels into groups. A primitive's pixels must come group by group.
pub(crate) struct Groups<'a> {
    share: &'a mut Share,
    grid: TileGrid,
    /// All of a pixel's samples are covered, or none.
    samples: SampleSet,
    /// Of the primitive that is covered: see [`TriangleId`](super::triangle_id::TriangleId).
    id: u32,
    depth: LinearDepth,
    /// The group that is being filled, and the coverage of its left two blocks, and of its right two.
    group: [i32; 2],
    masks: [u32; 2],
}

impl<'a> Groups<'a> {
    pub(crate) fn new(share: &'a mut Share, grid: TileGrid, samples: SampleSet, id: u32, depth: LinearDepth) -> Self {
        Self { share, grid, samples, id, depth, group: [0; 2], masks: [0; 2] }
    }

    /// Covers a pixel of the picture.
    #[inline(always)]
    pub(crate) fn cover(&mut self, x: i32, y: i32) {
        let group = [x >> GROUP_BITS, y >> GROUP_BITS];
        if group != self.group {
            self.finish();
            self.group = group;
        }
        let bit = (y & 3) * 4 + (x & 3) + ((y >> 2) & 1) * 16;
        self.masks[(x >> 2) as usize & 1] |= 1 << bit;
    }

    /// Leaves the record of the last group.
    pub(crate) fn finish(&mut self) {
        let [left, right] = std::mem::take(&mut self.masks);
        if left | right == 0 {
            return;
        }
        let [x, y] = self.group;
        let DepthPlane { z0, dz_dx, dz_dy } = self.depth.at_group(x, y);
        let first_block = (2 * x) | (2 * y) << 16;
        let depth = [z0, dz_dx, dz_dy].map(f32::to_bits);
        let tile = |group: i32| ((group << GROUP_BITS) >> self.grid.log2) as usize;
        let bin = tile(y) * self.grid.columns as usize + tile(x);
        let mut rest = self.samples.mask;
        while let Some(sample) = self.samples.take(&mut rest) {
            let at = (first_block | plane_bits(sample.plane)) as u32;
            self.share.bins[bin].push(BinEntry::new(Kind::Small, self.share.small.len()));
            self.share.small.push(SmallTriangle([self.id, at, left, right, depth[0], depth[1], depth[2], 0]));
        }
    }
}
