//! The target cut into bands, one row of tiles each, so that threads write to it without `unsafe`: a thread locks the
//! band for as long as it takes to copy one tile.

use super::{ColorBuffer, DepthBuffer, Target};
use crate::tile::view::TileView;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Some of the rows of a target's buffers: one sample of each pixel.
#[derive(Debug, Default)]
pub(crate) struct Plane<'a> {
    pub(crate) color: ColorBuffer<'a>,
    pub(crate) more_colors: Vec<ColorBuffer<'a>>,
    pub(crate) depth: DepthBuffer<'a>,
    pub(crate) stencil: Option<&'a mut [u8]>,
    pub(crate) triangle_ids: Option<&'a mut [u32]>,
    pub(crate) instance_ids: Option<&'a mut [u32]>,
    pub(crate) draw_ids: Option<&'a mut [u32]>,
    pub(crate) barycentrics: Option<&'a mut [[f32; 3]]>,
    pub(crate) hits: Option<&'a mut [u32]>,
}

impl<'a> Plane<'a> {
    /// Stretches of so many pixels. Where a buffer ends earlier than others, it is none.
    fn cut(self, pixels: usize) -> impl FnMut() -> Plane<'a> {
        let mut color = self.color.into_chunks(pixels);
        let mut more_colors: Vec<_> = self.more_colors.into_iter().map(|color| color.into_chunks(pixels)).collect();
        let mut depth = self.depth.into_chunks(pixels);
        let mut stencil = chunks(self.stencil, pixels);
        let mut triangle_ids = chunks(self.triangle_ids, pixels);
        let mut instance_ids = chunks(self.instance_ids, pixels);
        let mut draw_ids = chunks(self.draw_ids, pixels);
        let mut barycentrics = chunks(self.barycentrics, pixels);
        let mut hits = chunks(self.hits, pixels);
        move || Plane {
            color: color.next().unwrap_or_default(),
            more_colors: more_colors.iter_mut().map(|color| color.next().unwrap_or_default()).collect(),
            depth: depth.next().unwrap_or_default(),
            stencil: stencil.next(),
            triangle_ids: triangle_ids.next(),
            instance_ids: instance_ids.next(),
            draw_ids: draw_ids.next(),
            barycentrics: barycentrics.next(),
            hits: hits.next(),
        }
    }
}

fn chunks<T>(buffer: Option<&mut [T]>, pixels: usize) -> impl Iterator<Item = &mut [T]> {
    buffer.into_iter().flat_map(move |buffer| buffer.chunks_mut(pixels))
}

/// The rows that one row of tiles covers, sample by sample. Of what the target holds one value a pixel of, however many samples that has, only the first plane
/// has a buffer.
pub(crate) type Band<'a> = Vec<Plane<'a>>;

/// All bands of a target, from the top.
#[derive(Debug)]
pub(crate) struct Bands<'a>(Vec<Mutex<Band<'a>>>);

impl<'a> Bands<'a> {
    /// Cuts a valid target into bands of `side` rows.
    pub(crate) fn new(target: &'a mut Target<'_>, side: usize) -> Self {
        let (width, height) = (target.width as usize, target.height as usize);
        let all = Plane {
            color: target.color.reborrow(),
            more_colors: target.more_colors.iter_mut().map(ColorBuffer::reborrow).collect(),
            depth: target.depth.reborrow(),
            stencil: target.stencil.as_deref_mut(),
            triangle_ids: target.triangle_ids.as_deref_mut(),
            instance_ids: target.instance_ids.as_deref_mut(),
            draw_ids: target.draw_ids.as_deref_mut(),
            barycentrics: target.barycentrics.as_deref_mut(),
            hits: target.hits.as_deref_mut(),
        };
        let mut sample = all.cut(width * height);
        let mut samples: Vec<_> = (0..target.samples.count()).map(|_| sample().cut(side * width)).collect();
        let band = |_| Mutex::new(samples.iter_mut().map(|next| next()).collect());
        Self((0..height.div_ceil(side)).map(band).collect())
    }

    /// The band of a row of tiles, for this thread alone while the guard lives.
    pub(crate) fn lock(&self, row: usize) -> MutexGuard<'_, Band<'a>> {
        self.0[row].lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The part of a tile that lies in the picture, for copying between its blocks and the rows of a band.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TileRows {
    /// The picture's width, that is, the band's stride, and the tile's first column.
    width: usize,
    x: usize,
    columns: usize,
    rows: usize,
}

impl TileRows {
    pub(crate) fn new(view: &TileView, width: u32, height: u32) -> Self {
        let within = |first: i32, size: u32| (size as usize - first as usize).min(view.side as usize);
        Self { width: width as usize, x: view.x as usize, columns: within(view.x, width), rows: within(view.y, height) }
    }

    /// The tile's part of each row of a band.
    #[inline(always)]
    fn rows_of<'b, T>(&self, band: &'b mut [T]) -> impl Iterator<Item = &'b mut [T]> {
        let (first, last) = (self.x, self.x + self.columns);
        band.chunks_mut(self.width).take(self.rows).map(move |row| &mut row[first..last])
    }

    /// Calls `copy(row of the band, block, first sample)` for each piece of at most four pixels. `blocks` gives the
    /// number of the first block of a row of blocks.
    #[inline(always)]
    pub(crate) fn for_each<T>(
        &self,
        band: &mut [T],
        blocks: impl Fn(usize) -> usize,
        mut copy: impl FnMut(&mut [T], usize, usize),
    ) {
        for (row, pixels) in self.rows_of(band).enumerate() {
            let block = blocks(row / 4);
            for (k, piece) in pixels.chunks_mut(4).enumerate() {
                copy(piece, block + k, row % 4 * 4);
            }
        }
    }

    /// Gives all pixels one value.
    pub(crate) fn fill<T: Copy>(&self, band: &mut [T], value: T) {
        for row in self.rows_of(band) {
            row.fill(value);
        }
    }

    /// Replaces each pixel's value.
    pub(crate) fn update<T: Copy>(&self, band: &mut [T], new: impl Fn(T) -> T) {
        for row in self.rows_of(band) {
            for pixel in row {
                *pixel = new(*pixel);
            }
        }
    }

    /// Copies whole blocks out.
    #[inline(always)]
    pub(crate) fn store<T, U: Copy>(
        &self,
        band: &mut [T],
        source: &[[U; 16]],
        blocks: impl Fn(usize) -> usize,
        convert: impl Fn(U) -> T,
    ) {
        for (row, pixels) in self.rows_of(band).enumerate() {
            let (whole, rest) = pixels.as_chunks_mut::<4>();
            let (first, source) = (row % 4 * 4, &source[blocks(row / 4)..]);
            let (blocks, more) = source.split_at(whole.len());
            for (k, four) in whole.iter_mut().enumerate() {
                let [a, b, c, d] = blocks[k].as_chunks::<4>().0[row % 4];
                *four = [convert(a), convert(b), convert(c), convert(d)];
            }
            for (k, to) in rest.iter_mut().enumerate() {
                *to = convert(more[0][first + k]);
            }
        }
    }

    /// Copies into blocks.
    #[inline(always)]
    pub(crate) fn load<T: Copy, U>(
        &self,
        band: &mut [T],
        target: &mut [[U; 16]],
        blocks: impl Fn(usize) -> usize,
        convert: impl Fn(T) -> U,
    ) {
        self.for_each(band, blocks, |piece, block, first| {
            let samples = &mut target[block][first..first + 4];
            for (to, &from) in samples.iter_mut().zip(&*piece) {
                *to = convert(from);
            }
        });
    }
}
