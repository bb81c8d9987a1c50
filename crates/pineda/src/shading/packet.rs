//! Packets between the stages: interpolation fills their rows, the fragment stage reads them and leaves colours, blending takes those.
//!
//! Only the fragment stage is compiled for each shader; so what it works on lies in memory, a batch of packets at a time.

use super::distinct::Fragments;
use super::{__Row4 as Row4, Frag, FragParts, FragmentStage, Interpolation, OutputLayout, Outputs, Varyings};
use crate::lanes::Packet;
use crate::math::{Bool, Real, Vec2};
use crate::raster::triangle_id::{CLIPPED_CLOCKWISE, ORDER_BITS};
use crate::tile::view::BlockLanes;
use crate::wide::{Simd, f32x16, i32x16, mask32x16, u32x16};
use core::marker::PhantomData;

/// Packets that go through the fragment stage at a time.
pub(crate) const BATCH: usize = 16;

/// What a shader's varyings are.
#[derive(Clone, Copy, Debug)]
pub(crate) struct VaryingLayout {
    pub(crate) interpolation: &'static [Interpolation],
    pub(crate) derivatives: bool,
    /// Whether the last two numbers are a point's coordinates.
    pub(crate) point_coord: bool,
    /// Whether everything is interpolated with perspective.
    pub(crate) is_plain: bool,
}

impl VaryingLayout {
    pub(crate) fn new(interpolation: &'static [Interpolation], derivatives: bool) -> Self {
        let is_plain = interpolation.iter().all(|&i| i == Interpolation::Perspective);
        Self { interpolation, derivatives, point_coord: false, is_plain }
    }

    /// Rows of a packet: the varyings and, if asked for, their derivatives along x and y.
    fn rows(&self) -> usize {
        self.interpolation.len() * if self.derivatives { 3 } else { 1 }
    }
}

/// The rows of one packet.
pub(crate) struct PacketRows<'a> {
    pub(crate) here: &'a mut [[f32; 16]],
    pub(crate) dx: &'a mut [[f32; 16]],
    pub(crate) dy: &'a mut [[f32; 16]],
}

/// What a fragment stage gets beside the varyings, and what it leaves.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, align(64))]
pub(crate) struct PacketState {
    /// What is for the first colour buffer; of integers, the bits.
    pub(crate) color: Row4,
    /// Depths, as bits.
    pub(crate) depth: [i32; 16],
    pub(crate) ids: [u32; 16],
    pub(crate) block: u32,
    /// The block's first pixel.
    pub(crate) x: i32,
    pub(crate) y: i32,
    /// The lanes whose colour counts; the fragment stage takes away those that it discards.
    pub(crate) alive: u32,
}

impl PacketState {
    /// What is to be shaded.
    #[inline(always)]
    pub(crate) fn fragments(&self) -> Fragments<'_> {
        Fragments { ids: &self.ids, mask: self.alive, x: self.x, y: self.y }
    }
}

/// Up to [`BATCH`] packets of one run.
#[derive(Debug)]
pub(crate) struct PacketBatch {
    packets: [PacketState; BATCH],
    count: usize,
    rows: Vec<[f32; 16]>,
    rows_each: usize,
    /// What the packets' fragments have beside a colour: for further colour buffers, or to be blended with.
    more: Vec<Row4>,
    more_each: usize,
    derivatives: bool,
    front_is_clockwise: bool,
}

impl PacketBatch {
    pub(crate) fn new() -> Self {
        Self {
            packets: [PacketState::default(); BATCH],
            count: 0,
            rows: Vec::new(),
            rows_each: 0,
            more: Vec::new(),
            more_each: 0,
            derivatives: false,
            front_is_clockwise: false,
        }
    }

    /// Empties the batch for packets of this layout.
    pub(crate) fn start(&mut self, layout: &VaryingLayout, front_is_clockwise: bool) {
        self.count = 0;
        self.rows_each = layout.rows();
        self.derivatives = layout.derivatives;
        self.front_is_clockwise = front_is_clockwise;
        let rows = BATCH * self.rows_each;
        if self.rows.len() < rows {
            self.rows.resize(rows, [0.0; 16]);
        }
    }

    #[inline(always)]
    pub(crate) fn len(&self) -> usize {
        self.count
    }

    #[inline(always)]
    pub(crate) fn packets(&self) -> &[PacketState] {
        &self.packets[..self.count]
    }

    /// Adds a packet, with whatever an earlier one left in it. There must be room.
    #[inline(always)]
    pub(crate) fn add(&mut self) -> &mut PacketState {
        let packet = &mut self.packets[self.count];
        self.count += 1;
        packet
    }

    /// Packet `k` and its rows.
    #[inline(always)]
    pub(crate) fn packet(&mut self, k: usize) -> (&PacketState, PacketRows<'_>) {
        let rows = &mut self.rows[k * self.rows_each..(k + 1) * self.rows_each];
        let each = if self.derivatives { rows.len() / 3 } else { rows.len() };
        let (here, rest) = rows.split_at_mut(each);
        let (dx, dy) = rest.split_at_mut(if self.derivatives { each } else { 0 });
        (&self.packets[k], PacketRows { here, dx, dy })
    }

    /// What the fragments of packet `k` have beside a colour.
    #[inline(always)]
    pub(crate) fn more(&self, k: usize) -> &[Row4] {
        &self.more[k * self.more_each..(k + 1) * self.more_each]
    }

    /// Makes room for what comes beside the first colour.
    #[inline(never)]
    fn reserve_more(&mut self) {
        let rows = BATCH * self.more_each;
        if self.more.len() < rows {
            self.more.resize(rows, [[0.0; 16]; 4]);
        }
    }

    /// Runs a fragment stage over all packets: the only part that is compiled for each shader.
    #[inline(always)]
    pub(crate) fn run<S: Simd, St: FragmentStage<Packet<S>>>(&mut self, s: S, stage: &St) {
        if self.count == 0 {
            return;
        }
        let more_each = const { OutputLayout::of::<Packet<S>, St::Out>().more() };
        self.more_each = more_each;
        if more_each > 0 {
            self.reserve_more();
        }
        let lanes = BlockLanes::new(s);
        let own = 16 * <St::V as Varyings<Packet<S>>>::LEN;
        let length = if St::POINT_COORD { own + 2 * 16 } else { own };
        let zero = Real(f32x16::splat(s, 0.0));
        let none = Bool(mask32x16::splat(s, false));
        let first = St::V::read(Packet(s), self.rows.as_flattened());
        // One for all packets: the compiler would copy each new one several times over.
        let mut fragment = Frag {
            parts: FragParts {
                varyings: first,
                dx: first,
                dy: first,
                x: zero,
                y: zero,
                z: zero,
                point_coord: Vec2::new(zero, zero),
                front_facing: none,
                alive: none,
            },
            kind: PhantomData,
        };
        let mut k = 0;
        while k < self.count {
            let packet = &mut self.packets[k];
            let rows = self.rows[k * self.rows_each..(k + 1) * self.rows_each].as_flattened();
            let parts = &mut fragment.parts;
            parts.varyings = St::V::read(Packet(s), rows);
            if St::DERIVATIVES {
                parts.dx = St::V::read(Packet(s), &rows[length..]);
                parts.dy = St::V::read(Packet(s), &rows[2 * length..]);
            }
            if St::POINT_COORD {
                parts.point_coord = Vec2::read(Packet(s), &rows[own..]);
            }
            let ids = u32x16::simd_from(s, packet.ids);
            let code: i32x16<S> = (ids & ((1 << ORDER_BITS) - 1)).bitcast();
            let clockwise = code.simd_lt(3) | code.simd_eq(CLIPPED_CLOCKWISE as i32);
            parts.x = Real(lanes.x + (packet.x as f32 + 0.5));
            parts.y = Real(lanes.y + (packet.y as f32 + 0.5));
            parts.z = Real(i32x16::simd_from(s, packet.depth).bitcast());
            parts.front_facing = Bool(if self.front_is_clockwise { clockwise } else { !clockwise });
            parts.alive = Bool(mask32x16::from_bitmask(s, u64::from(packet.alive)));
            let more = if more_each > 0 { &mut self.more[k * more_each..(k + 1) * more_each] } else { &mut [] };
            stage.run(&mut fragment).write(&mut packet.color, more);
            if St::DISCARDS {
                packet.alive = fragment.alive().0.to_bitmask() as u32;
            }
            k += 1;
        }
    }
}
