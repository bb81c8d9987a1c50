//! Where a pass draws to: buffers in the caller's memory, row-major, the top row first.

pub(crate) mod bands;
pub(crate) mod color;
pub(crate) mod depth;
pub(crate) mod format;
pub(crate) mod half;
pub(crate) mod srgb;
pub(crate) mod texels;

pub use color::ColorBuffer;
pub use depth::DepthBuffer;
pub use half::{f16_to_f32, f32_to_f16};

use crate::Error;
use crate::raster::samples::Samples;

/// The most colour buffers that a target may have.
pub const MAX_COLORS: usize = 8;

/// The largest width and height of a target, in pixels.
pub const MAX_SIZE: u32 = 16_384;

/// What [`Target::triangle_ids`], [`Target::instance_ids`] and [`Target::draw_ids`] hold where nothing was drawn.
pub const NO_ID: u32 = u32::MAX;

/// The buffers that a pass draws into. Each holds `width * height` elements, row by row from the top; those that are `None` are not written.
///
/// If pixels have several [`samples`](Self::samples), each buffer holds either one element a pixel or one for each sample: a whole picture of the first sample, then one of the second, and so
/// on. In a buffer with one element a pixel, colours are the average over the pixel's samples, taken in linear light; everything else, integers among it, is what sample 0 has.
///
/// ```
/// use pineda::{ColorBuffer, DepthBuffer, Target};
/// let (width, height) = (640, 480);
/// let mut pixels = vec![[0u8; 4]; 640 * 480];
/// let mut depth = vec![0f32; 640 * 480];
/// let target = Target {
///     color: ColorBuffer::Rgba8Srgb(&mut pixels),
///     depth: DepthBuffer::D32F(&mut depth),
///     ..Target::new(width, height)
/// };
/// ```
#[derive(Debug)]
pub struct Target<'a> {
    /// Pixels across, 1 to [`MAX_SIZE`].
    pub width: u32,
    /// Pixels down, 1 to [`MAX_SIZE`].
    pub height: u32,
    /// How many samples a pixel has, at which coverage, depth and stencil are tested: more than one makes smooth borders.
    ///
    /// ```
    /// use pineda::*;
    /// let corners = [[0.0, 0.0], [0.0, 6.0], [6.0, 0.0]];
    /// let mut pass = Pass::new();
    /// pass.draw_with(
    ///     Mesh { vertices: &corners, indices: Indices::Sequential },
    ///     DrawState { space: Space::Raster, ..DrawState::default() },
    ///     |&[x, y]| (Vec4::from([x, y, 0.0, 1.0]), ()),
    ///     |f| Rgba::gray(f.splat(1.0)),
    /// );
    /// let (mut pixels, mut hits) = (vec![[0.0; 4]; 6 * 6], vec![0; 4 * 6 * 6]);
    /// let mut target = Target {
    ///     samples: Samples::Four,
    ///     color: ColorBuffer::Rgba32F(&mut pixels),
    ///     hits: Some(&mut hits),
    ///     ..Target::new(6, 6)
    /// };
    /// Renderer::new(Settings::default())?.render(&pass, &mut target)?;
    /// assert_eq!(pixels[..6].iter().map(|p| p[0]).collect::<Vec<_>>(), [1.0, 1.0, 1.0, 1.0, 1.0, 0.5]);
    /// assert_eq!([0, 1, 2, 3].map(|sample| hits[36 * sample + 5]), [1, 0, 1, 0]);
    /// # Ok::<(), Error>(())
    /// ```
    pub samples: Samples,
    /// The picture: what the fragment stage returns, or the first of what it returns.
    pub color: ColorBuffer<'a>,
    /// Where the further things go that fragment stages return; see [`Outputs`](crate::Outputs). With `color` at most [`MAX_COLORS`].
    ///
    /// Each draw must return as many as there are buffers, of the kinds that these hold; what is for [`ColorBuffer::None`] is dropped. A target without
    /// any takes every draw.
    ///
    /// ```
    /// use pineda::{ColorBuffer, Target};
    /// let (mut albedo, mut normals, mut ids) = (vec![[0u8; 4]; 64], vec![[0u16; 4]; 64], vec![0u32; 64]);
    /// let target = Target {
    ///     color: ColorBuffer::Rgba8Srgb(&mut albedo),
    ///     more_colors: vec![ColorBuffer::Rgba16F(&mut normals), ColorBuffer::R32U(&mut ids)],
    ///     ..Target::new(8, 8)
    /// };
    /// ```
    pub more_colors: Vec<ColorBuffer<'a>>,
    /// Depth, linear in raster space.
    pub depth: DepthBuffer<'a>,
    /// Stencil values.
    pub stencil: Option<&'a mut [u8]>,
    /// The triangle that each pixel shows (the line, the point), counted from 0 within its draw, and anew in each instance; [`NO_ID`] where there is
    /// none.
    pub triangle_ids: Option<&'a mut [u32]>,
    /// The instance of the draw that each pixel shows, counted from 0; 0 for draws without instances, [`NO_ID`] where there is nothing.
    pub instance_ids: Option<&'a mut [u32]>,
    /// The draw that each pixel shows, counted from 0 within the pass; [`NO_ID`] where there is none.
    pub draw_ids: Option<&'a mut [u32]>,
    /// Perspective-correct barycentric coordinates of each pixel's centre in the triangle that it shows, in the order of
    /// the triangle's vertices; zeros where there is none. In a line the first two count for its start and its end, in a point the first; on the edges and
    /// corners of a triangle they are the triangle's.
    pub barycentrics: Option<&'a mut [[f32; 3]]>,
    /// How many triangles, lines or points cover each pixel, whatever their depth: of a mesh without overlaps, exactly one.
    pub hits: Option<&'a mut [u32]>,
}

impl Target<'_> {
    /// A target without any buffer yet.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            width,
            height,
            samples: Samples::One,
            color: ColorBuffer::None,
            more_colors: Vec::new(),
            depth: DepthBuffer::None,
            stencil: None,
            triangle_ids: None,
            instance_ids: None,
            draw_ids: None,
            barycentrics: None,
            hits: None,
        }
    }

    /// Colour buffer `k`, if there are so many.
    pub(crate) fn color_buffer(&self, k: usize) -> Option<&ColorBuffer<'_>> {
        if k == 0 { Some(&self.color) } else { self.more_colors.get(k - 1) }
    }

    /// How many there are of them; 0 if there is no more than a `color` that is none.
    pub(crate) fn color_count(&self) -> usize {
        if self.color.is_none() && self.more_colors.is_empty() { 0 } else { 1 + self.more_colors.len() }
    }

    pub(crate) fn validate(&self) -> Result<(), Error> {
        let (width, height) = (self.width, self.height);
        let sides = 1..=MAX_SIZE;
        if !sides.contains(&width) || !sides.contains(&height) {
            return Err(Error::TargetSize { width, height });
        }
        let expected = width as usize * height as usize;
        let buffers = [
            ("color", self.color.length()),
            ("depth", self.depth.length()),
            ("stencil", self.stencil.as_ref().map(|b| b.len())),
            ("triangle_ids", self.triangle_ids.as_ref().map(|b| b.len())),
            ("instance_ids", self.instance_ids.as_ref().map(|b| b.len())),
            ("draw_ids", self.draw_ids.as_ref().map(|b| b.len())),
            ("barycentrics", self.barycentrics.as_ref().map(|b| b.len())),
            ("hits", self.hits.as_ref().map(|b| b.len())),
        ];
        if self.more_colors.len() >= MAX_COLORS {
            return Err(Error::TooManyColors { colors: 1 + self.more_colors.len() });
        }
        let more_colors = self.more_colors.iter().map(|color| ("more_colors", color.length()));
        for (buffer, length) in buffers.into_iter().chain(more_colors) {
            let of_all_samples = expected.checked_mul(self.samples.count());
            let is_right = |length: usize| length == expected || Some(length) == of_all_samples;
            if let Some(length) = length.filter(|&length| !is_right(length)) {
                let samples = self.samples.count();
                return Err(Error::BufferLength { buffer, length, expected, width, height, samples });
            }
        }
        Ok(())
    }
}
