//! What is drawn of triangles, and how large lines and points may be.

/// The widest lines, in pixels.
pub const MAX_LINE_WIDTH: u32 = 8_192;

/// The largest points, in pixels a side.
pub const MAX_POINT_SIZE: u32 = 8_192;

/// What is drawn of triangles.
///
/// Whatever it is, a triangle is [culled](crate::DrawState::cull) by its own facing, `f.front_facing()` is the triangle's, its
/// [depth bias](crate::DrawState::depth_bias) is the one that the filled triangle would have, and `#[flat]` varyings come from its provoking vertex.
///
/// ```
/// use pineda::*;
/// let corners = [[4.5, 2.5], [28.5, 2.5], [4.5, 26.5]];
/// let mut covered = Vec::new();
/// for polygon_mode in [PolygonMode::Fill, PolygonMode::Line, PolygonMode::Point] {
///     let mut pass = Pass::new();
///     pass.draw_with(
///         Mesh { vertices: &corners, indices: Indices::Sequential },
///         DrawState { polygon_mode, space: Space::Raster, ..DrawState::default() },
///         |&[x, y]| (Vec4::from([x, y, 0.0, 1.0]), ()),
///         |f| Rgba::gray(f.splat(1.0)),
///     );
///     let mut hits = vec![0; 32 * 32];
///     let mut target = Target { hits: Some(&mut hits), ..Target::new(32, 32) };
///     Renderer::new(Settings::default())?.render(&pass, &mut target)?;
///     covered.push(hits.iter().sum::<u32>());
/// }
/// assert_eq!(covered, [24 * 25 / 2, 3 * 24, 3]);
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PolygonMode {
    /// All of it.
    #[default]
    Fill,
    /// Its edges, as lines of the draw's [width](crate::DrawState::line_width). Each goes from one corner to the next, so that corners are drawn once; an edge that two triangles share
    /// is drawn twice. Where a triangle is clipped, its edges are.
    Line,
    /// Its corners, as points of the draw's [size](crate::DrawState::point_size).
    Point,
}
