//! Which vertices a triangle has, and loading sixteen triangles' vertices at once.

use crate::geometry::raster_space::ScreenVertex;
use crate::transpose::{columns4, each_of_sixteen};
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
                    // A minimum instead of a comparison and a branch: what is loaded first need not wait until the last index is judged.
                    [corners[0][k], corners[1][k], corners[2][k]] = indices[(t[k] as usize).min(indices.len() - 1)];
                    k += 1;
                }
                let [a, b, c] = corners;
                let first = u32x16::splat(s, first_vertex);
                [u32x16::simd_from(s, a) - first, u32x16::simd_from(s, b) - first, u32x16::simd_from(s, c) - first]
            }
            Corners::Sequential => [t * 3, t * 3 + 1, t * 3 + 2],
        }
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
    /// Loads triangles `t` to `t + count` of a run, up to sixteen.
    #[inline(always)]
    pub(crate) fn load(s: S, corners: &Corners<'_>, screen: &[ScreenVertex], t: usize, count: usize) -> Self {
        let mut own = [[0; 3]; 16];
        match *corners {
            Corners::Indexed { indices, first_vertex } => {
                if count == 16
                    && let Some(indices) = indices[t..].first_chunk()
                {
                    return Self::of(s, indices, first_vertex, screen);
                }
                own[..count].copy_from_slice(&indices[t..t + count]);
                own[count..].fill([first_vertex; 3]);
                Self::of(s, &own, first_vertex, screen)
            }
            Corners::Sequential => {
                let mut k = 0;
                while k < count {
                    own[k] = [3 * (t + k) as u32, 3 * (t + k) as u32 + 1, 3 * (t + k) as u32 + 2];
                    k += 1;
                }
                Self::of(s, &own, 0, screen)
            }
        }
    }

    /// Up to sixteen triangles from elsewhere.
    #[inline(always)]
    pub(crate) fn from_triangles(s: S, triangles: &[[ScreenVertex; 3]]) -> Self {
        Self::load(s, &Corners::Sequential, triangles.as_flattened(), 0, triangles.len().min(16))
    }

    #[inline(always)]
    fn of(s: S, indices: &[[u32; 3]; 16], first_vertex: u32, screen: &[ScreenVertex]) -> Self {
        let mut columns = [[[0; 16]; 3]; 3];
        let [a, b, c] = &mut columns;
        load_column::<S, 0>(s, indices, first_vertex, screen, a);
        load_column::<S, 1>(s, indices, first_vertex, screen, b);
        load_column::<S, 2>(s, indices, first_vertex, screen, c);
        let word = |corner: usize, word: usize| u32x16::from_slice(s, &columns[corner][word]);
        Self {
            x: [word(0, 0).bitcast(), word(1, 0).bitcast(), word(2, 0).bitcast()],
            y: [word(0, 1).bitcast(), word(1, 1).bitcast(), word(2, 1).bitcast()],
            z: [word(0, 2).bitcast(), word(1, 2).bitcast(), word(2, 2).bitcast()],
        }
    }
}

/// Corner `C` of each of sixteen triangles: x, y and z, lane by lane.
///
/// A function of its own, so that no more indices are at hand at once than there are registers for: see `load_rows` in `shading/by_lane.rs`.
#[inline(never)]
fn load_column<S: Simd, const C: usize>(
    s: S,
    indices: &[[u32; 3]; 16],
    first_vertex: u32,
    screen: &[ScreenVertex],
    out: &mut [[u32; 16]; 3],
) {
    s.apart(
        #[inline(always)]
        || {
            let vertex = |k: usize| (indices[k][C].wrapping_sub(first_vertex) as usize).min(screen.len() - 1);
            let [x, y, z, _] = columns4(each_of_sixteen!(|k| u32x4::simd_from(s, screen[vertex(k)].0)));
            *out = [x.into(), y.into(), z.into()];
        },
    );
}
