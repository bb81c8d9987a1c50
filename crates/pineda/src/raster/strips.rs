//! Coverage that is known row by row, as records of the usual kinds, all with the triangle's own plane of depth.
//!
//! Eight rows of pixels at a time, a *strip*. Where all of them are covered over some columns, a multiple of eight, these are one [mid record](MidTriangle) whose edges everything is inside
//! of. What is left at both ends is
//!
//! - for triangles that are not large, [small records](SmallTriangle) of 8 x 8 pixels with their coverage as masks;
//! - else a mid record for each row and end. A small record could not say how far away the anchor is, and depths from another one would be other bits.
//!
//! Strips and groups begin where 8 divides their coordinates, and so lie within a tile of any size: which of them there are depends on nothing but the picture.

use super::bins::{BinEntry, Kind, Share, TileGrid, bin};
use super::record::{DepthPlane, MidTriangle, SampleBox, SmallTriangle, plane_bits};
use super::rows::{Point, Stretch};
use super::samples::{Sample, SampleSet};
use crate::geometry::raster_space::{HALF_PIXEL, SUBPIXELS};

/// Rows of a strip, and the side of a group.
pub(crate) const ROWS: i32 = 8;

/// How far a triangle may reach from its anchor, in subpixels, for small records: it may touch a pixel whose centre is half a pixel further away, and a group may begin seven
/// pixels before that one, at a distance that fits an i16, whichever the sample.
const SMALL_REACH: i32 = 120 * SUBPIXELS;
const _: () = assert!(SMALL_REACH + HALF_PIXEL + 7 * SUBPIXELS / 16 + (ROWS - 1) * SUBPIXELS <= i16::MAX as i32);

/// A plane of depth, and the vertex that it is anchored at.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AnchoredPlane {
    pub(crate) anchor: Point,
    pub(crate) depth: DepthPlane,
}

impl AnchoredPlane {
    /// The distance of a sample of pixel (x, y) from the anchor, in subpixels; the sample is so far off the pixel's centre.
    fn distance(&self, x: i32, y: i32, [ox, oy]: [i32; 2]) -> [i32; 2] {
        let center = |v: i32| v * SUBPIXELS + HALF_PIXEL;
        [center(x) + ox - self.anchor[0], center(y) + oy - self.anchor[1]]
    }
}

/// Takes a triangle's coverage strip by strip.
pub(crate) struct Strips<'a> {
    share: &'a mut Share,
    grid: TileGrid,
    /// All of a pixel's samples are covered, or none.
    samples: SampleSet,
    /// See [`TriangleId`](super::triangle_id::TriangleId).
    id: u32,
    plane: AnchoredPlane,
    is_near: bool,
}

impl<'a> Strips<'a> {
    /// Of a triangle that reaches nowhere further from its plane's anchor than so many subpixels, in x or in y.
    pub(crate) fn new(
        share: &'a mut Share,
        grid: TileGrid,
        samples: SampleSet,
        id: u32,
        plane: AnchoredPlane,
        reach: i32,
    ) -> Self {
        Self { share, grid, samples, id, plane, is_near: reach <= SMALL_REACH }
    }

    /// Covers stretches of the eight rows of a strip; each row's come from left to right and do not meet.
    pub(crate) fn cover(&mut self, strip: i32, rows: &[Vec<Stretch>; ROWS as usize]) {
        let [first, end] = inner(rows);
        if first < end {
            self.whole(strip * ROWS, [first, end]);
        }
        // On both sides of it.
        let parts = |&[a, b]: &Stretch| [[a, b.min(first)], [a.max(end), b]];
        if self.is_near {
            let (mut left, mut right) = (i32::MAX, i32::MIN);
            for &[a, b] in rows.iter().flatten() {
                (left, right) = (left.min(a), right.max(b));
            }
            let mut x = left & -ROWS;
            while x < right {
                if first <= x && x < end {
                    x = end;
                    continue;
                }
                self.group(x, strip * ROWS, rows);
                x += ROWS;
            }
            return;
        }
        for (y, stretches) in (strip * ROWS..).zip(rows) {
            for part in stretches.iter().flat_map(parts).filter(|part| part[0] < part[1]) {
                self.row(y, part);
            }
        }
    }

    /// The group of 8 x 8 pixels at (x, y).
    fn group(&mut self, x: i32, y: i32, rows: &[Vec<Stretch>; ROWS as usize]) {
        let (mut left, mut right) = (0, 0);
        for (k, stretches) in rows.iter().enumerate() {
            for &[a, b] in stretches {
                let (a, b) = ((a - x).clamp(0, ROWS), (b - x).clamp(0, ROWS));
                let bits = (1 << b) - (1 << a);
                let bits = if a < b { bits } else { 0u32 };
                left |= (bits & 15) << (4 * k);
                right |= (bits >> 4) << (4 * k);
            }
        }
        if left | right == 0 {
            return;
        }
        let DepthPlane { z0, dz_dx, dz_dy } = self.plane.depth;
        let mut rest = self.samples.mask;
        while let Some(Sample { plane, offset }) = self.samples.take(&mut rest) {
            let [dx, dy] = self.plane.distance(x, y, offset);
            debug_assert!(i16::try_from(dx).is_ok() && i16::try_from(dy).is_ok());
            let entry = BinEntry::new(Kind::Small, self.share.small.len());
            self.share.small.push(SmallTriangle([
                self.id,
                (x >> 2 | (y >> 2) << 16 | plane_bits(plane)) as u32,
                left,
                right,
                z0.to_bits(),
                dz_dx.to_bits(),
                dz_dy.to_bits(),
                ((dx & 0xffff) | dy << 16) as u32,
            ]));
            self.enter([x, x], [y, y], entry);
        }
    }

    /// All of a strip's rows from row `y` on, over columns that eight divides.
    fn whole(&mut self, y: i32, [first, end]: Stretch) {
        self.mid([first, end - 1], [y, y + ROWS - 1], [[0; 3]; 3]);
    }

    /// One row of a stretch: not above the row, not left of the stretch, not right of it. The second edge leans so far that further below nothing of the block's rows is left.
    fn row(&mut self, y: i32, [first, end]: Stretch) {
        let (last, width) = (end - 1, end - first);
        let (x0, y0) = (first & -4, y & -4);
        let lean = width + 4;
        let edges = [[y0 - y, 0, 1], [x0 - first - lean * (y0 - y), 1, -lean], [last - x0, -1, 0]];
        self.mid([first, last], [y, y], edges);
    }

    /// A mid record over columns and rows, with edge functions over 256 by their values at the first sample of its blocks and their steps right and down.
    fn mid(&mut self, columns: [i32; 2], rows: [i32; 2], edges: [[i32; 3]; 3]) {
        let DepthPlane { z0, dz_dx, dz_dy } = self.plane.depth;
        let pair = |[first, last]: [i32; 2]| (first | last << 16) as u32;
        let steps = edges.map(|[_, right, down]| {
            debug_assert!(i16::try_from(right).is_ok() && i16::try_from(down).is_ok());
            ((right & 0xffff) | down << 16) as u32
        });
        let mut rest = self.samples.mask;
        while let Some(Sample { plane, offset }) = self.samples.take(&mut rest) {
            let [dx, dy] = self.plane.distance(columns[0] & -4, rows[0] & -4, offset);
            let entry = BinEntry::new(Kind::Mid, self.share.mid.len());
            self.share.mid.push(MidTriangle([
                self.id,
                pair(columns),
                pair(rows),
                z0.to_bits(),
                dz_dx.to_bits(),
                dz_dy.to_bits(),
                dx as u32,
                dy as u32,
                edges[0][0] as u32,
                edges[1][0] as u32,
                edges[2][0] as u32,
                steps[0],
                steps[1],
                steps[2],
                plane,
                0,
            ]));
            self.enter(columns, rows, entry);
        }
    }

    /// Enters a record into the bins of the tiles that these columns and rows lie in.
    fn enter(&mut self, columns: [i32; 2], rows: [i32; 2], entry: BinEntry) {
        let tile = |v: i32| v >> self.grid.log2;
        let tiles = SampleBox { x0: tile(columns[0]), x1: tile(columns[1]), y0: tile(rows[0]), y1: tile(rows[1]) };
        bin(&mut self.share.bins, &self.grid, tiles, entry);
    }
}

/// The columns, a multiple of eight, that all rows cover; empty if there are none.
fn inner(rows: &[Vec<Stretch>; ROWS as usize]) -> Stretch {
    let mut inner = [i32::MIN, i32::MAX];
    for stretches in rows {
        let &[[first, end]] = &stretches[..] else { return [0, 0] };
        inner = [inner[0].max(first), inner[1].min(end)];
    }
    let [first, end] = [(inner[0] + ROWS - 1) & -ROWS, inner[1] & -ROWS];
    if first < end { [first, end] } else { [0, 0] }
}
