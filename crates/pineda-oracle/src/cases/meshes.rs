//! Meshes in raster space: triangles that share edges and do not overlap, so that each pixel inside is covered once.

use super::triangles::{centre, depth_and_w, in_picture, near};
use super::{Case, Point, Random};
use crate::coverage::edge;

pub(super) fn grid(random: &mut Random, case: &mut Case) {
    let (columns, rows) = (random.between(1, 12), random.between(1, 12));
    // Squares of up to 2000 px; or of whole or half pixels, when edges pass through many centres.
    let cell = if random.one_in(3) { 128 * random.between(1, 16) } else { 4 * random.size(17) };
    // A corner moved by less than a quarter of a cell leaves every triangle of the grid its winding.
    let jitter = if random.one_in(2) { 0 } else { random.between(0, (cell - 1) / 4) };
    let [x, y] = if random.one_in(2) { centre(random, case) } else { in_picture(random, case) };
    let (x, y) = (x - cell * random.between(0, columns), y - cell * random.between(0, rows));

    let mut corners = Vec::new();
    for (row, column) in (0..=rows).flat_map(|row| (0..=columns).map(move |column| (row, column))) {
        corners.push(near(random, [x + column * cell, y + row * cell], jitter));
    }
    let at = |column: i64, row: i64| (row * (columns + 1) + column) as u32;
    let mut triangles = Vec::new();
    for (i, j) in (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j))) {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        triangles.extend(if random.one_in(2) { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] });
    }
    let (top, right) = ((0..columns).map(|i| at(i, 0)), (0..rows).map(|j| at(columns, j)));
    let (bottom, left) = ((1..=columns).rev().map(|i| at(i, rows)), (1..=rows).rev().map(|j| at(0, j)));
    let outline = top.chain(right).chain(bottom).chain(left).collect();
    push_mesh(random, case, corners, triangles, outline);
}

pub(super) fn fan(random: &mut Random, case: &mut Case) {
    let hub = if random.one_in(4) { in_picture(random, case) } else { centre(random, case) };
    // With a spoke along each axis no gap between neighbours reaches half a turn.
    let mut spokes = vec![[1, 0], [0, 1], [-1, 0], [0, -1]];
    for _ in 0..random.between(0, 20) {
        let bits = random.between(1, 12);
        spokes.push(direction(random, bits));
    }
    let half_turn = |[x, y]: Point| y < 0 || (y == 0 && x < 0);
    spokes.sort_by(|&a, &b| half_turn(a).cmp(&half_turn(b)).then_with(|| edge([0, 0], a, b).cmp(&0)));
    spokes.dedup_by(|a, b| half_turn(*a) == half_turn(*b) && edge([0, 0], *a, *b) == 0);

    let largest = random.size(22);
    let mut corners = vec![hub];
    for spoke in &spokes {
        let length = random.between(1, 1 + largest / spoke[0].abs().max(spoke[1].abs()));
        corners.push([hub[0] + length * spoke[0], hub[1] + length * spoke[1]]);
    }
    let count = spokes.len() as u32;
    let triangles = (0..count).map(|k| [0, k + 1, (k + 1) % count + 1]).collect();
    push_mesh(random, case, corners, triangles, (1..=count).collect());
}

pub(super) fn strip(random: &mut Random, case: &mut Case) {
    let along = direction(random, 14);
    let across = loop {
        let across = direction(random, 20);
        if edge([0, 0], along, across) != 0 {
            break across;
        }
    };
    let middle = if random.one_in(2) { centre(random, case) } else { in_picture(random, case) };
    let steps = random.between(2, 24);
    let at = |s: i64, t: i64| [0, 1].map(|axis| middle[axis] + (s - steps) * along[axis] + t * across[axis]);

    // From the last corner of either side, go on along one of them.
    let (mut corners, mut triangles) = (vec![at(0, 0), at(0, 1)], Vec::new());
    let (mut sides, mut position) = ([vec![0], vec![1]], [0, 0]);
    for _ in 0..2 * steps {
        let side = random.between(0, 1) as usize;
        position[side] += random.between(1, 2);
        let new = corners.len() as u32;
        corners.push(at(position[side], side as i64));
        triangles.push([sides[0][sides[0].len() - 1], sides[1][sides[1].len() - 1], new]);
        sides[side].push(new);
    }
    let outline = sides[0].iter().chain(sides[1].iter().rev()).copied().collect();
    push_mesh(random, case, corners, triangles, outline);
}

pub(super) fn subdivision(random: &mut Random, case: &mut Case) {
    let (width, height) = (random.size(22), random.size(22));
    let middle = if random.one_in(2) { centre(random, case) } else { in_picture(random, case) };
    let (left, top) = (middle[0] - random.between(0, width), middle[1] - random.between(0, height));
    let (right, bottom) = (left + width, top + height);
    // Everything stays counter-clockwise from here on: that is how it is known not to overlap.
    let mut corners = vec![[left, top], [left, bottom], [right, bottom], [right, top]];
    let (mut triangles, mut outline) = (vec![[0, 1, 2], [0, 2, 3]], vec![0, 1, 2, 3]);
    for _ in 0..random.between(0, 60) {
        let chosen = random.between(0, triangles.len() as i64 - 1) as usize;
        if random.one_in(3) {
            split_inside(random, chosen, &mut corners, &mut triangles);
        } else {
            split_edge(random, chosen, &mut corners, &mut triangles, &mut outline);
        }
    }
    push_mesh(random, case, corners, triangles, outline);
}

/// Three triangles for one, around a new corner; if there is room for it on the grid.
fn split_inside(random: &mut Random, chosen: usize, corners: &mut Vec<Point>, triangles: &mut Vec<[u32; 3]>) {
    let [a, b, c] = triangles[chosen];
    let [i, j, k] = [0; 3].map(|_| random.between(1, 9));
    let at = |k: u32| corners[k as usize];
    let middle = [0, 1].map(|axis| (i * at(a)[axis] + j * at(b)[axis] + k * at(c)[axis]) / (i + j + k));
    let new = corners.len() as u32;
    corners.push(middle);
    let parts = [[a, b, new], [b, c, new], [c, a, new]];
    if are_counter_clockwise(&parts, corners) {
        triangles[chosen] = parts[0];
        triangles.extend(&parts[1..]);
    } else {
        corners.pop();
    }
}

/// Splits an edge at a new corner on it or beside it, and so both triangles there; or one at the outline.
fn split_edge(
    random: &mut Random,
    chosen: usize,
    corners: &mut Vec<Point>,
    triangles: &mut Vec<[u32; 3]>,
    outline: &mut Vec<u32>,
) {
    let turn = random.between(0, 2) as usize;
    let [a, b, c] = super::orders(triangles[chosen])[turn];
    let (from, to) = (corners[a as usize], corners[b as usize]);
    let t = random.between(1, 15);
    let on_edge = [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * t / 16);
    let beside = random.pick(&[0, 0, 1, 64]);
    let new = corners.len() as u32;
    corners.push(near(random, on_edge, beside));

    let neighbour = triangles.iter().enumerate().find_map(|(index, &triangle)| {
        let turned =
            super::orders(triangle).into_iter().take(3).find(|&[first, second, _]| [first, second] == [b, a])?;
        Some((index, turned[2]))
    });
    let parts = [[a, new, c], [new, b, c]];
    let fits = are_counter_clockwise(&parts, corners);
    match neighbour {
        Some((index, d)) => {
            let others = [[b, new, d], [new, a, d]];
            if fits && are_counter_clockwise(&others, corners) {
                (triangles[chosen], triangles[index]) = (parts[0], others[0]);
                triangles.extend([parts[1], others[1]]);
                return;
            }
        }
        // The outline may move inwards only, lest it run into another part of itself.
        None if fits && edge(from, to, corners[new as usize]) >= 0 => {
            triangles[chosen] = parts[0];
            triangles.push(parts[1]);
            let after_a = outline.iter().position(|&k| k == a).map_or(0, |k| k + 1);
            outline.insert(after_a, new);
            return;
        }
        None => {}
    }
    corners.pop();
}

fn are_counter_clockwise(triangles: &[[u32; 3]], corners: &[Point]) -> bool {
    triangles.iter().all(|triangle| {
        let [a, b, c] = triangle.map(|k| corners[k as usize]);
        edge(a, b, c) > 0
    })
}

fn direction(random: &mut Random, bits: i64) -> Point {
    loop {
        let size = random.size(bits);
        let direction = near(random, [0, 0], size);
        if direction != [0, 0] {
            return direction;
        }
    }
}

fn push_mesh(random: &mut Random, case: &mut Case, corners: Vec<Point>, triangles: Vec<[u32; 3]>, outline: Vec<u32>) {
    for corner in corners {
        let (z, w) = depth_and_w(random);
        case.add_snapped(corner, z, w);
    }
    case.triangles = triangles.into_iter().map(|triangle| random.pick(&super::orders(triangle))).collect();
    case.outline = outline;
}
