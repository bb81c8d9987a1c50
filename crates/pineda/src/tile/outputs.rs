//! A tile's way to and from the target's buffers.

use super::paint::{Painter, Painting, Start};
use super::view::{BlockLanes, TileView};
use crate::raster::triangle_id::{ORDERS, TriangleId};
use crate::shading::run::RunView;
use crate::shading::weights::{Weights, of_clipped, of_triangle};
use crate::target::bands::{Band, TileRows};
use crate::target::depth::loaded_depth;
use crate::target::format::{TileColor, one_nan};
use crate::target::texels::fill_rows;
use crate::target::{ColorBuffer, DepthBuffer, NO_ID};
use crate::wide::{Simd, dispatch};

/// A tile's colours, in the order of the target's buffers.
fn colors<'a>(first: &'a mut TileColor, more: &'a mut [TileColor]) -> impl Iterator<Item = &'a mut TileColor> {
    std::iter::once(first).chain(more)
}

/// A band's colour buffers.
fn buffers<'a, 'b>(band: &'a mut Band<'b>) -> impl Iterator<Item = &'a mut ColorBuffer<'b>> {
    std::iter::once(&mut band.color).chain(&mut band.more_colors)
}

/// Loads what the tile does not clear.
pub(crate) fn load(painter: &mut Painter, painting: &Painting<'_>, view: &TileView, row: usize) {
    let loads_color = painting.start.colors[..=painting.wants.more_count].iter().any(Option::is_none);
    let loads_depth = painting.start.depth.is_none() && painting.wants.depth;
    let loads_stencil = painting.start.stencil.is_none() && painting.wants.stencil;
    if !loads_color && !loads_depth && !loads_stencil {
        return;
    }
    let rows = TileRows::new(view, painting.width, painting.height);
    let block = |row: usize| view.block(0, row as i32);
    let mut band = painting.bands.lock(row);
    let Painter { color, more_colors, .. } = painter;
    for ((color, buffer), start) in colors(color, more_colors).zip(buffers(&mut band)).zip(painting.start.colors) {
        if start.is_none() {
            color.load_rows(&rows, buffer, block);
        }
    }
    if loads_depth {
        let (format, tile) = (painting.depth_format, &mut painter.tile);
        let decode = |code: u32| format.decoded(code).to_bits() as i32;
        match &mut band.depth {
            DepthBuffer::None => {}
            DepthBuffer::D32F(depth) => rows.load(depth, &mut tile.depth, block, loaded_depth),
            DepthBuffer::D24(depth) => rows.load(depth, &mut tile.depth, block, decode),
            DepthBuffer::D16(depth) => rows.load(depth, &mut tile.depth, block, |code| decode(code.into())),
        }
        tile.unbound(true, true);
    }
    if let Some(stencil) = band.stencil.as_deref_mut().filter(|_| loads_stencil) {
        rows.load(stencil, &mut painter.tile.stencil, block, i32::from);
    }
}

/// Clears what a tile without triangles covers.
pub(crate) fn clear(painting: &Painting<'_>, view: &TileView, row: usize) {
    let rows = TileRows::new(view, painting.width, painting.height);
    let Start { colors, depth, stencil, is_first } = painting.start;
    let band = &mut *painting.bands.lock(row);
    for (buffer, color) in buffers(band).zip(colors) {
        if let Some(color) = color {
            fill_rows(&rows, buffer, color);
        }
    }
    let code = depth.map(|z| painting.depth_format.code(z));
    match (&mut band.depth, depth, code) {
        (DepthBuffer::D32F(buffer), Some(depth), _) => rows.fill(buffer, depth),
        (DepthBuffer::D24(buffer), _, Some(code)) => rows.fill(buffer, code),
        (DepthBuffer::D16(buffer), _, Some(code)) => rows.fill(buffer, code as u16),
        // As if it had been loaded and stored.
        (DepthBuffer::D32F(buffer), None, _) => rows.update(buffer, |z| f32::from_bits(loaded_depth(z) as u32)),
        (DepthBuffer::D24(buffer), ..) => rows.update(buffer, |code| code & 0xff_ffff),
        (DepthBuffer::D16(_) | DepthBuffer::None, ..) => {}
    }
    if let (Some(buffer), Some(value)) = (band.stencil.as_deref_mut(), stencil) {
        rows.fill(buffer, value);
    }
    if is_first {
        for ids in [&mut band.triangle_ids, &mut band.instance_ids, &mut band.draw_ids].into_iter().flatten() {
            rows.fill(ids, NO_ID);
        }
        if let Some(pixels) = band.barycentrics.as_deref_mut() {
            rows.fill(pixels, [0.0; 3]);
        }
        if let Some(hits) = band.hits.as_deref_mut() {
            rows.fill(hits, 0);
        }
    }
}

/// Copies the tile out.
pub(crate) fn store(painter: &mut Painter, painting: &Painting<'_>, view: &TileView, row: usize) {
    let rows = TileRows::new(view, painting.width, painting.height);
    let block = |row: usize| view.block(0, row as i32);
    let mut barycentrics = Vec::new();
    let mut guard = painting.bands.lock(row);
    if guard.barycentrics.is_some() {
        // The computation is long; the band is for copying only.
        drop(guard);
        barycentrics = barycentric_blocks(painter, painting, view);
        guard = painting.bands.lock(row);
    }
    let band = &mut *guard;
    for (color, buffer) in colors(&mut painter.color, &mut painter.more_colors).zip(buffers(band)) {
        color.store_rows(&rows, buffer, block);
    }
    let depths = &painter.tile.depth;
    let code = |bits: i32| painting.depth_format.code(f32::from_bits(bits as u32));
    match &mut band.depth {
        DepthBuffer::None => {}
        DepthBuffer::D32F(depth) => rows.store(depth, depths, block, |bits| f32::from_bits(bits as u32)),
        DepthBuffer::D24(depth) => rows.store(depth, depths, block, code),
        DepthBuffer::D16(depth) => rows.store(depth, depths, block, |bits| code(bits) as u16),
    }
    if let Some(stencil) = band.stencil.as_deref_mut() {
        rows.store(stencil, &painter.tile.stencil, block, |value| value as u8);
    }
    let (shown, is_first) = (&painter.tile.shown, painting.start.is_first);
    let instance_and_triangle = |id| {
        let number = TriangleId(id).number();
        let run = &painting.batch.runs[painting.batch.run_of(number)];
        run.instance_and_triangle(number - run.first_number)
    };
    if let Some(ids) = band.triangle_ids.as_deref_mut() {
        store_ids(&rows, ids, shown, view, is_first, |id| instance_and_triangle(id).1 as u32);
    }
    if let Some(ids) = band.instance_ids.as_deref_mut() {
        store_ids(&rows, ids, shown, view, is_first, |id| instance_and_triangle(id).0 as u32);
    }
    if let Some(ids) = band.draw_ids.as_deref_mut() {
        store_ids(&rows, ids, shown, view, is_first, |id| {
            painting.batch.runs[painting.batch.run_of(TriangleId(id).number())].draw as u32
        });
    }
    if let Some(pixels) = band.barycentrics.as_deref_mut() {
        rows.for_each(pixels, block, |piece, block, first| {
            for (k, pixel) in piece.iter_mut().enumerate() {
                if is_first || shown[block][first + k] != 0 {
                    *pixel = barycentrics[block][first + k];
                }
            }
        });
    }
    if let Some(hits) = band.hits.as_deref_mut() {
        rows.for_each(hits, block, |piece, block, first| {
            for (k, pixel) in piece.iter_mut().enumerate() {
                let before = if is_first { 0 } else { *pixel };
                *pixel = before + painter.hits[block][first + k];
            }
        });
    }
}

fn store_ids(
    rows: &TileRows,
    ids: &mut [u32],
    shown: &[[u32; 16]],
    view: &TileView,
    is_first: bool,
    convert: impl Fn(u32) -> u32,
) {
    rows.for_each(
        ids,
        |row| view.block(0, row as i32),
        |piece, block, first| {
            for (k, pixel) in piece.iter_mut().enumerate() {
                match shown[block][first + k] {
                    0 if is_first => *pixel = NO_ID,
                    0 => {}
                    id => *pixel = convert(id),
                }
            }
        },
    );
}

/// The barycentric coordinates of every sample; zeros where nothing is shown.
fn barycentric_blocks(painter: &Painter, painting: &Painting<'_>, view: &TileView) -> Vec<[[f32; 3]; 16]> {
    let shown = &painter.tile.shown;
    let mut blocks = vec![[[0.0; 3]; 16]; shown.len()];
    for (block, (ids, out)) in shown.iter().zip(&mut blocks).enumerate() {
        let (x, y) = view.pixel_of(block);
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
            let (values, order) = dispatch!(painting.level, s => coordinates(s, run, rows, &position, id, x, y));
            for same in lane..16 {
                if ids[same] == id.0 {
                    done |= 1 << same;
                    for (k, &vertex) in order.iter().enumerate() {
                        out[same][vertex] = values[k][same];
                    }
                }
            }
        }
    }
    blocks
}

/// The coordinates of a triangle at a block's samples, in canonical order, and the submitted vertex that each of the three is of.
#[inline(always)]
fn coordinates<S: Simd>(
    s: S,
    run: &RunView<'_>,
    rows: usize,
    position: &dyn Fn(usize) -> [f32; 4],
    id: TriangleId,
    x: i32,
    y: i32,
) -> ([[f32; 16]; 3], [usize; 3]) {
    let submitted = run.places(id);
    let (weights, order): (Weights<S>, [usize; 3]) = if id.is_clipped() {
        of_clipped(s, run, position, id, x, y)
    } else {
        let order = ORDERS[id.order_code() as usize & 7].map(usize::from);
        let places = order.map(|k| submitted[k]);
        (of_triangle(s, run, rows, places, x, y, &BlockLanes::new(s)), order)
    };
    let [a, b, c] = weights.perspective;
    let sum = (a + b) + c;
    let values = [one_nan(s, a / sum).into(), one_nan(s, b / sum).into(), one_nan(s, c / sum).into()];
    match &run.strokes {
        None => (values, order.map(|corner| run.submitted(corner))),
        Some(strokes) => strokes.coordinates(id.number() - run.first_number, values, order),
    }
}
