//! Which vertices a triangle has, and loading sixteen triangles' vertices at once.

use crate::geometry::raster_space::ScreenVertex;
use crate::transpose::columns4;
use crate::wide::{Simd, f32x16, i32x16, u32x4, u32x16};

/// Where the shaded vertices of a run of triangles stand. Corner 0 is the provoking vertex.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Corners<'a> {
    /// Corner k of triangle t is vertex `indices[t][k] - first_vertex`.
    Indexed {
        /// The indices of the run's triangles.
        indices: &'a [[u32; 3]],
        /// The first vertex that was shaded.
        first_vertex: u32,
    },
    /// Corner k of triangle t is vertex 3 t + k.
    Sequential,
}

impl Corners<'_> {
    /// The places of the vertices of triangle `t` of the run.
    #[inline(always)]
    pub(crate) fn of(&self, t: usize) -> [usize; 3] {
        match *self {
            Corners::Indexed { indices, first_vertex } => {
                let [a, b, c] = indices[t];
                [
                    a.wrapping_sub(first_vertex) as usize,
                    b.wrapping_sub(first_vertex) as usize,
                    c.wrapping_sub(first_vertex) as usize,
                ]
            }
            Corners::Sequential => [3 * t, 3 * t + 1, 3 * t + 2],
        }
    }

    /// The places of the vertices of sixteen triangles of the run, corner by corner.
    #[inline(always)]
    pub(crate) fn of_each<S: Simd>(&self, s: S, t: u32x16<S>) -> [u32x16<S>; 3] {
        match *self {
            Corners::Indexed { indices, first_vertex } => {
                let t: [u32; 16] = t.into();
                let mut corners = [[0; 16]; 3];
                let mut k = 0;
                while k < 16 {
                    [corners[0][k], corners[1][k], corners[2][k]] = indices[t[k] as usize];
                    k += 1;
                }
                let [a, b, c] = corners;
                let first = u32x16::splat(s, first_vertex);
                [u32x16::simd_from(s, a) - first, u32x16::simd_from(s, b) - first, u32x16::simd_from(s, c) - first]
            }
            Corners::Sequential => [t * 3, t * 3 + 1, t * 3 + 2],
        }
    }

    /// The places of the vertices of sixteen triangles from `t` on, of which `count` exist; the others repeat the last one.
    #[inline(always)]
    fn sixteen(&self, t: usize, count: usize) -> [u32; 48] {
        let mut places = [0; 48];
        match *self {
            Corners::Indexed { indices, first_vertex } => {
                let row = indices[t..t + count].as_flattened();
                places[..row.len()].copy_from_slice(row);
                if first_vertex != 0 {
                    let mut k = 0;
                    while k < 3 * count {
                        places[k] = places[k].wrapping_sub(first_vertex);
                        k += 1;
                    }
                }
            }
            Corners::Sequential => {
                let mut k = 0;
                while k < 3 * count {
                    places[k] = (3 * t + k) as u32;
                    k += 1;
                }
            }
        }
        places
    }
}

/// Sixteen triangles: the coordinates of their vertices in subpixels, and depths.
#[derive(Clone, Copy)]
pub(crate) struct Sixteen<S: Simd> {
    pub(crate) x: [i32x16<S>; 3],
    pub(crate) y: [i32x16<S>; 3],
    pub(crate) z: [f32x16<S>; 3],
}

impl<S: Simd> Sixteen<S> {
    /// Loads triangles `t` to `t + count` of a run.
    #[inline(always)]
    pub(crate) fn load(s: S, corners: &Corners<'_>, screen: &[ScreenVertex], t: usize, count: usize) -> Self {
        let places = corners.sixteen(t, count);
        let (x0, y0, z0) = column(s, &places, screen, 0);
        let (x1, y1, z1) = column(s, &places, screen, 1);
        let (x2, y2, z2) = column(s, &places, screen, 2);
        Self { x: [x0, x1, x2], y: [y0, y1, y2], z: [z0, z1, z2] }
    }

    /// Up to sixteen triangles from elsewhere.
    #[inline(always)]
    pub(crate) fn from_triangles(s: S, triangles: &[[ScreenVertex; 3]]) -> Self {
        let mut screen = [ScreenVertex::default(); 48];
        let mut places = [0; 48];
        let mut k = 0;
        while k < 3 * triangles.len().min(16) {
            screen[k] = triangles[k / 3][k % 3];
            places[k] = k as u32;
            k += 1;
        }
        let (x0, y0, z0) = column(s, &places, &screen, 0);
        let (x1, y1, z1) = column(s, &places, &screen, 1);
        let (x2, y2, z2) = column(s, &places, &screen, 2);
        Self { x: [x0, x1, x2], y: [y0, y1, y2], z: [z0, z1, z2] }
    }
}

/// Corner `c` of each of sixteen triangles.
#[inline(always)]
fn column<S: Simd>(s: S, places: &[u32; 48], screen: &[ScreenVertex], c: usize) -> (i32x16<S>, i32x16<S>, f32x16<S>) {
    let a = four(s, places, screen, c);
    let b = four(s, places, screen, c + 12);
    let d = four(s, places, screen, c + 24);
    let e = four(s, places, screen, c + 36);
    let [x, y, z, _] = columns4(a, b, d, e);
    (x.bitcast(), y.bitcast(), z.bitcast())
}

#[inline(always)]
fn four<S: Simd>(s: S, places: &[u32; 48], screen: &[ScreenVertex], at: usize) -> u32x16<S> {
    let a: u32x4<S> = u32x4::simd_from(s, screen[places[at] as usize].0);
    let b: u32x4<S> = u32x4::simd_from(s, screen[places[at + 3] as usize].0);
    let c: u32x4<S> = u32x4::simd_from(s, screen[places[at + 6] as usize].0);
    let d: u32x4<S> = u32x4::simd_from(s, screen[places[at + 9] as usize].0);
    a.combine(b).combine(c.combine(d))
}
