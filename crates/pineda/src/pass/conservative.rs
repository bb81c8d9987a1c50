//! Conservative rasterization: what counts as covered, when it is not the pixel's centre that counts.

/// Which pixels a draw's triangles cover: those whose centres they cover, those that they touch, or those that they cover whole.
///
/// `Overestimate` is for whatever must not be missed: cells of a voxel grid that geometry passes through, candidates for a collision, texels of a light map that
/// a triangle has any part in. `Underestimate` is for what must be certain: occluders that hide what lies behind them, cells that are filled.
///
/// Both are exact, with no uncertainty at all, for the triangle whose corners are snapped to 1/256 pixel (Direct3D's tier 3 and Vulkan's `VK_EXT_conservative_rasterization` leave
/// room for 1/256 pixel and more; extra sizes beyond it there are none). The top-left rule is off: a pixel along an edge that two triangles share is
/// touched by both. Windings and rotations cover the same pixels; what `Underestimate` covers is covered ordinarily, and what is covered ordinarily,
/// `Overestimate` covers. A triangle hits a pixel once. One that is clipped covers what the polygon that is left of it touches, or covers whole.
/// Culling, viewports and scissor rectangles work as ever. A triangle without area covers nothing.
///
/// Depth and varyings are those of the pixel's centre, and so *extrapolated* where the centre lies outside of the triangle, as in Direct3D and Vulkan. Depth is clamped to the
/// viewport's range; barycentric coordinates may be negative, or exceed 1. Where the extrapolated 1 / w is not positive, varyings with perspective mean nothing, and may be infinite or NaN;
/// `#[flat]` and `#[noperspective]` ones are as good as ever. A pixel that the ordinary triangle covers, too, is the same to the bit, but for depth where the triangle is
/// clipped: the largest part of what is left has the plane for all.
///
/// Only filled triangles know it; lines, points, and the edges and corners of triangles ([`PolygonMode`](crate::PolygonMode)) are [an error](crate::Error::ConservativeStrokes).
///
/// ```
/// use pineda::*;
/// // Its long side passes through the corners of pixels, and its other sides along their borders.
/// let corners = [[2.0, 2.0], [6.0, 2.0], [2.0, 6.0]];
/// let mut covered = Vec::new();
/// for conservative in [Conservative::Overestimate, Conservative::Off, Conservative::Underestimate] {
///     let mut pass = Pass::new();
///     pass.draw_with(
///         Mesh { vertices: &corners, indices: Indices::Sequential },
///         DrawState { conservative, space: Space::Raster, ..DrawState::default() },
///         |&[x, y]| (Vec4::from([x, y, 0.0, 1.0]), ()),
///         |f| Rgba::gray(f.splat(1.0)),
///     );
///     let mut hits = vec![0; 8 * 8];
///     let mut target = Target { hits: Some(&mut hits), ..Target::new(8, 8) };
///     Renderer::new(Settings::default())?.render(&pass, &mut target)?;
///     covered.push([1, 2, 3, 4, 5, 6].map(|row| hits[8 * row..8 * row + 8].iter().sum::<u32>()));
/// }
/// // Row by row, from the one that only the upper side touches.
/// assert_eq!(covered, [[6, 6, 5, 4, 3, 2], [0, 3, 2, 1, 0, 0], [0, 3, 2, 1, 0, 0]]);
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Conservative {
    /// Pixels whose centres are covered, by the top-left rule.
    #[default]
    Off,
    /// Every pixel that the triangle touches anywhere, be it with an edge or a corner: a closed square against a closed triangle.
    Overestimate,
    /// Only pixels that the triangle covers whole; an edge may pass along a pixel's border.
    Underestimate,
}
