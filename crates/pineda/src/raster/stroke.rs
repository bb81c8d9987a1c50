//! Lines and points: from their places on the raster to records in bins.
//!
//! - A line one pixel wide covers what [`diamond_exit`] says, group by group.
//! - A wider one is a rectangle, and so is a large point: two triangles, set up as all are, with one number. A small point's square is covered directly, which is the same:
//!   a square's left and top edges are its own.
//!
//! - A smooth one covers every pixel that it touches; how much of it, [`covered_area`](super::smooth::covered_area) says when it is shaded.
//!
//! A stroke's number stands for three vertex records of its own (see [`crate::pass::strokes`]), from which it is interpolated as if it were a triangle. Its
//! order code says which side it shows: lines and points show their front, those of a triangle what the triangle shows.

use super::bins::{Share, TileGrid};
use super::corners::Corners;
use super::diamond_exit::diamond_exit;
use super::groups::{Groups, LinearDepth};
use super::reach::PixelRect;
use super::samples::{SampleSet, Samples};
use super::setup::{SetupState, setup};
use super::smooth::touched;
use super::triangle_id::TriangleId;
use crate::geometry::clip::ClipTriangle;
use crate::geometry::project::Projection;
use crate::geometry::raster_space::{HALF_PIXEL, SUBPIXEL_BITS, SUBPIXELS, ScreenVertex};
use crate::wide::dispatch;
use fearless_simd::Level;

/// What a run's strokes are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum StrokeShape {
    /// Lines one pixel wide.
    Thin,
    /// Lines so many subpixels wide.
    Wide { width: f64 },
    /// The same, by the part of each pixel that they cover.
    Smooth { width: f64 },
    /// Points.
    Point,
}

impl StrokeShape {
    /// Where pixels have several samples, thin lines are rectangles, too (Vulkan 1.4, 28.8 "Line Segments").
    pub(crate) fn with_samples(self, samples: Samples) -> Self {
        match self {
            Self::Thin if !samples.is_one() => Self::Wide { width: f64::from(SUBPIXELS) },
            _ => self,
        }
    }
}

/// A line or a point on the raster.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Stroke {
    /// A line's ends; a point's upper left and lower right corner.
    pub(crate) ends: [[i32; 2]; 2],
    /// Depths at the ends.
    pub(crate) z: [f32; 2],
    pub(crate) is_drawn: bool,
    /// Whether it is of a triangle that shows its back.
    pub(crate) is_back: bool,
    pub(crate) fate: Fate,
    pub(crate) is_clipped: bool,
}

/// What became of the primitive that a stroke is the first of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Fate {
    /// Nothing to be told; or it is not the first.
    #[default]
    Usual,
    NonFinite,
    Outside,
    /// Of a triangle that is drawn as edges or corners.
    Degenerate,
    Culled,
}

/// What setup must know of a run of strokes.
#[derive(Clone, Copy)]
pub(crate) struct StrokeState<'a> {
    /// Whether degenerate and culled triangles are counted.
    pub(crate) counts: bool,
    pub(crate) level: Level,
    pub(crate) grid: TileGrid,
    pub(crate) rect: PixelRect,
    pub(crate) samples: SampleSet,
    pub(crate) shape: StrokeShape,
    pub(crate) projection: &'a Projection,
}

/// The largest square that is covered directly, in subpixels.
const SMALL_POINT: i32 = 16 * SUBPIXELS;

/// Order codes of what shows its front, and its back, to [`RunView`](crate::shading::run::RunView)s of strokes.
const FRONT: u32 = 0;
const BACK: u32 = 3;

/// Sets up strokes, of which the first has a number in the batch.
pub(crate) fn set_up_strokes(state: &StrokeState<'_>, strokes: &[Stroke], first_number: usize, share: &mut Share) {
    for stroke in strokes {
        match stroke.fate {
            Fate::Usual => {}
            Fate::NonFinite => share.statistics.non_finite += 1,
            Fate::Outside => share.statistics.outside += 1,
            Fate::Degenerate => share.degenerate += u64::from(state.counts),
            Fate::Culled => share.culled += u64::from(state.counts),
        }
        share.statistics.clipped += u64::from(stroke.is_clipped);
    }
    for (k, eight) in strokes.chunks(8).enumerate() {
        let number = first_number + 8 * k;
        let mut rectangles = Rectangles::default();
        for (k, stroke) in eight.iter().enumerate().filter(|(_, stroke)| stroke.is_drawn) {
            let id = TriangleId::first(number + k) | if stroke.is_back { BACK } else { FRONT };
            match state.shape {
                StrokeShape::Thin => thin_line(state, stroke, id, share),
                StrokeShape::Wide { width } => rectangles.set(k, stroke, corners_of_line(stroke, width)),
                StrokeShape::Smooth { width } => smooth_line(state, stroke, width, id, share),
                StrokeShape::Point if is_small(state, stroke) => small_point(state, stroke, id, share),
                StrokeShape::Point => rectangles.set(k, stroke, corners_of_point(stroke)),
            }
        }
        rectangles.set_up(state, number, share);
    }
}

fn thin_line(state: &StrokeState<'_>, stroke: &Stroke, id: u32, share: &mut Share) {
    let ([a, b], [za, zb]) = (stroke.ends, stroke.z);
    let mut groups = Groups::new(share, state.grid, state.samples, id, LinearDepth::along(a, b, za, zb));
    diamond_exit(a, b, &state.rect, |x, y| groups.cover(x, y));
    groups.finish();
}

fn smooth_line(state: &StrokeState<'_>, stroke: &Stroke, width: f64, id: u32, share: &mut Share) {
    let ([a, b], [za, zb]) = (stroke.ends, stroke.z);
    let mut groups = Groups::new(share, state.grid, state.samples, id, LinearDepth::along(a, b, za, zb));
    touched(&corners_of_line(stroke, width), &state.rect, |x, y| groups.cover(x, y));
    groups.finish();
}

/// Whether a point is covered directly. Where pixels have several samples, none is.
fn is_small(state: &StrokeState<'_>, stroke: &Stroke) -> bool {
    state.samples.samples.is_one() && stroke.ends[1][0] - stroke.ends[0][0] <= SMALL_POINT
}

fn small_point(state: &StrokeState<'_>, stroke: &Stroke, id: u32, share: &mut Share) {
    let [[x0, y0], [x1, y1]] = stroke.ends;
    // The first sample at or after a border.
    let first = |v: i32| (v - HALF_PIXEL + SUBPIXELS - 1) >> SUBPIXEL_BITS;
    let rect = &state.rect;
    let (columns, rows) =
        (first(x0).max(rect.x0)..first(x1).min(rect.x1), first(y0).max(rect.y0)..first(y1).min(rect.y1));
    let mut groups = Groups::new(share, state.grid, state.samples, id, LinearDepth::constant(stroke.z[0]));
    for group_row in rows.start >> 3..=(rows.end - 1) >> 3 {
        for group_column in columns.start >> 3..=(columns.end - 1) >> 3 {
            for y in rows.start.max(group_row << 3)..rows.end.min((group_row + 1) << 3) {
                for x in columns.start.max(group_column << 3)..columns.end.min((group_column + 1) << 3) {
                    groups.cover(x, y);
                }
            }
        }
    }
    groups.finish();
}

/// From the line's start on, clockwise on the picture: two corners with the start's depth, the others with the end's.
pub(crate) fn corners_of_line(stroke: &Stroke, width: f64) -> [[i32; 2]; 4] {
    let [a, b] = stroke.ends;
    let (dx, dy) = (f64::from(b[0] - a[0]), f64::from(b[1] - a[1]));
    let scale = width * 0.5 / (dx * dx + dy * dy).sqrt();
    let (nx, ny) = ((-dy * scale).round_ties_even() as i32, (dx * scale).round_ties_even() as i32);
    [[a[0] + nx, a[1] + ny], [a[0] - nx, a[1] - ny], [b[0] - nx, b[1] - ny], [b[0] + nx, b[1] + ny]]
}

/// The two triangles that cover for a stroke where pixels have several samples; of a smooth line, which covers pixels as wholes, none.
pub(crate) fn triangles_of(stroke: &Stroke, shape: StrokeShape) -> Option<[[[i32; 2]; 3]; 2]> {
    let [p, q, r, s] = match shape {
        StrokeShape::Thin | StrokeShape::Smooth { .. } => return None,
        StrokeShape::Wide { width } => corners_of_line(stroke, width),
        StrokeShape::Point => corners_of_point(stroke),
    };
    Some([[p, q, r], [p, r, s]])
}

fn corners_of_point(stroke: &Stroke) -> [[i32; 2]; 4] {
    let [[x0, y0], [x1, y1]] = stroke.ends;
    [[x0, y1], [x0, y0], [x1, y0], [x1, y1]]
}

/// Eight rectangles at most, as two triangles each; those that are not set have no area.
#[derive(Default)]
struct Rectangles {
    vertices: Option<Box<[ScreenVertex; 48]>>,
}

impl Rectangles {
    /// The rectangle of the stroke of that number among the eight, by its corners, clockwise on the picture.
    fn set(&mut self, k: usize, stroke: &Stroke, [p, q, r, s]: [[i32; 2]; 4]) {
        let vertices = self.vertices.get_or_insert_with(|| Box::new([ScreenVertex::default(); 48]));
        let [za, zb] = stroke.z;
        let [p, q, r, s] = [(p, za), (q, za), (r, zb), (s, zb)].map(|([x, y], z)| ScreenVertex::new(x, y, z, 1.0));
        for (half, mut triangle) in [[p, q, r], [p, r, s]].into_iter().enumerate() {
            // In canonical order, so that both halves have the code that the stroke has.
            let first = (0..3).min_by_key(|&k| (triangle[k].y(), triangle[k].x())).unwrap_or(0);
            triangle.rotate_left(first);
            if stroke.is_back {
                triangle.swap(1, 2);
            }
            vertices[6 * k + 3 * half..6 * k + 3 * half + 3].copy_from_slice(&triangle);
        }
    }

    fn set_up(&self, state: &StrokeState<'_>, first_number: usize, share: &mut Share) {
        let Some(vertices) = &self.vertices else { return };
        let setup_state = SetupState {
            grid: state.grid,
            rect: state.rect,
            samples: state.samples,
            cull_clockwise: false,
            cull_counter_clockwise: false,
            bias: None,
            counts: false,
            numbered_in_pairs: true,
            projection: state.projection,
            vertices: &|_| ClipTriangle::default(),
        };
        let statistics = share.statistics;
        set_up_triangles(state.level, &setup_state, &Corners::Sequential, &vertices[..], 0..16, first_number, share);
        share.statistics = statistics;
    }
}

/// Sets up triangles, at the level.
#[inline(never)]
pub(crate) fn set_up_triangles(
    level: Level,
    state: &SetupState<'_>,
    corners: &Corners<'_>,
    screen: &[ScreenVertex],
    range: std::ops::Range<usize>,
    first_number: usize,
    share: &mut Share,
) {
    dispatch!(level, s => setup(s, state, corners, screen, range, first_number, share));
}
