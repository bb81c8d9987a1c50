//! Where a fragment of a multisampled pixel is shaded: at the pixel's centre if its triangle covers that, else at the lowest-numbered sample that it covers.
//!
//! Nothing but the triangle decides, not what of it is visible: else a pass that is drawn in several flushes would give other bits. So coverage is found
//! again here, exactly, for the few lanes at triangles' borders. A triangle that covers all samples of a pixel covers its centre, too, which lies within
//! their hull.

use super::by_lane::ByLane;
use super::run::{RunView, record_rows};
use crate::geometry::clip::{ClipTriangle, clip};
use crate::geometry::raster_space::{HALF_PIXEL, SUBPIXELS, ScreenVertex};
use crate::pass::draw_call::DrawCall;
use crate::raster::samples::Samples;
use crate::raster::stroke::triangles_of;
use crate::raster::top_left::{is_top_left, is_top_left_edge};
use crate::raster::triangle_id::{CLIPPED_CLOCKWISE, ORDER_BITS, TriangleId};
use crate::tile::view::BlockLanes;
use crate::wide::{Simd, i32x16, mask32x16, u32x16};

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
    /// How far off its pixel's centre each lane is shaded, in subpixels; 0 of those that are not asked for.
    #[inline(always)]
    pub(crate) fn offsets<S: Simd>(&self, s: S, call: &dyn DrawCall, run: &RunView<'_>) -> [[i32; 16]; 2] {
        let first = self.ids[self.mask.trailing_zeros() as usize & 15];
        let asked = mask32x16::from_bitmask(s, u64::from(self.mask));
        let ids = asked.select(u32x16::simd_from(s, *self.ids), u32x16::splat(s, first));
        let codes: i32x16<S> = (ids & ((1 << ORDER_BITS) - 1)).bitcast();
        let is_plain = run.strokes.is_none() && codes.simd_ge(CLIPPED_CLOCKWISE as i32).all_false();
        let near = if is_plain { self.near(s, call, run, &ids.into()) } else { None };
        let Some([x, y]) = near else { return self.one_by_one(call, run) };
        let none = i32x16::splat(s, 0);
        [asked.select(x, none).into(), asked.select(y, none).into()]
    }

    /// Of triangles near their pixels, in the lanes.
    #[inline(always)]
    fn near<S: Simd>(&self, s: S, call: &dyn DrawCall, run: &RunView<'_>, ids: &[u32; 16]) -> Option<[i32x16<S>; 2]> {
        let vertices = ByLane::new(s, run, record_rows(call.layout().interpolation.len()), ids);
        let lanes = BlockLanes::new(s);
        let px = (lanes.column << 8) + (self.x * SUBPIXELS + HALF_PIXEL);
        let py = (lanes.row << 8) + (self.y * SUBPIXELS + HALF_PIXEL);
        let [ax, ay, ..] = vertices.row(s, run, 0, 0);
        let [bx, by, ..] = vertices.row(s, run, 1, 0);
        let [cx, cy, ..] = vertices.row(s, run, 2, 0);
        let x = [ax.bitcast::<i32x16<S>>() - px, bx.bitcast::<i32x16<S>>() - px, cx.bitcast::<i32x16<S>>() - px];
        let y = [ay.bitcast::<i32x16<S>>() - py, by.bitcast::<i32x16<S>>() - py, cy.bitcast::<i32x16<S>>() - py];
        let low = x[0].min(x[1]).min(x[2]).min(y[0]).min(y[1]).min(y[2]);
        let high = x[0].max(x[1]).max(x[2]).max(y[0]).max(y[1]).max(y[2]);
        if !(low.simd_lt(-NEAR) | high.simd_gt(NEAR)).all_false() {
            return None;
        }
        let none = i32x16::splat(s, 0);
        let (mut edge, mut dx, mut dy) = ([none; 3], [none; 3], [none; 3]);
        let mut k = 0;
        while k < 3 {
            let next = (k + 1) % 3;
            (dx[k], dy[k]) = (x[next] - x[k], y[next] - y[k]);
            let rule = is_top_left(dx[k], dy[k]).select(none, none + 1);
            edge[k] = x[k] * y[next] - x[next] * y[k] - rule;
            k += 1;
        }
        let (mut offset_x, mut offset_y) = (none, none);
        let mut sample = self.samples.count();
        while sample > 0 {
            sample -= 1;
            let [ox, oy] = self.samples.offset(sample);
            let inside = (edge[0] + dx[0] * oy - dy[0] * ox)
                | (edge[1] + dx[1] * oy - dy[1] * ox)
                | (edge[2] + dx[2] * oy - dy[2] * ox);
            let inside = inside.simd_ge(0);
            offset_x = inside.select(none + ox, offset_x);
            offset_y = inside.select(none + oy, offset_y);
        }
        let centre = (edge[0] | edge[1] | edge[2]).simd_ge(0);
        Some([centre.select(none, offset_x), centre.select(none, offset_y)])
    }

    /// Of any triangles, lines and points.
    #[inline(never)]
    fn one_by_one(&self, call: &dyn DrawCall, run: &RunView<'_>) -> [[i32; 16]; 2] {
        let mut offsets = [[0; 16]; 2];
        let mut rest = self.mask;
        while rest != 0 {
            let lane = rest.trailing_zeros() as usize & 15;
            rest &= rest - 1;
            let (column, row) = ((lane & 3) as i32, (lane >> 2) as i32);
            let center = [(self.x + column) * SUBPIXELS + HALF_PIXEL, (self.y + row) * SUBPIXELS + HALF_PIXEL];
            [offsets[0][lane], offsets[1][lane]] = self.offset(call, run, TriangleId(self.ids[lane]), center);
        }
        offsets
    }

    fn offset(&self, call: &dyn DrawCall, run: &RunView<'_>, id: TriangleId, center: [i32; 2]) -> [i32; 2] {
        let covers = |offset: &[i32; 2]| {
            let at = [center[0] + offset[0], center[1] + offset[1]];
            if let Some(strokes) = &run.strokes {
                let stroke = &strokes.strokes[id.number() - run.first_number];
                let triangles = triangles_of(stroke, strokes.shape);
                return triangles.is_none_or(|triangles| triangles.iter().any(|&corners| is_covered(corners, at)));
            }
            let places = run.places(id);
            let screen = places.map(|place| run.screen[place]);
            if !id.is_clipped() {
                return is_covered(screen.map(ScreenVertex::place), at);
            }
            let triangle = ClipTriangle::of(call, places.map(|place| run.source.vertex(place)));
            clip(run.projection, &triangle, screen).is_some_and(|clipped| {
                clipped.triangles().iter().any(|corners| is_covered(corners.map(ScreenVertex::place), at))
            })
        };
        let samples = (0..self.samples.count()).map(|sample| self.samples.offset(sample));
        std::iter::once([0, 0]).chain(samples).find(covers).unwrap_or([0, 0])
    }
}

/// Whether a triangle on the raster covers a point, by the top-left rule.
fn is_covered(mut triangle: [[i32; 2]; 3], at: [i32; 2]) -> bool {
    let edge = |a: [i32; 2], b: [i32; 2], p: [i32; 2]| {
        let [dx, dy] = [i64::from(b[0]) - i64::from(a[0]), i64::from(b[1]) - i64::from(a[1])];
        dx * (i64::from(p[1]) - i64::from(a[1])) - dy * (i64::from(p[0]) - i64::from(a[0]))
    };
    let area = edge(triangle[0], triangle[1], triangle[2]);
    if area < 0 {
        triangle.swap(1, 2);
    }
    area != 0
        && (0..3).all(|k| {
            let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
            let e = edge(a, b, at);
            e > 0 || (e == 0 && is_top_left_edge(b[0] - a[0], b[1] - a[1]))
        })
}
