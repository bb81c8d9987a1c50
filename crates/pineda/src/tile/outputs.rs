//! A tile's way to and from the target's buffers.

use super::paint::{Painter, Painting, Start};
use super::view::{BlockLanes, Positions, TileView};
use crate::pass::ColorMask;
use crate::raster::samples::MAX_SAMPLES;
use crate::raster::triangle_id::{ORDERS, TriangleId};
use crate::shading::OutputKind;
use crate::shading::coordinates::{Coordinates, coordinates};
use crate::shading::run::RunView;
use crate::shading::weights::{Weights, of_clipped, of_triangle};
use crate::target::bands::{Band, Plane, TileRows};
use crate::target::depth::loaded_depth;
use crate::target::format::TileColor;
use crate::target::texels::fill_rows;
use crate::target::{ColorBuffer, DepthBuffer, NO_ID};
use crate::wide::{Simd, dispatch, mask32x16};

/// A tile's colours, in the order of the target's buffers.
fn colors<'a>(first: &'a mut TileColor, more: &'a mut [TileColor]) -> impl Iterator<Item = &'a mut TileColor> {
    std::iter::once(first).chain(more)
}

/// A plane's colour buffers.
fn buffers<'a, 'b>(plane: &'a mut Plane<'b>) -> impl Iterator<Item = &'a mut ColorBuffer<'b>> {
    std::iter::once(&mut plane.color).chain(&mut plane.more_colors)
}

/// Loads what the tile does not clear. Where the target has one value a pixel, all samples of the pixel get it.
pub(crate) fn load(painter: &mut Painter, painting: &Painting<'_>, view: &TileView, row: usize) {
    let loads_color = painting.start.colors[..=painting.wants.more_count].iter().any(Option::is_none);
    let loads_depth = painting.start.depth.is_none() && painting.wants.depth;
    let loads_stencil = painting.start.stencil.is_none() && painting.wants.stencil;
    if !loads_color && !loads_depth && !loads_stencil {
        return;
    }
    let rows = TileRows::new(view, painting.width, painting.height);
    let band = &mut *painting.bands.lock(row);
    for sample in 0..view.samples.count() {
        let block = |row: usize| view.plane(sample) + view.block(0, row as i32);
        let Painter { color, more_colors, .. } = painter;
        for (k, (color, start)) in colors(color, more_colors).zip(painting.start.colors).enumerate() {
            if start.is_none() {
                let own = buffers(&mut band[sample]).nth(k).is_some_and(|buffer| !buffer.is_none());
                if let Some(buffer) = buffers(&mut band[if own { sample } else { 0 }]).nth(k) {
                    color.load_rows(&rows, buffer, block);
                }
            }
        }
        if loads_depth {
            let (format, tile) = (painting.depth_format, &mut painter.tile);
            let decode = |code: u32| format.decoded(code).to_bits() as i32;
            let from = if band[sample].depth.is_none() { 0 } else { sample };
            match &mut band[from].depth {
                DepthBuffer::None => {}
                DepthBuffer::D32F(depth) => rows.load(depth, &mut tile.depth, block, loaded_depth),
                DepthBuffer::D24(depth) => rows.load(depth, &mut tile.depth, block, decode),
                DepthBuffer::D16(depth) => rows.load(depth, &mut tile.depth, block, |code| decode(code.into())),
            }
        }
        if loads_stencil {
            let from = if band[sample].stencil.is_none() { 0 } else { sample };
            if let Some(stencil) = band[from].stencil.as_deref_mut() {
                rows.load(stencil, &mut painter.tile.stencil, block, i32::from);
            }
        }
    }
    if loads_depth {
        painter.tile.unbound(true, true);
    }
}

/// Clears what a tile without triangles covers.
pub(crate) fn clear(painting: &Painting<'_>, view: &TileView, row: usize) {
    let rows = TileRows::new(view, painting.width, painting.height);
    let Start { colors, depth, stencil, is_first } = painting.start;
    let code = depth.map(|z| painting.depth_format.code(z));
    for plane in &mut *painting.bands.lock(row) {
        if painting.is_last() {
            for (buffer, color) in buffers(plane).zip(colors) {
                if let Some(color) = color {
                    fill_rows(&rows, buffer, color);
                }
            }
            match (&mut plane.depth, depth, code) {
                (DepthBuffer::D32F(buffer), Some(depth), _) => rows.fill(buffer, depth),
                (DepthBuffer::D24(buffer), _, Some(code)) => rows.fill(buffer, code),
                (DepthBuffer::D16(buffer), _, Some(code)) => rows.fill(buffer, code as u16),
                // As if it had been loaded and stored.
                (DepthBuffer::D32F(buffer), None, _) => rows.update(buffer, |z| f32::from_bits(loaded_depth(z) as u32)),
                (DepthBuffer::D24(buffer), ..) => rows.update(buffer, |code| code & 0xff_ffff),
                (DepthBuffer::D16(_) | DepthBuffer::None, ..) => {}
            }
            if let (Some(buffer), Some(value)) = (plane.stencil.as_deref_mut(), stencil) {
                rows.fill(buffer, value);
            }
        }
        if is_first {
            for ids in [&mut plane.triangle_ids, &mut plane.instance_ids, &mut plane.draw_ids].into_iter().flatten() {
                rows.fill(ids, NO_ID);
            }
            if let Some(pixels) = plane.barycentrics.as_deref_mut() {
                rows.fill(pixels, [0.0; 3]);
            }
            if let Some(hits) = plane.hits.as_deref_mut() {
                rows.fill(hits, 0);
            }
        }
    }
}

/// Copies the tile out, but for what tells of triangles.
pub(crate) fn store(painter: &mut Painter, painting: &Painting<'_>, view: &TileView, row: usize) {
    let rows = TileRows::new(view, painting.width, painting.height);
    let mut guard = painting.bands.lock(row);
    let resolves = |band: &mut Band<'_>, k: usize| {
        view.samples.count() > 1
            && buffers(&mut band[0]).nth(k).is_some_and(|buffer| !buffer.is_none())
            && buffers(&mut band[1]).nth(k).is_some_and(|buffer| buffer.is_none())
    };
    let resolved: Vec<usize> = (0..=painting.wants.more_count).filter(|&k| resolves(&mut guard, k)).collect();
    if !resolved.is_empty() {
        // The computation is long; the band is for copying only.
        drop(guard);
        for k in resolved {
            if let Some(color) = colors(&mut painter.color, &mut painter.more_colors).nth(k) {
                dispatch!(painting.level, s => resolve(s, color, view));
            }
        }
        guard = painting.bands.lock(row);
    }
    for (sample, plane) in guard.iter_mut().enumerate() {
        let block = |row: usize| view.plane(sample) + view.block(0, row as i32);
        for (color, buffer) in colors(&mut painter.color, &mut painter.more_colors).zip(buffers(plane)) {
            color.store_rows(&rows, buffer, block);
        }
        let depths = &painter.tile.depth;
        let code = |bits: i32| painting.depth_format.code(f32::from_bits(bits as u32));
        match &mut plane.depth {
            DepthBuffer::None => {}
            DepthBuffer::D32F(depth) => rows.store(depth, depths, block, |bits| f32::from_bits(bits as u32)),
            DepthBuffer::D24(depth) => rows.store(depth, depths, block, code),
            DepthBuffer::D16(depth) => rows.store(depth, depths, block, |bits| code(bits) as u16),
        }
        if let Some(stencil) = plane.stencil.as_deref_mut() {
            rows.store(stencil, &painter.tile.stencil, block, |value| value as u8);
        }
    }
}

/// Copies out which triangles the tile shows, where in them, and how many cover it.
pub(crate) fn store_shown(painter: &mut Painter, painting: &Painting<'_>, view: &TileView, row: usize) {
    if !painting.wants.ids && !painting.wants.hits {
        return;
    }
    let rows = TileRows::new(view, painting.width, painting.height);
    let mut guard = painting.bands.lock(row);
    let mut barycentrics = Vec::new();
    if guard[0].barycentrics.is_some() {
        let is_by_sample = guard.last().is_some_and(|plane| plane.barycentrics.is_some());
        drop(guard);
        barycentrics = barycentric_blocks(painter, painting, view, is_by_sample);
        guard = painting.bands.lock(row);
    }
    let (shown, is_first) = (&painter.tile.shown, painting.start.is_first);
    let instance_and_triangle = |id| {
        let number = TriangleId(id).number();
        let run = &painting.batch.runs[painting.batch.run_of(number)];
        run.instance_and_triangle(number - run.first_number)
    };
    for (sample, plane) in guard.iter_mut().enumerate() {
        let block = |row: usize| view.plane(sample) + view.block(0, row as i32);
        if let Some(ids) = plane.triangle_ids.as_deref_mut() {
            store_ids(&rows, ids, shown, block, is_first, |id| instance_and_triangle(id).1 as u32);
        }
        if let Some(ids) = plane.instance_ids.as_deref_mut() {
            store_ids(&rows, ids, shown, block, is_first, |id| instance_and_triangle(id).0 as u32);
        }
        if let Some(ids) = plane.draw_ids.as_deref_mut() {
            store_ids(&rows, ids, shown, block, is_first, |id| {
                painting.batch.runs[painting.batch.run_of(TriangleId(id).number())].draw as u32
            });
        }
        if let Some(pixels) = plane.barycentrics.as_deref_mut() {
            rows.for_each(pixels, block, |piece, block, first| {
                for (k, pixel) in piece.iter_mut().enumerate() {
                    if is_first || shown[block][first + k] != 0 {
                        *pixel = barycentrics[block][first + k];
                    }
                }
            });
        }
        if let Some(hits) = plane.hits.as_deref_mut() {
            rows.for_each(hits, block, |piece, block, first| {
                for (k, pixel) in piece.iter_mut().enumerate() {
                    let before = if is_first { 0 } else { *pixel };
                    *pixel = before + painter.hits[block][first + k];
                }
            });
        }
    }
}

/// Replaces the colours of sample 0 by the averages over all samples, in linear light; but for integers, of which sample 0's stay.
///
/// Sums are taken by twos, so that samples of one colour have exactly that as their average.
#[inline(always)]
fn resolve<S: Simd>(s: S, color: &mut TileColor, view: &TileView) {
    if color.format.kind() != OutputKind::Float {
        return;
    }
    let (blocks, samples) = (view.side / 4, view.samples.count());
    let scale = 1.0 / samples as f32;
    let mut by = 0;
    while by < blocks {
        let mut bx = 0;
        while bx < blocks {
            let block = view.block(bx, by);
            bx += 1;
            let mut is_uniform = true;
            let mut sample = 1;
            while sample < samples {
                is_uniform &= color.is_same(s, block, block + view.plane(sample));
                sample += 1;
            }
            if is_uniform {
                continue;
            }
            let mut sums = [color.load(s, block); MAX_SAMPLES];
            let mut sample = 1;
            while sample < samples {
                sums[sample & (MAX_SAMPLES - 1)] = color.load(s, block + view.plane(sample));
                sample += 1;
            }
            let mut half = samples / 2;
            while half > 0 {
                let mut k = 0;
                while k < half {
                    let mut channel = 0;
                    while channel < 4 {
                        sums[k][channel] = sums[2 * k][channel] + sums[2 * k + 1][channel];
                        channel += 1;
                    }
                    k += 1;
                }
                half /= 2;
            }
            let [r, g, b, a] = sums[0];
            let average = [r * scale, g * scale, b * scale, a * scale];
            color.store(s, block, mask32x16::splat(s, true), average, ColorMask::ALL);
        }
        by += 1;
    }
}

fn store_ids(
    rows: &TileRows,
    ids: &mut [u32],
    shown: &[[u32; 16]],
    block: impl Fn(usize) -> usize,
    is_first: bool,
    convert: impl Fn(u32) -> u32,
) {
    rows.for_each(ids, block, |piece, block, first| {
        for (k, pixel) in piece.iter_mut().enumerate() {
            match shown[block][first + k] {
                0 if is_first => *pixel = NO_ID,
                0 => {}
                id => *pixel = convert(id),
            }
        }
    });
}

/// The barycentric coordinates of every sample, or of the centres of pixels; zeros where nothing is shown.
fn barycentric_blocks(
    painter: &Painter,
    painting: &Painting<'_>,
    view: &TileView,
    is_by_sample: bool,
) -> Vec<[[f32; 3]; 16]> {
    let shown = &painter.tile.shown;
    let mut blocks = vec![[[0.0; 3]; 16]; shown.len()];
    for (block, (ids, out)) in shown.iter().zip(&mut blocks).enumerate() {
        let (x, y) = view.pixel_of(block);
        let [dx, dy] = if is_by_sample { view.samples.offset(view.sample_of(block)) } else { [0, 0] };
        let moved = [[dx; 16], [dy; 16]];
        let mut done = 0u32;
        for lane in 0..16 {
            let id = TriangleId(ids[lane]);
            if done >> lane & 1 != 0 || id.0 == 0 {
                continue;
            }
            let run = painting.batch.run_of(id.number());
            let call = &painting.draws[painting.batch.runs[run].draw];
            let position = |vertex: usize| call.position(vertex);
            let (rows, run) = (call.record_rows(), &painting.runs[run]);
            let [first, second, third] =
                dispatch!(painting.level, s => coordinates_at(s, run, rows, &position, id, x, y, &moved));
            for same in lane..16 {
                if ids[same] == id.0 {
                    done |= 1 << same;
                    out[same] = [first[same], second[same], third[same]];
                }
            }
        }
    }
    blocks
}

/// The coordinates of a triangle at a block's pixels' centres, or off them.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "one call, inlined")]
fn coordinates_at<S: Simd>(
    s: S,
    run: &RunView<'_>,
    rows: usize,
    position: &dyn Fn(usize) -> [f32; 4],
    id: TriangleId,
    x: i32,
    y: i32,
    moved: &[[i32; 16]; 2],
) -> Coordinates {
    let at = Positions::new(s, &BlockLanes::new(s), Some(moved));
    let submitted = run.places(id);
    let (weights, order): (Weights<S>, [usize; 3]) = if id.is_clipped() {
        let (weights, order, _) = of_clipped(s, run, position, id, x, y, at);
        (weights, order)
    } else {
        let [a, b, c] = ORDERS[id.order_code() as usize & 7];
        let order = [usize::from(a), usize::from(b), usize::from(c)];
        let places = [submitted[order[0]], submitted[order[1]], submitted[order[2]]];
        (of_triangle(s, run, rows, places, x, y, at), order)
    };
    coordinates(s, run, id, &weights.perspective, order)
}
