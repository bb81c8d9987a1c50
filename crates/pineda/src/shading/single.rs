//! Packets of one triangle, sixteen at a time.
//!
//! A layer over the whole picture is hundreds of packets one after the other. What they have in common is found once a triangle (vertices, how the varyings differ) or
//! once a batch (edge functions at the blocks' first samples, sixteen blocks in the lanes), so that little is left to be done for each.
//!
//! Weights are edge functions rounded to f32 once, as everywhere (see [`weights`](super::weights)), and those of large triangles do not fit 32 bits. But mostly f64 can be avoided. At a
//! sample an edge function is `E = F + L`: what it is at the block's first sample, and what it gains from there, a multiple of 256. With B the f32 nearest to F
//!
//! ```text
//! E = B + ((F - B) + L)
//! ```
//!
//! and if the bracket is exact in f32, the outer sum rounds E once. It has few enough bits if F, too, is a multiple of 256. If it is not, but E is at least 2^32, f32 holds multiples of 512
//! only: all that counts of F's low eight bits is whether there are any, and 128 stands for them.

use super::MAX_VARYINGS;
use super::barycentric::{Both, Corner3};
use super::packet::{BATCH, PacketBatch, VaryingLayout};
use super::run::{RunView, record_rows};
use super::weights::Weights;
use crate::geometry::raster_space::{HALF_PIXEL, SUBPIXELS};
use crate::raster::triangle_id::TriangleId;
use crate::tile::view::BlockLanes;
use crate::wide::{Simd, f32x16, f64x8, i32x16};

/// Fewer packets of one triangle in a row do not pay for a batch that is theirs.
pub(crate) const LEAST_PACKETS: usize = 8;

/// A triangle made ready, which is not clipped.
#[derive(Debug)]
pub(crate) struct Single {
    id: TriangleId,
    inv_w: [f32; 3],
    /// What the edge functions are at the middle of pixel (0, 0), and gain a sample right and down, over 256.
    first: [i64; 3],
    step_x: [i32; 3],
    step_y: [i32; 3],
    /// Each varying at the first vertex, and by how much the others exceed it.
    corners: [[f32; 3]; MAX_VARYINGS],
    depths: [f32; 3],
    /// All varyings, of which those that are the same all over the triangle come last.
    varyings: [u8; MAX_VARYINGS],
    /// How many there are, and how many of them vary.
    count: usize,
    varying: usize,
    /// Each packet's weights of the second and third vertex, between two steps of interpolation.
    weights: [[[f32; 16]; 2]; BATCH],
}

impl Single {
    pub(crate) const NONE: Self = Self {
        id: TriangleId(0),
        inv_w: [0.0; 3],
        first: [0; 3],
        step_x: [0; 3],
        step_y: [0; 3],
        corners: [[0.0; 3]; MAX_VARYINGS],
        depths: [0.0; 3],
        varyings: [0; MAX_VARYINGS],
        count: 0,
        varying: 0,
        weights: [[[0.0; 16]; 2]; BATCH],
    };

    /// Another batch of triangles comes.
    pub(crate) fn forget(&mut self) {
        self.id = TriangleId(0);
    }

    /// Makes a triangle ready, unless it is.
    #[inline(always)]
    pub(crate) fn prepare(&mut self, run: &RunView<'_>, layout: &VaryingLayout, id: TriangleId) {
        if self.id != id {
            self.set(run, layout, id);
        }
    }

    #[inline(never)]
    fn set(&mut self, run: &RunView<'_>, layout: &VaryingLayout, id: TriangleId) {
        let each = record_rows(layout.interpolation.len());
        let [a, b, c] = run.canonical_places(id);
        let places = [a, b, c, run.places(id)[0]];
        let (mut x, mut y) = ([0; 3], [0; 3]);
        for (k, &place) in places[..3].iter().enumerate() {
            let record = &run.records[place * each];
            (x[k], y[k]) = (record[0] as i32, record[1] as i32);
            self.inv_w[k] = f32::from_bits(record[2]);
        }
        let from = |v: i32| i64::from(v) - i64::from(HALF_PIXEL);
        for k in 0..3 {
            let (a, b) = ((k + 1) % 3, (k + 2) % 3);
            (self.step_x[k], self.step_y[k]) = (y[a] - y[b], x[b] - x[a]);
            self.first[k] = from(x[a]) * from(y[b]) - from(x[b]) * from(y[a]);
        }
        (self.id, self.count, self.varying) = (id, layout.interpolation.len().min(MAX_VARYINGS), 0);
        // With 1 / w far from what f32 ends at, barycentric coordinates are finite: times 0 they are 0.
        let is_tame = self.inv_w.iter().all(|w| (1e-18..1e18).contains(w));
        let mut last = self.count;
        for k in 0..self.count {
            let corner @ [f0, d1, d2] = run.vertex_values(each, &places, k, false);
            self.corners[k] = corner;
            // -0 plus 0 is not -0.
            if is_tame && d1 == 0.0 && d2 == 0.0 && f0.to_bits() != (-0.0f32).to_bits() {
                last -= 1;
                self.varyings[last] = k as u8;
            } else {
                self.varyings[self.varying] = k as u8;
                self.varying += 1;
            }
        }
        if layout.depth {
            self.depths = run.vertex_depths([a, b, c]);
        }
    }

    /// Empties the batch for packets of this triangle only, and writes to it what they all share.
    #[inline(always)]
    pub(crate) fn start(&self, layout: &VaryingLayout, front_is_clockwise: bool, batch: &mut PacketBatch) {
        if batch.is_shared_by(self.id.0) {
            batch.start_again();
        } else {
            self.start_first(layout, front_is_clockwise, batch);
        }
    }

    #[inline(never)]
    fn start_first(&self, layout: &VaryingLayout, front_is_clockwise: bool, batch: &mut PacketBatch) {
        batch.start(layout, front_is_clockwise);
        batch.share(self.id.0);
        for &k in &self.varyings[self.varying..self.count] {
            batch.share_row(k.into(), [self.corners[usize::from(k)][0]; 16]);
        }
    }

    /// Interpolates what varies in all packets of a batch that was started for this triangle.
    #[inline(always)]
    pub(crate) fn interpolate_all<S: Simd>(&mut self, s: S, layout: &VaryingLayout, batch: &mut PacketBatch) {
        const ALL: [u8; BATCH] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];
        let list = &ALL[..batch.len().min(BATCH)];
        if layout.derivatives {
            self.interpolate::<S, true>(s, layout, batch, list, self.count);
        } else {
            self.interpolate::<S, false>(s, layout, batch, list, self.varying);
        }
    }

    /// The same of those packets of any batch that the list names: which show this triangle alone, at their pixels' centres.
    #[inline(always)]
    pub(crate) fn interpolate_listed<S: Simd, const FULL: bool>(
        &mut self,
        s: S,
        layout: &VaryingLayout,
        batch: &mut PacketBatch,
        list: &[u8],
    ) {
        self.interpolate::<S, FULL>(s, layout, batch, list, self.count);
    }

    /// Interpolates the first so many of `varyings`; with derivatives if `FULL`.
    #[inline(never)]
    fn interpolate<S: Simd, const FULL: bool>(
        &mut self,
        s: S,
        layout: &VaryingLayout,
        batch: &mut PacketBatch,
        list: &[u8],
        count: usize,
    ) {
        s.apart(
            #[inline(always)]
            || {
                let (x, y) = batch.places();
                let (x, y) = (i32x16::simd_from(s, *x), i32x16::simd_from(s, *y));
                let (lanes, firsts) = (BlockLanes::new(s), &Firsts::new(self, x, y));
                match firsts.arithmetic {
                    Arithmetic::Sum => {
                        self.weigh::<S, FULL, _>(s, layout, batch, list, &Sum::new(self, &lanes, firsts));
                    }
                    Arithmetic::Short => {
                        self.weigh::<S, FULL, _>(s, layout, batch, list, &Short::new(self, &lanes, x, y));
                    }
                    Arithmetic::Double => {
                        self.weigh::<S, FULL, _>(s, layout, batch, list, &Double::new(s, self, &lanes, x, y));
                    }
                }
                if !FULL {
                    self.set_rows(s, batch, list, count);
                }
            },
        );
    }

    /// From the edge functions of the packets that the list names, the weights of vertex 1 and 2; with derivatives, what follows from them, too.
    #[inline(always)]
    fn weigh<S: Simd, const FULL: bool, E: Edges<S>>(
        &mut self,
        s: S,
        layout: &VaryingLayout,
        batch: &mut PacketBatch,
        list: &[u8],
        edges: &E,
    ) {
        let [w0, w1, w2] = self.inv_w;
        let inv_w = [f32x16::splat(s, w0), f32x16::splat(s, w1), f32x16::splat(s, w2)];
        let [right, down] = [self.steps_in_lanes(s, &self.step_x), self.steps_in_lanes(s, &self.step_y)];
        let mut i = 0;
        while i < list.len().min(BATCH) {
            let packet = list[i] as usize;
            let weights = Weights::from_edges::<FULL>(edges.of(packet), right, down, inv_w);
            let both = Both::new::<FULL>(s, &weights, layout);
            if layout.depth {
                *batch.depth_row(packet) = weights.depth(s, Corner3::splat(s, self.depths)).into();
            }
            if FULL {
                let (_, mut rows) = batch.packet(packet);
                let mut k = 0;
                while k < self.count.min(MAX_VARYINGS) {
                    both.set::<FULL>(layout, &mut rows, k, Corner3::splat(s, self.corners[k]));
                    k += 1;
                }
            } else {
                let [b1, b2] = both.perspective();
                self.weights[packet & (BATCH - 1)] = [b1.into(), b2.into()];
            }
            i += 1;
        }
    }

    /// Sets the rows of varyings: one varying after the other, so that what its vertices have stays in registers.
    #[inline(always)]
    fn set_rows<S: Simd>(&self, s: S, batch: &mut PacketBatch, list: &[u8], count: usize) {
        let (rows, each) = batch.all_rows();
        let mut n = 0;
        while n < count.min(MAX_VARYINGS) {
            let k = self.varyings[n] as usize & (MAX_VARYINGS - 1);
            let corner = Corner3::splat(s, self.corners[k]);
            let mut i = 0;
            while i < list.len().min(BATCH) {
                let packet = list[i] as usize & (BATCH - 1);
                let [b1, b2] = self.weights[packet];
                rows[packet * each + k] = corner.at(f32x16::simd_from(s, b1), f32x16::simd_from(s, b2)).into();
                i += 1;
            }
            n += 1;
        }
    }

    /// What the edge functions gain a pixel right, or down. Differences times 256: exact.
    #[inline(always)]
    fn steps_in_lanes<S: Simd>(&self, s: S, steps: &[i32; 3]) -> [f32x16<S>; 3] {
        let step = |k: usize| steps[k] as f32 * SUBPIXELS as f32;
        [f32x16::splat(s, step(0)), f32x16::splat(s, step(1)), f32x16::splat(s, step(2))]
    }

    /// What edge function `k` gains a pixel right, and a pixel down.
    #[inline(always)]
    fn steps(&self, k: usize) -> [f64; 2] {
        [f64::from(self.step_x[k]) * f64::from(SUBPIXELS), f64::from(self.step_y[k]) * f64::from(SUBPIXELS)]
    }
}

/// A triangle's edge functions in the blocks of a batch.
trait Edges<S: Simd> {
    /// Those of the samples of packet `i`'s block.
    fn of(&self, i: usize) -> [f32x16<S>; 3];
}

/// How they are computed.
#[derive(Clone, Copy)]
enum Arithmetic {
    /// As above.
    Sum,
    /// In 32 bits.
    Short,
    /// In f64.
    Double,
}

/// The edge functions at the first samples of sixteen blocks.
struct Firsts {
    arithmetic: Arithmetic,
    /// B of each edge and block, and F - B.
    base: [[f32; BATCH]; 3],
    rest: [[f32; BATCH]; 3],
}

/// From where on f32 holds nothing but multiples of 512.
const FAR: f32 = 4_294_967_296.0;
/// What fits i32 is less.
const SHORT: f32 = 2_147_483_648.0;

impl Firsts {
    #[inline(always)]
    fn new<S: Simd>(single: &Single, x: i32x16<S>, y: i32x16<S>) -> Self {
        let ((x_low, x_high), (y_low, y_high)) = (x.to_float().widen(), y.to_float().widen());
        let (mut base, mut rest) = ([[0.0; BATCH]; 3], [[0.0; BATCH]; 3]);
        let (mut is_sum, mut is_short) = (true, true);
        let mut k = 0;
        while k < 3 {
            let [right, down] = single.steps(k);
            let is_multiple = single.first[k] % 256 == 0;
            let first = if is_multiple { single.first[k] } else { (single.first[k] & !255) | 128 } as f64;
            let (low, high) = ((x_low * right + y_low * down) + first, (x_high * right + y_high * down) + first);
            let nearest = low.narrow(high);
            let (nearest_low, nearest_high) = nearest.widen();
            base[k] = nearest.into();
            rest[k] = (low - nearest_low).narrow(high - nearest_high).into();
            // The most that a block's samples differ from its first. With less than 2^30, and no more than 2^24 for F - B, the bracket is a multiple of 128 below 2^31.
            let reach = (3.0 * (right.abs() + down.abs())) as f32;
            is_sum &=
                reach < SHORT / 2.0 && (is_multiple || nearest.simd_ge(FAR + 1.01 * reach).to_bitmask() == 0xffff);
            is_short &= nearest.abs().simd_lt(0.99 * SHORT - 1.01 * reach).to_bitmask() == 0xffff;
            k += 1;
        }
        let arithmetic = if is_sum {
            Arithmetic::Sum
        } else if is_short {
            Arithmetic::Short
        } else {
            Arithmetic::Double
        };
        Self { arithmetic, base, rest }
    }
}

/// As sums of two f32.
struct Sum<'a, S: Simd> {
    gain: [f32x16<S>; 3],
    firsts: &'a Firsts,
}

impl<'a, S: Simd> Sum<'a, S> {
    #[inline(always)]
    fn new(single: &Single, lanes: &BlockLanes<S>, firsts: &'a Firsts) -> Self {
        let mut gain = [lanes.x; 3];
        let mut k = 0;
        while k < 3 {
            gain[k] = lanes.x * (single.step_x[k] as f32 * 256.0) + lanes.y * (single.step_y[k] as f32 * 256.0);
            k += 1;
        }
        Self { gain, firsts }
    }
}

impl<S: Simd> Edges<S> for Sum<'_, S> {
    #[inline(always)]
    fn of(&self, i: usize) -> [f32x16<S>; 3] {
        let (i, [g0, g1, g2]) = (i & (BATCH - 1), self.gain);
        let Firsts { base, rest, .. } = self.firsts;
        [(g0 + rest[0][i]) + base[0][i], (g1 + rest[1][i]) + base[1][i], (g2 + rest[2][i]) + base[2][i]]
    }
}

/// In integers. All values fit 32 bits; on the way there, what does not wraps around and back.
struct Short<S: Simd> {
    gain: [i32x16<S>; 3],
    first: [[i32; BATCH]; 3],
}

impl<S: Simd> Short<S> {
    #[inline(always)]
    fn new(single: &Single, lanes: &BlockLanes<S>, x: i32x16<S>, y: i32x16<S>) -> Self {
        let (mut gain, mut first) = ([lanes.column; 3], [[0; BATCH]; 3]);
        let mut k = 0;
        while k < 3 {
            let (right, down) = (single.step_x[k].wrapping_mul(256), single.step_y[k].wrapping_mul(256));
            gain[k] = lanes.column * right + lanes.row * down;
            first[k] = (x * right + y * down + single.first[k] as i32).into();
            k += 1;
        }
        Self { gain, first }
    }
}

impl<S: Simd> Edges<S> for Short<S> {
    #[inline(always)]
    fn of(&self, i: usize) -> [f32x16<S>; 3] {
        let (i, [g0, g1, g2], first) = (i & (BATCH - 1), self.gain, &self.first);
        [(g0 + first[0][i]).to_float(), (g1 + first[1][i]).to_float(), (g2 + first[2][i]).to_float()]
    }
}

/// In f64.
struct Double<S: Simd> {
    low: [f64x8<S>; 3],
    high: [f64x8<S>; 3],
    first: [[f64; BATCH]; 3],
}

impl<S: Simd> Double<S> {
    #[inline(always)]
    fn new(s: S, single: &Single, lanes: &BlockLanes<S>, x: i32x16<S>, y: i32x16<S>) -> Self {
        let (x, y): ([i32; BATCH], [i32; BATCH]) = (x.into(), y.into());
        let ((column_low, column_high), (row_low, row_high)) = (lanes.x.widen(), lanes.y.widen());
        let zero = f64x8::splat(s, 0.0);
        let (mut low, mut high, mut first) = ([zero; 3], [zero; 3], [[0.0; BATCH]; 3]);
        let mut k = 0;
        while k < 3 {
            let [right, down] = single.steps(k);
            low[k] = column_low * right + row_low * down;
            high[k] = column_high * right + row_high * down;
            let mut i = 0;
            while i < BATCH {
                // All integers below 2^53.
                first[k][i] = (f64::from(x[i]) * right + f64::from(y[i]) * down) + single.first[k] as f64;
                i += 1;
            }
            k += 1;
        }
        Self { low, high, first }
    }
}

impl<S: Simd> Edges<S> for Double<S> {
    #[inline(always)]
    fn of(&self, i: usize) -> [f32x16<S>; 3] {
        let (i, low, high, first) = (i & (BATCH - 1), &self.low, &self.high, &self.first);
        [
            (low[0] + first[0][i]).narrow(high[0] + first[0][i]),
            (low[1] + first[1][i]).narrow(high[1] + first[1][i]),
            (low[2] + first[2][i]).narrow(high[2] + first[2][i]),
        ]
    }
}
