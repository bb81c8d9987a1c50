//! Packets between the stages: interpolation fills their rows, the fragment stage reads them and leaves colours, blending takes those.
//!
//! Only the fragment stage is compiled for each shader; so what it works on lies in memory, a batch of packets at a time.

use super::coordinates::Coordinates;
use super::distinct::Fragments;
use super::parts::Parts;
use super::run::RunView;
use super::{__Row4 as Row4, Frag, FragParts, FragmentStage, Interpolation, OutputLayout, Outputs, Varyings};
use crate::geometry::raster_space::{HALF_PIXEL, SUBPIXELS};
use crate::lanes::Packet;
use crate::math::{Bool, Real, Uint, Vec2, Vec3};
use crate::pass::Conservative;
use crate::pass::draw_call::DrawCall;
use crate::pass::plan::DepthRule;
use crate::raster::samples::{Sample, SampleSet, Samples};
use crate::raster::triangle_id::{CLIPPED_CLOCKWISE, ORDER_BITS, TriangleId};
use crate::tile::sink::AnyTest;
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
    /// Whether the depth is interpolated, too.
    pub(crate) depth: bool,
    /// Whether barycentric coordinates are asked for.
    pub(crate) barycentrics: bool,
    /// Whether everything is interpolated with perspective, and there is nothing but varyings (and their derivatives, and depth).
    pub(crate) is_plain: bool,
}

impl VaryingLayout {
    pub(crate) fn new(interpolation: &'static [Interpolation], derivatives: bool) -> Self {
        let is_plain = interpolation.iter().all(|&i| i == Interpolation::Perspective);
        Self { interpolation, derivatives, point_coord: false, depth: false, barycentrics: false, is_plain }
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
    pub(crate) z: &'a mut [f32; 16],
    pub(crate) barycentrics: &'a mut [Coordinates; 2],
}

/// Whether a packet's fragments are shaded elsewhere than at their pixels' centres.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Moved {
    No,
    /// Some lanes are, each to a place of its own that its triangle covers; the fragments are the pixels' still.
    ByLane,
    /// All are, to one sample, whose fragments they are.
    ToSample,
    /// The lanes are of any pixels of a tile.
    Gathered,
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
    /// The lanes whose colour counts; the fragment stage takes away those that it discards.
    pub(crate) alive: u32,
}

/// Up to [`BATCH`] packets of one run.
#[derive(Debug)]
pub(crate) struct PacketBatch {
    packets: [PacketState; BATCH],
    /// The first pixel of each one's block.
    x: [i32; BATCH],
    y: [i32; BATCH],
    count: usize,
    /// The triangle that all packets are of, those that are yet to be added too, and whose constant varyings their rows hold. 0 is none.
    shared_by: u32,
    /// From `aligned` on, so that no row lies in two cache lines.
    rows: Vec<f32>,
    aligned: usize,
    rows_each: usize,
    /// What the packets' fragments have beside a colour: for further colour buffers, or to be blended with.
    more: Vec<Row4>,
    more_each: usize,
    derivatives: bool,
    front_is_clockwise: bool,
    /// How far the lanes of each packet are moved off their pixels' centres, in subpixels.
    moved: [Moved; BATCH],
    offsets: [[[i32; 16]; 2]; BATCH],
    /// Those that may have to be.
    borders: [u32; BATCH],
    samples: Samples,
    /// Interpolated depths.
    z: [[f32; 16]; BATCH],
    /// Each lane's triangle and instance, for shaders that ask for them; and the draw of all.
    numbers: [[[u32; 16]; 2]; BATCH],
    draw: u32,
    /// With perspective and without, for shaders that ask for them.
    barycentrics: [[Coordinates; 2]; BATCH],
    /// The sample that each packet is of, if it is of one, and the samples that its lanes cover, for shaders that ask for them. Those that write a mask leave it here.
    sample_indices: [u32; BATCH],
    sample_masks: [[u32; 16]; BATCH],
}

impl PacketBatch {
    pub(crate) fn new() -> Self {
        Self {
            packets: [PacketState::default(); BATCH],
            x: [0; BATCH],
            y: [0; BATCH],
            count: 0,
            shared_by: 0,
            rows: Vec::new(),
            aligned: 0,
            rows_each: 0,
            more: Vec::new(),
            more_each: 0,
            derivatives: false,
            front_is_clockwise: false,
            moved: [Moved::No; BATCH],
            offsets: [[[0; 16]; 2]; BATCH],
            borders: [0; BATCH],
            samples: Samples::One,
            z: [[0.0; 16]; BATCH],
            numbers: [[[0; 16]; 2]; BATCH],
            draw: 0,
            barycentrics: [[[[0.0; 16]; 3]; 2]; BATCH],
            sample_indices: [0; BATCH],
            sample_masks: [[0; 16]; BATCH],
        }
    }

    /// Empties the batch for packets of this layout.
    pub(crate) fn start(&mut self, layout: &VaryingLayout, front_is_clockwise: bool) {
        (self.count, self.shared_by) = (0, 0);
        (self.moved, self.borders) = ([Moved::No; BATCH], [0; BATCH]);
        self.rows_each = layout.rows();
        self.derivatives = layout.derivatives;
        self.front_is_clockwise = front_is_clockwise;
        if self.rows.len() < 16 * (BATCH * self.rows_each + 1) {
            self.reserve_rows();
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

    /// Adds a packet of some of the pixels of the block from (x, y) on, with whatever else an earlier one left in it. There must be room.
    #[inline(always)]
    pub(crate) fn add(&mut self, block: u32, alive: u32, x: i32, y: i32) -> &mut PacketState {
        let k = self.count;
        let packet = &mut self.packets[k];
        (packet.block, packet.alive, self.x[k & (BATCH - 1)], self.y[k & (BATCH - 1)]) = (block, alive, x, y);
        self.count += 1;
        packet
    }

    /// The first pixels of all packets' blocks; behind the last packet, of any.
    #[inline(always)]
    pub(crate) fn places(&self) -> (&[i32; BATCH], &[i32; BATCH]) {
        (&self.x, &self.y)
    }

    /// What is to be shaded of packet `k`.
    #[inline(always)]
    pub(crate) fn fragments(&self, k: usize) -> Fragments<'_> {
        let PacketState { ids, alive, .. } = &self.packets[k];
        let k = k & (BATCH - 1);
        let moved = if self.moved[k] == Moved::No { None } else { Some(&self.offsets[k]) };
        let (x, y, border, samples) = (self.x[k], self.y[k], self.borders[k], self.samples);
        Fragments { ids, mask: *alive, x, y, moved, border, samples }
    }

    /// Moves the lanes of the last packet off their pixels' centres.
    pub(crate) fn shift(&mut self, moved: Moved, offsets: [[i32; 16]; 2]) {
        let last = self.count.wrapping_sub(1) & (BATCH - 1);
        (self.moved[last], self.offsets[last]) = (moved, offsets);
    }

    /// Leaves it to interpolation to move lanes of the last packet, which is of triangles on the raster.
    pub(crate) fn find_centroids(&mut self, border: u32, samples: Samples) {
        self.borders[self.count.wrapping_sub(1) & (BATCH - 1)] = border;
        self.samples = samples;
    }

    /// Whether a packet is moved, or may have to be.
    #[inline(always)]
    pub(crate) fn is_moved(&self, k: usize) -> bool {
        self.moved[k & (BATCH - 1)] != Moved::No || self.borders[k & (BATCH - 1)] != 0
    }

    /// Replaces the interpolated depths: by what a function makes of a triangle's id and a place on the raster, in subpixels.
    pub(crate) fn set_depths(&mut self, depth: impl Fn(u32, [i32; 2]) -> f32) {
        for (k, packet) in self.packets.iter().enumerate().take(self.count) {
            let mut rest = packet.alive & 0xffff;
            while rest != 0 {
                let lane = rest.trailing_zeros() as usize & 15;
                rest &= rest - 1;
                let [dx, dy] = if self.moved[k] == Moved::No { [0; 2] } else { self.offsets[k].map(|row| row[lane]) };
                let (x, y) = (self.x[k] + (lane & 3) as i32, self.y[k] + (lane >> 2) as i32);
                let center = |v: i32| v * SUBPIXELS + HALF_PIXEL;
                self.z[k][lane] = depth(packet.ids[lane], [center(x) + dx, center(y) + dy]);
            }
        }
    }

    /// Takes the interpolated depths for the fragments', clamped.
    #[inline(always)]
    pub(crate) fn take_depths<S: Simd>(&mut self, s: S, rule: &DepthRule) {
        let mut k = 0;
        while k < self.count {
            let z = f32x16::simd_from(s, self.z[k & (BATCH - 1)]);
            self.packets[k].depth = rule.clamped(s, z).bitcast::<i32x16<S>>().into();
            k += 1;
        }
    }

    /// Makes of the depths that the fragment stage left what is tested and stored.
    #[inline(never)]
    pub(crate) fn finish_written_depths<S: Simd>(&mut self, s: S, test: &AnyTest) {
        s.apart(
            #[inline(always)]
            || {
                let mut k = 0;
                while k < self.count {
                    let z = i32x16::simd_from(s, self.packets[k & (BATCH - 1)].depth).bitcast::<f32x16<S>>();
                    let z = test.format.rounded_lanes(s, test.rule.clamped(s, z));
                    self.packets[k & (BATCH - 1)].depth = z.bitcast::<i32x16<S>>().into();
                    k += 1;
                }
            },
        );
    }

    /// Says of which draw the packets are, and by a function of its id, of which instance and triangle each lane is.
    #[inline(never)]
    pub(crate) fn number(&mut self, draw: usize, instance_and_triangle: impl Fn(TriangleId) -> (usize, usize)) {
        self.draw = draw as u32;
        for (packet, [triangles, instances]) in self.packets[..self.count].iter().zip(&mut self.numbers) {
            let mut rest = packet.alive & 0xffff;
            while rest != 0 {
                let lane = rest.trailing_zeros() as usize & 15;
                rest &= rest - 1;
                let (instance, triangle) = instance_and_triangle(TriangleId(packet.ids[lane]));
                (triangles[lane], instances[lane]) = (triangle as u32, instance as u32);
            }
        }
    }

    /// Says by a function of its block of which sample each packet is: the only one that its fragments cover.
    #[inline(never)]
    pub(crate) fn set_samples(&mut self, sample_of: impl Fn(usize) -> usize) {
        for (k, packet) in self.packets[..self.count].iter().enumerate() {
            let sample = sample_of(packet.block as usize) as u32;
            (self.sample_indices[k], self.sample_masks[k]) = (sample, [1 << (sample & 15); 16]);
        }
    }

    /// Finds the samples that the fragments cover, of those that the draw lets through.
    #[inline(never)]
    pub(crate) fn find_covered_samples(&mut self, call: &dyn DrawCall, run: &RunView<'_>, samples: SampleSet) {
        // Fragments of one triangle mostly follow each other.
        let (mut last, mut parts) = (TriangleId(0), Parts::Wholes);
        for (k, packet) in self.packets[..self.count].iter().enumerate() {
            let mut rest = packet.alive & 0xffff;
            while rest != 0 {
                let lane = rest.trailing_zeros() as usize & 15;
                rest &= rest - 1;
                let id = TriangleId(packet.ids[lane]);
                if id != last {
                    let covers_wholes = call.state().conservative != Conservative::Off;
                    (last, parts) = (id, if covers_wholes { Parts::Wholes } else { Parts::of(call, run, id) });
                }
                // Other lanes than gathered ones are of the pixels where they stand, wherever they are shaded.
                let [dx, dy] =
                    if self.moved[k] == Moved::Gathered { self.offsets[k].map(|row| row[lane]) } else { [0; 2] };
                let (x, y) = (self.x[k] + (lane & 3) as i32, self.y[k] + (lane >> 2) as i32);
                let center = [x * SUBPIXELS + HALF_PIXEL + dx, y * SUBPIXELS + HALF_PIXEL + dy];
                let (mut mask, mut asked) = (0, samples.mask);
                while let Some(Sample { plane, offset }) = samples.take(&mut asked) {
                    mask |= u32::from(parts.cover([center[0] + offset[0], center[1] + offset[1]])) << plane;
                }
                self.sample_masks[k][lane] = mask;
            }
        }
    }

    /// The lanes of packet `k` whose fragment stage left a mask with a sample in it.
    #[inline(always)]
    pub(crate) fn lets_cover<S: Simd>(&self, s: S, k: usize, sample: usize) -> mask32x16<S> {
        !(u32x16::simd_from(s, self.sample_masks[k & (BATCH - 1)]) & (1 << (sample & 15))).simd_eq(0)
    }

    /// Whether the batch was last started for packets of one triangle only, and for this one.
    #[inline(always)]
    pub(crate) fn is_shared_by(&self, id: u32) -> bool {
        self.shared_by == id
    }

    /// Other triangles come, which may have the same ids.
    pub(crate) fn forget(&mut self) {
        self.shared_by = 0;
    }

    /// Empties the batch for more packets of the triangle that shares it.
    #[inline(always)]
    pub(crate) fn start_again(&mut self) {
        self.count = 0;
    }

    /// Gives every packet, those that are yet to be added too, the id of a triangle.
    pub(crate) fn share(&mut self, id: u32) {
        self.shared_by = id;
        for packet in &mut self.packets {
            packet.ids = [id; 16];
        }
    }

    /// The same for a row.
    pub(crate) fn share_row(&mut self, k: usize, row: [f32; 16]) {
        for packet in 0..BATCH {
            self.packet(packet).1.here[k] = row;
        }
    }

    /// The fragments of packet `k`, and its rows.
    #[inline(always)]
    pub(crate) fn packet(&mut self, k: usize) -> (Fragments<'_>, PacketRows<'_>) {
        let first = self.aligned + 16 * k * self.rows_each;
        let rows = self.rows[first..first + 16 * self.rows_each].as_chunks_mut().0;
        let each = if self.derivatives { rows.len() / 3 } else { rows.len() };
        let (here, rest) = rows.split_at_mut(each);
        let (dx, dy) = rest.split_at_mut(if self.derivatives { each } else { 0 });
        let PacketState { ids, alive, .. } = &self.packets[k];
        let moved = if self.moved[k & (BATCH - 1)] == Moved::No { None } else { Some(&self.offsets[k & (BATCH - 1)]) };
        let (x, y) = (self.x[k & (BATCH - 1)], self.y[k & (BATCH - 1)]);
        let (border, samples) = (self.borders[k & (BATCH - 1)], self.samples);
        let fragments = Fragments { ids, mask: *alive, x, y, moved, border, samples };
        let (z, barycentrics) = (&mut self.z[k & (BATCH - 1)], &mut self.barycentrics[k & (BATCH - 1)]);
        (fragments, PacketRows { here, dx, dy, z, barycentrics })
    }

    /// The rows of all packets, so many each.
    #[inline(always)]
    pub(crate) fn all_rows(&mut self) -> (&mut [[f32; 16]], usize) {
        (self.rows[self.aligned..].as_chunks_mut().0, self.rows_each)
    }

    /// The row of packet `k` for interpolated depths.
    #[inline(always)]
    pub(crate) fn depth_row(&mut self, k: usize) -> &mut [f32; 16] {
        &mut self.z[k & (BATCH - 1)]
    }

    /// What the fragments of packet `k` have beside a colour.
    #[inline(always)]
    pub(crate) fn more(&self, k: usize) -> &[Row4] {
        &self.more[k * self.more_each..(k + 1) * self.more_each]
    }

    #[inline(never)]
    fn reserve_rows(&mut self) {
        self.rows.resize(16 * (BATCH * self.rows_each + 1), 0.0);
        self.aligned = self.rows.as_ptr().align_offset(64).min(15);
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
        let mut k = 0;
        while k < self.count {
            // A function of its own: in one with the loop around it, LLVM's time grows with the square of the stage's length.
            s.apart(
                #[inline(always)]
                || self.run_packet(s, stage, k),
            );
            k += 1;
        }
    }

    #[inline(always)]
    fn run_packet<S: Simd, St: FragmentStage<Packet<S>>>(&mut self, s: S, stage: &St, k: usize) {
        let more_each = const { OutputLayout::of::<Packet<S>, St::Out>().more() };
        let lanes = BlockLanes::new(s);
        let own = 16 * <St::V as Varyings<Packet<S>>>::LEN;
        let length = if St::POINT_COORD { own + 2 * 16 } else { own };
        let zero = Real(f32x16::splat(s, 0.0));
        let none = Bool(mask32x16::splat(s, false));
        let first = St::V::read(Packet(s), &self.rows);
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
                ids: [Uint(i32x16::splat(s, 0)); 3],
                barycentrics: [Vec3::new(zero, zero, zero); 2],
                depth: zero,
                sample_index: Uint(i32x16::splat(s, 0)),
                sample_mask: Uint(i32x16::splat(s, 0)),
                written_mask: Uint(i32x16::splat(s, 0)),
                front_facing: none,
                alive: none,
            },
            kind: PhantomData,
        };
        let packet = &mut self.packets[k];
        let at = self.aligned + 16 * k * self.rows_each;
        let rows = &self.rows[at..at + 16 * self.rows_each];
        let parts = &mut fragment.parts;
        parts.varyings = St::V::read(Packet(s), rows);
        if St::DERIVATIVES {
            parts.dx = St::V::read(Packet(s), &rows[length..]);
            parts.dy = St::V::read(Packet(s), &rows[2 * length..]);
        }
        if St::POINT_COORD {
            parts.point_coord = Vec2::read(Packet(s), &rows[own..]);
        }
        if St::IDS {
            let [triangles, instances] = self.numbers[k & (BATCH - 1)];
            let (triangles, instances) = (u32x16::simd_from(s, triangles), u32x16::simd_from(s, instances));
            let draw = i32x16::splat(s, self.draw.cast_signed());
            parts.ids = [Uint(triangles.bitcast()), Uint(instances.bitcast()), Uint(draw)];
        }
        let ids = u32x16::simd_from(s, packet.ids);
        let code: i32x16<S> = (ids & ((1 << ORDER_BITS) - 1)).bitcast();
        let clockwise = code.simd_lt(3) | code.simd_eq(CLIPPED_CLOCKWISE as i32);
        parts.x = Real(lanes.x + (self.x[k & (BATCH - 1)] as f32 + 0.5));
        parts.y = Real(lanes.y + (self.y[k & (BATCH - 1)] as f32 + 0.5));
        if matches!(self.moved[k & (BATCH - 1)], Moved::ToSample | Moved::Gathered) {
            let [x, y] = self.offsets[k & (BATCH - 1)];
            let (x, y) = (i32x16::simd_from(s, x).to_float(), i32x16::simd_from(s, y).to_float());
            parts.x = Real(parts.x.0 + x * (1.0 / SUBPIXELS as f32));
            parts.y = Real(parts.y.0 + y * (1.0 / SUBPIXELS as f32));
        }
        parts.z = Real(i32x16::simd_from(s, packet.depth).bitcast());
        if St::BARYCENTRICS {
            let [with, without] = &self.barycentrics[k & (BATCH - 1)];
            parts.barycentrics =
                [Vec3::read(Packet(s), with.as_flattened()), Vec3::read(Packet(s), without.as_flattened())];
        }
        if St::WRITES_DEPTH {
            parts.depth = parts.z;
        }
        if St::SAMPLE_INDEX {
            let index = self.sample_indices[k & (BATCH - 1)];
            parts.sample_index = Uint(i32x16::splat(s, index.cast_signed()));
        }
        if St::SAMPLE_MASK {
            parts.sample_mask = Uint(u32x16::simd_from(s, self.sample_masks[k & (BATCH - 1)]).bitcast());
        }
        if St::WRITES_SAMPLE_MASK {
            parts.written_mask = Uint(i32x16::splat(s, -1));
        }
        parts.front_facing = Bool(if self.front_is_clockwise { clockwise } else { !clockwise });
        parts.alive = Bool(mask32x16::from_bitmask(s, u64::from(packet.alive)));
        let more = if more_each > 0 { &mut self.more[k * more_each..(k + 1) * more_each] } else { &mut [] };
        stage.run(&mut fragment).write(&mut packet.color, more);
        if St::DISCARDS {
            packet.alive = fragment.alive().0.to_bitmask() as u32;
        }
        if St::WRITES_SAMPLE_MASK {
            self.sample_masks[k & (BATCH - 1)] = fragment.parts.written_mask.0.bitcast::<u32x16<S>>().into();
        }
        if St::WRITES_DEPTH {
            packet.depth = fragment.parts.depth.0.bitcast::<i32x16<S>>().into();
        }
    }
}
