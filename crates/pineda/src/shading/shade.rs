//! The fragment stage: packets in, colours of the tile out.

use super::blend::blend;
use super::interpolate::{Fragments, interpolate};
use super::run::RunView;
use super::{Frag, FragmentStage};
use crate::lanes::Packet;
use crate::pass::{Blend, DepthState};
use crate::target::format::TileColor;
use crate::tile::Tile;
use crate::tile::sink::{AnyCompare, DepthTest};
use crate::tile::view::TileView;
use fearless_simd::{Simd, i32x16, mask32x16, prelude::*, u32x16};

/// The samples of a block that show triangles of one draw.
#[derive(Clone, Copy, Debug)]
pub(crate) struct VisiblePacket {
    pub(crate) block: u32,
    pub(crate) mask: u32,
}

/// The samples of a block that one triangle covers, for a draw that blends or discards.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct OrderedPacket {
    pub(crate) depth: [i32; 16],
    pub(crate) id: u32,
    pub(crate) block: u32,
    pub(crate) mask: u32,
}

/// What is to be shaded.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Packets<'a> {
    /// What the visibility buffer shows: each sample once.
    Visible(&'a [VisiblePacket]),
    /// Triangle by triangle, in submission order.
    Ordered(&'a [OrderedPacket], OrderedState),
}

/// How the fragments of an ordered draw meet the tile.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OrderedState {
    pub(crate) depth: DepthState,
    pub(crate) blend: Blend,
}

/// The tile that is shaded.
pub(crate) struct ShadedTile<'a> {
    pub(crate) view: &'a TileView,
    pub(crate) tile: &'a mut Tile,
    pub(crate) color: &'a mut TileColor,
}

/// Runs the fragment stage over packets.
#[inline(always)]
pub(crate) fn shade<S: Simd, St: FragmentStage<Packet<S>>>(
    s: S,
    stage: &St,
    run: &RunView<'_>,
    position: &dyn Fn(usize) -> [f32; 4],
    packets: Packets<'_>,
    target: &mut ShadedTile<'_>,
) {
    match packets {
        Packets::Visible(packets) => visible(s, stage, run, position, packets, target),
        Packets::Ordered(packets, state) => ordered(s, stage, run, position, packets, state, target),
    }
}

#[inline(always)]
fn visible<S: Simd, St: FragmentStage<Packet<S>>>(
    s: S,
    stage: &St,
    run: &RunView<'_>,
    position: &dyn Fn(usize) -> [f32; 4],
    packets: &[VisiblePacket],
    target: &mut ShadedTile<'_>,
) {
    let mut i = 0;
    while i < packets.len() {
        let VisiblePacket { block, mask } = packets[i];
        let block = block as usize;
        let (x, y) = target.view.pixel_of(block);
        let fragments = Fragments { ids: &target.tile.id[block], mask, x, y, depth: &target.tile.depth[block] };
        let (color, alive) = fragment(s, stage, run, position, &fragments);
        target.color.store(s, block, alive, color);
        i += 1;
    }
}

#[inline(always)]
fn ordered<S: Simd, St: FragmentStage<Packet<S>>>(
    s: S,
    stage: &St,
    run: &RunView<'_>,
    position: &dyn Fn(usize) -> [f32; 4],
    packets: &[OrderedPacket],
    state: OrderedState,
    target: &mut ShadedTile<'_>,
) {
    let test = AnyCompare(state.depth.compare);
    let mut i = 0;
    while i < packets.len() {
        let packet = &packets[i];
        i += 1;
        let block = packet.block as usize;
        let depth = i32x16::simd_from(s, packet.depth);
        let there = i32x16::simd_from(s, target.tile.depth[block]);
        let covered = mask32x16::from_bitmask(s, u64::from(packet.mask));
        let mask = (covered & test.passes(s, depth, there)).to_bitmask() as u32;
        if mask == 0 {
            continue;
        }
        let (x, y) = target.view.pixel_of(block);
        let fragments = Fragments { ids: &[packet.id; 16], mask, x, y, depth: &packet.depth };
        let (color, alive) = fragment(s, stage, run, position, &fragments);
        if state.depth.write {
            target.tile.depth[block] = alive.select(depth, there).into();
        }
        let color = blend(s, state.blend, color, target.color.load(s, block));
        target.color.store(s, block, alive, color);
        if let Some(shown) = target.tile.shown.get_mut(block) {
            let there = u32x16::simd_from(s, *shown);
            *shown = alive.select(u32x16::splat(s, packet.id), there).into();
        }
    }
}

/// One packet: interpolation, then the user's stage. The colours, and the lanes whose colour counts.
#[inline(always)]
fn fragment<S: Simd, St: FragmentStage<Packet<S>>>(
    s: S,
    stage: &St,
    run: &RunView<'_>,
    position: &dyn Fn(usize) -> [f32; 4],
    fragments: &Fragments<'_>,
) -> ([fearless_simd::f32x16<S>; 4], mask32x16<S>) {
    let parts = if St::DERIVATIVES {
        interpolate::<S, St::V, true>(s, run, position, fragments)
    } else {
        interpolate::<S, St::V, false>(s, run, position, fragments)
    };
    let mut fragment = Frag::new(parts);
    let color = stage.run(&mut fragment);
    ([color.r.0, color.g.0, color.b.0, color.a.0], fragment.alive().0)
}
