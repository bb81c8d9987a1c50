//! Ordered packets of one triangle in a row, sixteen at a time.
//!
//! A layer over the whole picture hands over hundreds of packets one after the other. What they have in common is found once a triangle (vertices, how the varyings differ) or
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
use super::shade::{OrderedPacket, Shading};
use super::weights::Weights;
use crate::geometry::raster_space::{HALF_PIXEL, SUBPIXELS};
use crate::pass::Compare;
use crate::raster::triangle_id::TriangleId;
use crate::tile::Tile;
use crate::tile::view::{BlockLanes, TileView};
use crate::wide::{Simd, f32x16, f64x8, i32x16, u32x16};

/// Fewer packets of one triangle do not pay for getting it ready.
const LEAST_PACKETS: usize = 8;

/// Whether a stretch of packets begins with enough of one triangle that is not clipped.
#[inline(always)]
pub(crate) fn begins_with_many(packets: &[OrderedPacket]) -> bool {
    let Some(last) = packets.get(LEAST_PACKETS - 1) else { return false };
    packets[0].id == last.id && !TriangleId(last.id).is_clipped()
}

/// A triangle made ready.
#[derive(Debug)]
pub(crate) struct Single {
    /// 0 is none.
    id: u32,
    inv_w: [f32; 3],
    /// What the edge functions are at the tile's first sample, and gain a sample right and down, over 256.
    first: [i64; 3],
    step_x: [i32; 3],
    step_y: [i32; 3],
    /// Each varying at the first vertex, and by how much the others exceed it.
    corners: [[f32; 3]; MAX_VARYINGS],
    /// The varyings that are not the same all over the triangle.
    varying: [u8; MAX_VARYINGS],
    varying_count: usize,
}

impl Single {
    pub(crate) const NONE: Self = Self {
        id: 0,
        inv_w: [0.0; 3],
        first: [0; 3],
        step_x: [0; 3],
        step_y: [0; 3],
        corners: [[0.0; 3]; MAX_VARYINGS],
        varying: [0; MAX_VARYINGS],
        varying_count: 0,
    };

    /// To be called when others write to the batch: it no longer holds what is the same for all of the triangle's packets.
    #[inline(always)]
    pub(crate) fn forget(&mut self) {
        self.id = 0;
    }

    /// Whether it is the triangle of a packet.
    #[inline(always)]
    pub(crate) fn is_of(&self, packet: &OrderedPacket) -> bool {
        self.id == packet.id
    }

    /// What edge function `k` gains a sample right, and a sample down.
    #[inline(always)]
    fn steps(&self, k: usize) -> [f64; 2] {
        [f64::from(self.step_x[k]) * f64::from(SUBPIXELS), f64::from(self.step_y[k]) * f64::from(SUBPIXELS)]
    }

    /// Edge function `k` at a sample of the tile.
    #[inline(always)]
    fn first_at(&self, k: usize, x: i32, y: i32) -> f64 {
        let gain = i64::from(x) * i64::from(self.step_x[k]) + i64::from(y) * i64::from(self.step_y[k]);
        (self.first[k] + gain * i64::from(SUBPIXELS)) as f64
    }

    /// Makes another triangle ready, and writes to the batch what all of its packets share.
    #[inline(never)]
    fn set(&mut self, run: &RunView<'_>, view: &TileView, layout: &VaryingLayout, batch: &mut PacketBatch, id: u32) {
        let varyings = layout.interpolation.len().min(MAX_VARYINGS);
        let each = record_rows(varyings);
        let [a, b, c] = run.canonical_places(TriangleId(id));
        let places = [a, b, c, run.places(TriangleId(id))[0]];
        let (mut x, mut y) = ([0; 3], [0; 3]);
        for (k, &place) in places[..3].iter().enumerate() {
            let record = &run.records[place * each];
            (x[k], y[k]) = (record[0] as i32, record[1] as i32);
            self.inv_w[k] = f32::from_bits(record[2]);
        }
        let from = |v: i32, first: i32| i64::from(v) - i64::from(first * SUBPIXELS + HALF_PIXEL);
        for k in 0..3 {
            let (a, b) = ((k + 1) % 3, (k + 2) % 3);
            (self.step_x[k], self.step_y[k]) = (y[a] - y[b], x[b] - x[a]);
            let (ax, ay, bx, by) = (from(x[a], view.x), from(y[a], view.y), from(x[b], view.x), from(y[b], view.y));
            self.first[k] = ax * by - bx * ay;
        }
        self.id = id;
        batch.set_all_ids(id);
        // With 1 / w far from what f32 ends at, barycentric coordinates are finite: times 0 they are 0.
        let is_tame = self.inv_w.iter().all(|w| (1e-18..1e18).contains(w));
        self.varying_count = 0;
        for k in 0..varyings {
            let corner @ [f0, d1, d2] = run.vertex_values(each, &places, k, false);
            self.corners[k] = corner;
            // -0 plus 0 is not -0.
            if is_tame && d1 == 0.0 && d2 == 0.0 && f0.to_bits() != (-0.0f32).to_bits() {
                batch.set_all_rows(k, [f0; 16]);
            } else {
                self.varying[self.varying_count] = k as u8;
                self.varying_count += 1;
            }
        }
    }
}

/// Fills the batch, which is empty, with those of the first packet's triangle's packets that pass the depth test. Returns how many packets it took, at most sixteen.
#[inline(always)]
pub(crate) fn fill<S: Simd>(
    s: S,
    shading: &mut Shading<'_>,
    layout: &VaryingLayout,
    packets: &[OrderedPacket],
) -> usize {
    let id = packets[0].id;
    if shading.single.id != id {
        shading.single.set(shading.run, shading.view, layout, shading.batch, id);
    }
    let single = &*shading.single;
    let mut blocks = [packets[0].block; BATCH];
    let mut count = 1;
    while count < packets.len().min(BATCH) && packets[count].id == id {
        blocks[count & (BATCH - 1)] = packets[count].block;
        count += 1;
    }
    let packets = &packets[..count];
    let (x, y) = places(shading.view, u32x16::simd_from(s, blocks));
    let firsts = Firsts::new(s, single, x, y);
    let (x, y): ([i32; BATCH], [i32; BATCH]) = ((x + shading.view.x).into(), (y + shading.view.y).into());
    let compare = shading.call.state().depth.compare;
    let lanes = BlockLanes::new(s);
    let [w0, w1, w2] = single.inv_w;
    let inv_w = [f32x16::splat(s, w0), f32x16::splat(s, w1), f32x16::splat(s, w2)];
    match firsts.way {
        Way::Sum => {
            let mut gain = [lanes.x; 3];
            let mut k = 0;
            while k < 3 {
                gain[k] = lanes.x * (single.step_x[k] as f32 * 256.0) + lanes.y * (single.step_y[k] as f32 * 256.0);
                k += 1;
            }
            let (base, rest) = (&firsts.base, &firsts.rest);
            let mut j = 0;
            while j < count {
                let i = j & (BATCH - 1);
                if let Some(new) = admit(s, shading.tile, shading.batch, compare, &packets[j], x[i], y[i]) {
                    let e0 = (gain[0] + rest[0][i]) + base[0][i];
                    let e1 = (gain[1] + rest[1][i]) + base[1][i];
                    let e2 = (gain[2] + rest[2][i]) + base[2][i];
                    set_rows(s, layout, shading.batch, single, new, [e0, e1, e2], inv_w);
                }
                j += 1;
            }
        }
        Way::Short => {
            // All values fit 32 bits; on the way there, what does not wraps around and back.
            let (mut gain, mut first) = ([lanes.column; 3], [[0; BATCH]; 3]);
            let mut k = 0;
            while k < 3 {
                let (right, down) = (single.step_x[k].wrapping_mul(256), single.step_y[k].wrapping_mul(256));
                gain[k] = lanes.column * right + lanes.row * down;
                first[k] = (firsts.x * right + firsts.y * down + single.first[k] as i32).into();
                k += 1;
            }
            let mut j = 0;
            while j < count {
                let i = j & (BATCH - 1);
                if let Some(new) = admit(s, shading.tile, shading.batch, compare, &packets[j], x[i], y[i]) {
                    let e0 = (gain[0] + first[0][i]).to_float();
                    let e1 = (gain[1] + first[1][i]).to_float();
                    let e2 = (gain[2] + first[2][i]).to_float();
                    set_rows(s, layout, shading.batch, single, new, [e0, e1, e2], inv_w);
                }
                j += 1;
            }
        }
        Way::Double => {
            let ((column_low, column_high), (row_low, row_high)) = (lanes.x.widen(), lanes.y.widen());
            let zero = f64x8::splat(s, 0.0);
            let (mut gain_low, mut gain_high) = ([zero; 3], [zero; 3]);
            let mut k = 0;
            while k < 3 {
                let [right, down] = single.steps(k);
                gain_low[k] = column_low * right + row_low * down;
                gain_high[k] = column_high * right + row_high * down;
                k += 1;
            }
            let mut j = 0;
            while j < count {
                let i = j & (BATCH - 1);
                if let Some(new) = admit(s, shading.tile, shading.batch, compare, &packets[j], x[i], y[i]) {
                    let mut edges = [lanes.x; 3];
                    let mut k = 0;
                    while k < 3 {
                        let first = single.first_at(k, x[i] - shading.view.x, y[i] - shading.view.y);
                        edges[k] = (gain_low[k] + first).narrow(gain_high[k] + first);
                        k += 1;
                    }
                    set_rows(s, layout, shading.batch, single, new, edges, inv_w);
                }
                j += 1;
            }
        }
    }
    count
}

/// Where blocks' first samples lie, from the tile's, by the blocks' numbers.
#[inline(always)]
fn places<S: Simd>(view: &TileView, blocks: u32x16<S>) -> (i32x16<S>, i32x16<S>) {
    // A tile has fewer than 2^9 blocks, in rows of less than 2^5: a product with the inverse, rounded up, exceeds 2^16 times the quotient by less than 2^9, and so its fraction
    // by less than 1 / stride.
    let stride = view.stride as u32;
    let rows = (blocks * ((1 << 16) / stride + 1)) >> 16;
    let columns = blocks.bitcast::<i32x16<S>>() - rows.bitcast::<i32x16<S>>() * stride as i32;
    ((columns << 2) - 4, (rows.bitcast::<i32x16<S>>() << 2) - 4)
}

/// How a batch's edge functions are computed.
#[derive(Clone, Copy)]
enum Way {
    /// As above.
    Sum,
    /// In 32 bits.
    Short,
    /// In f64.
    Double,
}

/// The edge functions at the first samples of sixteen blocks.
struct Firsts<S: Simd> {
    way: Way,
    x: i32x16<S>,
    y: i32x16<S>,
    /// B of each edge and block, and F - B.
    base: [[f32; BATCH]; 3],
    rest: [[f32; BATCH]; 3],
}

/// From where on f32 holds nothing but multiples of 512.
const FAR: f32 = 4_294_967_296.0;
/// What fits i32 is less.
const SHORT: f32 = 2_147_483_648.0;

impl<S: Simd> Firsts<S> {
    #[inline(always)]
    fn new(_: S, single: &Single, x: i32x16<S>, y: i32x16<S>) -> Self {
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
        let way = if is_sum {
            Way::Sum
        } else if is_short {
            Way::Short
        } else {
            Way::Double
        };
        Self { way, x, y, base, rest }
    }
}

/// Adds a packet to the batch if any of its samples passes the depth test, and says as which.
#[inline(always)]
fn admit<S: Simd>(
    s: S,
    tile: &Tile,
    batch: &mut PacketBatch,
    compare: Compare,
    packet: &OrderedPacket,
    x: i32,
    y: i32,
) -> Option<usize> {
    let depth = i32x16::simd_from(s, packet.depth);
    let there = i32x16::simd_from(s, tile.depth[packet.block as usize]);
    let mask = compare.passing_lanes(s, depth, there) & packet.mask;
    if mask == 0 {
        return None;
    }
    let number = batch.len();
    let new = batch.add();
    (new.block, new.alive, new.x, new.y) = (packet.block, mask, x, y);
    new.depth = depth.into();
    Some(number)
}

/// The varyings of a packet that are not the same everywhere, from its edge functions.
#[inline(always)]
fn set_rows<S: Simd>(
    s: S,
    layout: &VaryingLayout,
    batch: &mut PacketBatch,
    single: &Single,
    packet: usize,
    edges: [f32x16<S>; 3],
    inv_w: [f32x16<S>; 3],
) {
    let both = Both::new::<false>(s, &Weights::from_edges::<false>(edges, edges, edges, inv_w), layout);
    let rows = batch.plain_rows(packet);
    let mut i = 0;
    while i < single.varying_count.min(MAX_VARYINGS) {
        let k = single.varying[i] as usize & (MAX_VARYINGS - 1);
        let [f0, d1, d2] = single.corners[k];
        let corner = Corner3 { f0: f32x16::splat(s, f0), d1: f32x16::splat(s, d1), d2: f32x16::splat(s, d2) };
        rows[k] = both.plain(corner).into();
        i += 1;
    }
}
