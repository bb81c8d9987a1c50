//! Which pixels of a row triangles touch, and which they cover whole: conservative coverage, in integers.
//!
//! A row of pixels is a strip of the picture. What lies of an edge within the strip reaches from some x to some other, and passes through the squares in between. From
//! these stretches alone follows what a region R, a union of triangles, does to the row:
//!
//! ```text
//!   strip  -----+-----+-----+-----+-----+-----+-----+---     touched by a triangle:  from the leftmost square that one of its edges meets to the
//!               |    _|_____|_____|____ |     |     |                                rightmost; closed squares, closed strip
//!               |  _/ |     |     |    \|_    |     |        covered whole:          met by a triangle, as above, but met by no edge of R's border;
//!          -----+-/---+-----+-----+-----+-\---+-----+---                             both with open squares and an open strip
//!                 (  )|     |     |     |(  )
//! ```
//!
//! - *Touched.* A triangle's part in the closed strip is convex, so it meets the squares from its leftmost point's to its rightmost point's; and these are on edges.
//! - *Covered whole.* An open square that R's border does not meet lies inside of R or outside; if R meets it, inside. And so does its closure, for R is closed.
//!
//! | value | range | proof |
//! | --- | --- | --- |
//! | corners | +-2^23 | the guard band |
//! | where an edge meets a height, times the edge's height | 2^23 2^24 + 2^24 2^24 < 2^49 | |

use crate::geometry::raster_space::{GUARD_BAND, SUBPIXEL_BITS, SUBPIXELS};
use crate::pass::Conservative;

/// A point on the raster, in subpixels.
pub(crate) type Point = [i32; 2];

/// Columns of a row: the first, and the one after the last.
pub(crate) type Stretch = [i32; 2];

/// Triangles that cover together, all of one winding.
#[derive(Debug, Default)]
pub(crate) struct Region {
    triangles: Vec<[Edge; 3]>,
    /// Edges that hold the region's border; only for what covers whole.
    border: Vec<Edge>,
    is_closed: bool,
}

impl Region {
    /// Of these triangles, with area and of one winding, for what covers conservatively; keeps its memory.
    pub(crate) fn set(&mut self, triangles: &[[Point; 3]], conservative: Conservative) {
        debug_assert!(triangles.as_flattened().as_flattened().iter().all(|v| v.abs() <= GUARD_BAND));
        self.is_closed = conservative != Conservative::Underestimate;
        let edges = |&[a, b, c]: &[Point; 3]| [[a, b], [b, c], [c, a]];
        self.triangles.clear();
        self.triangles.extend(triangles.iter().map(|triangle| edges(triangle).map(Edge::new)));
        self.border.clear();
        if !self.is_closed {
            // An edge that goes there in one triangle and back in another lies inside.
            let all = || triangles.iter().flat_map(edges);
            self.border.extend(all().filter(|&[a, b]| all().all(|other| other != [b, a])).map(Edge::new));
        }
    }

    /// The smallest and the largest coordinates of its corners.
    pub(crate) fn bounds(&self) -> (Point, Point) {
        let (mut low, mut high) = ([i32::MAX; 2], [i32::MIN; 2]);
        for Edge { upper, lower } in self.triangles.as_flattened() {
            for axis in 0..2 {
                low[axis] = low[axis].min(upper[axis]).min(lower[axis]);
                high[axis] = high[axis].max(upper[axis]).max(lower[axis]);
            }
        }
        (low, high)
    }

    /// The stretches that are covered in a row, within some columns, from left to right.
    pub(crate) fn row(&self, row: i32, within: Stretch, out: &mut Vec<Stretch>) {
        out.clear();
        for edges in &self.triangles {
            let mut hull = [i32::MAX, i32::MIN];
            for edge in edges {
                if let Some([first, end]) = edge.columns(row, self.is_closed) {
                    hull = [hull[0].min(first), hull[1].max(end)];
                }
            }
            let [first, end] = [hull[0].max(within[0]), hull[1].min(within[1])];
            if first < end {
                out.push([first, end]);
            }
        }
        merge(out);
        for edge in &self.border {
            if let Some(taken) = edge.columns(row, false) {
                subtract(out, taken);
            }
        }
    }
}

/// Sorts stretches and joins those that meet.
fn merge(stretches: &mut Vec<Stretch>) {
    if stretches.len() < 2 {
        return;
    }
    stretches.sort_unstable();
    stretches.dedup_by(|next, last| {
        let meets = next[0] <= last[1];
        if meets {
            last[1] = last[1].max(next[1]);
        }
        meets
    });
}

/// Takes columns out of stretches.
fn subtract(stretches: &mut Vec<Stretch>, [first, end]: Stretch) {
    let mut k = 0;
    while k < stretches.len() {
        let [a, b] = stretches[k];
        let (left, right) = ([a, b.min(first)], [a.max(end), b]);
        match (left[0] < left[1], right[0] < right[1]) {
            // Not of an empty taking, which leaves both sides of what it lies in.
            _ if first >= end || b <= first || end <= a => k += 1,
            (true, true) => {
                stretches[k] = left;
                stretches.insert(k + 1, right);
                k += 2;
            }
            (true, false) => {
                stretches[k] = left;
                k += 1;
            }
            (false, true) => {
                stretches[k] = right;
                k += 1;
            }
            (false, false) => drop(stretches.remove(k)),
        }
    }
}

/// An edge, from its upper to its lower end.
#[derive(Clone, Copy, Debug)]
struct Edge {
    upper: Point,
    lower: Point,
}

impl Edge {
    fn new([a, b]: [Point; 2]) -> Self {
        if a[1] <= b[1] { Self { upper: a, lower: b } } else { Self { upper: b, lower: a } }
    }

    /// The columns of those squares of a row that the edge meets: closed squares, or open ones. `None` if it lies above the row or below; empty if it lies on a border
    /// between two columns.
    fn columns(&self, row: i32, is_closed: bool) -> Option<Stretch> {
        let (top, bottom) = (row * SUBPIXELS, (row + 1) * SUBPIXELS);
        let reaches = if is_closed {
            self.upper[1] <= bottom && self.lower[1] >= top
        } else {
            self.upper[1] < bottom && self.lower[1] > top
        };
        if !reaches {
            return None;
        }
        let (p, q) = (self.at(self.upper[1].max(top), self.upper), self.at(self.lower[1].min(bottom), self.lower));
        let (left, right) = if p <= q { (p, q) } else { (q, p) };
        // Those with x < right and x + 1 > left; where a border counts, x <= right and x + 1 >= left.
        Some(if is_closed { [left.ceil - 1, right.floor + 1] } else { [left.floor, right.ceil] })
    }

    /// Where the edge is at a height that it reaches; `end` is the end that it may be at.
    fn at(&self, height: i32, end: Point) -> Column {
        if height == end[1] {
            return Column { floor: end[0] >> SUBPIXEL_BITS, ceil: (end[0] + SUBPIXELS - 1) >> SUBPIXEL_BITS };
        }
        let wide = |axis: usize| i64::from(self.lower[axis]) - i64::from(self.upper[axis]);
        let down = i64::from(height) - i64::from(self.upper[1]);
        let (numerator, denominator) = (i64::from(self.upper[0]) * wide(1) + wide(0) * down, wide(1));
        let column = denominator * i64::from(SUBPIXELS);
        let floor = numerator.div_euclid(column);
        Column { floor: floor as i32, ceil: (floor + i64::from(floor * column != numerator)) as i32 }
    }
}

/// A place in pixels, rounded down and up. Two of them compare as their places do, as far as stretches of columns are concerned.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Column {
    floor: i32,
    ceil: i32,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::clip::{ClipTriangle, clip};
    use crate::geometry::project::Projection;
    use crate::geometry::raster_space::ScreenVertex;
    use crate::pass::{Space, Viewport};
    use crate::shading::MAX_CLIP_DISTANCES;
    use pineda_oracle::cases::{Case, Family, Random};
    use pineda_oracle::{Rational, Triangle, contains, covered_area, covers_whole, touches};

    /// Compares rows with the oracle: what one of the triangles touches, and what all of them cover together, by exact areas. Returns how many pixels are covered whole by none of
    /// them alone.
    fn check(triangles: &[[Point; 3]], what: &str) -> usize {
        let (width, height) = (24, 18);
        let of_oracle: Vec<Triangle> = triangles.iter().map(|triangle| triangle.map(|p| p.map(i64::from))).collect();
        let mut region = Region::default();
        let mut across = 0;
        for conservative in [Conservative::Overestimate, Conservative::Underestimate] {
            region.set(triangles, conservative);
            let mut stretches = Vec::new();
            for y in 0..height {
                region.row(y, [0, width], &mut stretches);
                assert!(stretches.windows(2).all(|pair| pair[0][1] < pair[1][0]), "in order and apart: {stretches:?}");
                for x in 0..width {
                    let pixel = [x, y].map(i64::from);
                    let is_touched = of_oracle.iter().any(|&triangle| touches(triangle, pixel));
                    let expected = if conservative == Conservative::Overestimate {
                        is_touched
                    } else if of_oracle.iter().any(|&triangle| covers_whole(triangle, pixel)) {
                        true
                    } else {
                        let is_whole = is_touched && is_whole(&of_oracle, pixel);
                        across += usize::from(is_whole);
                        is_whole
                    };
                    let found = stretches.iter().any(|&[first, end]| (first..end).contains(&x));
                    assert_eq!(found, expected, "{conservative:?}: pixel ({x}, {y}) of {triangles:?}, {what}");
                }
            }
        }
        across
    }

    /// Whether triangles that do not overlap cover all of a pixel together.
    fn is_whole(triangles: &[Triangle], [i, j]: [i64; 2]) -> bool {
        let corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(|p| p.map(|v| 256 * v));
        let is_inside = |&corner: &[i64; 2]| triangles.iter().any(|&triangle| contains(triangle, corner));
        let clockwise = |&[a, b, c]: &Triangle| {
            if pineda_oracle::winding([a, b, c]) == pineda_oracle::Winding::Clockwise { [a, b, c] } else { [a, c, b] }
        };
        corners.iter().all(is_inside)
            && triangles.iter().map(|t| covered_area(&clockwise(t), [i, j])).fold(Rational::ZERO, |a, b| a + b)
                == Rational::ONE
    }

    #[test]
    fn every_pixel_of_triangles_is_the_oracles() {
        let mut random = Random::new(0x0e5);
        for case in 0..3_000 {
            let far = random.pick(&[1 << 23, 1 << 16, 6_000, 6_000, 600]);
            let grid = random.pick(&[1, 1, 1, 128, 256]);
            let middle = [random.between(0, 24 * 256), random.between(0, 18 * 256)];
            let triangle = [0; 3].map(|_| {
                let at = |v: i64, random: &mut Random| (v + random.between(-far, far)).clamp(-(1 << 23), 1 << 23);
                middle.map(|v| (at(v, &mut random) / grid * grid) as i32)
            });
            let [a, b, c] = triangle.map(|p| p.map(i64::from));
            if (b[0] - a[0]) * (c[1] - a[1]) != (c[0] - a[0]) * (b[1] - a[1]) {
                check(&[triangle], &format!("case {case}"));
            }
        }
    }

    /// Polygons as clipping leaves them, whose corners snapping may have moved inwards by a subpixel.
    #[test]
    fn every_pixel_of_clipped_triangles_is_the_oracles() {
        let projection = Projection::new(Space::Clip, &Viewport::whole(24, 18));
        let families =
            [Family::NearPlane, Family::FarPlane, Family::BeyondGuardBand, Family::Homogeneous, Family::OnPlanes];
        let (mut polygons, mut across) = (0, 0);
        for n in 0..1_500 {
            let case = Case::of_family(families[n as usize % 5], n);
            let mut positions = [case.vertices[0]; 16];
            positions[..3].copy_from_slice(&case.vertices[..3]);
            let mut screen = [ScreenVertex::default(); 16];
            projection.project(fearless_simd::Level::fallback(), &positions, &mut screen);
            let screen = [screen[0], screen[1], screen[2]];
            let [a, b, c] = screen.map(ScreenVertex::outcode);
            if (a | b | c) == 0 || a & b & c != 0 {
                continue;
            }
            let positions = [positions[0], positions[1], positions[2]];
            let triangle = ClipTriangle { positions, distances: [[0.0; MAX_CLIP_DISTANCES]; 3] };
            let Some(clipped) = clip(&projection, &triangle, screen) else { continue };
            let triangles: Vec<_> = clipped.triangles().iter().map(|t| t.map(|v| [v.x(), v.y()])).collect();
            polygons += usize::from(triangles.len() > 1);
            across += check(&triangles, &format!("{case}"));
        }
        assert!(polygons > 200 && across > 500, "{polygons} polygons, {across} pixels across edges within them");
    }

    #[test]
    fn a_corner_that_snapping_moved_inwards_parts_a_row() {
        // The polygon's lower side has its middle corner a subpixel higher, on a border: nothing touches the row below there.
        let [left, middle, right] = [[256, 513], [2560, 512], [5120, 513]];
        let top = [2560, 256];
        let triangles = [[top, right, middle], [top, middle, left]];
        check(&triangles, "a dent");
        let mut region = Region::default();
        region.set(&triangles, Conservative::Overestimate);
        let mut stretches = Vec::new();
        region.row(2, [0, 24], &mut stretches);
        assert_eq!(stretches, [[0, 21]], "the dent's corner is on the border");
        let triangles = [[top, right, [2560, 511]], [top, [2560, 511], left]];
        check(&triangles, "a deeper dent");
        region.set(&triangles, Conservative::Overestimate);
        region.row(2, [0, 24], &mut stretches);
        assert_eq!(stretches.len(), 2, "{stretches:?}");
    }
}
