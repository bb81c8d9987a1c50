//! Which vertices make which primitives, and what of them a `flat` varying shows: the words that a user says it with.

/// Which vertices a draw's primitives are made of.
///
/// ```
/// use pineda::*;
/// let corners = [[0.0, 0.0], [0.0, 64.0], [64.0, 0.0], [64.0, 64.0]];
/// let mut hits = vec![0; 64 * 64];
/// // The same two triangles, in bytes and in words.
/// for indices in [Indices::U8(&[0, 1, 2, 2, 1, 3]), Indices::U32([[0, 1, 2], [2, 1, 3]].as_flattened())] {
///     let mut pass = Pass::new();
///     pass.draw_with(
///         Mesh { vertices: &corners, indices },
///         DrawState { space: Space::Raster, ..DrawState::default() },
///         |&[x, y]| (Vec4::from([x, y, 0.5, 1.0]), ()),
///         |f| Rgba::gray(f.z()),
///     );
///     let mut target = Target { hits: Some(&mut hits), ..Target::new(64, 64) };
///     Renderer::new(Settings::default())?.render(&pass, &mut target)?;
///     assert!(hits.iter().all(|&hits| hits == 1));
/// }
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub enum Indices<'a> {
    /// All vertices, in their order.
    #[default]
    Sequential,
    /// The vertices that these name.
    U8(&'a [u8]),
    /// The vertices that these name.
    U16(&'a [u16]),
    /// The vertices that these name. Triangles as `[u32; 3]` are given with `as_flattened()`.
    U32(&'a [u32]),
}

/// How a row of vertices makes triangles, lines or points, as in Vulkan.
///
/// With a row `v0, v1, v2, ...`, which is the vertices themselves or what the [`Indices`] name, triangle `i` has these vertices:
///
/// | | first | second | third | with [`ProvokingVertex::Last`] |
/// | --- | --- | --- | --- | --- |
/// | list | `v[3i]` | `v[3i + 1]` | `v[3i + 2]` | the same |
/// | strip, `i` even | `v[i]` | `v[i + 1]` | `v[i + 2]` | the same |
/// | strip, `i` odd | `v[i]` | `v[i + 2]` | `v[i + 1]` | `v[i + 1]`, `v[i]`, `v[i + 2]` |
/// | fan | `v[i + 1]` | `v[i + 2]` | `v[0]` | `v[0]`, `v[i + 1]`, `v[i + 2]` |
///
/// The order decides which side is the front, which vertex [provokes](ProvokingVertex), and what the three
/// [barycentric coordinates](crate::Target::barycentrics) belong to; it changes no other bit. So the same triangles are the same picture, whichever way
/// they are given.
///
/// A strip or fan of fewer than three vertices is no triangle; a list must hold whole ones.
///
/// Line `i` goes from `v[2i]` to `v[2i + 1]` in a list, from `v[i]` to `v[i + 1]` in a strip; a loop has one more, from the last vertex back to the
/// first. Its first vertex provokes, or its end with [`ProvokingVertex::Last`]. How lines become pixels is told at
/// [`DrawState::line_width`](crate::DrawState::line_width), how points do at [`DrawState::point_size`](crate::DrawState::point_size).
///
/// A strip, four corners for two triangles:
///
/// ```
/// use pineda::*;
/// let corners = [[8.0, 8.0], [8.0, 56.0], [56.0, 8.0], [56.0, 56.0]];
/// let mut pass = Pass::new();
/// pass.draw_with(
///     Mesh { vertices: &corners, indices: Indices::Sequential },
///     DrawState { topology: PrimitiveTopology::TriangleStrip, space: Space::Raster, ..DrawState::default() },
///     |&[x, y]| (Vec4::from([x, y, 0.0, 1.0]), ()),
///     |f| Rgba::gray(f.splat(1.0)),
/// );
/// let mut hits = vec![0; 64 * 64];
/// let mut target = Target { hits: Some(&mut hits), ..Target::new(64, 64) };
/// Renderer::new(Settings::default())?.render(&pass, &mut target)?;
/// assert_eq!(hits.iter().sum::<u32>(), 48 * 48, "each pixel of the square once");
/// # Ok::<(), Error>(())
/// ```
///
/// A fan, a convex polygon around its first corner:
///
/// ```
/// use pineda::*;
/// let hexagon = [[60.0, 32.0], [46.0, 56.0], [18.0, 56.0], [4.0, 32.0], [18.0, 8.0], [46.0, 8.0]];
/// let mut pass = Pass::new();
/// pass.draw_with(
///     Mesh { vertices: &hexagon, indices: Indices::Sequential },
///     DrawState { topology: PrimitiveTopology::TriangleFan, space: Space::Raster, ..DrawState::default() },
///     |&[x, y]| (Vec4::from([x, y, 0.0, 1.0]), ()),
///     |f| Rgba::gray(f.splat(1.0)),
/// );
/// let mut ids = vec![0; 64 * 64];
/// let mut target = Target { triangle_ids: Some(&mut ids), ..Target::new(64, 64) };
/// Renderer::new(Settings::default())?.render(&pass, &mut target)?;
/// // Six corners make four triangles; the last lies between the last two corners and the first.
/// assert_eq!((ids[31 * 64 + 10], ids[10 * 64 + 40], ids[0]), (2, 3, NO_ID));
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum PrimitiveTopology {
    /// Three vertices each.
    #[default]
    TriangleList,
    /// Each vertex with the two before it. Every other triangle is taken the other way round, so that all of a strip show the same side.
    TriangleStrip,
    /// Each vertex with the one before it and the first.
    TriangleFan,
    /// Each vertex a point.
    PointList,
    /// Two vertices each.
    LineList,
    /// Each vertex with the one before it.
    LineStrip,
    /// The same, and the last one with the first: a strip that is closed, each of them where [restarts](crate::DrawState::primitive_restart) make
    /// several. Of two vertices it is two lines, of one none.
    LineLoop,
}

impl PrimitiveTopology {
    /// Every topology.
    pub const ALL: [Self; 7] = [
        Self::TriangleList,
        Self::TriangleStrip,
        Self::TriangleFan,
        Self::PointList,
        Self::LineList,
        Self::LineStrip,
        Self::LineLoop,
    ];

    /// Whether each primitive has vertices of its own, so that there is nothing to restart.
    pub(crate) fn is_list(self) -> bool {
        matches!(self, Self::TriangleList | Self::PointList | Self::LineList)
    }

    /// What its primitives are called.
    pub(crate) fn plural(self) -> &'static str {
        match self {
            Self::TriangleList | Self::TriangleStrip | Self::TriangleFan => "triangles",
            Self::PointList => "points",
            Self::LineList | Self::LineStrip | Self::LineLoop => "lines",
        }
    }

    pub(crate) fn is_of_triangles(self) -> bool {
        matches!(self, Self::TriangleList | Self::TriangleStrip | Self::TriangleFan)
    }

    pub(crate) fn is_of_lines(self) -> bool {
        matches!(self, Self::LineList | Self::LineStrip | Self::LineLoop)
    }
}

/// Which vertex of a triangle or a line a `#[flat]` varying has its value from. A point has but one.
///
/// ```
/// use pineda::*;
/// varyings! { struct Level { #[flat] level: Real } }
///
/// /// The level that the middle of the picture shows, of a triangle whose corners have these.
/// fn shown(levels: [f32; 3], provoking_vertex: ProvokingVertex) -> Result<f32, Error> {
///     let corners = [[0.0, 0.0, levels[0]], [64.0, 0.0, levels[1]], [32.0, 64.0, levels[2]]];
///     let mut pass = Pass::new();
///     pass.draw_with(
///         Mesh { vertices: &corners, indices: Indices::Sequential },
///         DrawState { provoking_vertex, space: Space::Raster, ..DrawState::default() },
///         |&[x, y, level]| (Vec4::from([x, y, 0.0, 1.0]), Level { level: level.into() }),
///         |f| Rgba::gray(f.level),
///     );
///     let mut pixels = vec![[0.0; 4]; 64 * 64];
///     let mut target = Target { color: ColorBuffer::Rgba32F(&mut pixels), ..Target::new(64, 64) };
///     Renderer::new(Settings::default())?.render(&pass, &mut target)?;
///     Ok(pixels[32 * 64 + 32][0])
/// }
///
/// assert_eq!(shown([0.25, 0.5, 0.75], ProvokingVertex::First)?, 0.25);
/// assert_eq!(shown([0.25, 0.5, 0.75], ProvokingVertex::Last)?, 0.75);
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ProvokingVertex {
    /// The first, as in Vulkan, WebGPU and Direct3D: vertex `i` of a strip's triangle or line `i`, vertex `i + 1` of a fan's.
    #[default]
    First,
    /// The last, as in OpenGL: vertex `i + 2` of a strip's or fan's triangle `i`, vertex `i + 1` of a strip's line `i`.
    Last,
}

/// What the vertex stage of an [instanced](crate::Pass::draw_instanced) draw takes: a vertex, and the instance that it is drawn for, with their numbers.
///
/// The numbers may be all that a draw needs: `()` is a vertex without data, and any number of them takes no memory. A triangle over the whole picture, of nothing but
/// its corners' numbers:
///
/// ```
/// use pineda::*;
///
/// struct Everywhere;
///
/// #[shader]
/// impl Shader for Everywhere {
///     type Vertex = Instanced<(), ()>;
///     type Varyings<L: Lanes> = Vec2<L>;
///
///     fn vertex(&self, v: &Self::Vertex) -> (Vec4, Vec2) {
///         // (0, 0), (2, 0) and (0, 2): the picture is the square up to (1, 1).
///         let [u, v] = [v.vertex_id << 1 & 2, v.vertex_id & 2].map(|x| x as f32);
///         (Vec4::from([2.0 * u - 1.0, 1.0 - 2.0 * v, 0.0, 1.0]), Vec2::from([u, v]))
///     }
///
///     fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
///         Rgba { r: f.x, g: f.y, b: f.splat(0.0), a: f.splat(1.0) }
///     }
/// }
///
/// let corners = Mesh { vertices: &[(); 3], indices: Indices::Sequential };
/// let mut pass = Pass::new();
/// pass.draw_instanced(&Everywhere, corners, &[()], DrawState::default());
/// let mut pixels = vec![[0.0; 4]; 8 * 8];
/// let mut target = Target { color: ColorBuffer::Rgba32F(&mut pixels), ..Target::new(8, 8) };
/// Renderer::new(Settings::default())?.render(&pass, &mut target)?;
/// assert_eq!((pixels[0], pixels[63]), ([0.0625, 0.0625, 0.0, 1.0], [0.9375, 0.9375, 0.0, 1.0]));
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Instanced<V, I> {
    /// The mesh's vertex.
    pub vertex: V,
    /// Its number in [`Mesh::vertices`](crate::Mesh::vertices), from 0: what the index says, where there are indices. Vulkan's `VertexIndex`, WebGPU's `vertex_index`.
    pub vertex_id: u32,
    /// The instance's own data.
    pub instance: I,
    /// The instance's number, from 0: what [`Target::instance_ids`](crate::Target::instance_ids) shows.
    pub instance_id: u32,
}
