//! The stages of a pass, one after the other; each shares its work among the threads.

use super::Renderer;
use crate::geometry::clip::ClipTriangle;
use crate::geometry::raster_space::ScreenVertex;
use crate::pass::assembly::Assembly;
use crate::pass::draw_call::VertexJob;
use crate::pass::memory::uses_stencil;
use crate::pass::plan::{Batch, Geometry, Run};
use crate::pass::strokes::{Expansion, RECORDS_EACH, StrokeRun};
use crate::pass::validate::DrawExtent;
use crate::pass::{Conservative, Cull, DrawStatistics, FrontFace, Pass, ProvokingVertex};
use crate::raster::bins::{Share, TileGrid};
use crate::raster::conservative::set_up_conservative;
use crate::raster::corners::Corners;
use crate::raster::depth_bias::Bias;
use crate::raster::samples::SampleSet;
use crate::raster::setup::SetupState;
use crate::raster::stroke::{Stroke, StrokeState, set_up_strokes, set_up_triangles};
use crate::shading::run::{RecordRow, RunView, Source};
use crate::shading::strokes::StrokeView;
use crate::target::ColorBuffer;
use crate::target::bands::Bands;
use crate::target::depth::{DepthFormat, loaded_depth};
use crate::target::format::ColorFormat;
use crate::tile::paint::{Painting, Start, Wants};
use crate::tile::queue::TileQueue;
use crate::{Target, parallel};

/// Triangles that one job assembles.
const ASSEMBLED_PER_JOB: usize = 1 << 15;
/// Vertices that one job shades: fewer take less time than a thread to start. In builds for tests fewer all the same, so that small scenes have several jobs.
const VERTICES_PER_JOB: usize = if cfg!(debug_assertions) { 1 << 12 } else { 1 << 13 };
/// Lines or points that one job makes; those of a triangle stay together.
const STROKES_PER_JOB: usize = 3 * 1024;
/// Triangles below which another share is not worth its bins, and a thread; in builds for tests fewer, too.
const LEAST_SHARE: usize = if cfg!(debug_assertions) { 1 << 9 } else { 1 << 14 };

impl Renderer {
    /// Primitive assembly, where triangles are not given as the later stages want them.
    pub(super) fn assemble(&mut self, pass: &Pass<'_>, extents: &[DrawExtent], batch: &Batch<'_>) {
        let (mut firsts, mut copies) = (Vec::new(), Vec::new());
        let mut rest = &mut self.assembled[..batch.assembled];
        for run in &batch.runs {
            let (first_vertex, vertices_each) = match run.geometry {
                Geometry::Given(..) => continue,
                Geometry::Shared { first_vertex, vertices_each, .. } => (first_vertex, vertices_each),
                Geometry::Alone { .. } => (0, 0),
            };
            let (own, first, others);
            (own, rest) = rest.split_at_mut(run.assembled());
            (first, others) = own.split_at_mut(run.assembled().min(run.triangles_each));
            firsts.push((run, first_vertex, first));
            copies.push((others, vertices_each));
        }
        let mut workers = vec![(); self.threads];
        let mut jobs = Vec::new();
        for (run, first_vertex, first) in &mut firsts {
            let (_, mut next) = run.instance_and_triangle(0);
            for out in first.chunks_mut(ASSEMBLED_PER_JOB) {
                let begin = next;
                next += out.len();
                jobs.push((run.draw, *first_vertex, begin, out));
            }
        }
        parallel::for_each(&mut workers, jobs.into_iter(), |(), (draw, first_vertex, begin, out)| {
            Assembly::of(&*pass.draws[draw]).assemble(&extents[draw].stretches, begin, first_vertex, out);
        });
        let mut jobs = Vec::new();
        for ((_, _, first), (others, vertices_each)) in firsts.iter().zip(copies) {
            let instances = (ASSEMBLED_PER_JOB / first.len().max(1)).max(1);
            for (k, out) in others.chunks_mut(instances * first.len().max(1)).enumerate() {
                jobs.push((&**first, out, (1 + k * instances) as u32 * vertices_each, vertices_each));
            }
        }
        parallel::for_each(&mut workers, jobs.into_iter(), |(), (first, out, offset, vertices_each)| {
            copy_instances(first, out, offset, vertices_each);
        });
    }

    /// The vertex stage.
    pub(super) fn run_vertices(&mut self, pass: &Pass<'_>, batch: &Batch<'_>) {
        let mut jobs = Vec::new();
        let (mut screen, mut records) = (&mut self.screen[..], &mut self.records[..]);
        for run in &batch.runs {
            let rows = pass.draws[run.draw].record_rows();
            for first in (0..run.screen.len()).step_by(VERTICES_PER_JOB) {
                let count = (run.screen.len() - first).min(VERTICES_PER_JOB);
                let (own_screen, own_records);
                (own_screen, screen) = screen.split_at_mut(count);
                (own_records, records) = records.split_at_mut(count * rows);
                let job = VertexJob {
                    source: run.source(&self.assembled),
                    first_place: first,
                    projection: &run.projection,
                    screen: own_screen,
                    records: own_records,
                };
                jobs.push((run.draw, job));
            }
        }
        let level = self.level;
        parallel::for_each(&mut vec![(); self.threads], jobs.into_iter(), |(), (draw, job)| {
            pass.draws[draw].run_vertices(level, job);
        });
    }

    /// Lines and points, from the vertices that they have.
    pub(super) fn expand(&mut self, pass: &Pass<'_>, batch: &Batch<'_>, format: DepthFormat) {
        let mut jobs = Vec::new();
        let (mut strokes, mut records) = (&mut self.strokes[..], &mut self.stroke_records[..]);
        for run in &batch.runs {
            let Some(stroke_run) = &run.strokes else { continue };
            let call = &*pass.draws[run.draw];
            let expansion = Expansion {
                call,
                shape: stroke_run.shape,
                projection: &run.projection,
                corners: run.corners(&self.assembled),
                source: run.source(&self.assembled),
                screen: &self.screen[run.screen.clone()],
                records: &self.records[run.records.clone()],
                bias: Bias::new(&call.state().depth_bias, format),
            };
            for first in (0..run.triangles).step_by(STROKES_PER_JOB) {
                let count = (run.triangles - first).min(STROKES_PER_JOB);
                let (own_strokes, own_records);
                (own_strokes, strokes) = strokes.split_at_mut(count);
                (own_records, records) = records.split_at_mut(count * RECORDS_EACH * call.record_rows());
                jobs.push((expansion, first / run.numbers_each, own_strokes, own_records));
            }
        }
        let mut workers = vec![(); self.threads];
        parallel::for_each(&mut workers, jobs.into_iter(), |(), (expansion, first, strokes, records)| {
            expansion.run(first, strokes, records);
        });
    }

    /// Setup and binning: each share takes its stretch of the batch's triangles.
    pub(super) fn set_up(
        &mut self,
        pass: &Pass<'_>,
        batch: &Batch<'_>,
        grid: TileGrid,
        target: &Target<'_>,
        counts: bool,
    ) {
        let (format, samples) = (target.depth.format(), target.samples);
        let count = batch.triangles.div_ceil(LEAST_SHARE).clamp(1, self.threads);
        self.shares.resize_with(count, Share::default);
        let size = batch.triangles.div_ceil(count).next_multiple_of(16);
        let (level, screen, assembled) = (self.level, &self.screen[..], &self.assembled[..]);
        let strokes = &self.strokes[..];
        let shares = self.shares.iter_mut().enumerate();
        parallel::for_each(&mut vec![(); self.threads], shares, |(), (k, share)| {
            share.reset(&grid);
            let (first, last) = (k * size, ((k + 1) * size).min(batch.triangles));
            for run in &batch.runs[batch.run_of(first)..] {
                let start = first.max(run.first_number) - run.first_number;
                let end = last.min(run.first_number + run.triangles);
                if end <= run.first_number + start {
                    break;
                }
                let call = &pass.draws[run.draw];
                let samples = SampleSet::new(samples, call.state().sample_mask);
                if let Some(stroke_run) = &run.strokes {
                    let (shape, rect, projection) = (stroke_run.shape, run.rect, &run.projection);
                    let state = StrokeState { counts, level, grid, rect, samples, shape, projection };
                    let end = end - run.first_number;
                    let before = share.statistics;
                    share.statistics.count(call.state().topology, start, end, run.numbers_each);
                    share.start_segment(run.segment);
                    let strokes = &strokes[stroke_run.strokes.clone()][start..end];
                    set_up_strokes(&state, strokes, run.first_number + start, share);
                    if counts {
                        share.count(run.draw, &before);
                    }
                    continue;
                }
                let (corners, source) = (run.corners(assembled), run.source(assembled));
                let vertices = |places: [usize; 3]| ClipTriangle::of(&**call, places.map(|place| source.vertex(place)));
                let (cull_clockwise, cull_counter_clockwise) = culled(call.state().cull, call.state().front_face);
                let bias = Bias::new(&call.state().depth_bias, format);
                let state = SetupState {
                    grid,
                    rect: run.rect,
                    samples,
                    cull_clockwise,
                    cull_counter_clockwise,
                    bias,
                    counts,
                    numbered_in_pairs: false,
                    projection: &run.projection,
                    vertices: &vertices,
                };
                share.start_segment(run.segment);
                share.make_room(end - run.first_number - start, target.samples.count());
                let (range, screen) = (start..end - run.first_number, &screen[run.screen.clone()]);
                let before = share.statistics;
                match call.state().conservative {
                    Conservative::Off => {
                        set_up_triangles(level, &state, &corners, screen, range, run.first_number, share);
                    }
                    mode => set_up_conservative(mode, &state, &corners, screen, range, run.first_number, share),
                }
                if counts {
                    share.count(run.draw, &before);
                }
            }
        });
    }

    /// Adds a flush's numbers to its draws'.
    pub(super) fn collect(&mut self, batch: &Batch<'_>, draws: &mut [DrawStatistics]) {
        for run in &batch.runs {
            draws[run.draw].vertices_shaded += run.screen.len() as u64;
        }
        for share in &self.shares {
            draws.iter_mut().zip(&share.draws).for_each(|(draw, counted)| draw.add(counted));
        }
        for painter in &mut self.painters {
            draws.iter_mut().zip(&painter.draws).for_each(|(draw, counted)| draw.add(counted));
            painter.draws.clear();
        }
    }

    /// Coverage, depth and shading, tile by tile.
    pub(super) fn paint(
        &mut self,
        pass: &Pass<'_>,
        batch: &Batch<'_>,
        grid: TileGrid,
        target: &mut Target<'_>,
        is_first: bool,
        flushes: usize,
    ) {
        let view = |run| {
            let (screen, strokes) = (&self.screen, &self.strokes);
            view(pass, run, &self.assembled, screen, &self.records, strokes, &self.stroke_records)
        };
        let runs: Vec<RunView<'_>> = batch.runs.iter().map(view).collect();
        let (width, height) = (target.width, target.height);
        let wants = Wants {
            color: target.color.format(),
            more_colors: std::array::from_fn(|k| {
                target.color_buffer(k + 1).map_or(ColorFormat::None, ColorBuffer::format)
            }),
            more_count: target.more_colors.len(),
            depth: !target.depth.is_none(),
            stencil: target.stencil.is_some() || uses_stencil(pass),
            ids: target.triangle_ids.is_some()
                || target.instance_ids.is_some()
                || target.draw_ids.is_some()
                || target.barycentrics.is_some(),
            hits: target.hits.is_some(),
        };
        let depth_format = target.depth.format();
        let clear_depth = pass.clear_depth.map(|z| depth_format.rounded(f32::from_bits(loaded_depth(z) as u32)));
        let samples = target.samples;
        let kept = Some(&self.kept).filter(|_| flushes > 1 && !samples.is_one());
        // What is kept of some tiles only, the others still start with.
        let starts = is_first || kept.is_some();
        let colors = std::array::from_fn(|k| {
            let buffer = target.color_buffer(k).filter(|_| starts)?;
            pass.start_of(k, buffer.format())
        });
        let painting = Painting {
            level: self.level,
            grid,
            width,
            height,
            draws: &pass.draws,
            batch,
            runs: &runs,
            shares: &self.shares,
            bands: &Bands::new(target, 1 << grid.log2),
            start: Start {
                colors,
                depth: clear_depth.filter(|_| starts),
                stencil: pass.clear_stencil.filter(|_| starts),
                is_first,
            },
            wants,
            depth_format,
            samples,
            kept,
        };
        let queue = TileQueue::new(&grid);
        let jobs = 0..self.painters.len().min(grid.tile_count());
        parallel::for_each(&mut self.painters, jobs, |painter, _| painter.paint_all(&painting, &queue));
    }
}

/// Triangles of further instances: those of the first, with the vertices that come `vertices_each` later each time.
fn copy_instances(first: &[[u32; 3]], out: &mut [[u32; 3]], mut offset: u32, vertices_each: u32) {
    for instance in out.chunks_mut(first.len().max(1)) {
        for (to, from) in instance.as_flattened_mut().iter_mut().zip(first.as_flattened()) {
            *to = from + offset;
        }
        offset = offset.wrapping_add(vertices_each);
    }
}

/// What shading sees of a run.
fn view<'a>(
    pass: &Pass<'_>,
    run: &'a Run<'_>,
    assembled: &'a [[u32; 3]],
    screen: &'a [ScreenVertex],
    records: &'a [RecordRow],
    all_strokes: &'a [Stroke],
    stroke_records: &'a [RecordRow],
) -> RunView<'a> {
    let state = pass.draws[run.draw].state();
    let plain = RunView {
        run,
        corners: run.corners(assembled),
        source: run.source(assembled),
        first_number: run.first_number,
        records: &records[run.records.clone()],
        screen: &screen[run.screen.clone()],
        projection: &run.projection,
        front_is_clockwise: state.front_face == FrontFace::Clockwise,
        provoking: state.provoking_vertex,
        strokes: None,
    };
    match &run.strokes {
        None => plain,
        // Three records each, the provoking one first; which side they show is in their codes.
        Some(StrokeRun { shape, strokes, records }) => RunView {
            corners: Corners::Sequential,
            source: Source::Range(0),
            records: &stroke_records[records.clone()],
            screen: &[],
            front_is_clockwise: true,
            provoking: ProvokingVertex::First,
            strokes: Some(StrokeView {
                shape: *shape,
                strokes: &all_strokes[strokes.clone()],
                is_of_triangles: state.topology.is_of_triangles(),
                provoking: state.provoking_vertex,
            }),
            ..plain
        },
    }
}

/// Whether triangles are culled that wind clockwise on the picture, and counter-clockwise ones.
fn culled(cull: Cull, front: FrontFace) -> (bool, bool) {
    let clockwise_is_front = front == FrontFace::Clockwise;
    match cull {
        Cull::None => (false, false),
        Cull::Front => (clockwise_is_front, !clockwise_is_front),
        Cull::Back => (!clockwise_is_front, clockwise_is_front),
    }
}
