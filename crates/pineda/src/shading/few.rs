//! Packets of a few triangles, whose rows are in the cache.

use super::barycentric::{Both, Corner3};
use super::cached::{TRIANGLE_HEADER, TriangleCache};
use super::centroid::centroid_offsets;
use super::distinct::{Distinct, Fragments};
use super::packet::{BATCH, PacketBatch, PacketRows, VaryingLayout};
use super::weights::Weights;
use crate::geometry::raster_space::SUBPIXELS;
use crate::tile::view::{BlockLanes, Positions};
use crate::wide::{Simd, Words, i32x16, mask32x16, u32x4, u32x16};

/// Packets of up to `N` triangles, all of them in the cache; with derivatives if `FULL`.
#[inline(never)]
pub(crate) fn few<S: Simd, const N: usize, const FULL: bool>(
    s: S,
    layout: &VaryingLayout,
    batch: &mut PacketBatch,
    distinct: &[Distinct; BATCH],
    list: &[u8],
    cache: &TriangleCache,
) {
    s.apart(
        #[inline(always)]
        || {
            let lanes = BlockLanes::new(s);
            let mut i = 0;
            while i < list.len() {
                let k = list[i] as usize;
                let (fragments, mut rows) = batch.packet(k);
                from_cache::<S, N, FULL>(s, layout, &fragments, &distinct[k & (BATCH - 1)], &lanes, cache, &mut rows);
                i += 1;
            }
        },
    );
}

#[inline(always)]
fn from_cache<S: Simd, const N: usize, const FULL: bool>(
    s: S,
    layout: &VaryingLayout,
    fragments: &Fragments<'_>,
    distinct: &Distinct,
    lanes: &BlockLanes<S>,
    cache: &TriangleCache,
    rows: &mut PacketRows<'_>,
) {
    // Beyond the last any: a branch would cost more.
    let mut triangles: [&[[u32; 4]]; N] = [&[]; N];
    let mut t = 0;
    while t < N {
        triangles[t] = cache.rows(distinct.ids[t]);
        t += 1;
    }
    let pick = Pick::<S, N>::new(s, distinct);
    let at = Positions::new(s, lanes, fragments.moved);
    let (x, y) = (at.x + fragments.x * SUBPIXELS, at.y + fragments.y * SUBPIXELS);
    let one: [i32x16<S>; 4] = pick.row(s, &triangles, 0);
    let two: [i32x16<S>; 4] = pick.row(s, &triangles, 1);
    let mut e1 = (x * one[0] + y * one[1]) + one[2];
    let mut e2 = (x * two[0] + y * two[1]) + two[2];
    if fragments.border != 0 {
        let zero = [one[3] - e1 - e2, -(one[0] + two[0]), -(one[1] + two[1])];
        let edges = [zero, [e1, one[0], one[1]], [e2, two[0], two[1]]];
        let [ox, oy] = centroid_offsets(s, edges, fragments.border, fragments.samples);
        e1 = e1 + one[0] * ox + one[1] * oy;
        e2 = e2 + two[0] * ox + two[1] * oy;
    }
    let e0 = one[3] - e1 - e2;
    let [w0, w1, w2, _] = pick.row(s, &triangles, 2);
    let edges = [e0.to_float(), e1.to_float(), e2.to_float()];
    let (mut right, mut down) = (edges, edges);
    if FULL {
        // A pixel's: times 256 is exact. All three edge functions together do not change.
        let pixel = SUBPIXELS as f32;
        right = [(-one[0] - two[0]).to_float() * pixel, one[0].to_float() * pixel, two[0].to_float() * pixel];
        down = [(-one[1] - two[1]).to_float() * pixel, one[1].to_float() * pixel, two[1].to_float() * pixel];
    }
    let weights = Weights::from_edges::<FULL>(edges, right, down, [w0, w1, w2]);
    let both = Both::new::<FULL>(s, &weights, layout);
    let mut k = 0;
    while k < layout.interpolation.len() {
        let [f0, d1, d2, _] = pick.row(s, &triangles, TRIANGLE_HEADER + k);
        both.set::<FULL>(layout, rows, k, Corner3 { f0, d1, d2 });
        k += 1;
    }
    if layout.depth {
        let [f0, d1, d2, _] = pick.row(s, &triangles, TRIANGLE_HEADER + layout.interpolation.len());
        *rows.z = weights.depth(s, Corner3 { f0, d1, d2 }).into();
    }
}

/// Which of up to `N` triangles each lane shows.
struct Pick<S: Simd, const N: usize> {
    /// The lanes of each.
    masks: [mask32x16<S>; N],
    /// Each lane's triangle among its four, as [`u32x16::pick_in_fours`] takes it; or where its first word stands among the rows of these, as [`u32x16::pick`] does.
    place: u32x16<S>,
    /// The lanes of the last four.
    is_late: mask32x16<S>,
}

impl<S: Simd, const N: usize> Pick<S, N> {
    #[inline(always)]
    fn new(s: S, distinct: &Distinct) -> Self {
        let mut masks = [mask32x16::from_bitmask(s, 0); N];
        let each = if S::CAN_PICK { 4 } else { 1 };
        let mut place = u32x16::splat(s, u32x16::<S>::place(0));
        let mut late = 0;
        let mut t = 1;
        while t < N {
            masks[t] = mask32x16::from_bitmask(s, u64::from(distinct.masks[t]));
            place = masks[t].select(u32x16::splat(s, u32x16::<S>::place(each * (t as u32 % 4))), place);
            late |= if t < 4 { 0 } else { distinct.masks[t] };
            t += 1;
        }
        Self { masks, place, is_late: mask32x16::from_bitmask(s, u64::from(late)) }
    }

    /// Row `r` of each lane's triangle.
    #[inline(always)]
    fn row<W: Words<S>>(&self, s: S, triangles: &[&[[u32; 4]]; N], r: usize) -> [W; 4] {
        let [a, b, c, d] = self.words(s, triangles, r);
        [a.bitcast(), b.bitcast(), c.bitcast(), d.bitcast()]
    }

    /// The same, as integers.
    #[inline(always)]
    fn words(&self, s: S, triangles: &[&[[u32; 4]]; N], r: usize) -> [u32x16<S>; 4] {
        if N >= 4 && (S::CAN_PICK || S::CAN_PICK_IN_FOURS) {
            let mut row = self.row_of_four(s, triangles, r, 0);
            if N > 4 {
                let late = self.row_of_four(s, triangles, r, 4);
                let mut i = 0;
                while i < 4 {
                    row[i] = self.is_late.select(late[i], row[i]);
                    i += 1;
                }
            }
            return row;
        }
        let mut row = [u32x16::splat(s, 0); 4];
        let mut i = 0;
        while i < 4 {
            row[i] = u32x16::splat(s, triangles[0][r][i]);
            let mut t = 1;
            while t < N {
                row[i] = self.masks[t].select(u32x16::splat(s, triangles[t][r][i]), row[i]);
                t += 1;
            }
            i += 1;
        }
        row
    }

    /// The same of one of triangles `t` to `t + 3`: of all four rows as one vector with one instruction a word, or of a word of all four with one for each register.
    #[inline(always)]
    fn row_of_four(&self, s: S, triangles: &[&[[u32; 4]]; N], r: usize, t: usize) -> [u32x16<S>; 4] {
        let a = u32x4::simd_from(s, triangles[t % N][r]);
        let b = u32x4::simd_from(s, triangles[(t + 1) % N][r]);
        let c = u32x4::simd_from(s, triangles[(t + 2) % N][r]);
        let d = u32x4::simd_from(s, triangles[(t + 3) % N][r]);
        if S::CAN_PICK {
            let (rows, next) = (a.combine(b).combine(c.combine(d)), u32x16::<S>::place(1) - u32x16::<S>::place(0));
            let place = self.place;
            return [
                rows.pick(place),
                rows.pick(place + next),
                rows.pick(place + 2 * next),
                rows.pick(place + 3 * next),
            ];
        }
        let [x, y, z, w] = u32x4::transpose([a, b, c, d]);
        [
            u32x16::repeat(x).pick_in_fours(self.place),
            u32x16::repeat(y).pick_in_fours(self.place),
            u32x16::repeat(z).pick_in_fours(self.place),
            u32x16::repeat(w).pick_in_fours(self.place),
        ]
    }
}
