//! The records of a share of the batch's triangles, and which tiles they touch.

use super::record::{LargeTriangle, MidTriangle, SampleBox, SmallTriangle};
use crate::geometry::raster_space::{HALF_PIXEL, SUBPIXELS};
use crate::pass::{DrawStatistics, Statistics};

/// The grid of tiles that covers a target.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TileGrid {
    /// log2 of a tile's side in pixels.
    pub(crate) log2: u32,
    /// Tiles across.
    pub(crate) columns: u32,
    /// Tiles down.
    pub(crate) rows: u32,
}

impl TileGrid {
    pub(crate) fn new(width: u32, height: u32, log2: u32) -> Self {
        let side = 1 << log2;
        Self { log2, columns: width.div_ceil(side), rows: height.div_ceil(side) }
    }

    pub(crate) fn tile_count(&self) -> usize {
        self.columns as usize * self.rows as usize
    }
}

/// A record's place: two tag bits for its kind, and its index among its kind. One list a tile holds all kinds, so that the order of
/// submission holds across them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct BinEntry(u32);

/// The kinds of records.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Small,
    Mid,
    Large,
}

const TAG_SHIFT: u32 = 30;

impl BinEntry {
    #[inline(always)]
    pub(crate) fn new(kind: Kind, index: usize) -> Self {
        debug_assert!(index < 1 << TAG_SHIFT);
        Self(index as u32 | (kind as u32) << TAG_SHIFT)
    }

    #[inline(always)]
    pub(crate) fn kind(self) -> Kind {
        match self.0 >> TAG_SHIFT {
            0 => Kind::Small,
            1 => Kind::Mid,
            _ => Kind::Large,
        }
    }

    #[inline(always)]
    pub(crate) fn index(self) -> usize {
        (self.0 & ((1 << TAG_SHIFT) - 1)) as usize
    }
}

/// The first records of a run of draws that tiles treat alike; see [`crate::pass::plan::Segment`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct SegmentStart {
    pub(crate) segment: usize,
    pub(crate) small: usize,
    pub(crate) mid: usize,
    pub(crate) large: usize,
}

impl SegmentStart {
    /// Whether an entry comes at or after this start.
    #[inline(always)]
    pub(crate) fn is_before(&self, entry: BinEntry) -> bool {
        let first = match entry.kind() {
            Kind::Small => self.small,
            Kind::Mid => self.mid,
            Kind::Large => self.large,
        };
        entry.index() >= first
    }
}

/// What setup makes of a share of a batch's triangles, in submission order. Each share has one owner at a time.
#[derive(Debug, Default)]
pub(crate) struct Share {
    pub(crate) small: Vec<SmallTriangle>,
    pub(crate) mid: Vec<MidTriangle>,
    pub(crate) large: Vec<LargeTriangle>,
    /// For each tile the records that touch it, in submission order.
    pub(crate) bins: Vec<Vec<BinEntry>>,
    pub(crate) segments: Vec<SegmentStart>,
    pub(crate) statistics: Statistics,
    /// What else is counted of each draw if it is asked for.
    pub(crate) draws: Vec<DrawStatistics>,
    /// Of the run that is being set up, if it is asked for.
    pub(crate) degenerate: u64,
    pub(crate) culled: u64,
}

impl Share {
    /// Empties it and keeps its memory.
    pub(crate) fn reset(&mut self, grid: &TileGrid) {
        self.small.clear();
        self.mid.clear();
        self.large.clear();
        self.segments.clear();
        self.statistics = Statistics::default();
        self.draws.clear();
        for bin in &mut self.bins {
            bin.clear();
        }
        self.bins.resize_with(grid.tile_count(), Vec::new);
    }

    /// Makes room for the records of so many triangles with so many samples a pixel, before they come one by one: lists that grow are copied, and to touch memory for the first time takes
    /// longer than to write a record there. More than some ten thousand grow all the same.
    pub(crate) fn make_room(&mut self, triangles: usize, samples: usize) {
        const MOST: usize = 1 << 16;
        let records = triangles.saturating_mul(samples).min(MOST);
        make_room(&mut self.small, records);
        make_room(&mut self.mid, records);
    }

    /// Adds what has been counted since `before` to a draw's numbers.
    pub(crate) fn count(&mut self, draw: usize, before: &Statistics) {
        if self.draws.len() <= draw {
            self.draws.resize(draw + 1, DrawStatistics::default());
        }
        let now = &self.statistics;
        self.draws[draw].add(&DrawStatistics {
            triangles: now.triangles - before.triangles,
            lines: now.lines - before.lines,
            points: now.points - before.points,
            non_finite: now.non_finite - before.non_finite,
            outside: now.outside - before.outside,
            clipped: now.clipped - before.clipped,
            degenerate: std::mem::take(&mut self.degenerate),
            culled: std::mem::take(&mut self.culled),
            ..DrawStatistics::default()
        });
    }

    /// From here on triangles belong to this segment.
    pub(crate) fn start_segment(&mut self, segment: usize) {
        if self.segments.last().is_none_or(|last| last.segment != segment) {
            let (small, mid, large) = (self.small.len(), self.mid.len(), self.large.len());
            self.segments.push(SegmentStart { segment, small, mid, large });
        }
    }
}

fn make_room<T>(records: &mut Vec<T>, more: usize) {
    // Nothing is to be kept of an empty list, but when it grows, it is copied as a whole.
    if records.is_empty() && records.capacity() < more {
        *records = Vec::new();
    }
    // Without memory for all of them, there may be enough for those that come.
    let _ = records.try_reserve(more);
}

/// The stretches of a tile's bin that belong to one segment each.
pub(crate) struct Stretches<'a> {
    share: &'a Share,
    rest: &'a [BinEntry],
}

impl<'a> Stretches<'a> {
    pub(crate) fn new(share: &'a Share, bin: &'a [BinEntry]) -> Self {
        Self { share, rest: bin }
    }
}

impl<'a> Iterator for Stretches<'a> {
    type Item = (usize, &'a [BinEntry]);

    fn next(&mut self) -> Option<Self::Item> {
        let &first = self.rest.first()?;
        let next = self.share.segments.partition_point(|start| start.is_before(first));
        let length = match self.share.segments.get(next) {
            Some(start) => self.rest.partition_point(|&entry| !start.is_before(entry)),
            None => self.rest.len(),
        };
        let (stretch, rest) = self.rest.split_at(length);
        self.rest = rest;
        Some((self.share.segments[next - 1].segment, stretch))
    }
}

/// Enters a record into every tile of its box.
#[inline(never)]
pub(crate) fn bin(bins: &mut [Vec<BinEntry>], grid: &TileGrid, tiles: SampleBox, entry: BinEntry) {
    let mut y = tiles.y0;
    while y <= tiles.y1 {
        let mut x = tiles.x0;
        while x <= tiles.x1 {
            bins[y as usize * grid.columns as usize + x as usize].push(entry);
            x += 1;
        }
        y += 1;
    }
}

/// Enters a large record into those tiles of its box that it may touch: not those wholly on the outer side of an edge.
#[inline(never)]
pub(crate) fn bin_large(
    bins: &mut [Vec<BinEntry>],
    grid: &TileGrid,
    tiles: SampleBox,
    entry: BinEntry,
    t: &LargeTriangle,
) {
    let side = i64::from(((1 << grid.log2) - 1) * SUBPIXELS);
    for y in tiles.y0..=tiles.y1 {
        for x in tiles.x0..=tiles.x1 {
            let first = |tile: i32| i64::from((tile << grid.log2) * SUBPIXELS + HALF_PIXEL);
            let (px, py) = (first(x), first(y));
            let is_outside = (0..3).any(|k| {
                let (a, b) = (t.vertex(k), t.vertex((k + 1) % 3));
                let (dx, dy) = (b.0 - a.0, b.1 - a.1);
                // At the tile's innermost sample.
                dx * (py - a.1) - dy * (px - a.0) + (dx * side).max(0) + (-dy * side).max(0) < 0
            });
            if !is_outside {
                bins[y as usize * grid.columns as usize + x as usize].push(entry);
            }
        }
    }
}
