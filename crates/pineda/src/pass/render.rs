//! Executing a pass.

mod stages;

use super::colors::check;
use super::kept::KeptTiles;
use super::memory::{grow, uses_stencil, with_own};
use super::multisample::check_samples;
use super::plan::{Batch, Plan, plan};
use super::validate::validate;
use super::{DrawStatistics, Pass, Statistics};
use crate::geometry::raster_space::ScreenVertex;
use crate::raster::bins::{Share, TileGrid};
use crate::raster::stroke::Stroke;
use crate::shading::run::RecordRow;
use crate::tile::paint::Painter;
use crate::tile::view::TileView;
use crate::{Error, Settings, Target};
use fearless_simd::Level;

/// Draws passes, and keeps its working memory from one to the next.
#[derive(Debug)]
pub struct Renderer {
    level: Level,
    threads: usize,
    settings: Settings,
    assembled: Vec<[u32; 3]>,
    screen: Vec<ScreenVertex>,
    records: Vec<RecordRow>,
    strokes: Vec<Stroke>,
    stroke_records: Vec<RecordRow>,
    shares: Vec<Share>,
    painters: Vec<Painter>,
    /// The depth between flushes, for targets without a depth buffer.
    depth: Vec<f32>,
    /// The same of stencil values.
    stencil: Vec<u8>,
    /// The same of targets with several samples.
    kept: KeptTiles,
}

impl Renderer {
    /// A renderer; its memory comes with the first pass.
    ///
    /// # Errors
    /// [`Error::SimdUnavailable`] if the settings name a SIMD level that this machine lacks.
    pub fn new(settings: Settings) -> Result<Self, Error> {
        let (level, threads) = (settings.simd.require()?, settings.thread_count());
        Ok(Self {
            level,
            threads,
            settings,
            assembled: Vec::new(),
            screen: Vec::new(),
            records: Vec::new(),
            strokes: Vec::new(),
            stroke_records: Vec::new(),
            shares: Vec::new(),
            painters: Vec::new(),
            depth: Vec::new(),
            stencil: Vec::new(),
            kept: KeptTiles::default(),
        })
    }

    /// Draws a pass to a target.
    ///
    /// # Errors
    /// What is wrong with the target, a mesh or a viewport, found before anything is drawn; see [`Error`].
    pub fn render(&mut self, pass: &Pass<'_>, target: &mut Target<'_>) -> Result<Statistics, Error> {
        self.execute(pass, target, None)
    }

    /// Draws a pass to a target, to the same bits as [`Renderer::render`], and counts what each of its draws does: occlusion queries and pipeline
    /// statistics. Takes a little longer.
    ///
    /// ```
    /// use pineda::*;
    /// let square = |z: f32| [[8.0, 8.0], [8.0, 24.0], [24.0, 8.0], [24.0, 8.0], [8.0, 24.0], [24.0, 24.0]].map(|[x, y]| [x, y, z, 1.0f32]);
    /// let (near, far) = (square(0.25), square(0.75));
    /// let mut pass = Pass::new();
    /// for vertices in [&near, &far] {
    ///     let state = DrawState { space: Space::Raster, ..DrawState::default() };
    ///     let mesh = Mesh { vertices: &vertices[..], indices: Indices::Sequential };
    ///     pass.draw_with(mesh, state, |&position| (Vec4::from(position), ()), |f| Rgba::gray(f.z()));
    /// }
    /// let draws = Renderer::new(Settings::default())?.render_counted(&pass, &mut Target::new(32, 32))?;
    /// assert_eq!(draws.iter().map(|draw| draw.samples_passed).collect::<Vec<_>>(), [16 * 16, 0]);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Renderer::render`].
    pub fn render_counted(&mut self, pass: &Pass<'_>, target: &mut Target<'_>) -> Result<Vec<DrawStatistics>, Error> {
        let mut draws = vec![DrawStatistics::default(); pass.draws.len()];
        self.execute(pass, target, Some(&mut draws))?;
        Ok(draws)
    }

    /// Draws, and counts if there is something to count in: an element for each draw.
    fn execute(
        &mut self,
        pass: &Pass<'_>,
        target: &mut Target<'_>,
        mut draws: Option<&mut [DrawStatistics]>,
    ) -> Result<Statistics, Error> {
        target.validate()?;
        let extents = validate(pass, self.level, self.threads)?;
        check(pass, target)?;
        check_samples(pass, target)?;
        let mut others = plan(pass, &extents, target, self.settings.memory, draws.is_some());
        let first = others.next().unwrap_or_default();
        let grid = TileGrid::new(target.width, target.height, self.settings.tile.log2());
        let flushes = self.reserve(&first, others.clone(), target, uses_stencil(pass), grid)?;
        let (mut depth, mut stencil) = (std::mem::take(&mut self.depth), std::mem::take(&mut self.stencil));
        let mut target = with_own(pass, target, &mut depth, &mut stencil, flushes);
        let mut statistics = Statistics::default();
        for (flush, batch) in std::iter::once(first).chain(others).enumerate() {
            self.assemble(pass, &extents, &batch);
            self.run_vertices(pass, &batch);
            self.expand(pass, &batch, target.depth.format());
            self.set_up(pass, &batch, grid, &target, draws.is_some());
            self.kept.is_last = flush + 1 == flushes;
            self.paint(pass, &batch, grid, &mut target, flush == 0, flushes);
            if let Some(draws) = draws.as_deref_mut() {
                self.collect(&batch, draws);
            }
            statistics.flushes += 1;
            self.shares.iter().for_each(|share| statistics.add(&share.statistics));
        }
        (self.depth, self.stencil) = (depth, stencil);
        Ok(statistics)
    }

    /// Memory for the largest batch, and for each thread's state. Returns how many batches there are.
    fn reserve(
        &mut self,
        first: &Batch<'_>,
        others: Plan<'_>,
        target: &Target<'_>,
        stencil: bool,
        grid: TileGrid,
    ) -> Result<usize, Error> {
        let (mut flushes, mut assembled) = (1, first.assembled);
        let (mut screen, mut records) = (first.screen_vertices, first.record_rows);
        let (mut strokes, mut stroke_rows) = (first.strokes, first.stroke_rows);
        for batch in others {
            strokes = batch.strokes.max(strokes);
            stroke_rows = batch.stroke_rows.max(stroke_rows);
            flushes += 1;
            assembled = batch.assembled.max(assembled);
            screen = batch.screen_vertices.max(screen);
            records = batch.record_rows.max(records);
        }
        grow(&mut self.assembled, assembled, "triangles of strips, fans and instances")?;
        grow(&mut self.screen, screen, "projected vertices")?;
        grow(&mut self.records, records, "vertex records")?;
        grow(&mut self.strokes, strokes, "lines and points")?;
        grow(&mut self.stroke_records, stroke_rows, "vertex records of lines and points")?;
        self.painters.resize_with(self.threads, Painter::new);
        if !target.samples.is_one() {
            self.stencil.clear();
            if flushes > 1 {
                let view = TileView::new(0, 0, grid.log2, target.samples);
                let color_words = (0..target.color_count()).filter_map(|k| target.color_buffer(k));
                let words = color_words.map(|color| color.format().words()).sum::<usize>();
                let blocks = view.block_count() * (1 + usize::from(stencil || target.stencil.is_some()) + words);
                self.kept.reserve(grid.tile_count(), blocks)?;
            }
            return Ok(flushes);
        }
        let pixels = target.width as usize * target.height as usize;
        if flushes > 1 && target.depth.is_none() {
            grow(&mut self.depth, pixels, "depth between flushes")?;
        }
        if flushes > 1 && target.stencil.is_none() && stencil {
            grow(&mut self.stencil, pixels, "stencil between flushes")?;
        } else {
            self.stencil.clear();
        }
        Ok(flushes)
    }
}
