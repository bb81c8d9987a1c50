//! The traps of the five tutorials: `pineda` gets the very pixels right that each page gets wrong. What the pages draw there stands in
//! `crates/pineda-oracle/tests/tutorial_traps.rs`.
//!
//! Pictures: `.` not covered, `#` covered once, `2` covered twice.

use pineda::*;
use pineda_oracle::{Visible, picture};
use pineda_proof::{Drawing, Probe, ProbeVertex, Renderers};

/// Draws triangles at every setting, in every order of their corners.
fn hits(space: Space, triangles: &[[[f32; 4]; 3]], size: u32) -> Vec<u32> {
    let mut renderers = Renderers::default();
    let mut hits: Option<Vec<u32>> = None;
    for setting in 0..renderers.count() {
        for order in [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]] {
            let vertex = |position| ProbeVertex { position, ..ProbeVertex::default() };
            let vertices: Vec<_> = triangles.iter().flat_map(|t| order.map(|k: usize| vertex(t[k]))).collect();
            let mut pass = Pass::new();
            let state = DrawState { space, ..DrawState::default() };
            pass.draw(&Probe, Mesh { vertices: &vertices, indices: Indices::Sequential }, state);
            let found = Drawing::of(renderers.nth(setting), &pass, size, size).expect("valid").hits;
            assert_eq!(*hits.get_or_insert_with(|| found.clone()), found, "setting {setting}, order {order:?}");
        }
    }
    hits.expect("there is a setting")
}

/// Triangles in pixels, in a square picture.
fn check(triangles: &[[[f32; 2]; 3]], size: u32, expected: &str) {
    let triangles: Vec<_> = triangles.iter().map(|t| t.map(|[x, y]| [x, y, 0.5, 1.0])).collect();
    assert_eq!(picture(&hits(Space::Raster, &triangles, size), size), expected);
}

#[test]
fn tutorial_1_left_edge_is_kept() {
    check(&[[[1.5, 0.5], [1.5, 4.5], [4.5, 2.5]]], 6, "......\n.##...\n.###..\n.##...\n......\n......\n");
}

#[test]
fn tutorial_1_nothing_is_drawn_beyond_a_corner() {
    check(&[[[2.5, 2.5], [4.5, 5.5], [4.5, 0.5]]], 6, "......\n...#..\n..##..\n...#..\n......\n......\n");
}

#[test]
fn tutorial_1_top_and_left_are_for_y_down() {
    let square = [[[0.5, 0.5], [0.5, 3.5], [3.5, 3.5]], [[0.5, 0.5], [3.5, 3.5], [3.5, 0.5]]];
    check(&square, 5, "###..\n###..\n###..\n.....\n.....\n");
}

#[test]
fn tutorials_1_2_and_5_shared_edges_are_hit_once() {
    let square = [[[1.5, 1.5], [1.5, 5.5], [5.5, 5.5]], [[1.5, 1.5], [5.5, 5.5], [5.5, 1.5]]];
    let right = "........\n.####...\n.####...\n.####...\n.####...\n........\n........\n........\n";
    check(&square, 8, right);
    // The same in tutorial 2's space.
    let ndc = square.map(|t| t.map(|[x, y]: [f32; 2]| [x / 4.0 - 1.0, 1.0 - y / 4.0, 0.5, 1.0]));
    assert_eq!(picture(&hits(Space::Clip, &ndc, 8), 8), right);
}

#[test]
fn tutorial_5_triangle_is_no_parallelogram() {
    check(
        &[[[1.5, 1.5], [1.5, 5.5], [5.5, 1.5]]],
        8,
        // Its shader, with its closed edges, has five, four, three, two and one.
        "........\n.####...\n.###....\n.##.....\n.#......\n........\n........\n........\n",
    );
}

#[test]
fn edge_functions_are_integers() {
    // In f32 the edge function of pixel (5, 3) rounds to zero from either side of the shared edge: two hits.
    let [a, b, c, d] = [[-1528, -2039], [4343, 3830], [-698, -1773], [74, 1207]].map(|p| p.map(|x| x as f32 / 256.0));
    let both = [[a, b, c], [b, a, d]].map(|t| t.map(|[x, y]| [x, y, 0.5, 1.0]));
    assert_eq!(hits(Space::Raster, &both, 8)[3 * 8 + 5], 1);
    // And pixel (5, 1) by tutorial 3's inverse.
    let [a, b, c, d] =
        [[25849, -24041], [-23035, 24811], [10449, 7799], [3477, -23299]].map(|p| p.map(|x| x as f32 / 256.0));
    let both = [[a, b, c], [b, a, d]].map(|t| t.map(|[x, y]| [x, y, 0.5, 1.0]));
    assert_eq!(hits(Space::Raster, &both, 8)[8 + 5], 1);
}

#[test]
fn tutorial_3_shared_edges_are_not_torn() {
    let [a, b, c, d] = [[2.0, 3.0], [7.0, 8.0], [7.0, 1.0], [1.0, 5.0]];
    let right = "........\n......#.\n...####.\n..#####.\n.######.\n..#####.\n....###.\n......#.\n";
    check(&[[a, b, c], [b, a, d]], 8, right);
}

/// A road whose third corner is behind the eye: (x, y, w), from tutorial 3.
const ROAD: [[f32; 3]; 3] = [[-0.25, -1.0, 1.0], [0.25, -1.0, 1.0], [0.0, 3.0, -1.0]];

#[test]
fn tutorial_3_promise_is_kept() {
    let road = |near: f32| ROAD.map(|[x, y, w]| [x, y, w - near, w]);
    let seen = "..####..\n..####..\n..####..\n..####..\n...##...\n...##...\n...##...\n...##...\n";
    let cut = "........\n........\n........\n........\n...##...\n...##...\n...##...\n...##...\n";
    for (near, expected) in [(0.25, seen), (0.5, cut)] {
        let exact = Visible::new(&road(near), 8, 8).expect("finite").coverage();
        assert_eq!(picture(&exact, 8), expected);
        assert_eq!(picture(&hits(Space::Clip, &[road(near)], 8), 8), expected);
    }
}

#[test]
fn tutorial_3_a_corner_behind_the_eye_is_not_a_corner_of_the_picture() {
    // Its macro sets w to 1: the road then narrows towards a corner that is not there.
    let wrong = ROAD.map(|[x, y, _]| [x, y, 0.5, 1.0]);
    let narrow = "...##...\n...##...\n...##...\n...##...\n...##...\n...##...\n...##...\n...##...\n";
    assert_eq!(picture(&hits(Space::Clip, &[wrong], 8), 8), narrow);
}
