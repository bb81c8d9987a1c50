//! Whole lookups: level of detail, filtering, scaling. Each is compiled once for a format, a kind of texture and a width, as a function of its own.

use super::address::whole;
use super::filter::{Flat, Kind, LevelLanes, Lookup, Mapping, Place};
use super::format::{Filterable, TextureFormat};
use super::image::Image;
use super::lod::Gradient;
use crate::lanes::Lanes;
use crate::math::{Bool, Int, Real, Rgba};

/// Lookups that may be strung along a line.
pub(super) trait Strung: Kind {
    const IS_STRUNG: bool;
}

impl Strung for Flat {
    const IS_STRUNG: bool = true;
}
impl Strung for super::filter::Volume {
    const IS_STRUNG: bool = false;
}
impl Strung for super::filter::Cube {
    const IS_STRUNG: bool = false;
}

impl<F: Filterable> Lookup<'_, '_, F> {
    /// At the level of detail that a gradient asks for.
    #[inline(always)]
    pub(super) fn at_gradient<L: Lanes, K: Strung, M: Mapping<L>, const AXES: usize>(
        &self,
        place: Place<L>,
        gradient: &Gradient<L>,
        bias: Real<L>,
        mapping: M,
    ) -> [Real<L>; 4] {
        let (image, sampler) = (self.image, self.sampler);
        let level = &image.levels[0];
        let most = if K::IS_STRUNG { sampler.most_lookups() } else { 1 };
        let (lod, count, step) = if most == 1 {
            let lod = if sampler.needs_lod(image) { gradient.lod::<AXES>(level) } else { Real::new(bias.lanes(), 0.0) };
            (lod, Real::new(bias.lanes(), 1.0), [gradient.dx[0], gradient.dx[1]])
        } else {
            let line = gradient.line(level, most);
            let step = [
                line.is_down.select(gradient.dy[0], gradient.dx[0]),
                line.is_down.select(gradient.dy[1], gradient.dx[1]),
            ];
            (line.lod, line.count, step)
        };
        let lod = sampler.in_range(lod + bias);
        let [u, v, w] = place.at;
        let mut sum = [lod; 4];
        let mut i = 0.0;
        // A single lookup is a line of one: the code for it is there once.
        loop {
            let mut at = place.at;
            if most > 1 {
                let along = (i + 0.5) / count - 0.5;
                at = [u + step[0] * along, v + step[1] * along, w];
            }
            let value = self.at_lod::<L, K, M>(Place { at, ..place }, lod, mapping);
            let counts = count.gt(i);
            let mut k = 0;
            while k < 4 {
                sum[k] = if i == 0.0 { value[k] } else { counts.select(sum[k] + value[k], sum[k]) };
                k += 1;
            }
            i += 1.0;
            if most == 1 || !count.gt(i).any() {
                break;
            }
        }
        if most > 1 {
            sum = [sum[0] / count, sum[1] / count, sum[2] / count, sum[3] / count];
        }
        sum
    }
}

/// What filtering made, as a colour.
#[inline(always)]
pub(super) fn color<L: Lanes, F: Filterable>(channels: [Real<L>; 4]) -> Rgba<L> {
    let [r, g, b, a] = F::scaled(channels);
    Rgba { r, g, b, a }
}

/// One texel of a level, as it is; where there is none, 0 in all channels that the format has.
#[inline(always)]
pub(super) fn fetch<L: Lanes, F: TextureFormat>(image: &Image<'_, F>, at: [Int<L>; 3], level: Int<L>) -> F::Color<L> {
    let lanes = level.lanes();
    let LevelLanes { size, row, slice, first } = LevelLanes::new(image, lanes, level);
    let mut inside = level.ge(0) & level.lt(image.count as i32);
    let mut k = 0;
    while k < 3 {
        inside &= at[k].ge(0) & at[k].lt(whole(size[k]));
        k += 1;
    }
    let index = (first + at[2] * slice) + (at[1] * row + at[0]);
    let index: Int<L> = Bool::select(inside, index, Int::new(lanes, 0));
    F::color(image.gather(lanes, index.0), inside.0)
}
