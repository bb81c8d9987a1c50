//! Triangles worth trying, each made from one number.
//!
//! ```
//! use pineda_oracle::cases::{Case, Family};
//!
//! let case = Case::of_family(Family::Sliver, 7);
//! assert_eq!(case.family, Family::Sliver);
//! assert_eq!(Case::from_seed(case.seed), case); // what a failing test has to print is the seed
//! ```

mod clip_space;
mod meshes;
mod random;
mod triangles;

use std::fmt;

pub use random::Random;

use crate::coverage::{self, Point, Triangle};
use crate::snap::snap;

/// The widest coordinate of a raster-space case, in 1/256 px: the guard band's border, +-32,768 px.
pub const GUARD_BAND: i64 = 1 << 23;

/// What a case's positions mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Space {
    /// (x px right, y px down, depth 0 to 1, w > 0 for perspective).
    Raster,
    /// (x, y, z, w): x right, y up, visible where 0 <= z <= w and w > 0.
    Clip,
}

/// A picture's size and one or more triangles to draw into it.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// The number that [`Case::from_seed`] makes this case from again.
    pub seed: u64,
    /// What is special about it.
    pub family: Family,
    /// Pixels in a row, 1 to 96.
    pub width: u32,
    /// Rows, 1 to 96.
    pub height: u32,
    /// What the positions mean.
    pub space: Space,
    /// Positions.
    pub vertices: Vec<[f32; 4]>,
    /// Three indices of vertices each, in any winding.
    pub triangles: Vec<[u32; 3]>,
    /// For a mesh whose triangles share edges and do not overlap, its outline: indices of vertices, a simple polygon
    /// (convex in clip space). Each pixel inside is covered exactly once. Empty for other cases.
    pub outline: Vec<u32>,
}

macro_rules! families {
    ($($(#[$doc:meta])* $name:ident $space:ident $make:path,)*) => {
        /// What is special about a case.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Family {
            $($(#[$doc])* $name,)*
        }

        impl Family {
            /// Every family.
            pub const ALL: [Self; [$(Self::$name),*].len()] = [$(Self::$name),*];

            fn make(self, random: &mut Random, case: &mut Case) {
                match self {
                    $(Self::$name => {
                        case.space = Space::$space;
                        $make(random, case);
                    })*
                }
            }
        }
    };
}

families! {
    /// One triangle of any size, from less than a pixel to the whole guard band.
    AnySize Raster triangles::any_size,
    /// One triangle with corners up to thousands of pixels beyond the border, often exactly on the guard band's.
    Beyond Raster triangles::beyond,
    /// One long triangle, one subpixel thick, in any direction.
    Sliver Raster triangles::sliver,
    /// One triangle with corners on pixel centres.
    CornerOnCentre Raster triangles::corner_on_centre,
    /// One triangle with edges through pixel centres.
    EdgeThroughCentre Raster triangles::edge_through_centre,
    /// One triangle with horizontal or vertical edges, often through pixel centres.
    AxisAligned Raster triangles::axis_aligned,
    /// One triangle of about two pixels.
    Tiny Raster triangles::tiny,
    /// One triangle without area: corners repeated or on one line.
    Degenerate Raster triangles::degenerate,
    /// One triangle whose corners are between subpixels, often exactly halfway, so that snapping decides.
    Unsnapped Raster triangles::unsnapped,
    /// Up to 48 triangles of the families above, over each other, with depth and w.
    Soup Raster triangles::soup,
    /// A mesh: a grid of squares with jittered corners, cut along either diagonal.
    Grid Raster meshes::grid,
    /// A mesh: a fan around a corner that is mostly on a pixel centre.
    Fan Raster meshes::fan,
    /// A mesh: a strip between two parallel lines of any direction.
    Strip Raster meshes::strip,
    /// A mesh: a rectangle divided again and again, at its edges (both neighbours at once) and inside its triangles.
    Subdivision Raster meshes::subdivision,
    /// One triangle between the near and the far plane, in perspective.
    InFront Clip clip_space::in_front,
    /// One triangle in front of the eye, with corners far beyond the guard band.
    BeyondGuardBand Clip clip_space::beyond_guard_band,
    /// One triangle through the near plane, in perspective; mostly with corners behind the eye (w < 0).
    NearPlane Clip clip_space::near_plane,
    /// One triangle through the far plane, in perspective.
    FarPlane Clip clip_space::far_plane,
    /// One triangle with coordinates of any sign and magnitude; z and w have nothing to do with each other.
    Homogeneous Clip clip_space::homogeneous,
    /// One triangle of a few round numbers: corners with w = 0, on the near and the far plane, in the eye itself.
    OnPlanes Clip clip_space::on_planes,
    /// A mesh: a flat grid through the near or far plane, whose shared edges are clipped twice.
    ClippedGrid Clip clip_space::clipped_grid,
    /// Triangles in raster space, some with a NaN or an infinity.
    NonFinite Raster triangles::non_finite,
    /// Triangles in clip space, some with a NaN or an infinity.
    NonFiniteClip Clip clip_space::non_finite,
}

impl Case {
    /// The case with this number. Consecutive numbers go through all families in turn.
    pub fn from_seed(seed: u64) -> Self {
        let family = Family::ALL[(seed % Family::ALL.len() as u64) as usize];
        let mut random = Random::new(seed);
        let mut size = || match random.between(0, 7) {
            0 => random.between(1, 8) as u32,
            1 => random.between(65, 96) as u32,
            _ => random.between(9, 40) as u32,
        };
        let (width, height) = (size(), size());
        let (vertices, triangles, outline) = (Vec::new(), Vec::new(), Vec::new());
        let mut case = Self { seed, family, width, height, space: Space::Raster, vertices, triangles, outline };
        family.make(&mut random, &mut case);
        case
    }

    /// The n-th case of a family.
    pub fn of_family(family: Family, n: u64) -> Self {
        Self::from_seed(n * Family::ALL.len() as u64 + family as u64)
    }

    /// The corners of each triangle.
    pub fn corners(&self) -> impl Iterator<Item = [[f32; 4]; 3]> {
        self.triangles.iter().map(|triangle| triangle.map(|index| self.vertices[index as usize]))
    }

    /// How many triangles have a corner that is not finite: they are dropped and counted.
    pub fn dropped(&self) -> usize {
        self.corners().filter(|corners| !is_finite(corners)).count()
    }

    /// The snapped corners of each triangle of a case in raster space, without those that are not finite.
    pub fn snapped(&self) -> Vec<Triangle> {
        self.corners().filter(is_finite).map(|corners| corners.map(|corner| self.snapped_corner(corner))).collect()
    }

    /// How often each pixel is covered in a case in raster space.
    pub fn hits(&self) -> Vec<u32> {
        coverage::hits(&self.snapped(), self.width, self.height)
    }

    /// The same for one sample of each pixel, which lies so many sixteenths of a pixel from its upper left corner.
    pub fn hits_at(&self, sample: [u8; 2]) -> Vec<u32> {
        let moved: Vec<_> = self.snapped().iter().map(|corners| corners.map(|at| seen_from(at, sample))).collect();
        coverage::hits(&moved, self.width, self.height)
    }

    /// What a mesh in raster space covers, from its outline alone.
    pub fn region(&self) -> Vec<bool> {
        self.region_at([8, 8])
    }

    /// The same for one sample of each pixel.
    pub fn region_at(&self, sample: [u8; 2]) -> Vec<bool> {
        let corner = |&k: &u32| seen_from(self.snapped_corner(self.vertices[k as usize]), sample);
        let outline: Vec<_> = self.outline.iter().map(corner).collect();
        coverage::polygon_coverage(&outline, self.width, self.height)
    }

    fn snapped_corner(&self, [x, y, ..]: [f32; 4]) -> Point {
        assert_eq!(self.space, Space::Raster, "only raster space can be snapped without projecting");
        [x, y].map(|x| snap(x.into()).expect("a case's finite positions are within the guard band"))
    }

    /// Adds a vertex of raster space at a snapped position, with a depth and a w.
    fn add_snapped(&mut self, [x, y]: Point, z: f32, w: f32) -> u32 {
        debug_assert!(x.abs().max(y.abs()) <= GUARD_BAND);
        self.vertices.push([x as f32 / 256.0, y as f32 / 256.0, z, w]); // 24 bits: exact
        self.vertices.len() as u32 - 1
    }

    /// Adds a triangle with corners of its own.
    fn add_triangle(&mut self, corners: [[f32; 4]; 3]) {
        let first = self.vertices.len() as u32;
        self.vertices.extend(corners);
        self.triangles.push([first, first + 1, first + 2]);
    }
}

/// A place, in subpixels, on a raster that is moved so that a sample, in sixteenths of a pixel, lies where pixels' centres do.
fn seen_from(at: Point, sample: [u8; 2]) -> Point {
    [0, 1].map(|k| at[k] - 16 * (i64::from(sample[k]) - 8))
}

/// The six orders in which the corners of one triangle can be given: three rotations of each winding.
pub fn orders([a, b, c]: [u32; 3]) -> [[u32; 3]; 6] {
    [[a, b, c], [b, c, a], [c, a, b], [a, c, b], [c, b, a], [b, a, c]]
}

impl fmt::Display for Case {
    /// Everything about the case, as Rust code where that helps.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { seed, family, width, height, space, .. } = self;
        writeln!(f, "Case::from_seed({seed}): {family:?}, {width} x {height}, {space:?} space")?;
        writeln!(f, "let vertices = {:?};", self.vertices)?;
        writeln!(f, "let triangles = {:?};", self.triangles)?;
        if self.outline.is_empty() { Ok(()) } else { writeln!(f, "let outline = {:?};", self.outline) }
    }
}

fn is_finite(corners: &[[f32; 4]; 3]) -> bool {
    corners.iter().flatten().all(|x| x.is_finite())
}
