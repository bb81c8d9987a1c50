//! Coverage of a snapped triangle, by the definition.
//!
//! A pixel belongs to a triangle if its centre is inside. If the centre is exactly on an edge, it belongs to the triangle
//! only if that edge is a top edge or a left edge:
//!
//! ```text
//!       top                 top edge:  exactly horizontal, the triangle below it
//!     +------+              left edge: not horizontal, the triangle to the right of it
//!      \    /
//!  left \  / right          the other two kinds, right and bottom, belong to whoever is beyond
//!        \/
//! ```

/// A position (x right, y down) in 1/256 pixel. |x| and |y| are at most 2^29, so that an edge function fits i64.
pub type Point = [i64; 2];

/// Three snapped corners, in either winding.
pub type Triangle = [Point; 3];

/// Subpixels in a pixel.
pub const SUBPIXELS: i64 = 256;

/// Whether the triangle owns pixel (i, j). A triangle without area owns nothing.
pub fn covers([a, b, c]: Triangle, pixel: [i64; 2]) -> bool {
    let centre = centre(pixel);
    winding([a, b, c]) != Winding::Degenerate
        && [(a, b, c), (b, c, a), (c, a, b)].into_iter().all(|(a, b, opposite)| match edge(a, b, centre).signum() {
            0 => is_top_edge(a, b, opposite) || is_left_edge(a, b, opposite),
            side => side == edge(a, b, opposite).signum(),
        })
}

/// The coverage of a whole picture, row by row from the top.
pub fn coverage(triangle: Triangle, width: u32, height: u32) -> Vec<bool> {
    let mut covered = vec![false; width as usize * height as usize];
    for_each_covered(triangle, width, height, |index| covered[index] = true);
    covered
}

/// How often each pixel of a picture is covered by one of the triangles.
pub fn hits(triangles: &[Triangle], width: u32, height: u32) -> Vec<u32> {
    let mut hits = vec![0; width as usize * height as usize];
    for &triangle in triangles {
        for_each_covered(triangle, width, height, |index| hits[index] += 1);
    }
    hits
}

/// Which way round the corners go, as seen in the picture (y down).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Winding {
    /// Right, up, left.
    CounterClockwise,
    /// Right, down, left.
    Clockwise,
    /// No area: nothing is covered.
    Degenerate,
}

/// Which way round the corners of a snapped triangle go.
pub fn winding([a, b, c]: Triangle) -> Winding {
    match edge(a, b, c).signum() {
        1 => Winding::CounterClockwise,
        -1 => Winding::Clockwise,
        _ => Winding::Degenerate,
    }
}

/// The pixels that a simple polygon owns, by another road than [`covers`]: the top-left rule says nothing else than that
/// each centre is moved by an infinitely small step to the right and, far smaller still, down. The moved point is on no
/// edge, so it is inside if a ray from it to the left crosses the outline an odd number of times.
pub fn polygon_coverage(outline: &[Point], width: u32, height: u32) -> Vec<bool> {
    let is_inside = |pixel| {
        let centre @ [_, y] = centre(pixel);
        let crossings = outline.iter().zip(outline.iter().cycle().skip(1)).filter(|&(&a, &b)| {
            let (upper, lower) = if a[1] <= b[1] { (a, b) } else { (b, a) };
            let spans_ray = upper[1] <= y && y < lower[1];
            spans_ray && edge(upper, lower, centre) >= 0
        });
        crossings.count() % 2 == 1
    };
    (0..height).flat_map(|j| (0..width).map(move |i| [i.into(), j.into()])).map(is_inside).collect()
}

/// Checks a mesh without overlaps: each pixel of `region` hit once, each other pixel never.
///
/// # Errors
/// Names the first pixel that is not so.
pub fn covered_exactly_once(hits: &[u32], region: &[bool], width: u32) -> Result<(), String> {
    assert_eq!(hits.len(), region.len(), "hits and region are of one picture");
    match hits.iter().zip(region).position(|(&hits, &inside)| hits != inside.into()) {
        None => Ok(()),
        Some(index) => {
            let (i, j) = (index % width as usize, index / width as usize);
            let (found, wanted) = (hits[index], u32::from(region[index]));
            Err(format!("pixel ({i}, {j}) is hit {found} times instead of {wanted}"))
        }
    }
}

/// The centre of a pixel in 1/256 px.
pub(crate) fn centre([i, j]: [i64; 2]) -> Point {
    [SUBPIXELS * i + SUBPIXELS / 2, SUBPIXELS * j + SUBPIXELS / 2]
}

/// E_ab(p) of raster-rules.md: twice the signed area of (a, b, p), positive if they go counter-clockwise in the picture.
pub(crate) fn edge(a: Point, b: Point, p: Point) -> i64 {
    (p[0] - a[0]) * (b[1] - a[1]) - (p[1] - a[1]) * (b[0] - a[0])
}

fn is_top_edge(a: Point, b: Point, opposite: Point) -> bool {
    a[1] == b[1] && opposite[1] > a[1]
}

fn is_left_edge(a: Point, b: Point, opposite: Point) -> bool {
    let (upper, lower) = if a[1] < b[1] { (a, b) } else { (b, a) };
    upper[1] != lower[1] && edge(upper, lower, opposite) > 0
}

/// Visits the covered pixels; those whose square is beyond the triangle's bounding box are not even asked.
fn for_each_covered(triangle: Triangle, width: u32, height: u32, mut visit: impl FnMut(usize)) {
    let span = |axis: usize, size: u32| {
        let [low, high] = [triangle.iter().map(|p| p[axis]).min(), triangle.iter().map(|p| p[axis]).max()]
            .map(|x| x.unwrap_or(0).div_euclid(SUBPIXELS));
        low.max(0)..(high + 1).min(size.into())
    };
    for j in span(1, height) {
        for i in span(0, width) {
            if covers(triangle, [i, j]) {
                visit((j * i64::from(width) + i) as usize);
            }
        }
    }
}
