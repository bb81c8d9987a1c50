//! Tiles: coverage, depth and visibility of the binned triangles, a square of the picture at a time.
//!
//! A tile is stored as blocks of 4 x 4 samples: a block is sixteen lanes and one cache line. Around the tile's blocks there is a border of
//! one block, so that a small triangle that hangs over the tile's edge needs no clipping; what lands in the border is never read. Of multisampled pixels, each
//! sample has such a plane of blocks, one behind the other.

pub(crate) mod coverage;
mod in_order;
pub(crate) mod large;
pub(crate) mod mid;
pub(crate) mod outputs;
pub(crate) mod paint;
pub(crate) mod queue;
pub(crate) mod sink;
pub(crate) mod small;
pub(crate) mod view;

use crate::raster::samples::MAX_SAMPLES;
use view::TileView;

/// The depth and visibility buffers of the tile that a thread is working on.
#[derive(Debug, Default)]
pub(crate) struct Tile {
    /// Depths as the bits of f32 in 0 to 1, which compare as integers.
    pub(crate) depth: Vec<[i32; 16]>,
    /// Stencil values, 0 to 255; empty unless a draw tests them or the target asks for them.
    pub(crate) stencil: Vec<[i32; 16]>,
    /// The visible triangle of each sample, a [`TriangleId`](crate::raster::triangle_id::TriangleId); 0 is none.
    pub(crate) id: Vec<[u32; 16]>,
    /// Of each sample.
    pub(crate) bounds: [Bounds; MAX_SAMPLES],
    sample_count: usize,
    window_count: usize,
    /// The triangle that each sample shows, whether its colour is there already or not; empty unless the target asks for it.
    pub(crate) shown: Vec<[u32; 16]>,
    pub(crate) worklist: mid::Worklist,
}

impl Tile {
    /// Starts a tile with one depth everywhere and nothing visible.
    pub(crate) fn clear(&mut self, view: &TileView, depth: f32) {
        let blocks = view.block_count();
        self.depth.clear();
        self.depth.resize(blocks, [depth.to_bits() as i32; 16]);
        self.id.clear();
        self.id.resize(blocks, [0; 16]);
        self.window_count = (view.side as usize / 16).pow(2);
        let mut bounds = Bounds { farthest: [0.0; 16], nearest: [1.0; 16] };
        bounds.farthest[..self.window_count].fill(depth);
        bounds.nearest[..self.window_count].fill(depth);
        self.sample_count = view.samples.count();
        self.bounds[..self.sample_count].fill(bounds);
    }

    /// Forgets what is known of the nearest and of the farthest depths.
    pub(crate) fn unbound(&mut self, nearest: bool, farthest: bool) {
        for bounds in &mut self.bounds[..self.sample_count] {
            if nearest {
                bounds.nearest[..self.window_count].fill(0.0);
            }
            if farthest {
                bounds.farthest[..self.window_count].fill(1.0);
            }
        }
    }
}

/// What is known of the depths in each 16 x 16 window, row by row: none is beyond `farthest`, none before `nearest`. Of a smaller tile than 64 x 64,
/// those that it does not have are 0 and 1: whatever is hidden in the others is hidden in them.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Bounds {
    pub(crate) farthest: [f32; 16],
    pub(crate) nearest: [f32; 16],
}
