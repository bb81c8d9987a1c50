//! Where a fragment of a multisampled pixel is shaded: at the pixel's centre if its triangle covers that, else at the lowest-numbered sample that it covers.
//!
//! Nothing but the triangle decides, not what of it is visible: else a pass that is drawn in several flushes would give other bits. So coverage is found
//! again here, exactly, for the few lanes at triangles' borders. A triangle that covers all samples of a pixel covers its centre, too, which lies within
//! their hull.

use super::parts::{Parts, is_covered};
use super::run::RunView;
use crate::geometry::raster_space::{HALF_PIXEL, SUBPIXELS};
use crate::pass::draw_call::DrawCall;
use crate::raster::samples::Samples;
use crate::raster::top_left::is_top_left;
use crate::raster::triangle_id::TriangleId;
use crate::wide::{Simd, i32x16, mask32x16};

/// Coordinates relative to a pixel's centre up to which edge functions fit i32 at all of its samples: 2 r^2 + 2^8 2 r < 2^31.
const NEAR: i32 = (1 << 15) - 4 * SUBPIXELS;
const _: () = assert!(2 * NEAR as i64 * NEAR as i64 + 4 * HALF_PIXEL as i64 * NEAR as i64 + 1 < i32::MAX as i64);

/// Fragments of a block that may not cover their pixels' centres.
#[derive(Clone, Copy)]
pub(crate) struct Borders<'a> {
    /// The triangle of each lane.
    pub(crate) ids: &'a [u32; 16],
    /// The lanes that are asked for, at least one.
    pub(crate) mask: u32,
    /// The block's first pixel.
    pub(crate) x: i32,
    pub(crate) y: i32,
    pub(crate) samples: Samples,
}

impl Borders<'_> {
    /// How far off its pixel's centre each lane is shaded, in subpixels; 0 of those that are not asked for. Of any triangles, lines and points.
    #[inline(never)]
    pub(crate) fn offsets(&self, call: &dyn DrawCall, run: &RunView<'_>) -> [[i32; 16]; 2] {
        let mut offsets = [[0; 16]; 2];
        // Neighbours mostly show the same triangle, and one that is clipped is clipped anew.
        let (mut last, mut parts) = (TriangleId(0), Parts::Wholes);
        let mut rest = self.mask;
        while rest != 0 {
            let lane = rest.trailing_zeros() as usize & 15;
            rest &= rest - 1;
            let (column, row) = ((lane & 3) as i32, (lane >> 2) as i32);
            let center = [(self.x + column) * SUBPIXELS + HALF_PIXEL, (self.y + row) * SUBPIXELS + HALF_PIXEL];
            let id = TriangleId(self.ids[lane]);
            if id != last {
                (last, parts) = (id, Parts::of(call, run, id));
            }
            [offsets[0][lane], offsets[1][lane]] =
                first_covered(self.samples, |offset| parts.cover([center[0] + offset[0], center[1] + offset[1]]));
        }
        offsets
    }
}

/// The first of a pixel's centre and its samples that is covered.
fn first_covered(samples: Samples, covers: impl FnMut(&[i32; 2]) -> bool) -> [i32; 2] {
    let offsets = (0..samples.count()).map(|sample| samples.offset(sample));
    std::iter::once([0, 0]).chain(offsets).find(covers).unwrap_or([0, 0])
}

/// How far off their pixels' centres the lanes of a mask are shaded, in the lanes: of triangles on the raster whose edge functions fit i32 in all of the pixel. Of each edge
/// there is the edge function at the pixel's centre, and what it gains a subpixel right and a subpixel down.
#[inline(always)]
pub(super) fn centroid_offsets<S: Simd>(
    s: S,
    edges: [[i32x16<S>; 3]; 3],
    mask: u32,
    samples: Samples,
) -> [i32x16<S>; 2] {
    let none = i32x16::splat(s, 0);
    let e0 = edges[0][0] - rule(s, &edges[0]);
    let e1 = edges[1][0] - rule(s, &edges[1]);
    let e2 = edges[2][0] - rule(s, &edges[2]);
    let (mut x, mut y) = (none, none);
    let moves = (e0 | e1 | e2).simd_lt(0) & mask32x16::from_bitmask(s, u64::from(mask));
    if !moves.all_false() {
        let mut sample = samples.count();
        while sample > 0 {
            sample -= 1;
            let [ox, oy] = samples.offset(sample);
            let inside = (e0 + edges[0][1] * ox + edges[0][2] * oy)
                | (e1 + edges[1][1] * ox + edges[1][2] * oy)
                | (e2 + edges[2][1] * ox + edges[2][2] * oy);
            let inside = inside.simd_ge(0) & moves;
            x = inside.select(none + ox, x);
            y = inside.select(none + oy, y);
        }
    }
    [x, y]
}

/// 0 for top and left edges, 1 for others.
#[inline(always)]
fn rule<S: Simd>(s: S, [_, right, down]: &[i32x16<S>; 3]) -> i32x16<S> {
    let none = i32x16::splat(s, 0);
    is_top_left(*down, -*right).select(none, none + 1)
}

/// The same for triangles of any size, by their vertices relative to the pixels' centres.
#[inline(always)]
pub(super) fn centroid_offsets_of_vertices<S: Simd>(
    s: S,
    x: [i32x16<S>; 3],
    y: [i32x16<S>; 3],
    mask: u32,
    samples: Samples,
) -> [i32x16<S>; 2] {
    let low = x[0].min(x[1]).min(x[2]).min(y[0]).min(y[1]).min(y[2]);
    let high = x[0].max(x[1]).max(x[2]).max(y[0]).max(y[1]).max(y[2]);
    if !(low.simd_lt(-NEAR) | high.simd_gt(NEAR)).all_false() {
        let (x, y) = ([x[0].into(), x[1].into(), x[2].into()], [y[0].into(), y[1].into(), y[2].into()]);
        let [ox, oy] = far_offsets(x, y, mask, samples);
        return [i32x16::simd_from(s, ox), i32x16::simd_from(s, oy)];
    }
    centroid_offsets(s, [edge(x, y, 0, 1), edge(x, y, 1, 2), edge(x, y, 2, 0)], mask, samples)
}

/// The edge function from vertex a to vertex b at (0, 0), and what it gains to the right and down.
#[inline(always)]
fn edge<S: Simd>(x: [i32x16<S>; 3], y: [i32x16<S>; 3], a: usize, b: usize) -> [i32x16<S>; 3] {
    [x[a] * y[b] - x[b] * y[a], y[a] - y[b], x[b] - x[a]]
}

#[inline(never)]
fn far_offsets(x: [[i32; 16]; 3], y: [[i32; 16]; 3], mask: u32, samples: Samples) -> [[i32; 16]; 2] {
    let mut offsets = [[0; 16]; 2];
    for lane in (0..16).filter(|lane| mask >> lane & 1 != 0) {
        let triangle = [0, 1, 2].map(|k| [x[k][lane], y[k][lane]]);
        [offsets[0][lane], offsets[1][lane]] = first_covered(samples, |&offset| is_covered(triangle, offset));
    }
    offsets
}
