//! Strokes: the lines and points that primitives become after the vertex stage.
//!
//! What comes later knows triangles. So each line or point gets three vertex records of its own, from which it is interpolated as a triangle would be:
//!
//! ```text
//!   c                    x        c     A line from p (whose vertex provokes) to q is interpolated from p, q and c, a point at a right angle from p
//!   |                    |              with p's varyings. A sample counts for q by the part of the way to q at which it lies, whichever its
//!   p--------q           x-----x        distance from the line. A point is interpolated from three corners of its square, with its vertex's varyings.
//! ```
//!
//! Its coverage is another matter, and [setup's](crate::raster::stroke). A line that needs clipping has its varyings clipped, too: with perspective they are
//! sums with the weights that its ends have in space; on the screen, with those that they have there.
//!
//! c may lie beyond the guard band: up to 2^25 subpixels from the target's corner, as far as edge functions fit f64.

use super::draw_call::DrawCall;
use super::{Cull, DrawState, FrontFace, MAX_POINT_SIZE, PolygonMode};
use crate::geometry::clip::{ClipTriangle, area_x2, clip};
use crate::geometry::clip_line::{clip_line, point_on_raster};
use crate::geometry::project::{Projection, outcode};
use crate::geometry::raster_space::{GUARD_BAND, SUBPIXELS, ScreenVertex};
use crate::raster::corners::Corners;
use crate::raster::depth_bias::Bias;
use crate::raster::stroke::{Fate, Stroke, StrokeShape};
use crate::shading::Interpolation;
use crate::shading::run::{RECORD_HEADER, RecordRow, Source};
use std::ops::Range;

/// Vertex records of a stroke.
pub(crate) const RECORDS_EACH: usize = 3;

/// A run's strokes.
#[derive(Clone, Debug)]
pub(crate) struct StrokeRun {
    pub(crate) shape: StrokeShape,
    /// Where they stand in the batch's strokes, and the rows of their records among the batch's.
    pub(crate) strokes: Range<usize>,
    pub(crate) records: Range<usize>,
}

/// The shape of a draw's strokes; `None` if it draws triangles.
pub(crate) fn shape(state: &DrawState) -> Option<StrokeShape> {
    let is_of_triangles = state.topology.is_of_triangles();
    if is_of_triangles && state.polygon_mode == PolygonMode::Fill {
        return None;
    }
    let is_of_lines =
        if is_of_triangles { state.polygon_mode == PolygonMode::Line } else { state.topology.is_of_lines() };
    Some(if !is_of_lines {
        StrokeShape::Point
    } else if state.smooth_lines {
        StrokeShape::Smooth { width: f64::from(state.line_width) * f64::from(SUBPIXELS) }
    } else if state.line_width == 1.0 {
        StrokeShape::Thin
    } else {
        StrokeShape::Wide { width: f64::from(state.line_width) * f64::from(SUBPIXELS) }
    })
}

/// How many numbers a primitive of a draw has: one, but for triangles of which the edges or the corners are drawn.
pub(crate) fn numbers_each(state: &DrawState) -> usize {
    if state.topology.is_of_triangles() && shape(state).is_some() { 3 } else { 1 }
}

/// Primitives of a run, after their vertex stage.
#[derive(Clone, Copy)]
pub(crate) struct Expansion<'a> {
    pub(crate) call: &'a (dyn DrawCall + 'a),
    pub(crate) shape: StrokeShape,
    pub(crate) projection: &'a Projection,
    pub(crate) corners: Corners<'a>,
    pub(crate) source: Source<'a>,
    pub(crate) screen: &'a [ScreenVertex],
    pub(crate) records: &'a [RecordRow],
    pub(crate) bias: Option<Bias>,
}

impl Expansion<'_> {
    /// The strokes of the primitives from `first` on, and their records.
    pub(crate) fn run(&self, first: usize, strokes: &mut [Stroke], records: &mut [RecordRow]) {
        let state = self.call.state();
        let (rows, each) = (self.call.record_rows(), numbers_each(state));
        let outputs = strokes.chunks_mut(each).zip(records.chunks_mut(each * RECORDS_EACH * rows));
        for (k, (strokes, records)) in outputs.enumerate() {
            let places = self.corners.of(first + k);
            strokes.fill(Stroke::default());
            if each == 1 {
                // Of a line, the third is the provoking vertex once more.
                let [a, b, provoking] = places;
                self.one([a, b], provoking, provoking, &mut strokes[0], records);
                continue;
            }
            let Some((is_back, offset)) = self.triangle(places, &mut strokes[0]) else { continue };
            for (k, (stroke, records)) in strokes.iter_mut().zip(records.chunks_mut(RECORDS_EACH * rows)).enumerate() {
                let (fate, is_clipped) = (stroke.fate, stroke.is_clipped);
                self.one([places[k], places[(k + 1) % 3]], places[k], places[0], stroke, records);
                (stroke.fate, stroke.is_clipped, stroke.is_back) = (fate, is_clipped, is_back);
                stroke.z = stroke.z.map(|z| z + offset);
            }
        }
    }

    fn one(&self, ends: [usize; 2], from: usize, flat: usize, stroke: &mut Stroke, records: &mut [RecordRow]) {
        match self.shape {
            StrokeShape::Point => self.point(ends[0], flat, stroke, records),
            _ => self.line(ends, from, flat, stroke, records),
        }
    }

    /// Whether a triangle shows its back, and the offset of its depths; `None` if it is culled, or nothing of it is there.
    fn triangle(&self, places: [usize; 3], told: &mut Stroke) -> Option<(bool, f32)> {
        let state = self.call.state();
        let screen = places.map(|place| self.screen[place]);
        let codes = screen.map(ScreenVertex::outcode);
        let is_back_if = |is_clockwise: bool| is_clockwise != (state.front_face == FrontFace::Clockwise);
        let is_left_out = |is_back: bool| match state.cull {
            Cull::None => false,
            Cull::Front => !is_back,
            Cull::Back => is_back,
        };
        if (codes[0] | codes[1] | codes[2]) & outcode::NON_FINITE != 0 {
            told.fate = Fate::NonFinite;
            return None;
        }
        if codes[0] & codes[1] & codes[2] != 0 {
            told.fate = Fate::Outside;
            return None;
        }
        if screen.iter().any(|v| v.is_off_raster()) {
            told.is_clipped = true;
            let triangle = ClipTriangle::of(self.call, places.map(|place| self.source.vertex(place)));
            let Some(clipped) = clip(self.projection, &triangle, screen) else {
                told.fate = Fate::Degenerate;
                return None;
            };
            let is_back = is_back_if(clipped.is_clockwise);
            let depths: Vec<f32> = clipped.triangles().as_flattened().iter().map(|v| v.z()).collect();
            let offset =
                self.bias.map_or(0.0, |bias| bias.offset_of_clipped(self.projection, triangle.positions, &depths));
            if is_left_out(is_back) {
                told.fate = Fate::Culled;
                return None;
            }
            return Some((is_back, offset));
        }
        let area = area_x2(screen);
        let is_back = is_back_if(area > 0);
        let offset = self.bias.map_or(0.0, |bias| offset_of(&bias, screen, area));
        if area == 0 || is_left_out(is_back) {
            told.fate = if area == 0 { Fate::Degenerate } else { Fate::Culled };
            return None;
        }
        Some((is_back, offset))
    }

    fn position(&self, place: usize) -> [f32; 4] {
        self.call.position(self.source.vertex(place))
    }

    fn point(&self, place: usize, flat: usize, stroke: &mut Stroke, records: &mut [RecordRow]) {
        let mut screen = self.screen[place];
        let mut is_plain = true;
        match screen.outcode() {
            outcode::NON_FINITE => {
                stroke.fate = Fate::NonFinite;
                return;
            }
            0 if screen.is_off_raster() => {
                let Some(there) = point_on_raster(self.projection, self.position(place)) else { return };
                (screen, is_plain) = (there, false);
            }
            0 => {}
            _ => {
                stroke.fate = Fate::Outside;
                return;
            }
        }
        let size = self.call.point_size(self.source.vertex(place)).unwrap_or(self.call.state().point_size);
        if size.is_nan() {
            stroke.fate = Fate::NonFinite;
            return;
        }
        let size = (size.clamp(0.0, MAX_POINT_SIZE as f32) * SUBPIXELS as f32).round_ties_even() as i32;
        let (x0, y0) = (screen.x() - (size >> 1), screen.y() - (size >> 1));
        let (x1, y1) = (x0 + size, y0 + size);
        // What lies outside of the largest target is invisible; and the rest keeps its corners within the guard band.
        let largest = crate::MAX_SIZE as i32 * SUBPIXELS;
        if size == 0 || x1 < 0 || y1 < 0 || x0 > largest || y0 > largest {
            return;
        }
        *stroke = Stroke { ends: [[x0, y0], [x1, y1]], z: [screen.z(); 2], is_drawn: true, ..*stroke };
        let (rows, layout) = (self.call.record_rows(), self.call.layout());
        let corners = [([x0, y0], [0.0f32, 0.0]), ([x1, y0], [1.0, 0.0]), ([x0, y1], [0.0, 1.0])];
        for (record, (at, coordinates)) in records.chunks_mut(rows).zip(corners) {
            self.copy(place, at, record);
            if layout.point_coord {
                let end = RECORD_HEADER + layout.interpolation.len();
                record.as_flattened_mut()[end - 2..end].copy_from_slice(&coordinates.map(f32::to_bits));
            }
            if !is_plain {
                record[0][2] = 1.0f32.to_bits();
            }
        }
        self.copy_flat(flat, &mut records[..rows]);
    }

    /// A line between two vertices, with one's record first, and the flat varyings of some vertex.
    fn line(&self, ends: [usize; 2], from: usize, flat: usize, stroke: &mut Stroke, records: &mut [RecordRow]) {
        let screen = ends.map(|place| self.screen[place]);
        let codes = screen.map(ScreenVertex::outcode);
        if (codes[0] | codes[1]) & outcode::NON_FINITE != 0 {
            stroke.fate = Fate::NonFinite;
            return;
        }
        if codes[0] & codes[1] != 0 {
            stroke.fate = Fate::Outside;
            return;
        }
        // How far samples may lie from the line; and the guard band must hold a rectangle's corners.
        let (reach, guard_band) = match self.shape {
            StrokeShape::Wide { width } | StrokeShape::Smooth { width } => {
                let reach = (width * 0.5) as i32 + SUBPIXELS;
                (reach, GUARD_BAND - reach)
            }
            _ => (SUBPIXELS, GUARD_BAND),
        };
        let rows = self.call.record_rows();
        let [p_record, q_record, c_record] = three(records, rows);
        let (p, q) = if from == ends[1] && from != ends[0] { (1, 0) } else { (0, 1) };
        let is_inside = |v: ScreenVertex| !v.is_off_raster() && v.x().abs().max(v.y().abs()) <= guard_band;
        let points = if screen.into_iter().all(is_inside) {
            self.copy(ends[p], [screen[p].x(), screen[p].y()], p_record);
            self.copy(ends[q], [screen[q].x(), screen[q].y()], q_record);
            screen
        } else {
            let is_cut_anyhow = screen.iter().any(|v| v.is_off_raster());
            stroke.is_clipped = is_cut_anyhow;
            let sides = outcode::LEFT | outcode::RIGHT | outcode::TOP | outcode::BOTTOM;
            let planes = codes[0] | codes[1] | sides;
            let positions = ends.map(|place| self.position(place));
            let distances = ends.map(|place| self.call.clip_distances(self.source.vertex(place)));
            let Some(clipped) = clip_line(self.projection, positions, distances, planes, guard_band) else { return };
            // Only their ratio counts.
            let inv_w = clipped.map(|end| 1.0 / end.w);
            let inv_w = inv_w.map(|v| (v / inv_w[0].max(inv_w[1])) as f32);
            let own_w = ends.map(|place| f64::from(self.position(place)[3]));
            for (end, record) in [(p, &mut *p_record), (q, &mut *q_record)] {
                let at = &clipped[end];
                let on_screen = [0, 1].map(|k| at.weights[k] * own_w[k] / at.w);
                self.mix(ends, end, at.weights, on_screen, record);
                record[0][0] = at.screen.0[0];
                record[0][1] = at.screen.0[1];
                record[0][2] = inv_w[end].to_bits();
            }
            clipped.map(|end| end.screen)
        };
        self.copy_flat(flat, p_record);
        let ends = points.map(|v| [v.x(), v.y()]);
        *stroke = Stroke { ends, z: points.map(ScreenVertex::z), is_drawn: ends[0] != ends[1], ..*stroke };
        c_record.copy_from_slice(p_record);
        let c = at_right_angle(ends[p], ends[q], reach);
        (c_record[0][0], c_record[0][1]) = (c[0] as u32, c[1] as u32);
    }

    fn record(&self, place: usize) -> &[RecordRow] {
        let rows = self.call.record_rows();
        &self.records[place * rows..(place + 1) * rows]
    }

    /// A vertex's record, at another place on the raster.
    fn copy(&self, place: usize, [x, y]: [i32; 2], out: &mut [RecordRow]) {
        out.copy_from_slice(self.record(place));
        (out[0][0], out[0][1]) = (x as u32, y as u32);
    }

    /// Takes the flat varyings over from another vertex.
    fn copy_flat(&self, place: usize, out: &mut [RecordRow]) {
        let from = self.record(place).as_flattened();
        for (k, interpolation) in self.call.layout().interpolation.iter().enumerate() {
            if *interpolation == Interpolation::Flat {
                out.as_flattened_mut()[RECORD_HEADER + k] = from[RECORD_HEADER + k];
            }
        }
    }

    /// The record of a point of a line: varyings by the weights of the line's ends, in space and on the screen; flat ones of end `own`.
    fn mix(&self, ends: [usize; 2], own: usize, in_space: [f64; 2], on_screen: [f64; 2], out: &mut [RecordRow]) {
        out.copy_from_slice(self.record(ends[own]));
        let [a, b] = ends.map(|place| self.record(place).as_flattened());
        for (k, interpolation) in self.call.layout().interpolation.iter().enumerate() {
            let at = RECORD_HEADER + k;
            let [wa, wb] = match interpolation {
                Interpolation::Flat => continue,
                Interpolation::Perspective => in_space,
                Interpolation::NoPerspective => on_screen,
            };
            let [a, b] = [a[at], b[at]].map(f32::from_bits);
            // What is the same at both ends stays exactly that.
            if a != b {
                out.as_flattened_mut()[at] = ((f64::from(a) * wa + f64::from(b) * wb) as f32).to_bits();
            }
        }
    }
}

fn three(records: &mut [RecordRow], rows: usize) -> [&mut [RecordRow]; 3] {
    let (p, rest) = records.split_at_mut(rows);
    let (q, c) = rest.split_at_mut(rows);
    [p, q, c]
}

/// The offset that a triangle on the raster has.
fn offset_of(bias: &Bias, v: [ScreenVertex; 3], area: i64) -> f32 {
    let side = |k: usize| (f64::from(v[k].x() - v[0].x()), f64::from(v[k].y() - v[0].y()));
    let rise = |k: usize| f64::from(v[k].z()) - f64::from(v[0].z());
    let ((ax, ay), (bx, by)) = (side(1), side(2));
    let scale = f64::from(SUBPIXELS) / area as f64;
    let (dz_dx, dz_dy) = ((rise(1) * by - rise(2) * ay) * scale, (rise(2) * ax - rise(1) * bx) * scale);
    bias.offset(&v.map(ScreenVertex::z), dz_dx as f32, dz_dy as f32)
}

/// A point at a right angle to the line from p to q: so far from p that no sample within `reach` of the line has barycentric coordinates much beyond 1.
///
/// Edge functions of triangles with an area up to 2^31 are computed in 32 bits where the triangle is shown. A line is shown a little outside of its triangle,
/// too: so its area is kept below half of that, or above it.
fn at_right_angle(p: [i32; 2], q: [i32; 2], reach: i32) -> [i32; 2] {
    const MOST: i64 = 1 << 31;
    let [dx, dy] = [i64::from(q[0] - p[0]), i64::from(q[1] - p[1])];
    let length_squared = dx * dx + dy * dy;
    if length_squared == 0 {
        return p;
    }
    let length = (length_squared as f64).sqrt();
    let mut times = (f64::from(reach) / length).ceil().max(1.0) as i64;
    if (MOST / 2..=MOST).contains(&(times * length_squared)) {
        times = MOST / length_squared + 1;
    }
    // Where the area is large, times length is at most reach + length or 2^31 / length + length, with a length of at least 2^9.
    [(i64::from(p[0]) - times * dy) as i32, (i64::from(p[1]) + times * dx) as i32]
}
