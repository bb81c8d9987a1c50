//! Ear clipping (Meisters 1975): cut off a corner whose triangle lies inside the polygon, until three are left.
//!
//! ```text
//!     d ______ c          Corner c is an ear: b, c, d turns left, and no corner of the rest is in the triangle.
//!      |     /            Corner b is not: it turns right. Only such corners (and those that go straight on) can be
//!      |   / b            in a triangle that turns left, so only they are looked at: the blockers.
//!      |   \
//!      |_____\ a
//! ```
//!
//! Blockers are kept in a grid over the polygon's box, about one a cell, so that a small ear asks a few of them: close
//! to n steps for n corners in place of n^2. A corner that goes straight on is never an ear, since its triangle has no
//! area, but it keeps others from being one, so no triangle's edge runs past it.
//!
//! Corners at the same place as one of the triangle's own do not block: polygons with holes are written with a bridge
//! that is walked both ways.
//!
//! A polygon that crosses itself can run out of ears. Then what is left of it loses a corner without area, or else any
//! corner, and the search goes on: n - 2 triangles in every case.

use super::flatten::{Point, area_x2};

/// Scratch memory, reused from one polygon to the next.
#[derive(Default)]
pub(super) struct EarClipper {
    previous: Vec<u32>,
    next: Vec<u32>,
    turn: Vec<Turn>,
    grid: Grid,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Turn {
    Left,
    Straight,
    Right,
    /// Not in the polygon any more.
    Gone,
}

/// What is cut off when there are no ears: tried in this order.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Patience {
    Ears,
    Straight,
    Anything,
}

impl EarClipper {
    /// Cuts the counter-clockwise polygon `points` (four corners or more) into triangles. `false` if `steps` ran out
    /// and the rest was cut as a fan.
    pub(super) fn clip(&mut self, points: &[Point], steps: &mut u64, mut emit: impl FnMut([u32; 3])) -> bool {
        self.start(points);
        let mut left = points.len();
        let mut corner = 0;
        let mut since_cut = 0;
        let mut patience = Patience::Ears;
        while left > 3 {
            let (before, after) = (self.previous[corner as usize], self.next[corner as usize]);
            *steps = steps.saturating_sub(1);
            if *steps == 0 {
                self.fan(corner, left, emit);
                return false;
            }
            let cut = match patience {
                Patience::Ears => self.is_ear(points, corner, steps),
                Patience::Straight => self.turn[corner as usize] == Turn::Straight,
                Patience::Anything => true,
            };
            if cut {
                emit([before, corner, after]);
                self.cut(points, corner);
                left -= 1;
                since_cut = 0;
                patience = Patience::Ears;
                // Going on behind the neighbour makes fewer slivers than eating along one side.
                corner = self.next[after as usize];
                continue;
            }
            since_cut += 1;
            corner = after;
            if since_cut == left {
                since_cut = 0;
                patience = if patience == Patience::Ears { Patience::Straight } else { Patience::Anything };
            }
        }
        self.fan(corner, left, emit);
        true
    }

    fn start(&mut self, points: &[Point]) {
        let n = points.len() as u32;
        self.previous.clear();
        self.previous.extend((0..n).map(|i| if i == 0 { n - 1 } else { i - 1 }));
        self.next.clear();
        self.next.extend((0..n).map(|i| if i + 1 == n { 0 } else { i + 1 }));
        self.turn.clear();
        self.turn.resize(points.len(), Turn::Gone);
        for i in 0..n {
            self.turn[i as usize] = self.turn_at(points, i);
        }
        let turn = &self.turn;
        self.grid.start(points, (0..n).filter(|&i| turn[i as usize] != Turn::Left));
    }

    fn turn_at(&self, points: &[Point], corner: u32) -> Turn {
        let [a, b, c] = self.triangle_at(points, corner);
        let area = area_x2(a, b, c);
        if area > 0.0 {
            Turn::Left
        } else if area == 0.0 {
            Turn::Straight
        } else {
            Turn::Right
        }
    }

    fn triangle_at(&self, points: &[Point], corner: u32) -> [Point; 3] {
        [self.previous[corner as usize], corner, self.next[corner as usize]].map(|i| points[i as usize])
    }

    fn is_ear(&self, points: &[Point], corner: u32, steps: &mut u64) -> bool {
        if self.turn[corner as usize] != Turn::Left {
            return false;
        }
        let triangle = self.triangle_at(points, corner);
        let blocks = |i: u32| {
            let blocker = matches!(self.turn[i as usize], Turn::Straight | Turn::Right);
            blocker && is_inside(points[i as usize], triangle)
        };
        !self.grid.any(triangle, steps, blocks)
    }

    fn cut(&mut self, points: &[Point], corner: u32) {
        let (before, after) = (self.previous[corner as usize], self.next[corner as usize]);
        self.next[before as usize] = after;
        self.previous[after as usize] = before;
        self.turn[corner as usize] = Turn::Gone;
        for neighbour in [before, after] {
            // The angle at a neighbour only shrinks, so nothing becomes a blocker that the grid does not know.
            self.turn[neighbour as usize] = self.turn_at(points, neighbour);
        }
    }

    fn fan(&self, corner: u32, left: usize, mut emit: impl FnMut([u32; 3])) {
        let mut second = self.next[corner as usize];
        for _ in 2..left {
            let third = self.next[second as usize];
            emit([corner, second, third]);
            second = third;
        }
    }
}

/// In the closed triangle, but not on one of its corners.
fn is_inside(p: Point, [a, b, c]: [Point; 3]) -> bool {
    p != a && p != b && p != c && area_x2(a, b, p) >= 0.0 && area_x2(b, c, p) >= 0.0 && area_x2(c, a, p) >= 0.0
}

/// Points in square cells, in a list per cell.
#[derive(Default)]
struct Grid {
    min: Point,
    cells_per_unit: Point,
    side: usize,
    first: Vec<u32>,
    following: Vec<u32>,
}

impl Grid {
    const NONE: u32 = u32::MAX;

    fn start(&mut self, points: &[Point], members: impl Iterator<Item = u32> + Clone) {
        let [mut min, mut max] = [points[0]; 2];
        for p in points {
            for axis in 0..2 {
                min[axis] = if p[axis] < min[axis] { p[axis] } else { min[axis] };
                max[axis] = if p[axis] > max[axis] { p[axis] } else { max[axis] };
            }
        }
        self.side = (members.clone().count().isqrt()).max(1);
        self.min = min;
        self.cells_per_unit = std::array::from_fn(|axis| {
            let per_unit = self.side as f64 / (max[axis] - min[axis]);
            if per_unit.is_finite() { per_unit } else { 0.0 }
        });
        self.first.clear();
        self.first.resize(self.side * self.side, Self::NONE);
        self.following.clear();
        self.following.resize(points.len(), Self::NONE);
        for i in members {
            let [column, row] = self.cell(points[i as usize]);
            let first = &mut self.first[row * self.side + column];
            self.following[i as usize] = *first;
            *first = i;
        }
    }

    fn cell(&self, p: Point) -> [usize; 2] {
        // A cast to an integer saturates, also for NaN.
        std::array::from_fn(|axis| {
            (((p[axis] - self.min[axis]) * self.cells_per_unit[axis]) as usize).min(self.side - 1)
        })
    }

    /// Whether `test` holds for any member in the cells that the triangle's box touches. Each cell and member is a step.
    fn any(&self, triangle: [Point; 3], steps: &mut u64, test: impl Fn(u32) -> bool) -> bool {
        let cells = triangle.map(|p| self.cell(p));
        let range = |axis: usize| {
            let on_axis = cells.map(|cell| cell[axis]);
            on_axis[0].min(on_axis[1]).min(on_axis[2])..=on_axis[0].max(on_axis[1]).max(on_axis[2])
        };
        let mut taken = 0;
        let mut found = false;
        'cells: for row in range(1) {
            for column in range(0) {
                taken += 1;
                let mut member = self.first[row * self.side + column];
                while member != Self::NONE {
                    taken += 1;
                    if test(member) {
                        found = true;
                        break 'cells;
                    }
                    member = self.following[member as usize];
                }
            }
        }
        *steps = steps.saturating_sub(taken);
        found
    }
}
