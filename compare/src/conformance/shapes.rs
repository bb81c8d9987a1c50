//! Shapes whose coverage is compared pixel for pixel: triangles, lines or points in a cell of a sheet, each corner on the subpixel grid, each vertex with a flat colour of 8-bit codes.
//!
//! Where the colours are added, a pixel's codes say how often and by which triangles it was covered; where they replace each other, which triangle came last. Both follow
//! from coverage alone, and so the oracle can say what is right, pixel by pixel.

use super::Bench;
use super::sheet::{Draw, Interpolation, Sheet, Vertex, clip_position_between};
use super::tally::{Row, Tally};
use anyhow::Result;
use pineda::{Blend, Cull, DepthState, DrawState, FrontFace, PrimitiveTopology, Scissor, Viewport};
use pineda_oracle::cases::Random;
use pineda_oracle::{Point, Winding, covers, line_covers, point_covers, winding};
use std::fmt;

/// Pixels to each side of a sheet of shapes.
const SHEET: u32 = 2048;
/// Pixels to each side of the smallest cell.
pub(crate) const SMALLEST_CELL: u32 = 32;

/// One case: a list or a strip in a cell of its own.
#[derive(Clone, Debug)]
pub(crate) struct Shape {
    /// What it was made from.
    pub(crate) seed: u64,
    /// Pixels to each side of the cell: a power of two.
    pub(crate) cell: u32,
    /// 1/256 pixels from the cell's corner.
    pub(crate) corners: Vec<Point>,
    /// By how much each is given beside where it snaps to, in 1/16 of that.
    pub(crate) besides: Vec<[i64; 2]>,
    pub(crate) colors: Vec<[u8; 4]>,
    pub(crate) indices: Vec<u32>,
    /// Viewport and scissor count from the cell's corner.
    pub(crate) state: DrawState,
    /// The cell's corner in the sheet, in pixels.
    origin: [u32; 2],
}

impl Shape {
    pub(crate) fn new(seed: u64, cell: u32, corners: Vec<Point>, indices: Vec<u32>, random: &mut Random) -> Self {
        // Sums of a few of them stay below 255.
        let colors = corners.iter().map(|_| [1, 0, 0, 0].map(|least| random.between(least, 12) as u8)).collect();
        let state = DrawState {
            depth: DepthState::OFF,
            cull: random.pick(&[Cull::None, Cull::None, Cull::Front, Cull::Back]),
            front_face: random.pick(&[FrontFace::CounterClockwise, FrontFace::Clockwise]),
            blend: random.pick(&[Blend::ADD, Blend::OPAQUE]),
            ..DrawState::DEFAULT
        };
        let besides = vec![[0; 2]; corners.len()];
        Self { seed, cell, corners, besides, colors, indices, state, origin: [0; 2] }
    }

    /// Indices of each triangle's corners, the first vertex first.
    fn triangles(&self) -> Vec<[usize; 3]> {
        if self.state.topology == PrimitiveTopology::TriangleList {
            return self.indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]].map(|k| k as usize)).collect();
        }
        let turned = |(n, t): (usize, &[u32])| if n % 2 == 0 { [t[0], t[1], t[2]] } else { [t[0], t[2], t[1]] };
        self.indices.windows(3).enumerate().map(turned).map(|t| t.map(|k| k as usize)).collect()
    }

    /// What is right for a pixel of the cell, by the oracle.
    pub(crate) fn expected(&self, pixel: [u32; 2]) -> [u8; 4] {
        let mut color = [0; 4];
        if !self.is_in_window(pixel) {
            return color;
        }
        for provoking in self.covering(pixel.map(i64::from)) {
            let own = self.colors[provoking];
            color = if self.state.blend == Blend::OPAQUE {
                own
            } else {
                [0, 1, 2, 3].map(|k| own[k].saturating_add(color[k]))
            };
        }
        color
    }

    /// The first vertices of what covers a pixel, in order.
    fn covering(&self, pixel: Point) -> Vec<usize> {
        let at = |k: usize| self.corners[k];
        let numbers: Vec<usize> = self.indices.iter().map(|&k| k as usize).collect();
        let width = self.state.line_width;
        let lines = |lines: &mut dyn Iterator<Item = [usize; 2]>| {
            lines
                .filter(|&[a, b]| {
                    let line = [at(a), at(b)];
                    if width == 1.0 { line_covers(line, pixel) } else { rectangle_covers(line, width, pixel) }
                })
                .map(|[a, _]| a)
                .collect()
        };
        match self.state.topology {
            PrimitiveTopology::PointList => numbers.into_iter().filter(|&k| point_covers(at(k), 256, pixel)).collect(),
            PrimitiveTopology::LineList => lines(&mut numbers.as_chunks::<2>().0.iter().copied()),
            PrimitiveTopology::LineStrip => lines(&mut numbers.windows(2).map(|ends| [ends[0], ends[1]])),
            _ => {
                let is_drawn = |&triangle: &[usize; 3]| {
                    let corners = triangle.map(at);
                    let is_front = match winding(corners) {
                        Winding::Degenerate => return false,
                        winding => {
                            (winding == Winding::CounterClockwise)
                                == (self.state.front_face == FrontFace::CounterClockwise)
                        }
                    };
                    let is_culled = self.state.cull == if is_front { Cull::Front } else { Cull::Back };
                    !is_culled && covers(corners, pixel)
                };
                self.triangles().into_iter().filter(is_drawn).map(|[provoking, ..]| provoking).collect()
            }
        }
    }

    /// Whether viewport and scissor leave the pixel. The viewport's corners are whole pixels wherever it matters.
    fn is_in_window(&self, pixel: [u32; 2]) -> bool {
        let [x, y] = pixel.map(|x| x as f32 + 0.5);
        let in_viewport = self.state.viewport.is_none_or(|viewport| {
            let (top, bottom) =
                (viewport.y.min(viewport.y + viewport.height), viewport.y.max(viewport.y + viewport.height));
            (viewport.x..viewport.x + viewport.width).contains(&x) && (top..bottom).contains(&y)
        });
        in_viewport
            && self.state.scissor.is_none_or(|scissor| {
                let [x, y] = pixel.map(i64::from);
                let columns = i64::from(scissor.x)..i64::from(scissor.x) + i64::from(scissor.width);
                let rows = i64::from(scissor.y)..i64::from(scissor.y) + i64::from(scissor.height);
                columns.contains(&x) && rows.contains(&y)
            })
    }

    /// How far a pixel's centre is from the nearest edge's line, in pixels.
    pub(crate) fn edge_distance(&self, pixel: [u32; 2]) -> f64 {
        let [x, y] = pixel.map(|x| 256 * i64::from(x) + 128);
        let distance = |a: Point, b: Point| {
            let (across, down) = (b[0] - a[0], b[1] - a[1]);
            let cross = across * (y - a[1]) - down * (x - a[0]);
            cross.abs() as f64 / (across as f64).hypot(down as f64) / 256.0
        };
        let edges = self.triangles().into_iter().flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]);
        edges.map(|edge| distance(self.corners[edge[0]], self.corners[edge[1]])).fold(f64::INFINITY, f64::min)
    }

    /// The state in the sheet.
    fn placed_state(&self) -> DrawState {
        let [x, y] = self.origin;
        let viewport = |viewport: Viewport| Viewport { x: viewport.x + x as f32, y: viewport.y + y as f32, ..viewport };
        let scissor = |scissor: Scissor| Scissor { x: scissor.x + x as i32, y: scissor.y + y as i32, ..scissor };
        DrawState {
            viewport: self.state.viewport.map(viewport),
            scissor: self.state.scissor.map(scissor),
            ..self.state
        }
    }

    /// Adds the shape to the draw that has its state.
    fn add_to(&self, sheet: &mut Sheet) {
        let mut state = self.placed_state();
        let is_strip = matches!(state.topology, PrimitiveTopology::TriangleStrip | PrimitiveTopology::LineStrip);
        state.primitive_restart = is_strip;
        let viewport = state.viewport.unwrap_or(sheet.viewport());
        if !sheet.draws.iter().any(|draw| draw.state == state) {
            let draw =
                Draw { vertices: Vec::new(), indices: Some(Vec::new()), interpolation: Interpolation::Flat, state };
            sheet.draws.push(draw);
        }
        let Some(draw) = sheet.draws.iter_mut().find(|draw| draw.state == state) else { return };
        let first = draw.vertices.len() as u32;
        let [x, y] = self.origin.map(|x| 256 * i64::from(x));
        for ((corner, beside), color) in self.corners.iter().zip(&self.besides).zip(&self.colors) {
            let point = [16 * (corner[0] + x) + beside[0], 16 * (corner[1] + y) + beside[1]];
            let position = clip_position_between(&viewport, point, 0.5, 1.0);
            draw.vertices.push(Vertex { position, color: color.map(|code| f32::from(code) / 255.0) });
        }
        let indices = draw.indices.get_or_insert_default();
        indices.extend(self.indices.iter().map(|index| first + index));
        if is_strip {
            indices.push(u32::MAX);
        }
    }
}

impl fmt::Display for Shape {
    /// Everything about it, for someone to draw it alone.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { seed, cell, corners, besides, colors, indices, state, .. } = self;
        let DrawState { topology, cull, front_face, viewport, scissor, .. } = state;
        let blend = if state.blend == Blend::OPAQUE { "replaced" } else { "added" };
        write!(
            f,
            "seed {seed}: {topology:?} in {cell} x {cell} pixels, corners in 1/256 pixel {corners:?}, codes {colors:?} {blend}, "
        )?;
        write!(f, "indices {indices:?}, cull {cull:?}, front {front_face:?}")?;
        if besides.iter().any(|beside| *beside != [0; 2]) {
            write!(f, ", given beside the corners by 1/4096 pixel times {besides:?}")?;
        }
        if let Some(viewport) = viewport {
            write!(f, ", {viewport:?}")?;
        }
        if let Some(scissor) = scissor {
            write!(f, ", {scissor:?}")?;
        }
        Ok(())
    }
}

/// Whether the rectangle that is a line of a width (Vulkan 1.4, "Rectangular Line Segments") covers a pixel. Its corners are on the subpixel grid.
fn rectangle_covers([a, b]: [Point; 2], width: f32, pixel: Point) -> bool {
    let [dx, dy] = [0, 1].map(|axis| (b[axis] - a[axis]) as f64);
    let [x, y] = [-dy, dx].map(|v| (128.0 * f64::from(width) * v / dx.hypot(dy)).round_ties_even() as i64);
    let corners = [[a[0] + x, a[1] + y], [a[0] - x, a[1] - y], [b[0] - x, b[1] - y], [b[0] + x, b[1] + y]];
    a != b && [[0, 1, 2], [0, 2, 3]].iter().any(|half| covers(half.map(|k| corners[k]), pixel))
}

/// Draws shapes, as many at once as a sheet holds, and compares. `row` explains a pixel of which the oracle says what `pineda` says; it is told what lavapipe says.
pub(crate) fn compare(
    bench: &mut Bench,
    mut shapes: Vec<Shape>,
    tally: &mut Tally,
    row: impl Fn(&Shape, [u32; 2], [u8; 4]) -> Option<Row>,
) -> Result<()> {
    tally.cases += shapes.len() as u64;
    for shapes in pack(&mut shapes) {
        let mut sheet = Sheet::new(SHEET);
        shapes.iter().for_each(|shape| shape.add_to(&mut sheet));
        let [ours, theirs] = bench.draw(&sheet)?;
        for shape in shapes {
            for pixel in (0..shape.cell).flat_map(|y| (0..shape.cell).map(move |x| [x, y])) {
                tally.pixels += 1;
                let at = sheet.at([0, 1].map(|axis| shape.origin[axis] + pixel[axis]));
                let (ours, theirs) = (ours.colors.codes()[at], theirs.colors.codes()[at]);
                tally.drawn += u64::from(ours != [0; 4]);
                if ours != theirs {
                    let expected = shape.expected(pixel);
                    let row = row(shape, pixel, theirs).filter(|_| ours == expected);
                    tally.differs(row, || {
                        format!("pixel {pixel:?}: pineda {ours:?}, lavapipe {theirs:?}, by the rules {expected:?}, {} pixels from an edge; {shape}", shape.edge_distance(pixel))
                    });
                }
            }
        }
    }
    Ok(())
}

/// Gives each shape its cell and returns the shapes of each sheet. Large ones come first, and cells follow each other on Morton's curve: so squares
/// whose sides are powers of two leave no gaps.
fn pack(shapes: &mut [Shape]) -> Vec<&[Shape]> {
    shapes.sort_by_key(|shape| std::cmp::Reverse(shape.cell));
    let capacity = u64::from(SHEET / SMALLEST_CELL).pow(2);
    let mut used = 0;
    let mut sheets = Vec::new();
    for shape in &mut *shapes {
        let place = used % capacity;
        let half = |bits: u64| (0..16).map(|k| (bits >> (2 * k) & 1) << k).sum::<u64>() as u32;
        shape.origin = [half(place), half(place >> 1)].map(|cells| cells * SMALLEST_CELL);
        sheets.push(used / capacity);
        used += u64::from(shape.cell / SMALLEST_CELL).pow(2);
    }
    let mut left = &*shapes;
    let mut parts = Vec::new();
    for count in sheets.chunk_by(|a, b| a == b).map(<[_]>::len) {
        let (part, rest) = left.split_at(count);
        parts.push(part);
        left = rest;
    }
    parts
}
