//! Clipping of the few lines that cross the near plane, the far plane, the guard band or a plane of the shader's own.
//!
//! In homogeneous coordinates and f64, as [triangles are clipped](super::clip). Each end that lies outside is replaced by the point where the line comes in, a sum of
//! both ends with positive weights; it is always computed from the line's own ends, plane by plane, and the innermost of these points is taken.

use super::clip::{distance, to_raster};
use super::project::{Homogeneous, Projection};
use super::raster_space::ScreenVertex;
use crate::shading::MAX_CLIP_DISTANCES;

/// An end of a clipped line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ClippedEnd {
    pub(crate) screen: ScreenVertex,
    pub(crate) w: f64,
    /// How much the line's own start and end count at it, in space.
    pub(crate) weights: [f64; 2],
}

/// Clips a line with finite positions and clip distances by the planes that `outcode` names, with a guard band of so many subpixels; `None` if nothing of it is left.
pub(crate) fn clip_line(
    projection: &Projection,
    positions: [[f32; 4]; 2],
    distances: [[f32; MAX_CLIP_DISTANCES]; 2],
    planes: u32,
    guard_band: i32,
) -> Option<[ClippedEnd; 2]> {
    let [a, b] = positions.map(|position| projection.homogeneous(position));
    // How much the other end counts at each.
    let mut cuts = [0.0f64; 2];
    let [a_distances, b_distances] = distances.map(|each| each.map(f64::from));
    for plane in super::clip::planes().filter(|plane| planes & plane != 0) {
        let da = distance(plane, &a, &a_distances, guard_band);
        let db = distance(plane, &b, &b_distances, guard_band);
        if da < 0.0 && db < 0.0 {
            return None;
        }
        if da < 0.0 {
            cuts[0] = cuts[0].max(-da / (db - da));
        } else if db < 0.0 {
            cuts[1] = cuts[1].max(-db / (da - db));
        }
    }
    if cuts[0] + cuts[1] >= 1.0 {
        return None;
    }
    let end = |weights: [f64; 2]| {
        let mix = |a: f64, b: f64| a * weights[0] + b * weights[1];
        let at = Homogeneous { x: mix(a.x, b.x), y: mix(a.y, b.y), z: mix(a.z, b.z), w: mix(a.w, b.w) };
        to_raster(projection, at).map(|screen| ClippedEnd { screen, w: at.w, weights })
    };
    Some([end([1.0 - cuts[0], cuts[0]])?, end([cuts[1], 1.0 - cuts[1]])?])
}

/// The place of a point on the raster whose position is finite, with a w that is beyond what [`Projection::project`] takes; `None` where w is not positive.
pub(crate) fn point_on_raster(projection: &Projection, position: [f32; 4]) -> Option<ScreenVertex> {
    to_raster(projection, projection.homogeneous(position))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::project::outcode;
    use crate::geometry::raster_space::GUARD_BAND;

    const NONE: [[f32; MAX_CLIP_DISTANCES]; 2] = [[0.0; MAX_CLIP_DISTANCES]; 2];
    use crate::pass::{Space, Viewport};

    #[test]
    fn a_line_through_the_near_plane_begins_there() {
        let projection = Projection::new(Space::Clip, &Viewport::whole(64, 64));
        let (behind, before) = ([0.0, 0.0, -1.0, -0.5], [0.0, 0.5, 1.0, 1.0]);
        let clip = |positions| clip_line(&projection, positions, NONE, outcode::NEAR, GUARD_BAND);
        let [start, end] = clip([behind, before]).expect("half of it is there");
        assert_eq!((start.weights, start.w, start.screen.z()), ([0.5, 0.5], 0.25, 0.0));
        assert_eq!((start.screen.x(), start.screen.y()), (32 * 256, 0));
        assert_eq!((end.weights, end.screen.y()), ([0.0, 1.0], 16 * 256));
        let [end, start] = clip([before, behind]).expect("the other way round");
        assert_eq!((start.weights, start.screen.y()), ([0.5, 0.5], 0));
        assert_eq!(end.weights, [1.0, 0.0]);
        assert!(clip([behind, behind]).is_none());
    }

    #[test]
    fn what_passes_a_corner_of_the_guard_band_is_left_out() {
        let projection = Projection::new(Space::Raster, &Viewport::whole(64, 64));
        let all = outcode::LEFT | outcode::RIGHT | outcode::TOP | outcode::BOTTOM;
        let clip =
            |x: f32, y: f32| clip_line(&projection, [[x, 0.0, 0.0, 1.0], [0.0, y, 0.0, 1.0]], NONE, all, GUARD_BAND);
        assert!(
            clip(70_000.0, 60_000.0).is_some_and(|[a, b]| a.screen.x() <= GUARD_BAND && b.screen.y() == GUARD_BAND)
        );
        assert!(clip(70_000.0, 62_000.0).is_none());
    }
}
