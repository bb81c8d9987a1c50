//! Filtering: from coordinates and a level of detail to channels.
//!
//! Exactly what is computed, so that a plain program can compute the same bits (`tests/textures.rs` has one), in f32, every operation rounded once:
//!
//! - between two numbers: `a + (b - a) * part`;
//! - in a slice: along u in the upper and in the lower row, then along v between both; in 3D, then along w between two slices;
//! - of two levels: between both by the fraction of the level of detail, where it is not 0;
//! - anisotropic: the sum from the first lookup to the last, divided by their number;
//! - then channels are scaled (8-bit codes by 1/255).

use super::address::{self, Beyond, is_beyond, whole};
use super::cube;
use super::format::{Filterable, TextureFormat};
use super::image::{Image, LEVELS};
use super::sampler::{Filter, MipFilter, Sampler, Wrap};
use crate::lanes::Lanes;
use crate::math::{Bool, Int, Real};
use crate::pass::Compare;
use crate::shader;

/// Where a texture is looked up.
#[derive(Clone, Copy)]
pub(super) struct Place<L: Lanes> {
    /// u, v and, in 3D, w.
    pub(super) at: [Real<L>; 3],
    /// The slice, but for 3D textures: a layer or face that there is.
    pub(super) slice: Int<L>,
}

/// What kind of texture it is.
pub(super) trait Kind {
    const IS_VOLUME: bool;
    const IS_CUBE: bool;
}

/// One slice, or an array of such.
pub(super) enum Flat {}
/// Slices are depth.
pub(super) enum Volume {}
/// Slices are the faces of a cube.
pub(super) enum Cube {}

impl Kind for Flat {
    const IS_VOLUME: bool = false;
    const IS_CUBE: bool = false;
}
impl Kind for Volume {
    const IS_VOLUME: bool = true;
    const IS_CUBE: bool = false;
}
impl Kind for Cube {
    const IS_VOLUME: bool = false;
    const IS_CUBE: bool = true;
}

/// What becomes of a texel before it is filtered.
pub(super) trait Mapping<L: Lanes>: Copy {
    /// How many channels are filtered: the others are whatever they are.
    fn channels<F: Filterable>() -> usize;
    fn map<F: Filterable>(self, channels: [Real<L>; 4]) -> [Real<L>; 4];
}

/// Nothing.
#[derive(Clone, Copy)]
pub(super) struct AsIs;

impl<L: Lanes> Mapping<L> for AsIs {
    #[inline(always)]
    fn channels<F: Filterable>() -> usize {
        F::CHANNELS
    }
    #[inline(always)]
    fn map<F: Filterable>(self, channels: [Real<L>; 4]) -> [Real<L>; 4] {
        channels
    }
}

/// 1 where the reference compares with the first channel, 0 elsewhere.
#[derive(Clone, Copy)]
pub(super) struct Compared<L: Lanes> {
    pub(super) compare: Compare,
    pub(super) reference: Real<L>,
}

impl<L: Lanes> Mapping<L> for Compared<L> {
    #[inline(always)]
    fn channels<F: Filterable>() -> usize {
        1
    }
    #[inline(always)]
    fn map<F: Filterable>(self, channels: [Real<L>; 4]) -> [Real<L>; 4] {
        let (reference, texel) = (self.reference, F::scaled_code(channels));
        let lanes = texel.lanes();
        let passes = match self.compare {
            Compare::Never => Bool(lanes.mask(0)),
            Compare::Less => reference.lt(texel),
            Compare::Equal => reference.eq(texel),
            Compare::LessEqual => reference.le(texel),
            Compare::Greater => reference.gt(texel),
            Compare::NotEqual => reference.ne(texel),
            Compare::GreaterEqual => reference.ge(texel),
            Compare::Always => Bool(lanes.mask(u32::MAX)),
        };
        [passes.select(1.0, Real::new(lanes, 0.0)); 4]
    }
}

/// The level of each lane.
pub(super) struct LevelLanes<L: Lanes> {
    pub(super) size: [Real<L>; 3],
    pub(super) row: Int<L>,
    pub(super) slice: Int<L>,
    pub(super) first: Int<L>,
}

impl<L: Lanes> LevelLanes<L> {
    /// A level that the image does not have is any that it has, or one without texels.
    #[inline(always)]
    pub(super) fn new<F: TextureFormat>(image: &Image<'_, F>, lanes: L, level: Int<L>) -> Self {
        let mut numbers = [0; 16];
        L::store_int(level.0, &mut numbers);
        let only = if image.count == 1 { 0 } else { numbers[0] };
        if image.count == 1 || !L::any(level.ne(only).0) {
            let level = &image.levels[only as usize & (LEVELS - 1)];
            let [width, height, slices] = level.size;
            return Self {
                size: [Real::new(lanes, width), Real::new(lanes, height), Real::new(lanes, slices)],
                row: Int::new(lanes, level.row),
                slice: Int::new(lanes, level.slice),
                first: Int::new(lanes, level.first),
            };
        }
        let (mut sizes, mut places) = ([[0.0; 16]; 3], [[0; 16]; 3]);
        let mut k = 0;
        while k < L::N {
            let level = &image.levels[numbers[k] as usize & (LEVELS - 1)];
            (sizes[0][k], sizes[1][k], sizes[2][k]) = (level.size[0], level.size[1], level.size[2]);
            (places[0][k], places[1][k], places[2][k]) = (level.row, level.slice, level.first);
            k += 1;
        }
        Self {
            size: [Real::load(lanes, &sizes[0]), Real::load(lanes, &sizes[1]), Real::load(lanes, &sizes[2])],
            row: Int(lanes.load_int(&places[0])),
            slice: Int(lanes.load_int(&places[1])),
            first: Int(lanes.load_int(&places[2])),
        }
    }
}

/// `a + (b - a) * part`, of as many channels as count.
#[inline(always)]
fn between<L: Lanes>(count: usize, a: [Real<L>; 4], b: [Real<L>; 4], part: Real<L>) -> [Real<L>; 4] {
    let r = a[0] + (b[0] - a[0]) * part;
    let g = if count > 1 { a[1] + (b[1] - a[1]) * part } else { a[1] };
    if count < 3 {
        return [r, g, a[2], a[3]];
    }
    [r, g, a[2] + (b[2] - a[2]) * part, a[3] + (b[3] - a[3]) * part]
}

#[inline(always)]
fn choose<L: Lanes>(mask: Bool<L>, a: [Real<L>; 4], b: [Real<L>; 4]) -> [Real<L>; 4] {
    [mask.select(a[0], b[0]), mask.select(a[1], b[1]), mask.select(a[2], b[2]), mask.select(a[3], b[3])]
}

/// A texture and the way to look it up.
#[derive(Clone, Copy)]
pub(super) struct Lookup<'a, 'i, F: Filterable> {
    pub(super) image: &'a Image<'i, F>,
    pub(super) sampler: &'a Sampler,
}

impl<F: Filterable> Lookup<'_, '_, F> {
    /// Channels, not scaled, at a level of detail that is in the sampler's range.
    #[shader(apart(lod))]
    pub(super) fn at_lod<L: Lanes, K: Kind, M: Mapping<L>>(
        &self,
        place: Place<L>,
        lod: Real<L>,
        mapping: M,
    ) -> [Real<L>; 4] {
        let lanes = lod.lanes();
        let Sampler { mag_filter, min_filter, mip_filter, .. } = *self.sampler;
        let (channels, last) = (M::channels::<F>(), (self.image.count - 1) as f32);
        let (first, part) = match mip_filter {
            _ if self.image.count == 1 => (Real::new(lanes, 0.0), Real::new(lanes, 0.0)),
            MipFilter::Base => (Real::new(lanes, 0.0), Real::new(lanes, 0.0)),
            MipFilter::Nearest => ((lod + 0.5).floor().clamp(0.0, last), Real::new(lanes, 0.0)),
            MipFilter::Linear => {
                let lod = lod.clamp(0.0, last);
                let first = lod.floor();
                (first, lod - first)
            }
        };
        let is_linear = match (mag_filter, min_filter) {
            (Filter::Linear, Filter::Linear) => Bool(lanes.mask(u32::MAX)),
            (Filter::Nearest, Filter::Nearest) => Bool(lanes.mask(0)),
            (Filter::Linear, Filter::Nearest) => lod.le(0.0),
            (Filter::Nearest, Filter::Linear) => lod.gt(0.0),
        };
        let (all, two) = (u32::MAX >> (32 - L::N as u32), part.gt(0.0));
        let passes = if L::any(two.0) { 2 } else { 1 };
        let mut result = [part; 4];
        let mut pass = 0;
        while pass < passes {
            let level = LevelLanes::new(self.image, lanes, whole((first + pass as f32).min(last)));
            let linear = L::mask_bits(is_linear.0);
            let mut value = result;
            if linear != 0 {
                value = self.linear::<L, K, M>(lanes, place, &level, mapping);
            }
            if linear != all {
                let nearest = self.nearest::<L, K, M>(lanes, place, &level, mapping);
                value = choose(is_linear, value, nearest);
            }
            result = if pass == 0 { value } else { choose(two, between(channels, result, value, part), result) };
            pass += 1;
        }
        result
    }

    #[inline(always)]
    fn beyond<K: Kind>(&self, axis: usize) -> Beyond {
        if K::IS_CUBE { Beyond::Faces } else { Beyond::Wrap(self.sampler.wrap[axis]) }
    }

    #[inline(always)]
    fn has_border<K: Kind>(&self) -> bool {
        let [u, v, w] = self.sampler.wrap;
        !K::IS_CUBE && (u == Wrap::Border || v == Wrap::Border || (K::IS_VOLUME && w == Wrap::Border))
    }

    /// The border's colour where a texel is beyond.
    #[inline(always)]
    fn or_border<L: Lanes>(&self, is_beyond: Bool<L>, channels: [Real<L>; 4]) -> [Real<L>; 4] {
        let mut out = channels;
        let mut k = 0;
        while k < 4 {
            out[k] = is_beyond.select(self.sampler.border[k] * F::UNITS[k], channels[k]);
            k += 1;
        }
        out
    }

    #[shader(apart(level.first))]
    fn nearest<L: Lanes, K: Kind, M: Mapping<L>>(
        &self,
        lanes: L,
        place: Place<L>,
        level: &LevelLanes<L>,
        mapping: M,
    ) -> [Real<L>; 4] {
        let [width, height, depth] = level.size;
        let x = address::nearest(self.beyond::<K>(0), place.at[0], width);
        let y = address::nearest(self.beyond::<K>(1), place.at[1], height);
        let z = if K::IS_VOLUME { address::nearest(self.beyond::<K>(2), place.at[2], depth) } else { x };
        let inside = |texel: Real<L>, size: Real<L>| whole(texel.max(0.0).min(size - 1.0));
        let slice = if K::IS_VOLUME { inside(z, depth) } else { place.slice };
        let index = (level.first + slice * level.slice) + (inside(y, height) * level.row + inside(x, width));
        let mut channels = F::channels::<L>(self.image.gather(lanes, index.0));
        if self.has_border::<K>() {
            let mut beyond = is_beyond(x, width) | is_beyond(y, height);
            if K::IS_VOLUME {
                beyond |= is_beyond(z, depth);
            }
            channels = self.or_border(beyond, channels);
        }
        mapping.map::<F>(channels)
    }

    #[inline(always)]
    fn linear<L: Lanes, K: Kind, M: Mapping<L>>(
        &self,
        lanes: L,
        place: Place<L>,
        level: &LevelLanes<L>,
        mapping: M,
    ) -> [Real<L>; 4] {
        let [width, height, depth] = level.size;
        let x = address::linear(self.beyond::<K>(0), place.at[0], width);
        let y = address::linear(self.beyond::<K>(1), place.at[1], height);
        let around = Around { x, y, width, height };
        if !K::IS_VOLUME {
            let beyond = Bool(lanes.mask(0));
            return self.slice::<L, K, M>(lanes, &around, level, place.slice, beyond, mapping);
        }
        let z = address::linear(self.beyond::<K>(2), place.at[2], depth);
        let mut result = [z.part; 4];
        let mut k = 0;
        while k < 2 {
            let slice = if k == 0 { z.low } else { z.high };
            let number = whole(slice.max(0.0).min(depth - 1.0));
            let value = self.slice::<L, K, M>(lanes, &around, level, number, is_beyond(slice, depth), mapping);
            result = if k == 0 { value } else { between(M::channels::<F>(), result, value, z.part) };
            k += 1;
        }
        result
    }

    /// The four texels around, in one slice.
    #[inline(always)]
    fn slice<L: Lanes, K: Kind, M: Mapping<L>>(
        &self,
        lanes: L,
        around: &Around<L>,
        level: &LevelLanes<L>,
        slice: Int<L>,
        is_beyond_slice: Bool<L>,
        mapping: M,
    ) -> [Real<L>; 4] {
        let Around { x, y, width, height } = *around;
        let beyond = Beyonds {
            left: is_beyond(x.low, width),
            right: is_beyond(x.high, width),
            above: is_beyond(y.low, height),
            below: is_beyond(y.high, height),
        };
        if K::IS_CUBE && L::any((beyond.left | beyond.right | beyond.above | beyond.below).0) {
            return self.across_edges(lanes, around, level, slice, &beyond, mapping);
        }
        let has_border = self.has_border::<K>();
        let (mut columns, mut rows) = ([x.low, x.high], [y.low, y.high]);
        if has_border {
            columns = [x.low.max(0.0).min(width - 1.0), x.high.max(0.0).min(width - 1.0)];
            rows = [y.low.max(0.0).min(height - 1.0), y.high.max(0.0).min(height - 1.0)];
        }
        let columns = [whole(columns[0]), whole(columns[1])];
        let first = level.first + slice * level.slice;
        let are_neighbours = !L::any(columns[1].ne(columns[0] + 1).0);
        // Not by a loop: what an array holds that a loop indexes goes through memory.
        let [mut a, mut b] = self.two(lanes, first + whole(rows[0]) * level.row, columns, are_neighbours);
        let [mut c, mut d] = self.two(lanes, first + whole(rows[1]) * level.row, columns, are_neighbours);
        if has_border {
            a = self.or_border(beyond.left | beyond.above | is_beyond_slice, a);
            b = self.or_border(beyond.right | beyond.above | is_beyond_slice, b);
            c = self.or_border(beyond.left | beyond.below | is_beyond_slice, c);
            d = self.or_border(beyond.right | beyond.below | is_beyond_slice, d);
        }
        let channels = M::channels::<F>();
        let upper = between(channels, mapping.map::<F>(a), mapping.map::<F>(b), x.part);
        let lower = between(channels, mapping.map::<F>(c), mapping.map::<F>(d), x.part);
        between(channels, upper, lower, y.part)
    }

    /// Two texels of a row.
    #[inline(always)]
    fn two<L: Lanes>(&self, lanes: L, row: Int<L>, columns: [Int<L>; 2], are_neighbours: bool) -> [[Real<L>; 4]; 2] {
        let words = if are_neighbours {
            self.image.gather_pairs(lanes, (row + columns[0]).0)
        } else {
            [self.image.gather(lanes, (row + columns[0]).0), self.image.gather(lanes, (row + columns[1]).0)]
        };
        [F::channels::<L>(words[0]), F::channels::<L>(words[1])]
    }

    /// The same where some of the texels are on other faces of a cube.
    #[inline(always)]
    fn across_edges<L: Lanes, M: Mapping<L>>(
        &self,
        lanes: L,
        around: &Around<L>,
        level: &LevelLanes<L>,
        face: Int<L>,
        beyond: &Beyonds<L>,
        mapping: M,
    ) -> [Real<L>; 4] {
        let Around { x, y, width, .. } = *around;
        let (columns, rows, size) = ([whole(x.low), whole(x.high)], [whole(y.low), whole(y.high)], whole(width));
        let mut texels = [[x.part; 4]; 4];
        let mut k = 0;
        while k < 4 {
            let index = across(lanes, level, face, columns[k & 1], rows[k >> 1], size);
            texels[k] = mapping.map::<F>(F::channels::<L>(self.image.gather(lanes, index.0)));
            k += 1;
        }
        let corners = [
            beyond.left & beyond.above,
            beyond.right & beyond.above,
            beyond.left & beyond.below,
            beyond.right & beyond.below,
        ];
        let found = texels;
        let mut k = 0;
        while k < 4 {
            let [a, b, c] = [found[(k + 1) & 3], found[(k + 2) & 3], found[(k + 3) & 3]];
            let mut i = 0;
            while i < 4 {
                // Three faces meet there.
                texels[k][i] = corners[k].select((a[i] + b[i] + c[i]) / 3.0, texels[k][i]);
                i += 1;
            }
            k += 1;
        }
        let channels = M::channels::<F>();
        let upper = between(channels, texels[0], texels[1], x.part);
        let lower = between(channels, texels[2], texels[3], x.part);
        between(channels, upper, lower, y.part)
    }
}

/// Which of the texels around are beyond the borders.
struct Beyonds<L: Lanes> {
    left: Bool<L>,
    right: Bool<L>,
    above: Bool<L>,
    below: Bool<L>,
}

/// The texels around a place in a slice, and the slice's size.
#[derive(Clone, Copy)]
struct Around<L: Lanes> {
    x: address::Pair<L>,
    y: address::Pair<L>,
    width: Real<L>,
    height: Real<L>,
}

/// The indices of texels that may lie beyond the edges of their cube's face.
#[inline(always)]
fn across<L: Lanes>(lanes: L, level: &LevelLanes<L>, face: Int<L>, x: Int<L>, y: Int<L>, size: Int<L>) -> Int<L> {
    let rows = [face, x, y, size, level.row, level.slice, level.first];
    let mut numbers = [[0; 16]; 7];
    let mut k = 0;
    while k < 7 {
        L::store_int(rows[k].0, &mut numbers[k]);
        k += 1;
    }
    let mut index = [0; 16];
    let mut k = 0;
    while k < L::N {
        let (face, x, y) = cube::across_edges(numbers[0][k], numbers[1][k], numbers[2][k], numbers[3][k]);
        index[k] = numbers[6][k] + face * numbers[5][k] + y * numbers[4][k] + x;
        k += 1;
    }
    Int(lanes.load_int(&index))
}
