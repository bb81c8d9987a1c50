//! Triangles in clip space, (x, y, z, w): in front of the eye, behind it and through its planes.

use super::triangles::spoil;
use super::{Case, Random};

pub(super) fn in_front(random: &mut Random, case: &mut Case) {
    let spread = random.magnitude(-3, 3);
    let flat = random.one_in(4); // w = 1: normalised device coordinates
    case.add_triangle([0; 3].map(|_| {
        let w = if flat { 1.0 } else { random.magnitude(-6, 6) };
        let [x, y] = [0; 2].map(|_| random.real(-1.5, 1.5).clamp(-spread, spread));
        [x * w, y * w, random.unit() * w, w]
    }));
}

pub(super) fn beyond_guard_band(random: &mut Random, case: &mut Case) {
    case.add_triangle([0; 3].map(|_| {
        let w = random.magnitude(-6, 6);
        let far = if random.one_in(4) { 1.0 } else { random.magnitude(4, 30) };
        let [x, y] = [0; 2].map(|_| random.real(-1.0, 1.0) * far);
        [x * w, y * w, random.unit() * w, w]
    }));
}

pub(super) fn near_plane(random: &mut Random, case: &mut Case) {
    let lens = Lens::new(random);
    let mut depths = [0; 3].map(|_| lens.near * random.magnitude(0, 6));
    let before = random.between(1, 2) as usize;
    // Before the near plane: sometimes still in front of the eye, mostly behind it.
    depths[..before].fill_with(|| if random.one_in(4) { random.unit() * lens.near } else { -random.magnitude(-4, 4) });
    add_turned(random, case, &lens, depths);
}

pub(super) fn far_plane(random: &mut Random, case: &mut Case) {
    let lens = Lens::new(random);
    let mut depths = [0; 3].map(|_| random.real(lens.near, lens.far));
    let beyond = random.between(1, 2) as usize;
    depths[..beyond].fill_with(|| lens.far * random.magnitude(0, 4));
    add_turned(random, case, &lens, depths);
}

pub(super) fn homogeneous(random: &mut Random, case: &mut Case) {
    let lowest = random.pick(&[-1, -4, -4, -40, -126]);
    let highest = (-lowest).max(3);
    case.add_triangle([0; 3].map(|_| {
        let [x, y, z, w] = [0; 4].map(|_| random.sign() * random.magnitude(lowest, highest));
        // Three times in four the corner is visible, or would be if the picture were larger.
        if random.one_in(4) { [x, y, z, w] } else { [x, y, w.abs() * random.unit(), w.abs()] }
    }));
}

pub(super) fn on_planes(random: &mut Random, case: &mut Case) {
    case.add_triangle([0; 3].map(|_| {
        let [x, y, w] = [0; 3].map(|_| random.pick(&[-2.0, -1.0, -0.5, 0.0, 0.0, 0.5, 1.0, 1.0, 2.0, 4.0]));
        [x, y, random.pick(&[0.0, w, w / 2.0, w * 2.0, -w]), w]
    }));
}

/// Corners O + s A + t B of a grid on a plane through O. All numbers are small multiples of small powers of two, so that
/// the sums are exact and the corners exactly on one plane.
pub(super) fn clipped_grid(random: &mut Random, case: &mut Case) {
    let mut vector = |w_low: i64, w_high: i64| -> [f32; 3] {
        let [x, y] = [0; 2].map(|_| random.between(-64, 64));
        [x, y, random.between(w_low, w_high)].map(|x| x as f32 / 16.0)
    };
    let (origin, along_s, along_t) = (vector(-32, 64), vector(-24, 24), vector(-24, 24));
    let near = random.pick(&[1.0, 0.5, 0.25]);
    let slope = random.pick(&[1.0, 1.0, 1.125]); // z = slope * w - near: no far plane, or one at w = 8 * near
    let (columns, rows) = (random.between(1, 5), random.between(1, 5));
    let jittered = random.one_in(2);
    let at = |column: i64, row: i64| (row * (columns + 1) + column) as u32;
    for (row, column) in (0..=rows).flat_map(|row| (0..=columns).map(move |column| (row, column))) {
        let mut moved = |k: i64, last: i64| {
            let jitter = if jittered && k > 0 && k < last { random.between(-1, 1) } else { 0 };
            (8 * k + jitter) as f32 / 8.0 // by less than a quarter of a cell, and never the outline
        };
        let (s, t) = (moved(column, columns), moved(row, rows));
        let [x, y, w] = [0, 1, 2].map(|axis| origin[axis] + s * along_s[axis] + t * along_t[axis]);
        case.vertices.push([x, y, slope * w - near, w]);
    }
    for (i, j) in (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j))) {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        let halves = if random.one_in(2) { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
        case.triangles.extend(halves.map(|triangle| random.pick(&super::orders(triangle))));
    }
    case.outline = vec![at(0, 0), at(columns, 0), at(columns, rows), at(0, rows)];
}

pub(super) fn non_finite(random: &mut Random, case: &mut Case) {
    for _ in 0..random.between(2, 8) {
        random.pick(&[in_front, near_plane, homogeneous])(random, case);
        spoil(random, case);
    }
}

/// A perspective projection: z = slope * w - offset, so that z = 0 at the near and z = w at the far plane.
struct Lens {
    near: f32,
    far: f32,
}

impl Lens {
    fn new(random: &mut Random) -> Self {
        let near = random.magnitude(-6, 1);
        Self { near, far: near * random.magnitude(1, 12) }
    }

    /// A vertex at a depth, mostly near the field of view that the eye has there.
    fn vertex(&self, random: &mut Random, depth: f32) -> [f32; 4] {
        let reach = if random.one_in(2) { depth.abs() } else { self.near.max(depth.abs()) * 4.0 };
        let slope = self.far / (self.far - self.near);
        [random.real(-reach, reach), random.real(-reach, reach), slope * depth - slope * self.near, depth]
    }
}

fn add_turned(random: &mut Random, case: &mut Case, lens: &Lens, depths: [f32; 3]) {
    let corners = depths.map(|depth| lens.vertex(random, depth));
    let turned = random.pick(&super::orders([0, 1, 2])).map(|k| corners[k as usize]);
    case.add_triangle(turned);
}
