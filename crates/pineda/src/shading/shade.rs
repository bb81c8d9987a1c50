//! From covered or visible samples to colours in the tile: interpolation, the user's fragment stage, blending.

use super::blend::blend;
use super::cached::TriangleCache;
use super::distinct::Distinct;
use super::interpolate::interpolate;
use super::large::Last;
use super::packet::{BATCH, PacketBatch, PacketState};
use super::run::RunView;
use super::stencil::Tests;
use crate::pass::ColorMask;
use crate::pass::draw_call::DrawCall;
use crate::raster::triangle_id::TriangleId;
use crate::target::format::{Channels, ColorFormat, TileColor};
use crate::tile::Tile;
use crate::tile::view::TileView;
use crate::wide::{Simd, f32x16, i32x16, mask32x16, u32x16};
use fearless_simd::Level;

/// The samples of a block that show triangles of one draw.
#[derive(Clone, Copy, Debug)]
pub(crate) struct VisiblePacket {
    /// The run that these triangles belong to.
    pub(crate) run: u32,
    pub(crate) block: u32,
    pub(crate) mask: u32,
    /// The block's first pixel.
    pub(crate) x: i32,
    pub(crate) y: i32,
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

/// A draw, its run's vertices, and the tile that is shaded.
pub(crate) struct Shading<'a> {
    pub(crate) level: Level,
    pub(crate) call: &'a dyn DrawCall,
    pub(crate) run: &'a RunView<'a>,
    pub(crate) view: &'a TileView,
    pub(crate) tile: &'a mut Tile,
    pub(crate) color: &'a mut TileColor,
    pub(crate) batch: &'a mut PacketBatch,
    pub(crate) cache: &'a mut TriangleCache,
}

/// Shades what the visibility buffer shows: each sample once.
#[inline(always)]
pub(crate) fn shade_visible<S: Simd>(s: S, shading: &mut Shading<'_>, packets: &[VisiblePacket]) {
    let layout = shading.call.layout();
    let position = |vertex: usize| shading.call.position(vertex);
    let (mut last, mut distinct) = (Last::none(s), [Distinct::NONE; BATCH]);
    shading.cache.start(shading.run, layout.interpolation.len());
    let mut first = 0;
    while first < packets.len() {
        let end = (first + BATCH).min(packets.len());
        shading.batch.start(&layout, shading.run.front_is_clockwise);
        let mut i = first;
        while i < end {
            let VisiblePacket { block, mask, x, y, .. } = packets[i];
            let packet = shading.batch.add();
            (packet.block, packet.alive, packet.x, packet.y) = (block, mask, x, y);
            packet.ids = shading.tile.id[block as usize];
            packet.depth = shading.tile.depth[block as usize];
            i += 1;
        }
        interpolate(s, shading.run, &position, &layout, shading.batch, &mut distinct, &mut last, shading.cache);
        shading.call.run_fragments(shading.level, shading.batch);
        let mut i = 0;
        while i < shading.batch.len() {
            let packet = &shading.batch.packets()[i];
            let alive = mask32x16::from_bitmask(s, u64::from(packet.alive));
            shading.color.store(s, packet.block as usize, alive, channels(s, packet), ColorMask::ALL);
            i += 1;
        }
        first = end;
    }
}

/// Shades covered samples in submission order, with depth test and blending.
#[inline(always)]
pub(crate) fn shade_in_order<S: Simd>(s: S, shading: &mut Shading<'_>, packets: &[OrderedPacket]) {
    let layout = shading.call.layout();
    let position = |vertex: usize| shading.call.position(vertex);
    let (mut last, mut distinct) = (Last::none(s), [Distinct::NONE; BATCH]);
    shading.cache.start(shading.run, layout.interpolation.len());
    let call = shading.call;
    let (state, discards) = (call.state(), call.discards());
    let tests = Tests { state, front_is_clockwise: shading.run.front_is_clockwise };
    let is_shaded = discards || (state.color_mask != ColorMask::NONE && shading.color.format != ColorFormat::None);
    let mut first = 0;
    while first < packets.len() {
        shading.batch.start(&layout, shading.run.front_is_clockwise);
        let mut next = first;
        while next < packets.len() && shading.batch.len() < BATCH {
            let packet = &packets[next];
            // What an earlier packet of the batch is about to change must not be tested yet.
            if contains(shading.batch, packet.block) {
                break;
            }
            let block = packet.block as usize;
            let covered = mask32x16::from_bitmask(s, u64::from(packet.mask));
            let id = TriangleId(packet.id);
            let tested = tests.of(s, shading.tile, id, block, covered, &packet.depth);
            let mut mask = tested.both;
            if !discards {
                tested.update(s, shading.tile, block);
            } else if tested.failing_counts() {
                // Whether they do anything is for the fragment stage to say.
                mask = covered;
            }
            let mask = mask.to_bitmask() as u32;
            if !is_shaded {
                keep(s, shading.tile, state.depth.write, block, tested.both, &packet.depth, &[packet.id; 16]);
                next += 1;
                continue;
            }
            if mask != 0 {
                let (x, y) = shading.view.pixel_of(packet.block as usize);
                let new = shading.batch.add();
                (new.block, new.alive, new.x, new.y) = (packet.block, mask, x, y);
                (new.ids, new.depth) = ([packet.id; 16], packet.depth);
            }
            next += 1;
        }
        interpolate(s, shading.run, &position, &layout, shading.batch, &mut distinct, &mut last, shading.cache);
        shading.call.run_fragments(shading.level, shading.batch);
        merge(s, shading);
        first = next;
    }
}

#[inline(always)]
fn contains(batch: &PacketBatch, block: u32) -> bool {
    let mut found = false;
    let mut k = 0;
    while k < batch.len() {
        found |= batch.packets()[k].block == block;
        k += 1;
    }
    found
}

/// Brings the colours of a batch of ordered packets into the tile.
#[inline(always)]
fn merge<S: Simd>(s: S, shading: &mut Shading<'_>) {
    let (state, discards) = (shading.call.state(), shading.call.discards());
    let tests = Tests { state, front_is_clockwise: shading.run.front_is_clockwise };
    let (replaces, is_unorm) = (state.blend.replaces(), shading.color.format.is_unorm());
    let mut i = 0;
    while i < shading.batch.len() {
        let packet = &shading.batch.packets()[i];
        let block = packet.block as usize;
        let mut alive = mask32x16::from_bitmask(s, u64::from(packet.alive));
        if discards && state.stencil.is_some() {
            let id = TriangleId(packet.ids[0]);
            let tested = tests.of(s, shading.tile, id, block, alive, &packet.depth);
            tested.update(s, shading.tile, block);
            alive = tested.both;
        }
        keep(s, shading.tile, state.depth.write, block, alive, &packet.depth, &packet.ids);
        let mut color = channels(s, packet);
        if let Some(strokes) = &shading.run.strokes {
            let stroke = TriangleId(packet.ids[0]).number() - shading.run.first_number;
            if let Some(parts) = strokes.covered_parts(s, stroke, packet) {
                color[3] = color[3] * parts;
            }
        }
        if !replaces {
            color = blend(s, &state.blend, is_unorm, color, shading.color.load(s, block));
        }
        shading.color.store(s, block, alive, color, state.color_mask);
        i += 1;
    }
}

/// What the samples that passed leave in the tile, but for colour and stencil.
#[inline(always)]
fn keep<S: Simd>(
    s: S,
    tile: &mut Tile,
    writes_depth: bool,
    block: usize,
    passed: mask32x16<S>,
    depth: &[i32; 16],
    ids: &[u32; 16],
) {
    if writes_depth {
        let there = &mut tile.depth[block];
        *there = passed.select(i32x16::simd_from(s, *depth), i32x16::simd_from(s, *there)).into();
    }
    if let Some(shown) = tile.shown.get_mut(block) {
        *shown = passed.select(u32x16::simd_from(s, *ids), u32x16::simd_from(s, *shown)).into();
    }
}

#[inline(always)]
fn channels<S: Simd>(s: S, packet: &PacketState) -> Channels<S> {
    let [r, g, b, a] = packet.color;
    [f32x16::simd_from(s, r), f32x16::simd_from(s, g), f32x16::simd_from(s, b), f32x16::simd_from(s, a)]
}
