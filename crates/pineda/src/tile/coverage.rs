//! Coverage of a stretch of a tile's bin: record by record, in submission order, into a sink.

use super::large::large;
use super::mid::{Worklist, flush, mid};
use super::sink::Sink;
use super::small::small;
use super::view::{BlockLanes, TileView};
use crate::raster::bins::{BinEntry, Kind, Share};
use crate::raster::reach::PixelRect;
use crate::wide::Simd;

/// Hands the covered samples of the records that `entries` name to the sink. `rect` is given where the draw's viewport does not reach
/// over the whole target: nothing outside is covered.
#[inline(always)]
pub(crate) fn cover<S: Simd, K: Sink<S>>(
    s: S,
    share: &Share,
    entries: &[BinEntry],
    view: &TileView,
    rect: Option<&PixelRect>,
    work: &mut Worklist,
    sink: &mut K,
) {
    let lanes = BlockLanes::new(s);
    let mut has_waiting = false;
    let mut i = 0;
    while i < entries.len() {
        let entry = entries[i];
        i += 1;
        if entry.kind() == Kind::Mid {
            mid(s, &share.mid[entry.index()], view, rect, &lanes, work, sink);
            has_waiting = true;
            continue;
        }
        if has_waiting {
            flush(s, view, rect, &lanes, work, sink);
            has_waiting = false;
        }
        if entry.kind() == Kind::Small {
            let first = i - 1;
            while i < entries.len() && entries[i].kind() == Kind::Small {
                i += 1;
            }
            small(s, &share.small, &entries[first..i], view, sink);
        } else {
            large(s, &share.large[entry.index()], view, rect, &lanes, sink);
        }
    }
    if has_waiting {
        flush(s, view, rect, &lanes, work, sink);
    }
}
