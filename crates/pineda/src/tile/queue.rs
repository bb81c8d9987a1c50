//! Which thread paints which tile: each goes along rows of its own, and helps with others' at the end.
//!
//! Neighbours in a row share cache lines and pages of records, vertices and indices, so that a thread had better take one after the other; and threads in different rows
//! never wait for each other's band of the target.

use crate::raster::bins::TileGrid;
use std::sync::atomic::{AtomicU32, AtomicUsize, Ordering::Relaxed};

/// The tiles of a grid, each to be handed out once.
#[derive(Debug)]
pub(crate) struct TileQueue {
    columns: u32,
    /// The next tile of each row.
    next: Vec<AtomicU32>,
    /// The first row that nobody has begun.
    fresh: AtomicUsize,
}

impl TileQueue {
    pub(crate) fn new(grid: &TileGrid) -> Self {
        let next = (0..grid.rows).map(|_| AtomicU32::new(0)).collect();
        Self { columns: grid.columns, next, fresh: AtomicUsize::new(0) }
    }

    /// Column and row of a tile that nobody has had, `None` if there is none left. `row` is the thread's, `None` before its first tile.
    pub(crate) fn take(&self, row: &mut Option<usize>) -> Option<(u32, u32)> {
        let take = |row: usize| {
            let column = self.next[row].fetch_add(1, Relaxed);
            (column < self.columns).then_some((column, row as u32))
        };
        if let Some(tile) = row.and_then(take) {
            return Some(tile);
        }
        let fresh = self.fresh.fetch_add(1, Relaxed);
        // Fresh rows first, then what others have left of theirs.
        let rows = (fresh..self.next.len()).chain(0..self.next.len());
        for other in rows {
            if let Some(tile) = take(other) {
                *row = Some(other);
                return Some(tile);
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_tile_is_taken_once() {
        for (columns, rows, threads) in [(1, 1, 3), (30, 17, 2), (7, 3, 7), (5, 64, 4)] {
            let queue = TileQueue::new(&TileGrid { log2: 6, columns, rows });
            let taken: Vec<(u32, u32)> = std::thread::scope(|scope| {
                let take_all = || {
                    let mut row = None;
                    std::iter::from_fn(|| queue.take(&mut row)).collect::<Vec<_>>()
                };
                let workers: Vec<_> = (0..threads).map(|_| scope.spawn(take_all)).collect();
                workers.into_iter().flat_map(|worker| worker.join().expect("no panic")).collect()
            });
            let mut sorted = taken.clone();
            sorted.sort_unstable();
            sorted.dedup();
            assert_eq!((taken.len(), sorted.len()), ((columns * rows) as usize, (columns * rows) as usize));
        }
    }
}
