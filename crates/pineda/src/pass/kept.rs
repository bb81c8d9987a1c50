//! Tiles with several samples between flushes: the target need not have room for all samples.

use crate::Error;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// What is kept of each tile: its blocks of depths, of stencil values, and of colours, as the tile stores them; nothing as long as nothing was drawn to it.
#[derive(Debug, Default)]
pub(crate) struct KeptTiles {
    tiles: Vec<Mutex<Vec<[u32; 16]>>>,
    /// Whether this is the last flush, after which nothing is kept.
    pub(crate) is_last: bool,
}

impl KeptTiles {
    /// Makes room for so many tiles with so many blocks each, and forgets what there was.
    pub(crate) fn reserve(&mut self, tiles: usize, blocks: usize) -> Result<(), Error> {
        self.tiles.resize_with(tiles, Mutex::default);
        for tile in &mut self.tiles {
            let tile = tile.get_mut().unwrap_or_else(PoisonError::into_inner);
            tile.clear();
            let bytes = blocks * size_of::<[u32; 16]>();
            tile.try_reserve(blocks).map_err(|_| Error::OutOfMemory {
                bytes: bytes.saturating_mul(tiles),
                what: "samples between flushes",
            })?;
        }
        self.is_last = false;
        Ok(())
    }

    /// A tile's blocks.
    pub(crate) fn lock(&self, tile: usize) -> MutexGuard<'_, Vec<[u32; 16]>> {
        self.tiles[tile].lock().unwrap_or_else(PoisonError::into_inner)
    }
}
