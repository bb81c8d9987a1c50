//! From covered or visible samples to colours in the tile: interpolation, the user's fragment stage, blending.

use super::blend::blend;
use super::interpolate::Interpolator;
use super::over::{is_over, merge_over};
use super::packet::{BATCH, PacketBatch, VaryingLayout};
use super::run::RunView;
use super::single::LEAST_PACKETS;
use super::stencil::Tests;
use super::visible_packets::VisiblePacket;
use super::{__Row4 as Row4, OutputKind, StageUses};
use crate::pass::draw_call::DrawCall;
use crate::pass::{Blend, ColorMask, ColorState, Conservative, DrawStatistics, Sampling};
use crate::raster::samples::SampleSet;
use crate::raster::triangle_id::TriangleId;
use crate::target::format::{Channels, ColorFormat, TileColor};
use crate::tile::Tile;
use crate::tile::sink::AnyTest;
use crate::tile::view::TileView;
use crate::wide::{Simd, f32x16, i32x16, mask32x16, u32x16};
use fearless_simd::Level;

/// The samples of a block that one triangle covers, for a draw that blends or discards.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct OrderedPacket {
    pub(crate) depth: [i32; 16],
    pub(crate) id: u32,
    pub(crate) block: u32,
    pub(crate) mask: u32,
}

/// A packet before it is in a batch.
trait Shown {
    /// The id of the triangle that it shows; 0 if it shows several.
    fn triangle(&self) -> u32;
}

impl Shown for OrderedPacket {
    #[inline(always)]
    fn triangle(&self) -> u32 {
        self.id
    }
}

impl Shown for VisiblePacket {
    #[inline(always)]
    fn triangle(&self) -> u32 {
        self.id
    }
}

/// A draw, its run's vertices, and the tile that is shaded.
pub(crate) struct Shading<'a> {
    pub(crate) level: Level,
    pub(crate) call: &'a dyn DrawCall,
    pub(crate) run: &'a RunView<'a>,
    pub(crate) view: &'a TileView,
    pub(crate) tile: &'a mut Tile,
    pub(crate) color: &'a mut TileColor,
    /// Those of the further colour buffers.
    pub(crate) more_colors: &'a mut [TileColor],
    pub(crate) batch: &'a mut PacketBatch,
    pub(crate) interpolator: &'a mut Interpolator,
    pub(crate) uses: StageUses,
    /// What becomes of depths that are not the triangles' own.
    pub(crate) depth: AnyTest,
    /// Where fragments and samples of ordered draws are counted, if they are.
    pub(crate) counted: Option<&'a mut DrawStatistics>,
}

impl Shading<'_> {
    /// How many colours beyond the first go to a buffer. A second source does not.
    #[inline(always)]
    pub(super) fn further(&self) -> usize {
        self.call.outputs().kinds.len().saturating_sub(1).min(self.more_colors.len())
    }

    /// Interpolates the varyings of the batch's packets; with `SINGLE`, each packet is known to show one triangle.
    #[inline(never)]
    pub(super) fn interpolate<S: Simd, const SINGLE: bool>(&mut self, s: S, layout: &VaryingLayout) {
        let call = self.call;
        let position = |vertex: usize| call.position(vertex);
        s.apart(
            #[inline(always)]
            || self.interpolator.interpolate::<S, SINGLE>(s, self.run, &position, layout, self.batch),
        );
    }

    /// Whether packets of one triangle in a row are shaded in batches of their own.
    #[inline(always)]
    fn takes_singles<S: Simd>(&self, layout: &VaryingLayout) -> bool {
        // Beyond a triangle, where overestimates reach, weights may be infinite, and what is constant at its corners is not.
        let is_inside = self.call.state().conservative == Conservative::Off;
        S::HAS_SHORTCUTS && layout.is_plain && is_inside && self.run.strokes.is_none()
    }

    /// Whether packets begin with enough of one triangle, which is not clipped.
    #[inline(always)]
    fn begins_with_one<P: Shown>(&self, packets: &[P]) -> bool {
        let id = packets[0].triangle();
        if id == 0 || TriangleId(id).is_clipped() {
            return false;
        }
        let mut count = 1;
        while count < LEAST_PACKETS.min(packets.len()) && packets[count].triangle() == id {
            count += 1;
        }
        count == LEAST_PACKETS || self.batch.is_shared_by(id)
    }

    /// Runs the fragment stage over the batch.
    #[inline(always)]
    pub(super) fn run_fragments<S: Simd>(&mut self, s: S) {
        let uses = self.uses;
        if uses.ids {
            let run = self.run;
            self.batch.number(run.run.draw, |id| run.run.instance_and_triangle(id.number() - run.first_number));
        }
        if uses.sample_index | uses.sample_mask {
            self.tell_samples();
        }
        self.call.run_fragments(self.level, self.batch);
        if uses.writes_depth {
            self.batch.finish_written_depths(s, &self.depth);
        }
    }

    /// The parts of packet `i`'s pixels that a smooth line covers; `None` of anything else.
    #[inline(always)]
    pub(super) fn covered_parts<S: Simd>(&self, s: S, i: usize) -> Option<f32x16<S>> {
        let strokes = self.run.strokes.as_ref()?;
        let fragments = self.batch.fragments(i);
        strokes.covered_parts(s, TriangleId(fragments.ids[0]).number() - self.run.first_number, &fragments)
    }

    /// Says which samples the batch's fragments are of, and cover.
    #[inline(never)]
    fn tell_samples(&mut self) {
        let (view, state) = (self.view, self.call.state());
        if view.samples.is_one() || state.sampling == Sampling::Sample {
            self.batch.set_samples(|block| view.sample_of(block));
        } else {
            self.batch.find_covered_samples(self.call, self.run, SampleSet::new(view.samples, state.sample_mask));
        }
    }

    /// Counts the lanes of a block.
    #[inline(always)]
    fn count(&mut self, block: usize, fragments: u32, samples: u32) {
        self.count_of(block, fragments.count_ones(), samples.count_ones());
    }

    /// Counts fragments that are shaded and samples that pass in a block.
    #[inline(always)]
    pub(super) fn count_of(&mut self, block: usize, fragments: u32, samples: u32) {
        if let Some(counted) = self.counted.as_deref_mut().filter(|_| !self.view.is_border(block)) {
            counted.fragments_shaded += u64::from(fragments);
            counted.samples_passed += u64::from(samples);
            counted.samples_written += u64::from(samples);
        }
    }
}

/// Shades what the visibility buffer shows: each sample once.
#[inline(always)]
pub(crate) fn shade_visible<S: Simd>(s: S, shading: &mut Shading<'_>, packets: &[VisiblePacket]) {
    let layout = shading.call.layout();
    shading.interpolator.start(shading.run, &layout);
    let takes_singles = shading.takes_singles::<S>(&layout);
    let mut first = 0;
    while first < packets.len() {
        if takes_singles && shading.begins_with_one(&packets[first..]) {
            first += take_visible_of_one(shading, &layout, &packets[first..]);
            shading.interpolator.interpolate_one(s, &layout, shading.batch);
        } else {
            shading.batch.start(&layout, shading.run.front_is_clockwise);
            let end = (first + BATCH).min(packets.len());
            while first < end {
                let VisiblePacket { block, mask, x, y, .. } = packets[first];
                let packet = shading.batch.add(block, mask, x, y);
                packet.ids = shading.tile.id[block as usize];
                packet.depth = shading.tile.depth[block as usize];
                first += 1;
            }
            shading.interpolate::<S, false>(s, &layout);
        }
        shading.run_fragments(s);
        store(s, shading);
    }
}

/// Brings the colours of a batch of visible packets into the tile.
#[inline(always)]
fn store<S: Simd>(s: S, shading: &mut Shading<'_>) {
    let further = shading.further();
    let mut i = 0;
    while i < shading.batch.len() {
        let packet = &shading.batch.packets()[i];
        let alive = mask32x16::from_bitmask(s, u64::from(packet.alive));
        let block = packet.block as usize;
        shading.color.store(s, block, alive, channels(s, &packet.color), ColorMask::ALL);
        let mut k = 0;
        while k < further {
            let color = channels(s, &shading.batch.more(i)[k]);
            shading.more_colors[k].store(s, block, alive, color, ColorMask::ALL);
            k += 1;
        }
        i += 1;
    }
}

/// Fills the batch with the first packets, as far as they are of one triangle, at most sixteen. Returns how many they are.
#[inline(always)]
fn take_visible_of_one(shading: &mut Shading<'_>, layout: &VaryingLayout, packets: &[VisiblePacket]) -> usize {
    let id = packets[0].id;
    shading.interpolator.start_batch_of(shading.run, layout, shading.batch, TriangleId(id));
    let mut count = 0;
    while count < packets.len().min(BATCH) && packets[count].id == id {
        let VisiblePacket { block, mask, x, y, .. } = packets[count];
        let packet = shading.batch.add(block, mask, x, y);
        packet.depth = shading.tile.depth[block as usize];
        count += 1;
    }
    count
}

/// Shades covered samples in submission order, with depth test and blending.
#[inline(always)]
pub(crate) fn shade_in_order<S: Simd>(s: S, shading: &mut Shading<'_>, packets: &[OrderedPacket]) {
    let layout = shading.call.layout();
    shading.interpolator.start(shading.run, &layout);
    let call = shading.call;
    let (state, uses) = (call.state(), shading.uses);
    let is_late = uses.decides();
    let tests = Tests { state, front_is_clockwise: shading.run.front_is_clockwise };
    let has_color = shading.color.format != ColorFormat::None || !shading.more_colors.is_empty();
    let is_shaded = is_late || (has_color && !state.writes_no_color(call.outputs().kinds.len()));
    let is_usual = is_shaded && !is_late && state.stencil.is_none() && shading.counted.is_none();
    let takes_singles = is_usual && shading.takes_singles::<S>(&layout);
    let is_over = S::HAS_SHORTCUTS
        && is_usual
        && shading.run.strokes.is_none()
        && shading.further() == 0
        && is_over(&state.color(0), shading.color.format);
    let mut first = 0;
    while first < packets.len() {
        if takes_singles && shading.begins_with_one(&packets[first..]) {
            first += take_ordered_of_one(s, shading, &layout, &packets[first..]);
            shading.interpolator.interpolate_one(s, &layout, shading.batch);
            shading.run_fragments(s);
            merge(s, shading, is_over);
            continue;
        }
        shading.batch.start(&layout, shading.run.front_is_clockwise);
        // A bit for the blocks of the batch, by their numbers' last six bits.
        let mut blocks = 0u64;
        let mut next = first;
        while next < packets.len() && shading.batch.len() < BATCH {
            let packet = &packets[next];
            // What an earlier packet of the batch is about to change must not be tested yet.
            if blocks >> (packet.block & 63) & 1 != 0 && contains(shading.batch, packet.block) {
                break;
            }
            blocks |= 1 << (packet.block & 63);
            let block = packet.block as usize;
            let covered = mask32x16::from_bitmask(s, u64::from(packet.mask));
            let id = TriangleId(packet.id);
            let tested = tests.of(s, shading.tile, id, block, covered, &packet.depth);
            let mut mask = tested.both;
            if is_late {
                mask = tested.undecided(uses.writes_depth);
            } else {
                tested.update(s, shading.tile, block);
            }
            let mask = mask.to_bitmask() as u32;
            shading.count(block, if is_shaded { mask } else { 0 }, if is_shaded { 0 } else { mask });
            if !is_shaded {
                keep(s, shading.tile, state.depth.write, block, tested.both, &packet.depth, &[packet.id; 16]);
                next += 1;
                continue;
            }
            if mask != 0 {
                let (x, y) = shading.view.pixel_of(packet.block as usize);
                let new = shading.batch.add(packet.block, mask, x, y);
                (new.ids, new.depth) = ([packet.id; 16], packet.depth);
            }
            next += 1;
        }
        shading.interpolate::<S, true>(s, &layout);
        shading.run_fragments(s);
        merge(s, shading, is_over);
        first = next;
    }
}

/// Fills the batch with what passes the depth test of the first packets, as far as they are of one triangle, at most sixteen. Returns how many they are.
#[inline(always)]
fn take_ordered_of_one<S: Simd>(
    s: S,
    shading: &mut Shading<'_>,
    layout: &VaryingLayout,
    packets: &[OrderedPacket],
) -> usize {
    let id = packets[0].id;
    shading.interpolator.start_batch_of(shading.run, layout, shading.batch, TriangleId(id));
    let mut blocks = [packets[0].block; BATCH];
    let mut count = 1;
    while count < packets.len().min(BATCH) && packets[count].id == id {
        blocks[count & (BATCH - 1)] = packets[count].block;
        count += 1;
    }
    let (x, y) = shading.view.pixels_of(u32x16::simd_from(s, blocks));
    let (x, y): ([i32; BATCH], [i32; BATCH]) = (x.into(), y.into());
    let compare = shading.call.state().depth.compare;
    let mut i = 0;
    while i < count {
        let packet = &packets[i];
        let depth = i32x16::simd_from(s, packet.depth);
        let there = i32x16::simd_from(s, shading.tile.depth[packet.block as usize]);
        let mask = compare.passing_lanes(s, depth, there) & packet.mask;
        if mask != 0 {
            let (x, y) = (x[i & (BATCH - 1)], y[i & (BATCH - 1)]);
            shading.batch.add(packet.block, mask, x, y).depth = depth.into();
        }
        i += 1;
    }
    count
}

#[inline(always)]
pub(super) fn contains(batch: &PacketBatch, block: u32) -> bool {
    let mut found = false;
    let mut k = 0;
    while k < batch.len() {
        found |= batch.packets()[k].block == block;
        k += 1;
    }
    found
}

/// Brings the colours of a batch of ordered packets into the tile. `is_over` says that [`merge_over`] does all that is to be done.
#[inline(never)]
fn merge<S: Simd>(s: S, shading: &mut Shading<'_>, is_over: bool) {
    s.apart(
        #[inline(always)]
        || if S::HAS_SHORTCUTS && is_over { merge_over(s, shading) } else { merge_any(s, shading) },
    );
}

#[inline(always)]
fn merge_any<S: Simd>(s: S, shading: &mut Shading<'_>) {
    let (state, uses) = (shading.call.state(), shading.uses);
    // Without a stencil test, what is not discarded has passed, unless its depth is another now. (To test the rest of what passed once more changes nothing.)
    let is_late = uses.leaves_more() || (uses.discards && state.stencil.is_some());
    let tests = Tests { state, front_is_clockwise: shading.run.front_is_clockwise };
    let first = state.color(0);
    let how = How::of(&first);
    let further = shading.further();
    let mut i = 0;
    while i < shading.batch.len() {
        let packet = &shading.batch.packets()[i];
        let block = packet.block as usize;
        let mut alive = mask32x16::from_bitmask(s, u64::from(packet.alive));
        if is_late {
            if uses.writes_sample_mask {
                alive = alive & shading.batch.lets_cover(s, i, 0);
            }
            let id = TriangleId(packet.ids[0]);
            let tested = tests.of(s, shading.tile, id, block, alive, &packet.depth);
            tested.update(s, shading.tile, block);
            alive = tested.both;
        }
        keep(s, shading.tile, state.depth.write, block, alive, &packet.depth, &packet.ids);
        let passed = alive.to_bitmask() as u32;
        let parts = shading.covered_parts(s, i);
        let more = shading.batch.more(i);
        // Only a target with one colour buffer is blended with a second source.
        let second = if more.is_empty() { &packet.color } else { &more[0] };
        merge_color(s, shading.color, block, alive, &packet.color, second, parts, &first, how);
        let mut k = 0;
        while k < further {
            let state = state.color(k + 1);
            let (tile, how) = (&mut shading.more_colors[k], How::of(&state));
            merge_color(s, tile, block, alive, &more[k], &more[k], parts, &state, how);
            k += 1;
        }
        shading.count(block, 0, passed);
        i += 1;
    }
}

/// What the samples that passed leave in the tile, but for colour and stencil.
#[inline(always)]
pub(crate) fn keep<S: Simd>(
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

/// What becomes of a colour, found out once a batch.
#[derive(Clone, Copy)]
pub(super) enum How {
    Replace,
    Alpha,
    Any,
}

impl How {
    pub(super) fn of(state: &ColorState) -> Self {
        let Blend { color, alpha, .. } = Blend::ALPHA;
        match state.blend {
            blend if blend.replaces() => Self::Replace,
            blend if blend.color == color && blend.alpha == alpha => Self::Alpha,
            _ => Self::Any,
        }
    }
}

/// Brings one colour into the tile's; of a smooth line, by the parts of the pixels that it covers.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "inlined")]
pub(super) fn merge_color<S: Simd>(
    s: S,
    tile: &mut TileColor,
    block: usize,
    alive: mask32x16<S>,
    color: &Row4,
    second: &Row4,
    parts: Option<f32x16<S>>,
    state: &ColorState,
    how: How,
) {
    let (mut color, second, is_unorm) = (channels(s, color), channels(s, second), tile.format.is_unorm());
    // Integers have no alpha to be multiplied.
    if let Some(parts) = parts.filter(|_| tile.format.kind() == OutputKind::Float) {
        color[3] = f32x16::simd_from(s, products(&color[3].into(), &parts.into()));
    }
    // With the usual states known, nothing is left to be chosen.
    match how {
        How::Replace => {}
        How::Alpha => color = blend(s, &Blend::ALPHA, is_unorm, color, second, tile.load(s, block)),
        How::Any => color = blend(s, &state.blend, is_unorm, color, second, tile.load(s, block)),
    }
    tile.store(s, block, alive, color, state.mask);
}

/// Lane by lane. Not inlined: the compiler would multiply whether there is something to multiply by or not, and of what lies there else,
/// many a number is denormal, which takes a processor many times as long.
#[inline(never)]
fn products(a: &[f32; 16], b: &[f32; 16]) -> [f32; 16] {
    let mut out = [0.0; 16];
    for k in 0..16 {
        out[k] = a[k] * b[k];
    }
    out
}

#[inline(always)]
pub(crate) fn channels<S: Simd>(s: S, color: &Row4) -> Channels<S> {
    let [r, g, b, a] = *color;
    [f32x16::simd_from(s, r), f32x16::simd_from(s, g), f32x16::simd_from(s, b), f32x16::simd_from(s, a)]
}
