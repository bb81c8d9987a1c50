//! Shading of multisampled pixels: once a pixel and triangle, however many of its samples show or cover it; or once a sample, if a draw asks for that.
//!
//! A block of the picture has one block for each sample in the tile's buffers. Its fragments are put together from these: those that several samples
//! share are shaded once, and the colour goes to each of the samples, which are tested and blended one by one.

use super::__Row4 as Row4;
use super::centroid::Borders;
use super::packet::{BATCH, Moved, PacketState, VaryingLayout};
use super::sample_packets::SamplePacket;
use super::shade::{How, OrderedPacket, Shading, channels, contains, keep, merge_color};
use super::stencil::Tests;
use crate::geometry::raster_space::SUBPIXELS;
use crate::pass::{ColorMask, Conservative, DrawState, Sampling};
use crate::raster::triangle_id::{CLIPPED_CLOCKWISE, ORDER_BITS, TriangleId};
use crate::shading::OutputKind;
use crate::target::format::{ColorFormat, TileColor};
use crate::tile::Tile;
use crate::tile::view::TileView;
use crate::wide::{Simd, f32x16, i32x16, mask32x16, u32x16};

/// Fragments of several blocks of the tile, put together to a full packet: most pixels show one triangle, and packets of what else they show would have few
/// lanes each.
#[derive(Clone, Copy)]
struct Gathered {
    ids: [u32; 16],
    /// Of each fragment the first sample's block, and the lane there.
    places: [(u32, u8); 16],
    count: usize,
}

impl Gathered {
    const NONE: Self = Self { ids: [0; 16], places: [(0, 0); 16], count: 0 };

    /// Takes fragments out of `rest` until it is full.
    #[inline(always)]
    fn take(&mut self, packet: &SamplePacket, rest: &mut u32) {
        while *rest != 0 && self.count < 16 {
            let lane = rest.trailing_zeros() as usize & 15;
            *rest &= *rest - 1;
            self.ids[self.count & 15] = packet.ids[lane];
            self.places[self.count & 15] = (packet.block, lane as u8);
            self.count += 1;
        }
    }

    /// Adds what there is as a packet of its own.
    #[inline(always)]
    fn flush(&mut self, shading: &mut Shading<'_>) {
        let mask = (1 << self.count) - 1;
        let mut offsets = [[0; 16]; 2];
        let mut lane = 0;
        while lane < self.count {
            let (block, from) = self.places[lane & 15];
            let (x, y) = shading.view.pixel_of(block as usize);
            let column = x + i32::from(from & 3) - shading.view.x - (lane & 3) as i32;
            let row = y + i32::from(from >> 2) - shading.view.y - (lane >> 2) as i32;
            (offsets[0][lane & 15], offsets[1][lane & 15]) = (column * SUBPIXELS, row * SUBPIXELS);
            lane += 1;
        }
        shading.batch.add(0, mask, shading.view.x, shading.view.y).ids = self.ids;
        shading.batch.shift(Moved::Gathered, offsets);
        let DrawState { sampling, conservative, .. } = shading.call.state();
        if *sampling == Sampling::Centroid && *conservative == Conservative::Off {
            shading.batch.find_centroids(mask, shading.view.samples);
        }
        self.count = 0;
    }
}

/// What the fragments of a draw are interpolated with.
fn layout_of(shading: &Shading<'_>) -> VaryingLayout {
    VaryingLayout { depth: shading.call.state().sampling != Sampling::Sample, ..shading.call.layout() }
}

/// Shades what the visibility buffer shows.
#[inline(always)]
pub(crate) fn shade_visible_samples<S: Simd>(s: S, shading: &mut Shading<'_>, packets: &[SamplePacket]) {
    let layout = layout_of(shading);
    shading.interpolator.start(shading.run, &layout);
    // Lanes of several blocks go together where nothing is computed from the block.
    let can_gather = layout.depth && layout.is_plain && shading.run.strokes.is_none();
    let (mut gathered, mut rest, mut next) = (Gathered::NONE, 0, 0);
    loop {
        shading.batch.start(&layout, shading.run.front_is_clockwise);
        let mut places = [None; BATCH];
        while next < packets.len() && shading.batch.len() < BATCH {
            let packet = &packets[next];
            if can_gather && !packet.is_first && clipped(s, &packet.ids, packet.mask) == 0 {
                if rest == 0 {
                    rest = packet.mask;
                }
                gathered.take(packet, &mut rest);
                next += usize::from(rest == 0);
                if gathered.count == 16 {
                    places[shading.batch.len() & (BATCH - 1)] = Some(gathered.places);
                    gathered.flush(shading);
                }
                continue;
            }
            next += 1;
            let (x, y) = shading.view.pixel_of(packet.block as usize);
            let new = shading.batch.add(packet.block, packet.mask, x, y);
            new.ids = packet.ids;
            new.depth = shading.tile.depth[packet.block as usize];
            let border = packet.mask & !packet.inner;
            move_off_centers(s, shading, &layout, &packet.ids, border, packet.block as usize);
        }
        if next == packets.len() && gathered.count > 0 && shading.batch.len() < BATCH {
            places[shading.batch.len() & (BATCH - 1)] = Some(gathered.places);
            gathered.flush(shading);
        }
        if shading.batch.len() == 0 {
            return;
        }
        shading.interpolate::<S, false>(s, &layout);
        finish_depths(s, shading, &layout);
        shading.run_fragments(s);
        let further = shading.further();
        let mut i = 0;
        while i < shading.batch.len() {
            let store = Store {
                tile: shading.tile,
                view: shading.view,
                packet: &shading.batch.packets()[i],
                is_of_all_samples: layout.depth,
                places: &places[i],
            };
            let more = shading.batch.more(i);
            store.color(s, shading.color, &store.packet.color);
            let mut k = 0;
            while k < further {
                store.color(s, &mut shading.more_colors[k], &more[k]);
                k += 1;
            }
            i += 1;
        }
    }
}

/// Which lanes are of clipped triangles.
#[inline(always)]
fn clipped<S: Simd>(s: S, ids: &[u32; 16], mask: u32) -> u32 {
    let codes = u32x16::simd_from(s, *ids) & ((1 << ORDER_BITS) - 1);
    codes.simd_ge(CLIPPED_CLOCKWISE).to_bitmask() as u32 & mask
}

/// Where the colours of a packet go.
struct Store<'a> {
    tile: &'a Tile,
    view: &'a TileView,
    packet: &'a PacketState,
    is_of_all_samples: bool,
    /// Of gathered fragments.
    places: &'a Option<[(u32, u8); 16]>,
}

impl Store<'_> {
    /// Stores a colour for all samples that show its triangle; or for the one that it is of.
    #[inline(always)]
    fn color<S: Simd>(&self, s: S, color: &mut TileColor, rows: &Row4) {
        let &Self { tile, view, packet, is_of_all_samples, places } = self;
        let alive = mask32x16::from_bitmask(s, u64::from(packet.alive));
        let block = packet.block as usize;
        if !is_of_all_samples {
            color.store(s, block, alive, channels(s, rows), ColorMask::ALL);
            return;
        }
        // Encoded once: to the border's first block, which nobody reads, and from there to where it belongs.
        color.store(s, SCRATCH, alive, channels(s, rows), ColorMask::ALL);
        if let Some(places) = places {
            let mut rest = packet.alive;
            while rest != 0 {
                let lane = rest.trailing_zeros() as usize & 15;
                rest &= rest - 1;
                let (block, to) = (places[lane].0 as usize, usize::from(places[lane].1 & 15));
                let mut sample = 0;
                while sample < view.samples.count() {
                    let block = block + view.plane(sample);
                    color.copy_sample([SCRATCH, lane], [block, to], tile.id[block][to] == packet.ids[lane]);
                    sample += 1;
                }
            }
            return;
        }
        let mut sample = 0;
        while sample < view.samples.count() {
            let to = block + view.plane(sample);
            let shows = u32x16::simd_from(s, tile.id[to]).simd_eq(u32x16::simd_from(s, packet.ids));
            color.copy_block(s, SCRATCH, to, alive & shows);
            sample += 1;
        }
    }
}

/// A block that belongs to the border.
const SCRATCH: usize = 0;

/// Says where the fragments of the last packet of the batch are shaded. `border` are those that may not cover their pixels' centres.
#[inline(always)]
fn move_off_centers<S: Simd>(
    s: S,
    shading: &mut Shading<'_>,
    layout: &VaryingLayout,
    ids: &[u32; 16],
    border: u32,
    block: usize,
) {
    let samples = shading.view.samples;
    match shading.call.state().sampling {
        // What covers pixels as wholes covers their centres.
        Sampling::Centroid if border != 0 && shading.call.state().conservative == Conservative::Off => {
            if layout.is_plain && clipped(s, ids, border) == 0 && shading.run.strokes.is_none() {
                return shading.batch.find_centroids(border, samples);
            }
            let (x, y) = shading.view.pixel_of(block);
            let offsets = Borders { ids, mask: border, x, y, samples }.offsets(shading.call, shading.run);
            shading.batch.shift(Moved::ByLane, offsets);
        }
        Sampling::Sample => {
            let [x, y] = samples.offset(shading.view.sample_of(block));
            shading.batch.shift(Moved::ToSample, [[x; 16], [y; 16]]);
        }
        Sampling::Center | Sampling::Centroid => {}
    }
}

/// Gives the fragments their depths: where they are shaded, and so not those of the depth buffer's samples.
#[inline(always)]
fn finish_depths<S: Simd>(s: S, shading: &mut Shading<'_>, layout: &VaryingLayout) {
    if layout.depth {
        if let Some(strokes) = &shading.run.strokes {
            shading.batch.set_depths(|ids, at| strokes.depth(TriangleId(ids).number() - shading.run.first_number, at));
        }
        shading.batch.take_depths(s, &shading.depth.rule);
    }
}

/// Shades covered samples in submission order, with depth test and blending. `packets` holds all that there is of each triangle.
#[inline(always)]
pub(crate) fn shade_samples_in_order<S: Simd>(s: S, shading: &mut Shading<'_>, packets: &mut [OrderedPacket]) {
    let layout = layout_of(shading);
    let view = shading.view;
    // What is shaded together: of a triangle what lies in one block, of all samples or of one.
    let part = |block: u32| if layout.depth { block as usize % view.plane_blocks } else { block as usize };
    // Triangles come in the order of their numbers.
    packets.sort_unstable_by_key(|packet| (packet.id >> ORDER_BITS, part(packet.block), packet.block));
    shading.interpolator.start(shading.run, &layout);
    let call = shading.call;
    let state = call.state();
    let uses = shading.uses;
    let is_late = uses.decides() || state.alpha_to_coverage;
    let tests = Tests { state, front_is_clockwise: shading.run.front_is_clockwise };
    let has_color = shading.color.format != ColorFormat::None || !shading.more_colors.is_empty();
    let is_shaded = is_late || (has_color && !state.writes_no_color(call.outputs().kinds.len()));
    let mut rest = packets;
    while !rest.is_empty() {
        shading.batch.start(&layout, shading.run.front_is_clockwise);
        // The packets of each group in the batch.
        let mut groups: [&[OrderedPacket]; BATCH] = [&[]; BATCH];
        while let (Some(first), true) = (rest.first(), shading.batch.len() < BATCH) {
            let (id, block) = (first.id, part(first.block));
            // What an earlier packet of the batch is about to change must not be tested yet.
            if contains(shading.batch, block as u32) {
                break;
            }
            let count = rest.iter().take_while(|packet| packet.id == id && part(packet.block) == block).count();
            let (group, others) = std::mem::take(&mut rest).split_at_mut(count);
            rest = others;
            let (mut mask, mut covered, mut passed) = (0, [0; 16], 0);
            for packet in &mut *group {
                covered[view.sample_of(packet.block as usize) & 15] |= packet.mask;
                let inside = mask32x16::from_bitmask(s, u64::from(packet.mask));
                let tested = tests.of(s, shading.tile, TriangleId(id), packet.block as usize, inside, &packet.depth);
                let both = tested.both.to_bitmask() as u32;
                passed += both.count_ones();
                if is_late {
                    packet.mask = tested.undecided(uses.writes_depth).to_bitmask() as u32;
                } else {
                    tested.update(s, shading.tile, packet.block as usize);
                    packet.mask = both;
                }
                mask |= packet.mask;
                if !is_shaded {
                    let block = packet.block as usize;
                    keep(s, shading.tile, state.depth.write, block, tested.both, &packet.depth, &[id; 16]);
                }
            }
            if !is_shaded {
                shading.count_of(block, 0, passed);
            } else if mask != 0 {
                shading.count_of(block, mask.count_ones(), 0);
                let inner = covered[..view.samples.count()].iter().fold(u32::MAX, |all, own| all & own);
                let (x, y) = view.pixel_of(block);
                let new = shading.batch.add(block as u32, mask, x, y);
                (new.ids, new.depth) = ([id; 16], if layout.depth { group[0].depth } else { own_depths(s, group) });
                move_off_centers(s, shading, &layout, &[id; 16], mask & !inner, block);
                groups[shading.batch.len() - 1] = group;
            }
        }
        shading.interpolate::<S, true>(s, &layout);
        finish_depths(s, shading, &layout);
        shading.run_fragments(s);
        merge(s, shading, &groups, is_late);
    }
}

/// The depths of a triangle's fragments that are of one sample. Lines and clipped triangles are of several parts, each of which covers other lanes.
#[inline(always)]
fn own_depths<S: Simd>(s: S, group: &[OrderedPacket]) -> [i32; 16] {
    let mut depth = i32x16::simd_from(s, group[0].depth);
    let mut k = 1;
    while k < group.len() {
        let mask = mask32x16::from_bitmask(s, u64::from(group[k].mask));
        depth = mask.select(i32x16::simd_from(s, group[k].depth), depth);
        k += 1;
    }
    depth.into()
}

/// Brings the colours of a batch into the samples that passed.
#[inline(always)]
fn merge<S: Simd>(s: S, shading: &mut Shading<'_>, groups: &[&[OrderedPacket]; BATCH], is_late: bool) {
    let (state, samples) = (shading.call.state(), shading.view.samples.count());
    let tests = Tests { state, front_is_clockwise: shading.run.front_is_clockwise };
    let first = state.color(0);
    let how = How::of(&first);
    let further = shading.further();
    let uses = shading.uses;
    let leaves_more = uses.leaves_more();
    let has_alpha = shading.call.outputs().kinds.first() == Some(&OutputKind::Float);
    let mut i = 0;
    while i < shading.batch.len() {
        let packet = &shading.batch.packets()[i];
        let id = TriangleId(packet.ids[0]);
        let parts = shading.covered_parts(s, i);
        let more = shading.batch.more(i);
        // Only a target with one colour buffer is blended with a second source.
        let second = if more.is_empty() { &packet.color } else { &more[0] };
        let mut count = 0;
        for ordered in groups[i] {
            let block = ordered.block as usize;
            let mut depth = &ordered.depth;
            let mut alive = mask32x16::from_bitmask(s, u64::from(packet.alive & ordered.mask));
            if state.alpha_to_coverage && has_alpha {
                alive = alive & covers_by_alpha(s, &packet.color[3], shading.view.sample_of(block), samples);
            }
            if leaves_more {
                if uses.writes_sample_mask {
                    alive = alive & shading.batch.lets_cover(s, i, shading.view.sample_of(block));
                }
                if uses.writes_depth {
                    depth = &packet.depth;
                }
            }
            if is_late {
                let tested = tests.of(s, shading.tile, id, block, alive, depth);
                tested.update(s, shading.tile, block);
                alive = tested.both;
            }
            keep(s, shading.tile, state.depth.write, block, alive, depth, &packet.ids);
            merge_color(s, shading.color, block, alive, &packet.color, second, parts, &first, how);
            let mut k = 0;
            while k < further {
                let state = state.color(k + 1);
                let (tile, how) = (&mut shading.more_colors[k], How::of(&state));
                merge_color(s, tile, block, alive, &more[k], &more[k], parts, &state, how);
                k += 1;
            }
            count += alive.to_bitmask().count_ones();
        }
        let block = packet.block as usize;
        shading.count_of(block, 0, count);
        i += 1;
    }
}

/// Which lanes' alpha covers a sample: of n samples the first `round(n alpha)`.
#[inline(always)]
fn covers_by_alpha<S: Simd>(s: S, alpha: &[f32; 16], sample: usize, samples: usize) -> mask32x16<S> {
    (f32x16::simd_from(s, *alpha) * samples as f32).simd_ge(f32x16::splat(s, sample as f32 + 0.5))
}
