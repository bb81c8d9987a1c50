//! How much of the light from all around the ground is hidden from by what is above it.
//!
//! Every place of the ground looks at the same places around it, so the answer is a sum of the map of heights, moved by a few steps. Plain loops along its rows take a tenth of the time of a shader that
//! looks the heights up: where a row's texels lie, and how much they count, is known before.

use super::shadow::DISC;

/// How far around each place is looked, in parts of the map, and how much that counts: close things darken a little of the ground much, higher ones much of it a little.
const RADII: [(f32, f32); 2] = [(0.012, 0.55), (0.05, 0.45)];
/// Texels beyond the map's border, for all places looked at, and more.
const PAD: usize = 16;

/// 0 where nothing is above, in a map of heights of `size` x `size` in which 1 is nothing; at most 256, for else the places looked at lie beyond the padding.
pub(super) fn hidden(heights: &[f32], size: usize) -> Vec<f32> {
    debug_assert!(size <= 256, "a map of {size}");
    let stride = size + 2 * PAD;
    let mut padded = vec![1.0; stride * stride];
    // What is above something, and what is around that.
    let (mut low, mut high) = ([size; 2], [0; 2]);
    for (y, row) in heights.chunks_exact(size).enumerate() {
        padded[(y + PAD) * stride + PAD..][..size].copy_from_slice(row);
        let is_above = |height: &f32| *height < 1.0;
        if let (Some(first), Some(last)) = (row.iter().position(is_above), row.iter().rposition(is_above)) {
            (low, high) = ([low[0].min(first), low[1].min(y)], [high[0].max(last), high[1].max(y)]);
        }
    }
    let [columns, rows] = [0, 1].map(|axis| low[axis].saturating_sub(PAD)..(high[axis] + PAD).min(size));
    let mut hidden = vec![0.0; size * size];
    for [x, y] in DISC {
        for (radius, weight) in RADII {
            let weight = weight / DISC.len() as f32;
            let (across, down) =
                (Moved::new(x * radius, columns.clone(), size), Moved::new(y * radius, rows.clone(), size));
            for (j, &part) in down.parts.iter().enumerate() {
                let texels = |row: usize| &padded[(down.first + row) * stride + across.first..][..=columns.len()];
                let hidden = &mut hidden[(rows.start + j) * size..][columns.clone()];
                add(hidden, [texels(j), texels(j + 1)], &across.parts, part, weight);
            }
        }
    }
    hidden
}

/// Places in a row of texels, or in a column, moved: between which texels they lie.
struct Moved {
    /// The first place's first texel, counted from the padding's border. The next place's is the next one.
    first: usize,
    /// How much each place's second texel counts.
    parts: Vec<f32>,
}

impl Moved {
    fn new(offset: f32, places: std::ops::Range<usize>, size: usize) -> Self {
        // As a bilinear lookup has it.
        let at = |place: usize| ((place as f32 + 0.5) / size as f32 + offset) * size as f32 - 0.5;
        debug_assert!(places.clone().all(|k| at(k).floor() - at(0).floor() == k as f32), "{offset}");
        let first = at(places.start).floor() as isize + PAD as isize;
        Self { first: first.unsigned_abs(), parts: places.map(|place| at(place) - at(place).floor()).collect() }
    }
}

/// Adds what a row's places see between two rows of texels.
fn add(hidden: &mut [f32], [above, below]: [&[f32]; 2], parts: &[f32], part: f32, weight: f32) {
    let (above, below) = ([above, &above[1..]], [below, &below[1..]]);
    let count = hidden.len();
    let ([a, b], [c, d]) = (above.map(|row| &row[..count]), below.map(|row| &row[..count]));
    let parts = &parts[..count];
    for k in 0..count {
        let (upper, lower) = (a[k] + (b[k] - a[k]) * parts[k], c[k] + (d[k] - c[k]) * parts[k]);
        let near = 1.0 - (upper + (lower - upper) * part);
        hidden[k] += near * near * weight;
    }
}
