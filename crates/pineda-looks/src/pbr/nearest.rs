//! What is nearest around a place of a map of depths, roughly: so that a wide filter is asked only where there is anything for it to find.
//!
//! The map is cut into blocks. Of each, the least depth in it and in the blocks within reach around it is kept: no lookup within reach of any place in the block finds less.

use pineda::{Error, Lanes, R32F, Real, Sampler, Texture2d, Vec2, Wrap, shader};

/// Blocks across and down.
const BLOCKS: usize = 64;
/// How many blocks around a place are in reach.
const REACH: usize = 5;
/// With what is in reach of the map's own blocks around them.
const SIDE: usize = BLOCKS + 2 * REACH;

/// The least depths around each block.
#[derive(Debug)]
pub(super) struct Nearest {
    map: Texture2d<'static, R32F>,
}

impl Nearest {
    /// How far from a place lookups may be made, along each axis, in parts of the map. The texels that a bilinear one takes begin up to one and a half before it, which is less than the half of a block that is left over.
    pub(super) const WITHIN: f32 = (REACH as f32 - 0.5) / BLOCKS as f32;

    /// Of a map whose sides are `size`, a multiple of 64 and at least 256, in which 1 is infinitely far away, and so is what lies beyond the map.
    pub(super) fn new(depths: &[f32], size: usize) -> Result<Self, Error> {
        let block = size / BLOCKS;
        let mut least = vec![1.0; SIDE * SIDE];
        for (band, blocks) in depths.chunks_exact(block * size).zip(least.chunks_exact_mut(SIDE).skip(REACH)) {
            // Row by row first, for that goes several at a time.
            let mut columns = vec![1.0; size];
            for row in band.chunks_exact(size) {
                columns.iter_mut().zip(row).for_each(|(least, &depth)| *least = lesser(*least, depth));
            }
            for (least, columns) in blocks[REACH..].iter_mut().zip(columns.chunks_exact(block)) {
                *least = columns.iter().copied().fold(1.0, lesser);
            }
        }
        // Along rows, then along columns. What is found beyond the end of a row is the border of the next one, which is empty.
        let around = |least: &[f32], stride: usize| -> Vec<f32> {
            let near = |k: usize| (0..=2 * REACH).filter_map(move |j| (k + j * stride).checked_sub(REACH * stride));
            let found = |k: usize| near(k).filter_map(|k| least.get(k).copied()).fold(1.0, lesser);
            (0..least.len()).map(found).collect()
        };
        let side = SIDE as u32;
        Ok(Self { map: Texture2d::new(side, side, around(&around(&least, 1), SIDE))? })
    }

    /// No depth in the map is less within [`WITHIN`](Self::WITHIN) of a place.
    #[shader(apart(place))]
    pub(super) fn around<L: Lanes>(&self, place: Vec2<L>) -> Real<L> {
        let sampler = Sampler { wrap: [Wrap::Border; 3], border: [1.0; 4], ..Sampler::NEAREST };
        let at = (place * BLOCKS as f32 + REACH as f32) * (1.0 / SIDE as f32);
        self.map.sample_level(&sampler, at, 0.0).r
    }
}

fn lesser(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Single texels here and there, at the borders, too: none that a bilinear lookup within reach would find is overlooked, and far from all of them there is nothing.
    #[test]
    fn nearest_overlooks_nothing() {
        for size in [256, 512] {
            let mut depths = vec![1.0; size * size];
            let found =
                [(0, 0, 0.5), (size - 1, 7, 0.25), (size / 2, size / 2 + 3, 0.75), (size / 2 + 9, size - 1, 0.1)];
            for (x, y, depth) in found {
                depths[y * size + x] = depth;
            }
            let nearest = Nearest::new(&depths, size).unwrap();
            let mut empty = 0;
            for (x, y) in
                (0..64 * 64).map(|k| [k % 64, k / 64].map(|c| (c as f32 - 12.0) / 40.0 + 0.003)).map(<[f32; 2]>::into)
            {
                let reach = |at: f32, texel: usize| {
                    (at * size as f32 - (texel as f32 + 0.5)).abs() < Nearest::WITHIN * size as f32 + 1.0
                };
                let seen = found.into_iter().filter(|&(column, row, _)| reach(x, column) && reach(y, row));
                let least = seen.map(|(.., depth)| depth).fold(1.0, lesser);
                let around = f32::from(nearest.around(Vec2::<pineda::Scalar>::from([x, y])));
                assert!(around <= least, "{around} > {least} at {x}, {y} of {size}");
                empty += u32::from(around == 1.0);
            }
            assert!(empty > 2000, "{empty}");
        }
    }
}
