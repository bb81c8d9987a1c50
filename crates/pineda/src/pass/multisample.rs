//! How a draw meets pixels with several samples.

use super::Pass;
use crate::{Error, Target};

/// Where the fragments of a multisampled target are shaded: WGSL's and GLSL's interpolation sampling `centroid`, `center` and `sample`.
///
/// Coverage, depth and stencil are always each sample's own, and a fragment's colour goes to those of its samples that pass.
///
/// ```
/// use pineda::*;
/// /// A triangle whose slanted border goes through most pixels, and red that grows from left to right.
/// fn draw(sampling: Sampling) -> Result<Vec<[f32; 4]>, Error> {
///     let corners = [[0.0, 0.0], [0.0, 8.0], [8.0, 0.0]];
///     let mut pass = Pass::new();
///     pass.draw_with(
///         Mesh { vertices: &corners, indices: Indices::Sequential },
///         DrawState { sampling, space: Space::Raster, ..DrawState::default() },
///         |&[x, y]| (Vec4::from([x, y, 0.0, 1.0]), Real::from(x)),
///         |f| { let x = f.varyings(); Rgba::opaque(Vec3::new(x, x, x)) },
///     );
///     let mut pixels = vec![[0.0; 4]; 4 * 8 * 8];
///     let mut target = Target { samples: Samples::Four, color: ColorBuffer::Rgba32F(&mut pixels), ..Target::new(8, 8) };
///     Renderer::new(Settings::default())?.render(&pass, &mut target)?;
///     Ok(pixels)
/// }
/// // Pixel (7, 0) is covered at its samples 0 and 2, not at its centre.
/// let pixel = |samples: Vec<[f32; 4]>| [0, 1, 2, 3].map(|k| samples[64 * k + 7][0]);
/// assert_eq!(pixel(draw(Sampling::Centroid)?), [7.375, 0.0, 7.375, 0.0]);
/// assert_eq!(pixel(draw(Sampling::Center)?), [7.5, 0.0, 7.5, 0.0]);
/// assert_eq!(pixel(draw(Sampling::Sample)?), [7.375, 0.0, 7.125, 0.0]);
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Sampling {
    /// Once a pixel: at the pixel's centre if the triangle covers it, else at the lowest-numbered sample that the triangle covers. Nothing is extrapolated.
    #[default]
    Centroid,
    /// Once a pixel, at the pixel's centre, whether the triangle covers it or not: what graphics cards do if nothing else is said. At borders, varyings
    /// may lie outside of what the vertices have.
    Center,
    /// Once a sample, there: as if the picture had as many more pixels.
    Sample,
}

/// Whether fragment stages that ask for a sample are run once a sample.
pub(crate) fn check_samples(pass: &Pass<'_>, target: &Target<'_>) -> Result<(), Error> {
    let asks_in_vain = |state: &super::DrawState| !target.samples.is_one() && state.sampling != Sampling::Sample;
    let first = pass.draws.iter().position(|call| call.uses().sample_index && asks_in_vain(call.state()));
    first.map_or(Ok(()), |draw| Err(Error::SampleIndex { draw }))
}
