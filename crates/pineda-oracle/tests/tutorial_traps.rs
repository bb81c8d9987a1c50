//! The traps in the five tutorials of `../shared/seeds`: each test as its page has it, in f32 and with its own mistakes, and
//! the pixels where it goes wrong. (Tutorial 4 is tutorial 1 with notes in Chinese and without the code.)
//!
//! Pictures: `.` not covered, `#` covered once, `2` covered twice.

use pineda_oracle::{
    Point, Triangle, Visible, Winding, covered_exactly_once, covers, hits, picture, polygon_coverage, winding,
};

type Vec2 = [f32; 2];
type Vec3 = [f32; 3];

/// Three corners of two triangles that share the diagonal of a square from (0.5, 0.5) to (3.5, 3.5): all its edges pass
/// through pixel centres. Counter-clockwise in the picture, so that the tutorials' edge functions are positive inside.
const SQUARE: [[Vec2; 3]; 2] = [[[0.5, 0.5], [0.5, 3.5], [3.5, 3.5]], [[0.5, 0.5], [3.5, 3.5], [3.5, 0.5]]];

/// What the rules say of the square: the top and the left edge keep their pixels, each pixel belongs to one triangle.
const SQUARE_COVERED: &str = "###..\n###..\n###..\n.....\n.....\n";

fn snapped(triangle: [Vec2; 3]) -> Triangle {
    triangle.map(|corner| corner.map(|x| (x * 256.0) as i64)) // exact for every number in this file
}

fn expected(triangles: &[[Vec2; 3]], size: u32) -> Vec<u32> {
    let triangles: Vec<_> = triangles.iter().map(|&triangle| snapped(triangle)).collect();
    hits(&triangles, size, size)
}

/// Draws triangles with somebody else's test of a pixel's centre.
fn drawn<T: Copy>(triangles: &[T], size: u32, is_inside: impl Fn(T, Vec2) -> bool) -> Vec<u32> {
    let centres = (0..size).flat_map(|j| (0..size).map(move |i| [i as f32 + 0.5, j as f32 + 0.5]));
    centres.map(|p| triangles.iter().filter(|&&triangle| is_inside(triangle, p)).count() as u32).collect()
}

/// Tutorial 1, "The Edge Function".
fn edge_function(a: Vec2, b: Vec2, c: Vec2) -> f32 {
    (c[0] - a[0]) * (b[1] - a[1]) - (c[1] - a[1]) * (b[0] - a[0])
}

fn minus(a: Vec2, b: Vec2) -> Vec2 {
    [a[0] - b[0], a[1] - b[1]]
}

/// Tutorial 1, "Rasterization Rules", letter by letter.
fn tutorial_1_top_left([v0, v1, v2]: [Vec2; 3], p: Vec2) -> bool {
    let (w0, w1, w2) = (edge_function(v1, v2, p), edge_function(v2, v0, p), edge_function(v0, v1, p));
    let (edge0, edge1, edge2) = (minus(v2, v1), minus(v0, v2), minus(v1, v0));
    let mut overlaps = true;
    overlaps &= if w0 == 0.0 { (edge0[1] == 0.0 && edge0[0] > 0.0) || edge0[1] > 0.0 } else { w0 > 0.0 };
    overlaps &= if w1 == 0.0 { (edge1[1] == 0.0 && edge1[0] > 0.0) || edge1[1] > 0.0 } else { w1 > 0.0 };
    overlaps &= if w1 == 0.0 { (edge2[1] == 0.0 && edge2[0] > 0.0) || edge2[1] > 0.0 } else { w2 > 0.0 };
    overlaps
}

/// The same with `w2 == 0` in its third line, and a choice of what makes an edge a top or a left one.
fn tutorial_1_repaired([v0, v1, v2]: [Vec2; 3], p: Vec2, is_top_left: fn(Vec2) -> bool) -> bool {
    let owns = |a, b| match edge_function(a, b, p) {
        0.0 => is_top_left(minus(b, a)),
        w => w > 0.0,
    };
    owns(v1, v2) && owns(v2, v0) && owns(v0, v1)
}

#[test]
fn tutorial_1_third_line_loses_a_left_edge() {
    // v0 v1 is a vertical left edge through the centres of column 1; v2 is to the right of it.
    let triangle = [[1.5, 0.5], [1.5, 4.5], [4.5, 2.5]];
    assert_eq!(picture(&expected(&[triangle], 6), 6), "......\n.##...\n.###..\n.##...\n......\n......\n");
    let found = drawn(&[triangle], 6, tutorial_1_top_left);
    assert_eq!(picture(&found, 6), "......\n..#...\n..##..\n..#...\n......\n......\n");
}

#[test]
fn tutorial_1_third_line_draws_outside_of_the_triangle() {
    // Where w1 == 0 nobody asks for the sign of w2: the line v2 v0 goes on beyond v0 for ever.
    let triangle = [[2.5, 2.5], [4.5, 5.5], [4.5, 0.5]];
    assert_eq!(picture(&expected(&[triangle], 6), 6), "......\n...#..\n..##..\n...#..\n......\n......\n");
    let found = drawn(&[triangle], 6, tutorial_1_top_left);
    assert_eq!(picture(&found, 6), "......\n...#..\n..##..\n.#.#..\n#.....\n......\n");
}

#[test]
fn tutorial_1_top_and_left_are_for_y_up() {
    assert_eq!(picture(&expected(&SQUARE, 5), 5), SQUARE_COVERED);
    // "y-coordinates equal to 0 and x-coordinates positive" is a top edge for y up; with y down it is a bottom edge.
    let as_written = |edge: Vec2| (edge[1] == 0.0 && edge[0] > 0.0) || edge[1] > 0.0;
    let found = drawn(&SQUARE, 5, |triangle, p| tutorial_1_repaired(triangle, p, as_written));
    assert_eq!(picture(&found, 5), ".....\n###..\n###..\n###..\n.....\n");
    // These corners go counter-clockwise. "If you are using a counter-clockwise order, a top edge is horizontal with x
    // negative", which is right for y down, "and a left edge is an edge whose y is negative", which is then a right edge.
    let counter_clockwise = |edge: Vec2| (edge[1] == 0.0 && edge[0] < 0.0) || edge[1] < 0.0;
    let found = drawn(&SQUARE, 5, |triangle, p| tutorial_1_repaired(triangle, p, counter_clockwise));
    assert_eq!(picture(&found, 5), ".###.\n.###.\n.###.\n.....\n.....\n");
    // For y down and positive areas it takes one half of either.
    let y_down = |edge: Vec2| (edge[1] == 0.0 && edge[0] < 0.0) || edge[1] > 0.0;
    let found = drawn(&SQUARE, 5, |triangle, p| tutorial_1_repaired(triangle, p, y_down));
    assert_eq!(picture(&found, 5), SQUARE_COVERED);
}

#[test]
fn tutorial_1_knows_one_winding() {
    let [[a, b, c], _] = SQUARE;
    assert!(drawn(&[[a, c, b]], 5, tutorial_1_program).iter().all(|&hits| hits == 0));
    assert_eq!(expected(&[[a, c, b]], 5), expected(&[[a, b, c]], 5));
}

/// The program at the end of tutorial 1.
fn tutorial_1_program([v0, v1, v2]: [Vec2; 3], p: Vec2) -> bool {
    edge_function(v1, v2, p) >= 0.0 && edge_function(v2, v0, p) >= 0.0 && edge_function(v0, v1, p) >= 0.0
}

/// Tutorial 2, with its normalised device coordinates: [-1, 1] x [-1, 1], y up.
fn tutorial_2([p0, p1, p2]: [Vec2; 3], [x, y]: Vec2) -> bool {
    let f = |a: Vec2, b: Vec2, x: f32, y: f32| (a[1] - b[1]) * x + (b[0] - a[0]) * y + a[0] * b[1] - b[0] * a[1];
    let alpha = f(p1, p2, x, y) / f(p1, p2, p0[0], p0[1]);
    let beta = f(p2, p0, x, y) / f(p2, p0, p1[0], p1[1]);
    let gamma = f(p0, p1, x, y) / f(p0, p1, p2[0], p2[1]);
    [alpha, beta, gamma].iter().all(|weight| (0.0..=1.0).contains(weight))
}

/// Tutorial 5's fragment shader; uv from 0 to 1, y down after its `1.0 - uv.y`.
fn tutorial_5([a, b, c]: [Vec2; 3], uv: Vec2) -> bool {
    let (u, v) = tutorial_5_coordinates([a, b, c], uv);
    u >= 0.0 && v >= 0.0 && u + v <= 1.0
}

fn tutorial_5_coordinates([a, b, c]: [Vec2; 3], uv: Vec2) -> (f32, f32) {
    let dot = |a: Vec2, b: Vec2| a[0] * b[0] + a[1] * b[1];
    let (v0, v1, v2) = (minus(c, a), minus(b, a), minus(uv, a));
    let (dot00, dot01, dot02, dot11, dot12) = (dot(v0, v0), dot(v0, v1), dot(v0, v2), dot(v1, v1), dot(v1, v2));
    let det = 1.0 / (dot00 * dot11 - dot01 * dot01);
    ((dot11 * dot02 - dot01 * dot12) * det, (dot00 * dot12 - dot01 * dot02) * det)
}

#[test]
fn closed_tests_hit_shared_edges_twice() {
    // A square of 4 x 4 px, cut along its diagonal, in a picture of 8 x 8: edges through centres, powers of two throughout,
    // so that no rounding is to blame.
    let square = [[[1.5, 1.5], [1.5, 5.5], [5.5, 5.5]], [[1.5, 1.5], [5.5, 5.5], [5.5, 1.5]]];
    let right = "........\n.####...\n.####...\n.####...\n.####...\n........\n........\n........\n";
    let closed = "........\n.2####..\n.#2###..\n.##2##..\n.###2#..\n.####2..\n........\n........\n";
    assert_eq!(picture(&expected(&square, 8), 8), right);
    let to_ndc = |p: Vec2| [p[0] / 4.0 - 1.0, 1.0 - p[1] / 4.0];
    let to_uv = |p: Vec2| p.map(|x| x / 8.0);
    assert_eq!(picture(&drawn(&square, 8, tutorial_1_program), 8), closed);
    assert_eq!(picture(&drawn(&square, 8, |triangle, p| tutorial_2(triangle.map(to_ndc), to_ndc(p))), 8), closed);
    assert_eq!(picture(&drawn(&square, 8, |triangle, p| tutorial_5(triangle.map(to_uv), to_uv(p))), 8), closed);
}

#[test]
fn tutorial_5_prose_draws_a_parallelogram() {
    // "If and only if 0 <= lambda_1, lambda_2 <= 1": its shader knows better than its text, lambda_3 has a sign, too.
    let triangle = [[0.1875, 0.1875], [0.1875, 0.6875], [0.6875, 0.1875]];
    let by_prose = |triangle, p| {
        let (u, v) = tutorial_5_coordinates(triangle, p);
        (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v)
    };
    let to_uv = |p: Vec2| p.map(|x| x / 8.0);
    let shader = drawn(&[triangle], 8, |triangle, p| tutorial_5(triangle, to_uv(p)));
    assert_eq!(picture(&shader, 8), "........\n.#####..\n.####...\n.###....\n.##.....\n.#......\n........\n........\n");
    let prose = drawn(&[triangle], 8, |triangle, p| by_prose(triangle, to_uv(p)));
    assert_eq!(picture(&prose, 8), "........\n.#####..\n.#####..\n.#####..\n.#####..\n.#####..\n........\n........\n");
}

#[test]
fn edge_functions_in_floats_hit_twice_off_the_edge() {
    // No centre is on the shared edge a b, so that a fill rule would not help: f32 rounds the edge function of pixel (5, 3)
    // to zero from either side, and that within 20 px of the origin.
    let [a, b, c, d] = [[-1528, -2039], [4343, 3830], [-698, -1773], [74, 1207]];
    assert_ne!(winding([a, b, centre(5, 3)]), Winding::Degenerate);
    let float = |triangle: Triangle| triangle.map(|corner| corner.map(|x| x as f32 / 256.0));
    let both = [[a, b, c], [b, a, d]];
    let drawn = drawn(&both, 8, |triangle, p| tutorial_1_program(float(triangle), p));
    let expected = hits(&both, 8, 8);
    let wrong: Vec<_> = (0..64).filter(|&k| drawn[k] != expected[k]).collect();
    assert_eq!(wrong, [3 * 8 + 5]);
    assert_eq!((drawn[29], expected[29]), (2, 1));
}

fn centre(i: i64, j: i64) -> Point {
    [256 * i + 128, 256 * j + 128]
}

/// Tutorial 3: the vertex matrix, glm's inverse of it, and three dot products with (x, y, 1).
fn tutorial_3([v0, v1, v2]: [Vec3; 3], p: Vec2) -> bool {
    let m = [[v0[0], v1[0], v2[0]], [v0[1], v1[1], v2[1]], [v0[2], v1[2], v2[2]]];
    let e = glm_inverse(m); // column k holds edge function k
    e.iter().all(|e| e[0] * p[0] + e[1] * p[1] + e[2] >= 0.0)
}

/// glm 0.9's `inverse(mat3)`, operation by operation; `m[column][row]`.
fn glm_inverse(m: [Vec3; 3]) -> [Vec3; 3] {
    let one_over_determinant = 1.0
        / (m[0][0] * (m[1][1] * m[2][2] - m[2][1] * m[1][2]) - m[1][0] * (m[0][1] * m[2][2] - m[2][1] * m[0][2])
            + m[2][0] * (m[0][1] * m[1][2] - m[1][1] * m[0][2]));
    let columns = [
        [
            m[1][1] * m[2][2] - m[2][1] * m[1][2],
            -(m[0][1] * m[2][2] - m[2][1] * m[0][2]),
            m[0][1] * m[1][2] - m[1][1] * m[0][2],
        ],
        [
            -(m[1][0] * m[2][2] - m[2][0] * m[1][2]),
            m[0][0] * m[2][2] - m[2][0] * m[0][2],
            -(m[0][0] * m[1][2] - m[1][0] * m[0][2]),
        ],
        [
            m[1][0] * m[2][1] - m[2][0] * m[1][1],
            -(m[0][0] * m[2][1] - m[2][0] * m[0][1]),
            m[0][0] * m[1][1] - m[1][0] * m[0][1],
        ],
    ];
    columns.map(|column| column.map(|x| x * one_over_determinant))
}

#[test]
fn tutorial_3_inverse_tears_shared_edges() {
    // A quadrilateral on whole pixels, its diagonal from (2, 3) to (7, 8) through five centres. The two inverses disagree
    // about them: three are drawn twice and two by nobody, and no choice of > or >= could mend that.
    let [a, b, c, d] = [[2.0, 3.0], [7.0, 8.0], [7.0, 1.0], [1.0, 5.0]];
    let both = [[a, b, c], [b, a, d]];
    let right = "........\n......#.\n...####.\n..#####.\n.######.\n..#####.\n....###.\n......#.\n";
    let torn = "........\n......#.\n...####.\n..2####.\n.##.###.\n..##2##.\n....#2#.\n........\n";
    assert_eq!(picture(&expected(&both, 8), 8), right);
    let found = drawn(&both, 8, |triangle, p| tutorial_3(triangle.map(|[x, y]| [x, y, 1.0]), p));
    assert_eq!(picture(&found, 8), torn);
}

#[test]
fn tutorial_3_inverse_hits_twice_off_the_edge() {
    // Farther away it goes wrong beside the edge, too, where no fill rule is asked: within 128 px of the origin here.
    let [a, b, c, d] = [[25849, -24041], [-23035, 24811], [10449, 7799], [3477, -23299]];
    assert_ne!(winding([a, b, centre(5, 1)]), Winding::Degenerate);
    let float = |triangle: Triangle| triangle.map(|[x, y]| [x as f32 / 256.0, y as f32 / 256.0, 1.0]);
    let found = drawn(&[[a, b, c], [b, a, d]], 8, |triangle, p| tutorial_3(float(triangle), p));
    assert_eq!(found[8 + 5], 2);
    assert_eq!([[a, b, c], [b, a, d]].map(|triangle| covers(triangle, [5, 1])), [false, true]);
}

/// The road of `visible.rs`: its third corner is behind the eye. Corners as tutorial 3 has them, (x, y, w).
const ROAD: [Vec3; 3] = [[-0.25, -1.0, 1.0], [0.25, -1.0, 1.0], [0.0, 3.0, -1.0]];

/// Tutorial 3 counts rows from the bottom.
fn upside_down(picture: &str) -> String {
    picture.lines().rev().flat_map(|line| [line, "\n"]).collect()
}

#[test]
fn tutorial_3_promise_is_kept_without_clipping() {
    // In homogeneous coordinates w <= 0 needs no clipping, if the viewport transform lets w take part ...
    let to_raster = |[x, y, w]: Vec3| [8.0 * (x + w) / 2.0, 8.0 * (y + w) / 2.0, w];
    let found = drawn(&[ROAD.map(to_raster)], 8, tutorial_3);
    let seen = "..####..\n..####..\n..####..\n..####..\n...##...\n...##...\n...##...\n...##...\n";
    assert_eq!(upside_down(&picture(&found, 8)), seen);
    // ... and the exact answer is the same, as long as all that is in the picture is beyond the near plane (z = w - 1/4).
    let road = ROAD.map(|[x, y, w]| [x, y, w - 0.25, w]);
    let visible = Visible::new(&road, 8, 8).expect("finite");
    assert_eq!(picture(&visible.coverage(), 8), seen);
    // What the tutorial leaves to its second part is a near plane (z = w - 1/2).
    let road = ROAD.map(|[x, y, w]| [x, y, w - 0.5, w]);
    let visible = Visible::new(&road, 8, 8).expect("finite");
    let cut = "........\n........\n........\n........\n...##...\n...##...\n...##...\n...##...\n";
    assert_eq!(picture(&visible.coverage(), 8), cut);
}

#[test]
fn tutorial_3_macro_forgets_w() {
    // TO_RASTER as the page has it sets the third coordinate to one: the road narrows towards a corner that is not there.
    let to_raster = |v: Vec3| [8.0 * (v[0] + 1.0) / 2.0, 8.0 * (v[1] + 1.0) / 2.0, 1.0];
    let found = drawn(&[ROAD.map(to_raster)], 8, tutorial_3);
    let wrong = "...##...\n...##...\n...##...\n...##...\n...##...\n...##...\n...##...\n...##...\n";
    assert_eq!(upside_down(&picture(&found, 8)), wrong);
}

#[test]
fn every_mesh_of_this_file_is_right_by_the_rules() {
    let quad = [[2.0, 3.0], [7.0, 8.0], [7.0, 1.0], [1.0, 5.0]];
    for [a, b, c, d] in [quad, [[0.5, 0.5], [3.5, 3.5], [3.5, 0.5], [0.5, 3.5]]] {
        let counts = expected(&[[a, b, c], [b, a, d]], 8);
        let outline = [a, c, b, d].map(|corner| corner.map(|x| (x * 256.0) as i64));
        assert_eq!(covered_exactly_once(&counts, &polygon_coverage(&outline, 8, 8), 8), Ok(()));
    }
}
