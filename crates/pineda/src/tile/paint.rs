//! One tile from its bins to the target: visibility, shading, ordered draws, copying out.

use super::coverage::cover;
use super::in_order::InOrder;
use super::queue::TileQueue;
use super::sink::{AnyTest, DepthTest, HitCounter, Usual, Visibility};
use super::view::TileView;
use super::{Tile, outputs};
use crate::pass::draw_call::DrawCall;
use crate::pass::kept::KeptTiles;
use crate::pass::plan::{Batch, Segment, SegmentKind};
use crate::pass::{Compare, DrawStatistics, Sampling};
use crate::raster::bins::{BinEntry, Share, Stretches, TileGrid};
use crate::raster::reach::PixelRect;
use crate::raster::samples::Samples;
use crate::shading::interpolate::Interpolator;
use crate::shading::multisample::{shade_samples_in_order, shade_visible_samples};
use crate::shading::packet::PacketBatch;
use crate::shading::run::RunView;
use crate::shading::sample_packets::{SamplePacket, collect_visible as collect_visible_samples};
use crate::shading::shade::{OrderedPacket, Shading, shade_in_order, shade_visible};
use crate::shading::visible_packets::{VisiblePacket, collect_visible};
use crate::target::MAX_COLORS;
use crate::target::bands::Bands;
use crate::target::depth::DepthFormat;
use crate::target::format::{ColorFormat, TileColor};
use crate::wide::{Simd, dispatch};
use fearless_simd::Level;

/// A batch that is ready to be painted, and what it is painted on.
pub(crate) struct Painting<'a> {
    pub(crate) level: Level,
    pub(crate) grid: TileGrid,
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) draws: &'a [Box<dyn DrawCall + 'a>],
    pub(crate) batch: &'a Batch<'a>,
    /// One for each of the batch's runs.
    pub(crate) runs: &'a [RunView<'a>],
    /// In submission order.
    pub(crate) shares: &'a [Share],
    pub(crate) bands: &'a Bands<'a>,
    pub(crate) start: Start,
    pub(crate) wants: Wants,
    pub(crate) depth_format: DepthFormat,
    pub(crate) samples: Samples,
    /// Where tiles with several samples stay between flushes, if there is more than one.
    pub(crate) kept: Option<&'a KeptTiles>,
}

impl Painting<'_> {
    /// Whether what is painted goes to the target.
    pub(crate) fn is_last(&self) -> bool {
        self.kept.is_none_or(|kept| kept.is_last)
    }
}

/// What tiles start with; `None` is what the target holds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Start {
    /// Of each colour buffer, as the tile stores it.
    pub(crate) colors: [Option<[u32; 4]>; MAX_COLORS],
    pub(crate) depth: Option<f32>,
    pub(crate) stencil: Option<u8>,
    /// Whether ids, barycentric coordinates and hits start empty.
    pub(crate) is_first: bool,
}

/// What the target asks for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wants {
    pub(crate) color: ColorFormat,
    /// Of the further colour buffers, and how many there are.
    pub(crate) more_colors: [ColorFormat; MAX_COLORS - 1],
    pub(crate) more_count: usize,
    pub(crate) depth: bool,
    pub(crate) stencil: bool,
    /// Triangle, instance or draw ids, or barycentric coordinates.
    pub(crate) ids: bool,
    pub(crate) hits: bool,
}

impl Wants {
    fn any_color(&self) -> bool {
        self.color != ColorFormat::None || self.more_count > 0
    }
}

/// What a thread paints with; kept from pass to pass.
#[derive(Debug)]
pub(crate) struct Painter {
    pub(crate) tile: Tile,
    pub(crate) color: TileColor,
    /// Those of the further colour buffers.
    pub(crate) more_colors: Vec<TileColor>,
    pub(crate) hits: Vec<[u32; 16]>,
    visible: Vec<VisiblePacket>,
    visible_samples: Vec<SamplePacket>,
    batch: PacketBatch,
    interpolator: Interpolator,
    ordered: Vec<OrderedPacket>,
    /// What was counted of each draw, if it is asked for.
    pub(crate) draws: Vec<DrawStatistics>,
}

impl Painter {
    pub(crate) fn new() -> Self {
        Self {
            tile: Tile::default(),
            color: TileColor::new(ColorFormat::None),
            more_colors: Vec::new(),
            hits: Vec::new(),
            visible: Vec::new(),
            visible_samples: Vec::new(),
            batch: PacketBatch::new(),
            interpolator: Interpolator::new(),
            ordered: Vec::new(),
            draws: Vec::new(),
        }
    }

    /// Paints one tile after the other until none is left.
    pub(crate) fn paint_all(&mut self, painting: &Painting<'_>, queue: &TileQueue) {
        self.interpolator.forget();
        self.batch.forget();
        let mut place = None;
        while let Some((column, row)) = queue.take(&mut place) {
            self.paint(painting, column, row);
        }
    }

    /// Paints a tile and copies it to the target.
    fn paint(&mut self, painting: &Painting<'_>, column: u32, row: u32) {
        let view = TileView::new(column, row, painting.grid.log2, painting.samples);
        let bin = row as usize * painting.grid.columns as usize + column as usize;
        let mut kept = painting.kept.map(|kept| kept.lock(bin));
        if painting.shares.iter().all(|share| share.bins[bin].is_empty()) {
            let is_untouched = kept.as_ref().is_none_or(|kept| kept.is_empty());
            if is_untouched || !painting.is_last() {
                return outputs::clear(painting, &view, row as usize);
            }
        }
        self.start(painting, &view, row as usize);
        if let Some(kept) = kept.as_deref().filter(|kept| !kept.is_empty()) {
            self.restore(kept);
        }
        let mut has_visible = false;
        let mut counted = None;
        for share in painting.shares {
            for (segment, entries) in Stretches::new(share, &share.bins[bin]) {
                let segment = &painting.batch.segments[segment];
                if let Some(draw) = segment.draw.filter(|_| segment.draw != counted) {
                    self.counts(draw).tiles += 1;
                    counted = segment.draw;
                }
                if painting.wants.hits {
                    self.count(painting, share, entries, &view, segment);
                }
                match segment.kind {
                    SegmentKind::Deferred => {
                        let wants_ids = painting.wants.ids || painting.wants.any_color();
                        self.resolve_visibility(painting, share, entries, &view, segment, wants_ids);
                        has_visible = true;
                    }
                    SegmentKind::DepthOnly => {
                        if std::mem::take(&mut has_visible) {
                            self.shade_visible(painting, &view);
                            self.forget_visible();
                        }
                        self.resolve_visibility(painting, share, entries, &view, segment, painting.wants.ids);
                        self.forget_visible();
                    }
                    SegmentKind::Ordered { run } => {
                        if std::mem::take(&mut has_visible) {
                            self.shade_visible(painting, &view);
                            self.forget_visible();
                        }
                        self.draw_in_order(painting, share, entries, &view, segment, run);
                    }
                }
            }
        }
        if has_visible {
            self.shade_visible(painting, &view);
            self.keep_shown();
        }
        if painting.is_last() {
            outputs::store(self, painting, &view, row as usize);
        } else if let Some(kept) = &mut kept {
            self.keep(kept);
        }
        outputs::store_shown(self, painting, &view, row as usize);
    }

    /// Gives the tile its first contents.
    fn start(&mut self, painting: &Painting<'_>, view: &TileView, row: usize) {
        let Painting { start, wants, .. } = painting;
        self.tile.clear(view, start.depth.unwrap_or(1.0));
        self.tile.stencil.clear();
        if wants.stencil {
            self.tile.stencil.resize(view.block_count(), [start.stencil.unwrap_or(0).into(); 16]);
        }
        self.tile.shown.clear();
        if wants.ids {
            self.tile.shown.resize(view.block_count(), [0; 16]);
        }
        self.hits.clear();
        if wants.hits {
            self.hits.resize(view.block_count(), [0; 16]);
        }
        self.color.format = wants.color;
        self.color.clear(view.block_count(), start.colors[0].unwrap_or_default());
        self.more_colors.resize_with(wants.more_count, || TileColor::new(ColorFormat::None));
        for ((color, format), start) in self.more_colors.iter_mut().zip(wants.more_colors).zip(&start.colors[1..]) {
            color.format = format;
            color.clear(view.block_count(), start.unwrap_or_default());
        }
        outputs::load(self, painting, view, row);
    }

    fn count(
        &mut self,
        painting: &Painting<'_>,
        share: &Share,
        entries: &[BinEntry],
        view: &TileView,
        segment: &Segment,
    ) {
        let mut sink = HitCounter(&mut self.hits);
        let work = &mut self.tile.worklist;
        dispatch!(painting.level, s => cover(s, share, entries, view, segment.rect.as_ref(), work, &mut sink));
    }

    /// Coverage and depth of triangles whose shading can wait.
    fn resolve_visibility(
        &mut self,
        painting: &Painting<'_>,
        share: &Share,
        entries: &[BinEntry],
        view: &TileView,
        segment: &Segment,
        wants_ids: bool,
    ) {
        let (tile, rect) = (&mut self.tile, segment.rect.as_ref());
        let test = AnyTest { rule: segment.depth, format: painting.depth_format };
        let counted_in = segment.draw.map(|_| *view);
        let is_usual = segment.depth.is_whole_range() && painting.depth_format.is_float() && counted_in.is_none();
        let usual = Some(segment.depth.compare).filter(|_| is_usual);
        let area = Area { share, entries, view, rect };
        let passed = dispatch!(painting.level, s => visibility(s, &area, tile, usual, wants_ids, test, counted_in));
        if let Some(draw) = segment.draw {
            let counts = self.counts(draw);
            counts.samples_passed += passed;
            // Of the others only what is visible in the end.
            counts.samples_written += if segment.kind == SegmentKind::DepthOnly { passed } else { 0 };
        }
    }

    /// Shades every sample of the visibility buffer, draw by draw.
    fn shade_visible(&mut self, painting: &Painting<'_>, view: &TileView) {
        let has_color = painting.wants.any_color();
        if !has_color && painting.batch.segments.iter().all(|segment| segment.draw.is_none()) {
            return;
        }
        if !painting.samples.is_one() {
            return self.shade_visible_samples(painting, view);
        }
        let mut visible = std::mem::take(&mut self.visible);
        visible.clear();
        let tile = &self.tile;
        dispatch!(painting.level, s => collect_visible(s, painting.batch, tile, view, &mut visible));
        if painting.batch.runs.len() > 1 {
            // Stable: within a run, blocks stay in the order in which they lie.
            visible.sort_by_key(|packet| packet.run);
        }
        for packets in visible.chunk_by(|a, b| a.run == b.run) {
            let run = packets[0].run as usize;
            if let Some(draw) = painting.batch.segments[painting.batch.runs[run].segment].draw {
                let samples = packets.iter().map(|packet| u64::from(packet.mask.count_ones())).sum::<u64>();
                let counts = draws_entry(&mut self.draws, draw);
                counts.samples_written += samples;
                counts.fragments_shaded += if has_color { samples } else { 0 };
            }
            if !has_color {
                continue;
            }
            let mut shading = self.shading(painting, view, run, None);
            dispatch!(painting.level, s => shade_visible(s, &mut shading, packets));
        }
        self.visible = visible;
    }

    /// The same where pixels have several samples.
    fn shade_visible_samples(&mut self, painting: &Painting<'_>, view: &TileView) {
        let mut visible = std::mem::take(&mut self.visible_samples);
        visible.clear();
        let (batch, tile) = (painting.batch, &self.tile);
        let is_by_sample = |run: usize| painting.draws[batch.runs[run].draw].state().sampling == Sampling::Sample;
        dispatch!(painting.level, s => collect_visible_samples(s, batch, &is_by_sample, tile, view, &mut visible));
        if batch.runs.len() > 1 {
            visible.sort_by_key(|packet| packet.run);
        }
        for packets in visible.chunk_by(|a, b| a.run == b.run) {
            let run = &batch.runs[packets[0].run as usize];
            let segment = &batch.segments[run.segment];
            if let Some(draw) = segment.draw {
                let counts = draws_entry(&mut self.draws, draw);
                for packet in packets {
                    let fragments = u64::from(packet.mask.count_ones());
                    let samples =
                        if is_by_sample(packet.run as usize) { fragments } else { packet.samples(&self.tile, view) };
                    counts.samples_written += samples;
                    counts.fragments_shaded += if painting.wants.any_color() { fragments } else { 0 };
                }
            }
            if !painting.wants.any_color() {
                continue;
            }
            let mut shading = self.shading(painting, view, packets[0].run as usize, None);
            dispatch!(painting.level, s => shade_visible_samples(s, &mut shading, packets));
        }
        self.visible_samples = visible;
    }

    /// What the shading of a run's packets works on.
    fn shading<'a>(
        &'a mut self,
        painting: &'a Painting<'_>,
        view: &'a TileView,
        run: usize,
        counted: Option<&'a mut DrawStatistics>,
    ) -> Shading<'a> {
        let batch = painting.batch;
        let call = &*painting.draws[batch.runs[run].draw];
        Shading {
            level: painting.level,
            call,
            uses: call.uses(),
            run: &painting.runs[run],
            view,
            tile: &mut self.tile,
            color: &mut self.color,
            more_colors: &mut self.more_colors,
            batch: &mut self.batch,
            interpolator: &mut self.interpolator,
            depth: AnyTest { rule: batch.segments[batch.runs[run].segment].depth, format: painting.depth_format },
            counted,
        }
    }

    /// Keeps the tile until the next flush.
    fn keep(&self, kept: &mut Vec<[u32; 16]>) {
        kept.clear();
        kept.extend_from_slice(bytemuck::must_cast_slice(&self.tile.depth));
        kept.extend_from_slice(bytemuck::must_cast_slice(&self.tile.stencil));
        for color in std::iter::once(&self.color).chain(&self.more_colors) {
            kept.extend_from_slice(&color.words);
        }
    }

    /// Goes on with a tile that was kept.
    fn restore(&mut self, mut kept: &[[u32; 16]]) {
        let mut fill =
            |blocks: &mut [[u32; 16]]| blocks.copy_from_slice(kept.split_off(..blocks.len()).unwrap_or_default());
        let tile = &mut self.tile;
        fill(bytemuck::must_cast_slice_mut(&mut tile.depth));
        fill(bytemuck::must_cast_slice_mut(&mut tile.stencil));
        for color in std::iter::once(&mut self.color).chain(&mut self.more_colors) {
            fill(&mut color.words);
        }
        tile.unbound(true, true);
    }

    /// The numbers of a draw.
    fn counts(&mut self, draw: usize) -> &mut DrawStatistics {
        draws_entry(&mut self.draws, draw)
    }

    /// Empties the visibility buffer, after noting what it showed.
    fn forget_visible(&mut self) {
        self.keep_shown();
        self.tile.id.fill([0; 16]);
    }

    /// Notes what was shaded, if the target asks for it.
    fn keep_shown(&mut self) {
        for (shown, ids) in self.tile.shown.iter_mut().zip(&self.tile.id) {
            for (to, &id) in shown.iter_mut().zip(ids) {
                if id != 0 {
                    *to = id;
                }
            }
        }
    }

    /// Draws triangles one after the other: those that blend, or may discard, or do not write depth.
    fn draw_in_order(
        &mut self,
        painting: &Painting<'_>,
        share: &Share,
        entries: &[BinEntry],
        view: &TileView,
        segment: &Segment,
        run: usize,
    ) {
        let call = &*painting.draws[painting.batch.runs[run].draw];
        if call.state().depth.write {
            let [less, _, greater] = segment.depth.compare.outcomes();
            self.tile.unbound(less, greater);
        }
        let test = AnyTest { rule: segment.depth, format: painting.depth_format };
        let mut work = std::mem::take(&mut self.tile.worklist);
        let mut counted = segment.draw.map(|_| DrawStatistics::default());
        let is_plain = painting.samples.is_one() && !call.state().alpha_to_coverage;
        let mut packets = std::mem::take(&mut self.ordered);
        let mut sink = InOrder {
            test,
            packets: &mut packets,
            is_plain,
            flush: &mut |packets: &mut [OrderedPacket]| {
                let mut shading = self.shading(painting, view, run, counted.as_mut());
                if is_plain {
                    dispatch!(painting.level, s => shade_in_order(s, &mut shading, packets));
                } else {
                    dispatch!(painting.level, s => shade_samples_in_order(s, &mut shading, packets));
                }
            },
        };
        dispatch!(painting.level, s => cover(s, share, entries, view, segment.rect.as_ref(), &mut work, &mut sink));
        sink.finish();
        (self.tile.worklist, self.ordered) = (work, packets);
        if let (Some(counted), Some(draw)) = (counted, segment.draw) {
            self.counts(draw).add(&counted);
        }
    }
}

/// Coverage and depth; `usual` is the comparison of a usual test. How many samples passed, if they are counted.
#[inline(always)]
fn visibility<S: Simd>(
    s: S,
    area: &Area<'_>,
    tile: &mut Tile,
    usual: Option<Compare>,
    wants_ids: bool,
    test: AnyTest,
    counted_in: Option<TileView>,
) -> u64 {
    if S::HAS_SHORTCUTS {
        match (usual, wants_ids) {
            (Some(Compare::Less), true) => return visibility_with::<S, _, true>(s, area, tile, Usual::<false>, None),
            (Some(Compare::Less), false) => return visibility_with::<S, _, false>(s, area, tile, Usual::<false>, None),
            (Some(Compare::Greater), true) => return visibility_with::<S, _, true>(s, area, tile, Usual::<true>, None),
            (Some(Compare::Greater), false) => {
                return visibility_with::<S, _, false>(s, area, tile, Usual::<true>, None);
            }
            _ => {}
        }
    }
    visibility_with::<S, _, true>(s, area, tile, test, counted_in)
}

/// A kernel for each test, and for whether ids are wanted: together they would be too much for the compiler to see through.
#[inline(never)]
fn visibility_with<S: Simd, T: DepthTest<S>, const ID: bool>(
    s: S,
    area: &Area<'_>,
    tile: &mut Tile,
    test: T,
    counted_in: Option<TileView>,
) -> u64 {
    s.apart(
        #[inline(always)]
        || {
            let (mut sink, work) = Visibility::<T, ID>::new::<S>(tile, test, counted_in);
            cover(s, area.share, area.entries, area.view, area.rect, work, &mut sink);
            sink.passed
        },
    )
}

/// What is covered, and where.
struct Area<'a> {
    share: &'a Share,
    entries: &'a [BinEntry],
    view: &'a TileView,
    rect: Option<&'a PixelRect>,
}

/// The element for a draw.
fn draws_entry(draws: &mut Vec<DrawStatistics>, draw: usize) -> &mut DrawStatistics {
    if draws.len() <= draw {
        draws.resize(draw + 1, DrawStatistics::default());
    }
    &mut draws[draw]
}
