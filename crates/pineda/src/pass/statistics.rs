use super::PrimitiveTopology;

/// What became of the triangles, lines and points of a pass.
///
/// ```
/// use pineda::*;
/// let inside = [[-1.0, 1.0, 0.5], [-1.0, -1.0, 0.5], [1.0, -1.0, 0.5]];
/// let beyond = inside.map(|[x, y, _]| [x, y, 2.0]);
/// let broken = inside.map(|[x, y, _]| [x, y, f32::NAN]);
/// let triangles = [inside, beyond, broken];
/// let mut pass = Pass::new();
/// pass.draw_with(
///     Mesh { vertices: triangles.as_flattened(), indices: Indices::Sequential },
///     DrawState::default(),
///     |&[x, y, z]| (Vec4::from([x, y, z, 1.0]), ()),
///     |f| Rgba::gray(f.z()),
/// );
/// let statistics = Renderer::new(Settings::default())?.render(&pass, &mut Target::new(64, 64))?;
/// assert_eq!((statistics.triangles, statistics.outside, statistics.non_finite), (3, 1, 1));
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Statistics {
    /// Triangles that came in, of all instances, whatever is drawn of them.
    pub triangles: u64,
    /// Lines that came in, of all instances.
    pub lines: u64,
    /// Points that came in, of all instances.
    pub points: u64,
    /// Of all these, dropped because a vertex has a NaN or infinite position.
    pub non_finite: u64,
    /// Of those, left out because they lie wholly outside the view volume or the guard band.
    pub outside: u64,
    /// Of those, cut by the near plane, the far plane or the guard band, or with a w beyond 2^64 or 2^-64: these take a slower way.
    pub clipped: u64,
    /// How many times what had been collected was drawn before the pass went on: 1 unless its geometry is larger
    /// than [`Settings::memory`](crate::Settings::memory).
    pub flushes: u64,
}

/// What one draw did, as [`Renderer::render_counted`](crate::Renderer::render_counted) counts it.
///
/// Every triangle that comes in is at most one of `non_finite`, `outside`, `degenerate` and `culled`. No number depends on threads or on the SIMD level; those that depend
/// on anything else of [`Settings`](crate::Settings) say so.
///
/// ```
/// use pineda::*;
/// // From far to near, each over all of the picture.
/// let layers = [0.75, 0.5, 0.25].map(|z| [[0.0, 0.0, z, 1.0], [0.0, 64.0, z, 1.0], [64.0, 0.0, z, 1.0]]);
/// let mut pass = Pass::new();
/// for (corners, blend) in layers.iter().zip([Blend::OPAQUE, Blend::OPAQUE, Blend::ALPHA]) {
///     pass.draw_with(
///         Mesh { vertices: &corners[..], indices: Indices::Sequential },
///         DrawState { blend, space: Space::Raster, ..DrawState::default() },
///         |&corner: &[f32; 4]| (corner.into(), ()),
///         |f| Rgba::gray(f.z()),
///     );
/// }
/// let mut pixels = vec![[0; 4]; 32 * 32];
/// let mut target = Target { color: ColorBuffer::Rgba8(&mut pixels), ..Target::new(32, 32) };
/// let draws = Renderer::new(Settings::default())?.render_counted(&pass, &mut target)?;
/// assert_eq!(draws.iter().map(|draw| draw.samples_passed).collect::<Vec<_>>(), [1024, 1024, 1024]);
/// // The first was hidden before anything was shaded.
/// assert_eq!(draws.iter().map(|draw| draw.samples_written).collect::<Vec<_>>(), [0, 1024, 1024]);
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct DrawStatistics {
    /// Vertices that went through the vertex stage: more if the pass takes several flushes. Those of clipped triangles go through it again, uncounted.
    pub vertices_shaded: u64,
    /// Triangles that came in, whatever is drawn of them.
    pub triangles: u64,
    /// Lines that came in.
    pub lines: u64,
    /// Points that came in.
    pub points: u64,
    /// Dropped because a vertex has a NaN or infinite position.
    pub non_finite: u64,
    /// Left out because they lie wholly outside the view volume or the guard band.
    pub outside: u64,
    /// Cut, or looked at closely; see [`Statistics::clipped`].
    pub clipped: u64,
    /// Triangles without an area on the raster, after snapping and clipping.
    pub degenerate: u64,
    /// Triangles left out for the face that they show.
    pub culled: u64,
    /// Tiles that at least one of its triangles may touch, in each flush. Depends on the size of tiles.
    pub tiles: u64,
    /// Fragments that went through the fragment stage. Of opaque draws only what is visible is shaded, and that may be decided several times, tile by tile: depends on the size of tiles, and
    /// on flushes.
    pub fragments_shaded: u64,
    /// Samples that passed all tests when it was their turn, and were not discarded: an occlusion query. 0 says that nothing of the draw was
    /// visible on top of the draws before it.
    pub samples_passed: u64,
    /// Samples that were written, each time that one was. Of opaque draws, those that passed but were hidden again before anything was shaded are none: the difference to
    /// `samples_passed` is the work that was saved, and depends on the size of tiles and on flushes. Of draws that blend, discard, test stencil, leave depth as it is, or write no colour at all, it is
    /// all that passed. What colour masks and write masks then let through makes no difference.
    pub samples_written: u64,
}

impl DrawStatistics {
    pub(crate) fn add(&mut self, other: &Self) {
        self.vertices_shaded += other.vertices_shaded;
        self.triangles += other.triangles;
        self.lines += other.lines;
        self.points += other.points;
        self.non_finite += other.non_finite;
        self.outside += other.outside;
        self.clipped += other.clipped;
        self.degenerate += other.degenerate;
        self.culled += other.culled;
        self.tiles += other.tiles;
        self.fragments_shaded += other.fragments_shaded;
        self.samples_passed += other.samples_passed;
        self.samples_written += other.samples_written;
    }
}

impl Statistics {
    pub(crate) fn add(&mut self, other: &Self) {
        self.triangles += other.triangles;
        self.lines += other.lines;
        self.points += other.points;
        self.non_finite += other.non_finite;
        self.outside += other.outside;
        self.clipped += other.clipped;
        self.flushes += other.flushes;
    }

    /// Counts primitives by the numbers that they have, `each` of them; one counts where its first number does.
    pub(crate) fn count(&mut self, topology: PrimitiveTopology, first: usize, end: usize, each: usize) {
        let count = (end.div_ceil(each) - first.div_ceil(each)) as u64;
        match topology {
            PrimitiveTopology::PointList => self.points += count,
            _ if topology.is_of_lines() => self.lines += count,
            _ => self.triangles += count,
        }
    }
}
