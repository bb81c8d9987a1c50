//! Single triangles in raster space, on the subpixel grid (and, in one family, between its points).

use super::{Case, GUARD_BAND, Point, Random};

pub(super) fn any_size(random: &mut Random, case: &mut Case) {
    let (middle, size) = (in_picture(random, case), random.size(24));
    let corners = [0; 3].map(|_| near(random, middle, size));
    push(random, case, corners);
}

pub(super) fn beyond(random: &mut Random, case: &mut Case) {
    let middle = in_picture(random, case);
    let [a, mut b, c] = [0; 3].map(|_| {
        let size = random.size(23);
        let mut point = near(random, middle, size);
        if random.one_in(3) {
            point[random.between(0, 1) as usize] = random.pick(&[-GUARD_BAND, GUARD_BAND]);
        }
        point
    });
    if !random.one_in(4) {
        // One edge passes right through the picture; otherwise the triangle would seldom be seen.
        b = near(random, [0, 1].map(|axis| 2 * middle[axis] - a[axis]), 256);
    }
    push(random, case, [a, b, c]);
}

pub(super) fn sliver(random: &mut Random, case: &mut Case) {
    // Mostly right through a pixel's centre, which the fill rule then gives to the sliver or not; it hits few others.
    let middle = if random.one_in(4) { in_picture(random, case) } else { centre(random, case) };
    let size = random.size(16);
    let direction = near(random, [0, 0], size);
    let mut along = |from: i64, to: i64| {
        let t = random.between(from, to);
        [0, 1].map(|axis| middle[axis] + direction[axis] * t)
    };
    let (start, end, between) = (along(-64, 0), along(0, 64), along(-64, 64));
    let beside = near(random, between, 1);
    push(random, case, [start, end, beside]);
}

pub(super) fn corner_on_centre(random: &mut Random, case: &mut Case) {
    let others = random.between(0, 2) as usize;
    let mut corners = [0; 3].map(|_| centre(random, case));
    corners[..others].fill_with(|| in_picture(random, case));
    push(random, case, corners);
}

pub(super) fn edge_through_centre(random: &mut Random, case: &mut Case) {
    let centre = centre(random, case);
    let bits = random.between(1, 16);
    let size = random.size(bits);
    let step = near(random, [0, 0], size);
    let most_steps = ((1 << 22) / size).min(512);
    let [before, after] = [-1, 1].map(|sign| {
        let t = sign * random.between(1, most_steps);
        [centre[0] + t * step[0], centre[1] + t * step[1]]
    });
    let apex = if random.one_in(2) { in_picture(random, case) } else { near(random, centre, 4 * size) };
    push(random, case, [before, after, apex]);
}

pub(super) fn axis_aligned(random: &mut Random, case: &mut Case) {
    let [[x0, y0], [x1, y1], apex] =
        [0; 3].map(|_| if random.one_in(3) { in_picture(random, case) } else { centre(random, case) });
    let corners = match random.between(0, 2) {
        0 => [[x0, y0], [x1, y0], apex],
        1 => [[x0, y0], [x0, y1], apex],
        _ => [[x0, y0], [x1, y0], [x1, y1]],
    };
    let turned = random.pick(&super::orders([0, 1, 2])).map(|k| corners[k as usize]);
    push(random, case, turned);
}

pub(super) fn tiny(random: &mut Random, case: &mut Case) {
    let (middle, size) = (in_picture(random, case), random.between(128, 640));
    let corners = [0; 3].map(|_| near(random, middle, size));
    push(random, case, corners);
}

pub(super) fn degenerate(random: &mut Random, case: &mut Case) {
    let (on_centre, size) = (random.one_in(2), random.size(14));
    let start = if on_centre { centre(random, case) } else { in_picture(random, case) };
    let step = near(random, [0, 0], size);
    let corners = [0; 3].map(|_| {
        let t = random.between(-3, 3);
        [start[0] + t * step[0], start[1] + t * step[1]]
    });
    push(random, case, corners);
}

pub(super) fn unsnapped(random: &mut Random, case: &mut Case) {
    let corners = [0; 3].map(|_| {
        let on_tie = random.one_in(2);
        let [x, y] = in_picture(random, case).map(|x| {
            let between = if on_tie { 0.5 } else { random.unit() };
            (x as f32 + between) / 256.0
        });
        let (z, w) = depth_and_w(random);
        [x, y, z, w]
    });
    case.add_triangle(corners);
}

pub(super) fn soup(random: &mut Random, case: &mut Case) {
    let makers =
        [any_size, beyond, sliver, corner_on_centre, edge_through_centre, axis_aligned, tiny, degenerate, unsnapped];
    for _ in 0..random.size(6).min(48) {
        random.pick(&makers)(random, case);
    }
}

pub(super) fn non_finite(random: &mut Random, case: &mut Case) {
    for _ in 0..random.between(2, 8) {
        any_size(random, case);
        spoil(random, case);
    }
}

/// Puts a NaN or an infinity into one of the case's last three vertices, two times in three.
pub(super) fn spoil(random: &mut Random, case: &mut Case) {
    if !random.one_in(3) {
        let vertex = case.vertices.len() - random.between(1, 3) as usize;
        let component = random.between(0, 3) as usize;
        case.vertices[vertex][component] = random.pick(&[f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY]);
    }
}

/// A depth, and a w that is mostly 1 for all corners or of any magnitude.
pub(super) fn depth_and_w(random: &mut Random) -> (f32, f32) {
    let depth = if random.one_in(4) { random.pick(&[0.0, 0.5, 1.0]) } else { random.unit() };
    (depth, if random.one_in(2) { 1.0 } else { random.magnitude(-6, 6) })
}

/// A subpixel in the picture or a little outside.
pub(super) fn in_picture(random: &mut Random, case: &Case) -> Point {
    [case.width, case.height].map(|size| random.between(-512, i64::from(size) * 256 + 512))
}

/// The centre of a pixel in the picture or a little outside.
pub(super) fn centre(random: &mut Random, case: &Case) -> Point {
    [case.width, case.height].map(|size| random.between(-2, i64::from(size) + 1) * 256 + 128)
}

/// A point at most `size` away in x and in y, still within the guard band.
pub(super) fn near(random: &mut Random, point: Point, size: i64) -> Point {
    point.map(|x| (x + random.between(-size, size)).clamp(-GUARD_BAND, GUARD_BAND))
}

fn push(random: &mut Random, case: &mut Case, corners: [Point; 3]) {
    let triangle = corners.map(|corner| {
        let (z, w) = depth_and_w(random);
        case.add_snapped(corner.map(|x| x.clamp(-GUARD_BAND, GUARD_BAND)), z, w)
    });
    case.triangles.push(triangle);
}
