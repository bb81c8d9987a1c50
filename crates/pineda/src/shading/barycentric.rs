//! Barycentric coordinates, and varyings from them.
//!
//! A varying is `(f0 + b1 (f1 - f0)) + b2 (f2 - f0)`, in canonical order of the vertices. What is the same at all three vertices stays
//! exactly that.

use super::Interpolation;
use super::packet::{PacketRows, VaryingLayout};
use super::weights::Weights;
use crate::wide::{Simd, f32x16};

/// How the three vertices' values of one varying enter: the first, and by how much the others exceed it.
#[derive(Clone, Copy)]
pub(crate) struct Corner3<S: Simd> {
    pub(crate) f0: f32x16<S>,
    pub(crate) d1: f32x16<S>,
    pub(crate) d2: f32x16<S>,
}

impl<S: Simd> Corner3<S> {
    /// The same in all lanes.
    #[inline(always)]
    pub(crate) fn splat(s: S, [f0, d1, d2]: [f32; 3]) -> Self {
        Self { f0: f32x16::splat(s, f0), d1: f32x16::splat(s, d1), d2: f32x16::splat(s, d2) }
    }

    /// The varying, from the weights of the second and third vertex.
    #[inline(always)]
    pub(crate) fn at(&self, b1: f32x16<S>, b2: f32x16<S>) -> f32x16<S> {
        (self.f0 + b1 * self.d1) + b2 * self.d2
    }
}

/// The weights of the second and third vertex, normalised, and their derivatives.
#[derive(Clone, Copy)]
struct Barycentric<S: Simd> {
    b1: f32x16<S>,
    b2: f32x16<S>,
    dx: [f32x16<S>; 2],
    dy: [f32x16<S>; 2],
}

impl<S: Simd> Barycentric<S> {
    #[inline(always)]
    fn new(s: S, weights: &[f32x16<S>; 3], dx: &[f32x16<S>; 3], dy: &[f32x16<S>; 3], derivatives: bool) -> Self {
        let sum = (weights[0] + weights[1]) + weights[2];
        let scale = f32x16::splat(s, 1.0) / sum;
        let (b1, b2) = (weights[1] * scale, weights[2] * scale);
        let mut this = Self { b1, b2, dx: [b1, b2], dy: [b1, b2] };
        if derivatives {
            // Of a quotient: (n / d)' = (n' - (n / d) d') / d.
            let (sum_dx, sum_dy) = ((dx[0] + dx[1]) + dx[2], (dy[0] + dy[1]) + dy[2]);
            this.dx = [(dx[1] - b1 * sum_dx) * scale, (dx[2] - b2 * sum_dx) * scale];
            this.dy = [(dy[1] - b1 * sum_dy) * scale, (dy[2] - b2 * sum_dy) * scale];
        }
        this
    }
}

/// Both kinds of barycentric coordinates.
pub(crate) struct Both<S: Simd> {
    perspective: Barycentric<S>,
    linear: Barycentric<S>,
}

impl<S: Simd> Both<S> {
    #[inline(always)]
    pub(crate) fn new<const FULL: bool>(s: S, weights: &Weights<S>, layout: &VaryingLayout) -> Self {
        let derivatives = FULL && layout.derivatives;
        let perspective = Barycentric::new(s, &weights.perspective, &weights.dx, &weights.dy, derivatives);
        let linear = if FULL && !layout.is_plain {
            Barycentric::new(s, &weights.linear, &weights.linear_dx, &weights.linear_dy, derivatives)
        } else {
            perspective
        };
        Self { perspective, linear }
    }

    /// The weights of the second and third vertex with perspective.
    #[inline(always)]
    pub(crate) fn perspective(&self) -> [f32x16<S>; 2] {
        [self.perspective.b1, self.perspective.b2]
    }

    /// Varying `k` and its derivatives, from its values at the vertices.
    #[inline(always)]
    pub(crate) fn set<const FULL: bool>(
        &self,
        layout: &VaryingLayout,
        rows: &mut PacketRows<'_>,
        k: usize,
        f: Corner3<S>,
    ) {
        let interpolation = if FULL && !layout.is_plain { layout.interpolation[k] } else { Interpolation::Perspective };
        let b = match interpolation {
            Interpolation::Flat => {
                rows.here[k] = f.f0.into();
                if layout.derivatives {
                    (rows.dx[k], rows.dy[k]) = ([0.0; 16], [0.0; 16]);
                }
                return;
            }
            Interpolation::Perspective => &self.perspective,
            Interpolation::NoPerspective => &self.linear,
        };
        rows.here[k] = f.at(b.b1, b.b2).into();
        if FULL && layout.derivatives {
            rows.dx[k] = (b.dx[0] * f.d1 + b.dx[1] * f.d2).into();
            rows.dy[k] = (b.dy[0] * f.d1 + b.dy[1] * f.d2).into();
        }
    }
}
