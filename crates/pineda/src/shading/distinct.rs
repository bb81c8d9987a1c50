//! Which triangles a packet shows, and in which way it is therefore interpolated.

use super::cached::TriangleCache;
use super::packet::{BATCH, VaryingLayout};
use super::run::RunView;
use crate::raster::samples::Samples;
use crate::raster::triangle_id::{CLIPPED_CLOCKWISE, ORDER_BITS, TriangleId};
use crate::wide::{Simd, i32x16, mask32x16, u32x16};

/// The fragments of a block to be shaded.
#[derive(Clone, Copy)]
pub(crate) struct Fragments<'a> {
    /// The triangle of each lane; those outside the mask are ignored.
    pub(crate) ids: &'a [u32; 16],
    /// The lanes to be shaded, at least one.
    pub(crate) mask: u32,
    /// The block's first pixel.
    pub(crate) x: i32,
    pub(crate) y: i32,
    /// How far the lanes lie off their pixels' centres, in subpixels, if they do.
    pub(crate) moved: Option<&'a [[i32; 16]; 2]>,
    /// Lanes that are shaded at the lowest sample that their triangle covers, if it does not cover the pixel's centre.
    pub(crate) border: u32,
    pub(crate) samples: Samples,
}

/// The different triangles of a packet, and the way in which it is interpolated.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Distinct {
    pub(crate) way: Way,
    /// The triangle of each lane; the first one's where none counts.
    pub(crate) lanes: [u32; 16],
    /// As many as count for that way; beyond the last, any.
    pub(crate) ids: [u32; 16],
    /// The lanes of each; beyond the last, none.
    pub(crate) masks: [u32; 16],
}

/// How the lanes get their vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Way {
    /// One triangle.
    One,
    /// Up to so many, made ready in the [`TriangleCache`](super::cached::TriangleCache).
    Two,
    Four,
    Eight,
    /// One that is too large for the cache, or is not in it.
    Large,
    /// Lane by lane.
    ByLane,
    /// Triangles in turn, with all that a packet can ask for.
    InFull,
}

impl Way {
    /// What does without the cache.
    #[inline(always)]
    pub(crate) fn general(self) -> Self {
        match self {
            Self::One => Self::Large,
            Self::Two | Self::Four | Self::Eight => Self::ByLane,
            Self::Large | Self::ByLane | Self::InFull => self,
        }
    }
}

impl Distinct {
    pub(crate) const NONE: Self = Self { way: Way::One, lanes: [0; 16], ids: [0; 16], masks: [0; 16] };

    /// Sorts out the triangles of a packet. Nothing here waits for memory, so that it is done for several packets before any is interpolated.
    #[inline(always)]
    pub(crate) fn set<S: Simd>(&mut self, s: S, layout: &VaryingLayout, fragments: &Fragments<'_>) {
        let ids = u32x16::simd_from(s, *fragments.ids);
        let first = fragments.ids[fragments.mask.trailing_zeros() as usize & 15];
        let ids = mask32x16::from_bitmask(s, u64::from(fragments.mask)).select(ids, u32x16::splat(s, first));
        (self.lanes, self.masks) = (ids.into(), [0; 16]);
        let code: i32x16<S> = (ids & ((1 << ORDER_BITS) - 1)).bitcast();
        let is_plain = layout.is_plain && code.simd_ge(CLIPPED_CLOCKWISE as i32).all_false();
        self.way = if is_plain { self.plain_way(ids, fragments) } else { Way::InFull };
        if !is_plain {
            self.take(ids, 0..16, fragments.mask);
        }
    }

    /// The same for a packet of one triangle.
    #[inline(always)]
    pub(crate) fn set_single(&mut self, layout: &VaryingLayout, fragments: &Fragments<'_>) {
        let id = fragments.ids[0];
        (self.ids[0], self.masks[0], self.masks[1]) = (id, fragments.mask, 0);
        self.way = if layout.is_plain && !TriangleId(id).is_clipped() { Way::One } else { Way::InFull };
    }

    #[inline(always)]
    fn plain_way<S: Simd>(&mut self, ids: u32x16<S>, fragments: &Fragments<'_>) -> Way {
        if self.take(ids, 0..1, fragments.mask) == 0 {
            return Way::One;
        }
        if has_five(&self.lanes) {
            return Way::ByLane;
        }
        let rest = self.take(ids, 1..4, fragments.mask & !self.masks[0]);
        if rest != 0 {
            return if self.take(ids, 4..8, rest) == 0 { Way::Eight } else { Way::ByLane };
        }
        // No branch: it would be guessed wrong half of the time.
        [Way::Two, Way::Four][usize::from(self.masks[2] != 0)]
    }

    /// Takes so many triangles out of the lanes of `rest`, whether there are as many or not: a branch would cost more.
    #[inline(always)]
    fn take<S: Simd>(&mut self, ids: u32x16<S>, places: std::ops::Range<usize>, mut rest: u32) -> u32 {
        let mut t = places.start;
        while t < places.end {
            let id = self.lanes[rest.trailing_zeros() as usize & 15];
            let same = ids.simd_eq(id).to_bitmask() as u32 & rest;
            self.ids[t & 15] = id;
            self.masks[t & 15] = same;
            rest &= !same;
            t += 1;
        }
        rest
    }

    /// Has the cache make its triangles ready: four places or eight, whether they count or not.
    #[inline(always)]
    pub(crate) fn prepare(&self, run: &RunView<'_>, cache: &mut TriangleCache) {
        let places = match self.way {
            Way::One => 1,
            Way::Two | Way::Four => 4,
            Way::Eight => 8,
            Way::Large | Way::ByLane | Way::InFull => 0,
        };
        let mut t = 0;
        while t < places {
            cache.prepare(run, self.ids[t & 15]);
            t += 1;
        }
    }

    /// The way, given what the cache holds: a triangle may have driven out another, or be too large.
    #[inline(always)]
    pub(crate) fn way_with(&self, cache: &TriangleCache) -> Way {
        if self.way == Way::One {
            return if cache.holds(self.ids[0]) { Way::One } else { Way::Large };
        }
        let four =
            cache.holds(self.ids[0]) & cache.holds(self.ids[1]) & cache.holds(self.ids[2]) & cache.holds(self.ids[3]);
        match self.way {
            Way::Two | Way::Four if !four => Way::ByLane,
            Way::Eight if !(four & self.ids[4..8].iter().all(|&id| cache.holds(id))) => Way::ByLane,
            way => way,
        }
    }

    /// How many there are.
    #[inline(always)]
    pub(crate) fn count(&self) -> usize {
        let mut count = 0;
        while count < 16 && self.masks[count] != 0 {
            count += 1;
        }
        count
    }
}

/// Whether the corners of a block and one sample within show five different triangles: a quick way to know that there are many.
#[inline(always)]
fn has_five(ids: &[u32; 16]) -> bool {
    let [a, b, c, d, e] = [ids[0], ids[3], ids[12], ids[15], ids[5]];
    let corners = (a != b) & (a != c) & (a != d) & (b != c) & (b != d) & (c != d);
    corners & (e != a) & (e != b) & (e != c) & (e != d)
}

/// The packets of a batch, sorted by the way in which they are interpolated.
pub(crate) struct Ways {
    packets: [[u8; BATCH]; 7],
    counts: [usize; 7],
}

impl Ways {
    pub(crate) const NONE: Self = Self { packets: [[0; BATCH]; 7], counts: [0; 7] };

    #[inline(always)]
    pub(crate) fn add(&mut self, way: Way, packet: usize) {
        let count = &mut self.counts[way as usize];
        self.packets[way as usize][*count & (BATCH - 1)] = packet as u8;
        *count += 1;
    }

    #[inline(always)]
    pub(crate) fn of(&self, way: Way) -> &[u8] {
        &self.packets[way as usize][..self.counts[way as usize]]
    }
}
