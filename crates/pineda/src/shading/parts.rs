//! What covers for a fragment, found again from its triangle: for the few questions that coverage kernels do not answer, because nothing but the triangle may decide them.
//!
//! What of a triangle is visible depends on others; so where a fragment is shaded, and what it is told of its coverage, must not depend on that.

use super::run::RunView;
use crate::geometry::clip::{ClipTriangle, Clipped, clip};
use crate::geometry::raster_space::ScreenVertex;
use crate::pass::draw_call::DrawCall;
use crate::raster::stroke::triangles_of;
use crate::raster::top_left::is_top_left_edge;
use crate::raster::triangle_id::TriangleId;

/// The triangles on the raster that cover for a triangle, a line or a point.
#[expect(clippy::large_enum_variant, reason = "there is one at a time")]
pub(super) enum Parts {
    /// It covers pixels as wholes.
    Wholes,
    Itself([[i32; 2]; 3]),
    Halves([[[i32; 2]; 3]; 2]),
    Clipped(Option<Clipped>),
}

impl Parts {
    pub(super) fn of(call: &dyn DrawCall, run: &RunView<'_>, id: TriangleId) -> Self {
        if let Some(strokes) = &run.strokes {
            let stroke = &strokes.strokes[id.number() - run.first_number];
            return triangles_of(stroke, strokes.shape).map_or(Self::Wholes, Self::Halves);
        }
        let places = run.places(id);
        let screen = places.map(|place| run.screen[place]);
        if !id.is_clipped() {
            return Self::Itself(screen.map(ScreenVertex::place));
        }
        let triangle = ClipTriangle::of(call, places.map(|place| run.source.vertex(place)));
        Self::Clipped(clip(run.projection, &triangle, screen))
    }

    /// Whether they cover a place on the raster.
    pub(super) fn cover(&self, at: [i32; 2]) -> bool {
        match self {
            Self::Wholes => true,
            Self::Itself(corners) => is_covered(*corners, at),
            Self::Halves(halves) => halves.iter().any(|&corners| is_covered(corners, at)),
            Self::Clipped(clipped) => clipped.as_ref().is_some_and(|clipped| {
                clipped.triangles().iter().any(|corners| is_covered(corners.map(ScreenVertex::place), at))
            }),
        }
    }
}

/// Whether a triangle on the raster covers a point, by the top-left rule.
pub(super) fn is_covered(mut triangle: [[i32; 2]; 3], at: [i32; 2]) -> bool {
    let edge = |a: [i32; 2], b: [i32; 2], p: [i32; 2]| {
        let [dx, dy] = [i64::from(b[0]) - i64::from(a[0]), i64::from(b[1]) - i64::from(a[1])];
        dx * (i64::from(p[1]) - i64::from(a[1])) - dy * (i64::from(p[0]) - i64::from(a[0]))
    };
    let area = edge(triangle[0], triangle[1], triangle[2]);
    if area < 0 {
        triangle.swap(1, 2);
    }
    area != 0
        && (0..3).all(|k| {
            let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
            let e = edge(a, b, at);
            e > 0 || (e == 0 && is_top_left_edge(b[0] - a[0], b[1] - a[1]))
        })
}
