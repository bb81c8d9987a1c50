//! The fixed-function settings of a draw: plain structs with defaults.

use super::{
    Blend, ColorMask, ColorState, Compare, Conservative, DepthBias, DepthState, PolygonMode, PrimitiveTopology,
    ProvokingVertex, Sampling, Scissor, StencilState, Viewport,
};

/// Everything about a draw that is not its shader or its mesh.
///
/// ```
/// use pineda::{Cull, DrawState};
/// let state = DrawState { cull: Cull::Back, ..DrawState::default() };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawState {
    /// The space that the vertex stage's positions are in.
    pub space: Space,
    /// How vertices make triangles, lines or points.
    pub topology: PrimitiveTopology,
    /// What is drawn of triangles: all of them, their edges, or their corners.
    pub polygon_mode: PolygonMode,
    /// Whether triangles cover every pixel that they touch, or only those that they cover whole.
    pub conservative: Conservative,
    /// Pixels across a line, 1 to [`MAX_LINE_WIDTH`](crate::MAX_LINE_WIDTH).
    ///
    /// A line of width 1 is drawn by the *diamond exit* rule: of the pixels around whose centres there is a diamond, |dx| + |dy| < 1/2, it covers those
    /// whose diamonds it leaves. So a strip of lines covers the pixel at a joint once, and a line covers one pixel in each column, or row, that
    /// it passes. Ties are decided as if both ends lay a little further left and, far less, further up, as in OpenGL and Vulkan, and as the
    /// top-left rule has it. All of it is done in integers: see `crates/pineda/src/raster/diamond_exit.rs`.
    ///
    /// A wider one, or any where pixels have [several samples](crate::Target::samples), is a rectangle, with ends at right angles where the line ends (Vulkan's rectangular lines), drawn by the rules for triangles.
    /// Its corners are snapped to 1/256 pixel.
    ///
    /// Along a line, varyings are interpolated between its ends as its distance in perspective, `#[noperspective]` ones and depth as the distance on the picture;
    /// what counts is the nearest point of the line to the pixel's centre. Where that lies beyond an end, which happens to the first and last pixel of a line of
    /// width 1, values are extrapolated. Derivatives are those of the same function: across the line nothing changes.
    ///
    /// ```
    /// use pineda::*;
    /// let corners = [[2.5, 2.5], [12.5, 2.5], [12.5, 9.5], [2.5, 9.5]];
    /// let mut hits = vec![0; 16 * 12];
    /// // Of the wide ones, 9 pixels at the corners are in two lines.
    /// for (line_width, expected) in [(1.0, 2 * 10 + 2 * 7), (3.0, 3 * (2 * 10 + 2 * 7) - 9)] {
    ///     let mut pass = Pass::new();
    ///     pass.draw_with(
    ///         Mesh { vertices: &corners, indices: Indices::Sequential },
    ///         DrawState { topology: PrimitiveTopology::LineLoop, line_width, space: Space::Raster, ..DrawState::default() },
    ///         |&[x, y]| (Vec4::from([x, y, 0.0, 1.0]), ()),
    ///         |f| Rgba::gray(f.splat(1.0)),
    ///     );
    ///     let mut target = Target { hits: Some(&mut hits), ..Target::new(16, 12) };
    ///     Renderer::new(Settings::default())?.render(&pass, &mut target)?;
    ///     assert_eq!(hits.iter().filter(|&&hits| hits > 0).count(), expected);
    /// }
    /// # Ok::<(), Error>(())
    /// ```
    pub line_width: f32,
    /// Whether lines are smooth: the alpha of each fragment is multiplied by the part of its pixel that the line's rectangle covers, whatever the width.
    ///
    /// It wants blending ([`Blend::ALPHA`](crate::Blend::ALPHA)), and mostly no writing of depth; such draws are shaded fragment by fragment, in order. The part is that of
    /// the rectangle with corners snapped to 1/256 pixel, rounded to f32. Every pixel that the rectangle touches is covered. Integers have no alpha:
    /// they are stored as they are, in every pixel that a line touches.
    ///
    /// ```
    /// use pineda::*;
    /// let mut pass = Pass::new();
    /// pass.draw_with(
    ///     Mesh { vertices: &[[2.0, 4.25], [6.5, 4.25]], indices: Indices::Sequential },
    ///     DrawState {
    ///         topology: PrimitiveTopology::LineList,
    ///         smooth_lines: true,
    ///         blend: Blend::ALPHA,
    ///         space: Space::Raster,
    ///         ..DrawState::default()
    ///     },
    ///     |&[x, y]| (Vec4::from([x, y, 0.0, 1.0]), ()),
    ///     |f| Rgba::gray(f.splat(1.0)),
    /// );
    /// let mut pixels = vec![[0.0; 4]; 8 * 8];
    /// let mut target = Target { color: ColorBuffer::Rgba32F(&mut pixels), ..Target::new(8, 8) };
    /// Renderer::new(Settings::default())?.render(&pass, &mut target)?;
    /// // From 3.75 to 4.75: a quarter of the row above, three quarters of the row below; the last pixel is half covered.
    /// assert_eq!([3, 4].map(|row| pixels[8 * row + 5][3]), [0.25, 0.75]);
    /// assert_eq!([3, 4].map(|row| pixels[8 * row + 6][3]), [0.125, 0.375]);
    /// # Ok::<(), Error>(())
    /// ```
    pub smooth_lines: bool,
    /// The side of a point in pixels, 0 to [`MAX_POINT_SIZE`](crate::MAX_POINT_SIZE).
    ///
    /// A point is a square around its vertex, drawn by the rules for triangles: a pixel is covered if its centre lies in the square, on its left or on its
    /// top border. The size is rounded to 1/256 pixel. It is drawn if its vertex lies between the near and the far plane, whichever part of the square
    /// is in the picture. What is interpolated is the vertex's all over the square; where in the square a fragment lies says
    /// [`f.point_coord()`](crate::Frag::point_coord). Points of several sizes in one draw are [`Shader::point_size`](crate::Shader::point_size)'s.
    ///
    /// ```
    /// use pineda::*;
    /// let mut pass = Pass::new();
    /// pass.draw_with(
    ///     Mesh { vertices: &[[8.0, 6.0], [0.0, 0.0]], indices: Indices::Sequential },
    ///     DrawState { topology: PrimitiveTopology::PointList, point_size: 6.0, space: Space::Raster, ..DrawState::default() },
    ///     |&[x, y]| (Vec4::from([x, y, 0.0, 1.0]), ()),
    ///     |f| Rgba::gray(f.splat(1.0)),
    /// );
    /// let mut hits = vec![0; 16 * 12];
    /// let mut target = Target { hits: Some(&mut hits), ..Target::new(16, 12) };
    /// Renderer::new(Settings::default())?.render(&pass, &mut target)?;
    /// assert_eq!(hits.iter().sum::<u32>(), 6 * 6 + 3 * 3, "of the second, a quarter is in the picture");
    /// # Ok::<(), Error>(())
    /// ```
    pub point_size: f32,
    /// Whether the largest index that there can be (0xff, 0xffff or 0xffff_ffff, by the type of the indices) names no vertex but ends a strip, a fan or a loop:
    /// the next index begins another one.
    ///
    /// Triangles or lines are counted over all strips, fans or loops of the draw, and only those that exist: a strip of triangles of n vertices has n - 2, and one of fewer than three none.
    /// Without indices there is nothing to restart; with a list it is an [error](crate::Error::RestartInList).
    ///
    /// ```
    /// use pineda::*;
    /// let corners = [[0.0, 0.0], [0.0, 8.0], [8.0, 0.0], [8.0, 8.0], [16.0, 0.0], [16.0, 8.0], [24.0, 0.0], [24.0, 8.0]];
    /// let two_squares = [0, 1, 2, 3, 0xff, 4, 5, 6, 7];
    /// let mut pass = Pass::new();
    /// pass.draw_with(
    ///     Mesh { vertices: &corners, indices: Indices::U8(&two_squares) },
    ///     DrawState {
    ///         topology: PrimitiveTopology::TriangleStrip,
    ///         primitive_restart: true,
    ///         space: Space::Raster,
    ///         ..DrawState::default()
    ///     },
    ///     |&[x, y]| (Vec4::from([x, y, 0.0, 1.0]), ()),
    ///     |f| Rgba::gray(f.splat(1.0)),
    /// );
    /// let mut ids = vec![0; 24 * 8];
    /// let mut target = Target { triangle_ids: Some(&mut ids), ..Target::new(24, 8) };
    /// Renderer::new(Settings::default())?.render(&pass, &mut target)?;
    /// assert_eq!(ids[..24], [0, 0, 0, 0, 0, 0, 0, 1, NO_ID, NO_ID, NO_ID, NO_ID, NO_ID, NO_ID, NO_ID, NO_ID, 2, 2, 2, 2, 2, 2, 2, 3]);
    /// # Ok::<(), Error>(())
    /// ```
    pub primitive_restart: bool,
    /// Which vertex of a triangle or line `#[flat]` varyings have their value from.
    pub provoking_vertex: ProvokingVertex,
    /// Which faces are left out. Lines and points have no faces; the edges and corners of a triangle are left out with it.
    pub cull: Cull,
    /// Which winding is the front.
    pub front_face: FrontFace,
    /// The depth test.
    pub depth: DepthState,
    /// By how much the depths of triangles are moved before they are tested; of a triangle's edges and corners as much as of the triangle.
    pub depth_bias: DepthBias,
    /// Whether what lies before the near plane or beyond the far one is drawn, with the nearest or farthest depth of the viewport, instead of
    /// being clipped. What lies behind the eye is clipped nevertheless.
    /// ```
    /// use pineda::*;
    /// let beyond = [[-1.0, 1.0, 2.0, 1.0], [-1.0, -1.0, 2.0, 1.0], [1.0, -1.0, 2.0, 1.0]];
    /// let drawn = |depth_clamp| {
    ///     let mut pass = Pass::new();
    ///     pass.draw_with(
    ///         Mesh { vertices: &beyond, indices: Indices::Sequential },
    ///         DrawState { depth_clamp, depth: DepthState::OFF, ..DrawState::default() },
    ///         |&corner| (Vec4::from(corner), ()),
    ///         |f| Rgba::gray(f.z()),
    ///     );
    ///     Ok::<_, Error>(Renderer::new(Settings::default())?.render_counted(&pass, &mut Target::new(64, 64))?[0].samples_passed)
    /// };
    /// assert_eq!((drawn(false)?, drawn(true)?), (0, 32 * 63));
    /// # Ok::<(), Error>(())
    /// ```
    pub depth_clamp: bool,
    /// The stencil test; `None` for none.
    pub stencil: Option<StencilState>,
    /// How the fragment's colour meets the target's.
    pub blend: Blend,
    /// Which channels of the target are written.
    pub color_mask: ColorMask,
    /// For some of several colour buffers, what goes in place of `blend` and `color_mask`: number 0 is for [`Target::color`](crate::Target::color), the others
    /// are for [`Target::more_colors`](crate::Target::more_colors).
    ///
    /// ```
    /// use pineda::{Blend, ColorState, DrawState};
    /// // Blends all buffers but the third, which holds ids.
    /// let mut state = DrawState { blend: Blend::ALPHA, ..DrawState::default() };
    /// state.colors[2] = Some(ColorState::default());
    /// ```
    // As long as `MAX_COLORS`, by number: closures that capture fields of such a type whose length is a constant's name crash rustc 1.95.
    pub colors: [Option<ColorState>; 8],
    /// Where fragments are shaded if the target has [several samples](crate::Target::samples).
    pub sampling: Sampling,
    /// Which of a pixel's samples are covered at most: bit k is for sample k. Bits beyond the target's samples are ignored.
    pub sample_mask: u32,
    /// Whether the alpha of what the fragment stage returns (first) decides how many of a pixel's samples are covered: the first `round(alpha n)` of n, of those that the
    /// triangle covers. So foliage and hair may be drawn without sorting. Colours of integers have no alpha, and are not touched.
    ///
    /// ```
    /// use pineda::*;
    /// let corners = [[0.0, 0.0], [0.0, 2.0], [2.0, 0.0]];
    /// let mut pass = Pass::new();
    /// pass.draw_with(
    ///     Mesh { vertices: &corners, indices: Indices::Sequential },
    ///     DrawState { alpha_to_coverage: true, space: Space::Raster, ..DrawState::default() },
    ///     |&[x, y]| (Vec4::from([x, y, 0.0, 1.0]), ()),
    ///     |f| Rgba::from(f.splat([1.0, 1.0, 1.0, 0.5])),
    /// );
    /// let mut pixels = [[0.0; 4]; 1];
    /// let mut target = Target { samples: Samples::Four, color: ColorBuffer::Rgba32F(&mut pixels), ..Target::new(1, 1) };
    /// Renderer::new(Settings::default())?.render(&pass, &mut target)?;
    /// assert_eq!(pixels[0], [0.5, 0.5, 0.5, 0.25], "two samples of four, with an alpha of 0.5");
    /// # Ok::<(), Error>(())
    /// ```
    pub alpha_to_coverage: bool,
    /// The part of the target that is drawn to; all of it when `None`.
    pub viewport: Option<Viewport>,
    /// Nothing is drawn outside of it; no bounds but the viewport's when `None`.
    pub scissor: Option<Scissor>,
}

impl DrawState {
    /// What [`DrawState::default`] returns, for constants.
    pub const DEFAULT: Self = Self {
        space: Space::Clip,
        topology: PrimitiveTopology::TriangleList,
        polygon_mode: PolygonMode::Fill,
        conservative: Conservative::Off,
        line_width: 1.0,
        smooth_lines: false,
        point_size: 1.0,
        primitive_restart: false,
        provoking_vertex: ProvokingVertex::First,
        cull: Cull::None,
        front_face: FrontFace::CounterClockwise,
        depth: DepthState { compare: Compare::Less, write: true },
        depth_bias: DepthBias::NONE,
        depth_clamp: false,
        stencil: None,
        blend: Blend::OPAQUE,
        color_mask: ColorMask::ALL,
        colors: [None; 8],
        sampling: Sampling::Centroid,
        sample_mask: u32::MAX,
        alpha_to_coverage: false,
        viewport: None,
        scissor: None,
    };
}

impl Default for DrawState {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// The space of the positions that a vertex stage returns.
///
/// ```
/// use pineda::*;
/// let drawn = |space, corners: [[f32; 2]; 3]| {
///     let mut pass = Pass::new();
///     pass.draw_with(
///         Mesh { vertices: &corners, indices: Indices::Sequential },
///         DrawState { space, ..DrawState::default() },
///         |&[x, y]| (Vec4::from([x, y, 0.5, 1.0]), ()),
///         |f| Rgba::gray(f.z()),
///     );
///     let mut hits = vec![0; 64 * 64];
///     let mut target = Target { hits: Some(&mut hits), ..Target::new(64, 64) };
///     Renderer::new(Settings::default())?.render(&pass, &mut target)?;
///     Ok::<_, Error>(hits)
/// };
/// // The lower left half of the picture: y up, and y down.
/// let clip = drawn(Space::Clip, [[-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]])?;
/// assert!(clip == drawn(Space::Raster, [[0.0, 0.0], [0.0, 64.0], [64.0, 64.0]])?);
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Space {
    /// Homogeneous clip space (x, y, z, w): x right, y up, visible where `-w <= x, y <= w` and `0 <= z <= w`.
    /// Normalised device coordinates are clip space with w = 1.
    #[default]
    Clip,
    /// Raster space, exactly: x pixels right and y pixels down from the target's top-left corner, z the depth in 0 to 1, and w
    /// the distance along the view axis that perspective-correct interpolation divides by (1 without perspective).
    /// The viewport then only bounds what is drawn, and maps depth.
    Raster,
}

/// Which faces are left out, decided on snapped positions.
///
/// ```
/// use pineda::*;
/// // Counter-clockwise on the picture, for y points down here.
/// let corners = [[0.0, 0.0], [0.0, 64.0], [64.0, 64.0]];
/// let culled = |cull, front_face| {
///     let mut pass = Pass::new();
///     pass.draw_with(
///         Mesh { vertices: &corners, indices: Indices::Sequential },
///         DrawState { cull, front_face, space: Space::Raster, ..DrawState::default() },
///         |&[x, y]| (Vec4::from([x, y, 0.5, 1.0]), ()),
///         |f| Rgba::gray(f.z()),
///     );
///     Ok::<_, Error>(Renderer::new(Settings::default())?.render_counted(&pass, &mut Target::new(64, 64))?[0].culled)
/// };
/// assert_eq!(culled(Cull::Back, FrontFace::CounterClockwise)?, 0);
/// assert_eq!(culled(Cull::Back, FrontFace::Clockwise)?, 1);
/// assert_eq!(culled(Cull::None, FrontFace::Clockwise)?, 0);
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Cull {
    /// None: both faces are drawn.
    #[default]
    None,
    /// Front faces are left out.
    Front,
    /// Back faces are left out.
    Back,
}

/// Which winding is the front, as seen on the picture; with an example at [`Cull`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum FrontFace {
    /// Counter-clockwise, as in glTF and OpenGL.
    #[default]
    CounterClockwise,
    /// Clockwise.
    Clockwise,
}
