//! Where a pass draws to: buffers in the caller's memory, row-major, the top row first.

pub(crate) mod bands;
pub(crate) mod depth;
pub(crate) mod format;
pub(crate) mod srgb;

pub use depth::DepthBuffer;

use crate::Error;

/// The largest width and height of a target, in pixels.
pub const MAX_SIZE: u32 = 16_384;

/// What [`Target::triangle_ids`], [`Target::instance_ids`] and [`Target::draw_ids`] hold where nothing was drawn.
pub const NO_ID: u32 = u32::MAX;

/// The buffers that a pass draws into. Each holds `width * height` elements, row by row from the top; those that are `None` are not written.
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
    /// The picture.
    pub color: ColorBuffer<'a>,
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

/// The picture's format.
#[derive(Debug, Default)]
pub enum ColorBuffer<'a> {
    /// No picture: fragment stages of opaque draws do not run.
    #[default]
    None,
    /// Red, green, blue, alpha, each `round(255 x)` of a value clamped to 0 to 1; NaN counts as 0.
    Rgba8(&'a mut [[u8; 4]]),
    /// The same, with red, green and blue encoded by the sRGB curve (IEC 61966-2-1) to the nearest code; blended in linear light.
    Rgba8Srgb(&'a mut [[u8; 4]]),
    /// As the fragment stage returns them; every NaN is stored with the bits 0x7fc0_0000.
    Rgba32F(&'a mut [[f32; 4]]),
}

impl ColorBuffer<'_> {
    /// The same buffer, for a shorter while.
    pub(crate) fn reborrow(&mut self) -> ColorBuffer<'_> {
        match self {
            Self::None => ColorBuffer::None,
            Self::Rgba8(pixels) => ColorBuffer::Rgba8(pixels),
            Self::Rgba8Srgb(pixels) => ColorBuffer::Rgba8Srgb(pixels),
            Self::Rgba32F(pixels) => ColorBuffer::Rgba32F(pixels),
        }
    }
}

impl Target<'_> {
    /// A target without any buffer yet.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            width,
            height,
            color: ColorBuffer::None,
            depth: DepthBuffer::None,
            stencil: None,
            triangle_ids: None,
            instance_ids: None,
            draw_ids: None,
            barycentrics: None,
            hits: None,
        }
    }

    pub(crate) fn validate(&self) -> Result<(), Error> {
        let (width, height) = (self.width, self.height);
        let sides = 1..=MAX_SIZE;
        if !sides.contains(&width) || !sides.contains(&height) {
            return Err(Error::TargetSize { width, height });
        }
        let expected = width as usize * height as usize;
        let color = match &self.color {
            ColorBuffer::None => None,
            ColorBuffer::Rgba8(pixels) | ColorBuffer::Rgba8Srgb(pixels) => Some(pixels.len()),
            ColorBuffer::Rgba32F(pixels) => Some(pixels.len()),
        };
        let buffers = [
            ("color", color),
            ("depth", self.depth.length()),
            ("stencil", self.stencil.as_ref().map(|b| b.len())),
            ("triangle_ids", self.triangle_ids.as_ref().map(|b| b.len())),
            ("instance_ids", self.instance_ids.as_ref().map(|b| b.len())),
            ("draw_ids", self.draw_ids.as_ref().map(|b| b.len())),
            ("barycentrics", self.barycentrics.as_ref().map(|b| b.len())),
            ("hits", self.hits.as_ref().map(|b| b.len())),
        ];
        for (buffer, length) in buffers {
            if let Some(length) = length.filter(|&length| length != expected) {
                return Err(Error::BufferLength { buffer, length, expected, width, height });
            }
        }
        Ok(())
    }
}
