//! Primitive assembly: which vertices make the triangles of strips and fans, which make lines and points, of 8 and 16 bit indices, of instances.
//!
//! What comes after it knows lists of three places only; a list of 32 bit indices is one already. All else is turned into such a list, the stretch of a batch at a
//! time. A triangle's provoking vertex comes first in it, which turns the triangle round and changes nothing else. A line is its start, its end, and
//! its provoking vertex once more; a point is three times its vertex.
//!
//! Primitives are counted. Without restarts, triangle i ends at the vertex with the number 3 i + 2 or i + 2 of the row; where there are restarts, a
//! table of every [`STRETCH`] indices says how many primitives end before, and where the strip began that goes on. The line that closes a loop ends at
//! the restart, or where the row ends.

use super::draw_call::DrawCall;
use super::{Indices, PrimitiveTopology, ProvokingVertex};
use std::ops::Range;

/// Indices between two entries of the table of restarts.
pub(crate) const STRETCH: usize = 1 << 12;

/// How a draw's vertices make primitives.
#[derive(Clone, Copy)]
pub(crate) struct Assembly<'p> {
    pub(crate) indices: Indices<'p>,
    pub(crate) topology: PrimitiveTopology,
    pub(crate) provoking: ProvokingVertex,
    /// Whether the largest index means a restart.
    pub(crate) restarts: bool,
    /// Of the row.
    pub(crate) length: usize,
}

/// A stretch of indices in which strips, fans or loops may end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Stretch {
    /// How many primitives end before it.
    primitives: usize,
    /// Where the strip, fan or loop begins that goes on in it.
    start: usize,
}

/// What a stretch's own indices say of it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct StretchSummary {
    /// Its first and last restart.
    restarts: Option<[usize; 2]>,
    /// How many primitives end after the first one.
    primitives_after: usize,
}

/// What the primitives of a row with restarts are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Strip {
    /// Vertices of a strip that come before the one where its first primitive ends.
    before: usize,
    /// Whether a line from the last vertex to the first closes it.
    closes: bool,
}

impl Strip {
    pub(crate) fn of(topology: PrimitiveTopology) -> Self {
        let before = if topology.is_of_lines() { 1 } else { 2 };
        Self { before, closes: topology == PrimitiveTopology::LineLoop }
    }

    /// Whether a strip from `start` on that ends before `end` is closed by a line.
    fn closes(self, start: usize, end: usize) -> bool {
        self.closes && end >= start + 2
    }
}

/// A row of vertices: what indices name, or the vertices themselves.
pub(crate) trait Row: Copy + Sync {
    /// The index that restarts.
    const RESTART: u32;
    fn at(&self, place: usize) -> u32;
}

impl Row for &[u8] {
    const RESTART: u32 = u8::MAX as u32;
    #[inline(always)]
    fn at(&self, place: usize) -> u32 {
        u32::from(self[place])
    }
}

impl Row for &[u16] {
    const RESTART: u32 = u16::MAX as u32;
    #[inline(always)]
    fn at(&self, place: usize) -> u32 {
        u32::from(self[place])
    }
}

impl Row for &[u32] {
    const RESTART: u32 = u32::MAX;
    #[inline(always)]
    fn at(&self, place: usize) -> u32 {
        self[place]
    }
}

/// Vertices without indices.
#[derive(Clone, Copy)]
struct AllVertices;

impl Row for AllVertices {
    const RESTART: u32 = u32::MAX;
    #[inline(always)]
    fn at(&self, place: usize) -> u32 {
        place as u32
    }
}

/// Evaluates an expression with the row of some indices.
macro_rules! with_row {
    ($indices:expr, $row:ident => $do:expr) => {
        match $indices {
            Indices::Sequential => {
                let $row = AllVertices;
                $do
            }
            Indices::U8($row) => $do,
            Indices::U16($row) => $do,
            Indices::U32($row) => $do,
        }
    };
}

impl<'p> Assembly<'p> {
    pub(crate) fn of(call: &'p (dyn DrawCall + '_)) -> Self {
        let (state, indices) = (call.state(), call.indices());
        let restarts = state.primitive_restart && !matches!(indices, Indices::Sequential);
        let length = match indices {
            Indices::Sequential => call.vertex_count(),
            Indices::U8(indices) => indices.len(),
            Indices::U16(indices) => indices.len(),
            Indices::U32(indices) => indices.len(),
        };
        Self { indices, topology: state.topology, provoking: state.provoking_vertex, restarts, length }
    }

    /// Whether triangle i is row 3 i, 3 i + 1, 3 i + 2, in the order that the rest wants.
    pub(crate) fn is_plain_list(&self) -> bool {
        self.topology == PrimitiveTopology::TriangleList && self.provoking == ProvokingVertex::First
    }

    /// Primitives `first` on, as many as `out` holds: the places of their vertices, of which vertex `first_vertex` has the first.
    pub(crate) fn assemble(&self, stretches: &[Stretch], first: usize, first_vertex: u32, out: &mut [[u32; 3]]) {
        with_row!(self.indices, row => match self.provoking {
            ProvokingVertex::First => self.assemble_row::<_, false>(row, stretches, first, first_vertex, out),
            ProvokingVertex::Last => self.assemble_row::<_, true>(row, stretches, first, first_vertex, out),
        });
    }

    fn assemble_row<R: Row, const LAST: bool>(
        &self,
        row: R,
        stretches: &[Stretch],
        first: usize,
        first_vertex: u32,
        out: &mut [[u32; 3]],
    ) {
        let place = |at: usize| row.at(at).wrapping_sub(first_vertex);
        match self.topology {
            PrimitiveTopology::TriangleList => {
                for (k, triangle) in out.iter_mut().enumerate() {
                    let at = 3 * (first + k);
                    let [a, b, c] = [place(at), place(at + 1), place(at + 2)];
                    *triangle = if LAST { [c, a, b] } else { [a, b, c] };
                }
            }
            PrimitiveTopology::TriangleStrip if !self.restarts => {
                for (k, triangle) in out.iter_mut().enumerate() {
                    let at = first + k;
                    *triangle = of_strip::<LAST>(at, [place(at), place(at + 1), place(at + 2)]);
                }
            }
            PrimitiveTopology::TriangleFan if !self.restarts => {
                for (k, triangle) in out.iter_mut().enumerate() {
                    let at = first + k;
                    *triangle = of_fan::<LAST>([place(0), place(at + 1), place(at + 2)]);
                }
            }
            PrimitiveTopology::PointList => {
                for (k, point) in out.iter_mut().enumerate() {
                    *point = [place(first + k); 3];
                }
            }
            PrimitiveTopology::LineList => {
                for (k, line) in out.iter_mut().enumerate() {
                    let at = 2 * (first + k);
                    *line = of_line::<LAST>([place(at), place(at + 1)]);
                }
            }
            PrimitiveTopology::LineStrip | PrimitiveTopology::LineLoop if !self.restarts => {
                for (k, line) in out.iter_mut().enumerate() {
                    let end = if first + k + 1 < self.length { first + k + 1 } else { 0 };
                    *line = of_line::<LAST>([place(first + k), place(end)]);
                }
            }
            PrimitiveTopology::LineStrip | PrimitiveTopology::LineLoop => {
                let mut walk = Ends::from(self, row, stretches, first);
                for line in out {
                    let end = walk.next(row);
                    let start = walk.start;
                    let is_last = end == self.length || row.at(end) == R::RESTART;
                    *line = of_line::<LAST>([place(end - 1), if is_last { place(start) } else { place(end) }]);
                }
            }
            topology => {
                let is_fan = topology == PrimitiveTopology::TriangleFan;
                let mut walk = Ends::from(self, row, stretches, first);
                for triangle in out {
                    let end = walk.next(row);
                    let [b, c] = [place(end - 1), place(end)];
                    *triangle = if is_fan {
                        of_fan::<LAST>([place(walk.start), b, c])
                    } else {
                        of_strip::<LAST>(end - walk.start, [place(end - 2), b, c])
                    };
                }
            }
        }
    }

    /// The smallest and largest vertex of `count` primitives from `first` on; there must be one.
    pub(crate) fn reach(&self, stretches: &[Stretch], first: usize, count: usize) -> (u32, u32) {
        with_row!(self.indices, row => self.reach_of_row(row, stretches, first, count))
    }

    fn reach_of_row<R: Row>(&self, row: R, stretches: &[Stretch], first: usize, count: usize) -> (u32, u32) {
        let (places, hub) = self.places(row, stretches, first, count);
        let (mut low, mut high) = if hub < places.start { (row.at(hub), row.at(hub)) } else { (u32::MAX, 0) };
        if matches!(self.indices, Indices::Sequential) {
            return (low.min(places.start as u32), high.max(places.end as u32 - 1));
        }
        for at in places {
            let index = row.at(at);
            let counts = !(self.restarts && index == R::RESTART);
            low = low.min(if counts { index } else { u32::MAX });
            high = high.max(if counts { index } else { 0 });
        }
        (low, high)
    }

    /// The part of the row that some primitives come from, and the first vertex of a fan or loop, which may lie before it.
    fn places<R: Row>(&self, row: R, stretches: &[Stretch], first: usize, count: usize) -> (Range<usize>, usize) {
        let is_fan = self.topology == PrimitiveTopology::TriangleFan;
        let each = match self.topology {
            PrimitiveTopology::TriangleList => 3,
            PrimitiveTopology::LineList => 2,
            PrimitiveTopology::PointList => 1,
            _ => 0,
        };
        if each != 0 {
            return (each * first..each * (first + count), each * first);
        }
        let strip = Strip::of(self.topology);
        let has_hub = is_fan || strip.closes;
        let skipped = if is_fan { 1 } else { strip.before };
        if !self.restarts {
            let places = first + strip.before - skipped..(first + count + strip.before).min(self.length);
            return (places, if has_hub { 0 } else { first });
        }
        let mut walk = Ends::from(self, row, stretches, first);
        let begin = walk.next(row) - skipped;
        let hub = if has_hub { walk.start } else { begin };
        let last = Ends::from(self, row, stretches, first + count - 1).next(row);
        (begin..(last + 1).min(self.length), hub)
    }
}

/// A strip's triangle in the order that its provoking vertex begins; only whether `number` is odd matters.
#[inline(always)]
fn of_strip<const LAST: bool>(number: usize, [a, b, c]: [u32; 3]) -> [u32; 3] {
    let (second, third) = if number.is_multiple_of(2) { (b, c) } else { (c, b) };
    if !LAST {
        [a, second, third]
    } else if number.is_multiple_of(2) {
        [c, a, b]
    } else {
        [c, b, a]
    }
}

/// A fan's triangle in the order that its provoking vertex begins.
#[inline(always)]
fn of_fan<const LAST: bool>([hub, b, c]: [u32; 3]) -> [u32; 3] {
    if LAST { [c, hub, b] } else { [b, c, hub] }
}

/// A line's start and end, and the vertex that provokes.
#[inline(always)]
fn of_line<const LAST: bool>([a, b]: [u32; 2]) -> [u32; 3] {
    [a, b, if LAST { b } else { a }]
}

/// Goes through a row with restarts, from the end of one primitive to the end of the next.
struct Ends {
    /// Where the strip, fan or loop began that the last one is of.
    start: usize,
    /// Where the next begins if there is a restart between.
    begin: usize,
    /// The next place to look at.
    at: usize,
    length: usize,
    strip: Strip,
}

impl Ends {
    /// Before the end of primitive `number`.
    fn from<R: Row>(assembly: &Assembly<'_>, row: R, stretches: &[Stretch], number: usize) -> Self {
        let after = stretches.partition_point(|stretch| stretch.primitives <= number);
        let stretch = stretches[after - 1];
        let mut this = Self {
            start: stretch.start,
            begin: stretch.start,
            at: (after - 1) * STRETCH,
            length: assembly.length,
            strip: Strip::of(assembly.topology),
        };
        for _ in stretch.primitives..number {
            this.next(row);
        }
        this
    }

    /// The place of the next primitive's last vertex; of a line that closes a loop, the place after it. There must be one.
    #[inline(always)]
    fn next<R: Row>(&mut self, row: R) -> usize {
        self.start = self.begin;
        loop {
            let at = self.at;
            self.at += 1;
            if at == self.length || row.at(at) == R::RESTART {
                self.begin = self.at;
                if self.strip.closes(self.start, at) {
                    return at;
                }
                self.start = self.begin;
            } else if at >= self.start + self.strip.before {
                return at;
            }
        }
    }
}

/// Looks for restarts in a stretch that begins at `first`; and its smallest and largest index.
pub(crate) fn summarize<R: Row>(row: R, places: Range<usize>, strip: Strip) -> (StretchSummary, u32, u32) {
    let mut summary = StretchSummary::default();
    let (mut low, mut high) = (u32::MAX, 0);
    for at in places {
        let index = row.at(at);
        if index == R::RESTART {
            summary.primitives_after +=
                usize::from(summary.restarts.is_some_and(|[_, last]| strip.closes(last + 1, at)));
            summary.restarts = Some([summary.restarts.map_or(at, |[first, _]| first), at]);
        } else {
            (low, high) = (low.min(index), high.max(index));
            summary.primitives_after += usize::from(summary.restarts.is_some_and(|[_, last]| at > last + strip.before));
        }
    }
    (summary, low, high)
}

/// The table of the stretches of a row of `length`, and how many primitives there are.
pub(crate) fn stretches(summaries: &[StretchSummary], length: usize, strip: Strip) -> (Vec<Stretch>, usize) {
    let mut next = Stretch::default();
    let mut table = Vec::with_capacity(summaries.len());
    for (k, summary) in summaries.iter().enumerate() {
        table.push(next);
        let (begin, end) = (k * STRETCH, length.min((k + 1) * STRETCH));
        let goes_on_until = summary.restarts.map_or(end, |[first, _]| first);
        next.primitives +=
            goes_on_until.saturating_sub(begin.max(next.start + strip.before)) + summary.primitives_after;
        if let Some([first, last]) = summary.restarts {
            next.primitives += usize::from(strip.closes(next.start, first));
            next.start = last + 1;
        }
    }
    next.primitives += usize::from(strip.closes(next.start, length));
    (table, next.primitives)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What Vulkan's chapter "Primitive Topologies" says, word by word: vertices of triangle i, the provoking one first.
    fn by_the_book(row: &[u32], topology: PrimitiveTopology, provoking: ProvokingVertex) -> Vec<[u32; 3]> {
        let (v, is_last) = (row, provoking == ProvokingVertex::Last);
        let triangle = |i: usize| match topology {
            PrimitiveTopology::TriangleList => ([v[3 * i], v[3 * i + 1], v[3 * i + 2]], [v[3 * i], v[3 * i + 2]]),
            PrimitiveTopology::TriangleStrip => ([v[i], v[i + 1 + i % 2], v[i + 2 - i % 2]], [v[i], v[i + 2]]),
            PrimitiveTopology::TriangleFan => ([v[i + 1], v[i + 2], v[0]], [v[i + 1], v[i + 2]]),
            _ => unreachable!("no triangles"),
        };
        let line = |i: usize| match topology {
            PrimitiveTopology::PointList => [v[i]; 2],
            PrimitiveTopology::LineList => [v[2 * i], v[2 * i + 1]],
            _ => [v[i], v[(i + 1) % v.len()]],
        };
        let count = match topology {
            PrimitiveTopology::TriangleList => v.len() / 3,
            PrimitiveTopology::LineList => v.len() / 2,
            PrimitiveTopology::PointList => v.len(),
            PrimitiveTopology::LineStrip => v.len().saturating_sub(1),
            PrimitiveTopology::LineLoop if v.len() < 2 => 0,
            PrimitiveTopology::LineLoop => v.len(),
            _ => v.len().saturating_sub(2),
        };
        if topology.is_of_lines() || topology == PrimitiveTopology::PointList {
            return (0..count).map(|i| [line(i)[0], line(i)[1], line(i)[usize::from(is_last)]]).collect();
        }
        let turned = |i: usize| {
            let (mut corners, provokes) = triangle(i);
            while corners[0] != provokes[usize::from(is_last)] {
                corners.rotate_left(1);
            }
            corners
        };
        (0..count).map(turned).collect()
    }

    /// Rows of different vertices with restarts here and there, long enough for several stretches.
    fn rows() -> Vec<Vec<u32>> {
        let mut state = 1u32;
        let mut random = |below: u32| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) % below
        };
        let mut rows = vec![vec![], vec![0], vec![0, 1], vec![u32::MAX; 5], (0..3 * STRETCH as u32).collect()];
        for often in [2, 4, 30, 3_000, 20_000] {
            for length in [7, 100, STRETCH as u32 - 1, 3 * STRETCH as u32 + random(100)] {
                let index = |at| if random(often) == 0 { u32::MAX } else { at };
                rows.push((0..length).map(index).collect());
            }
        }
        rows
    }

    #[test]
    fn primitives_are_those_of_the_book() {
        for row in rows() {
            for topology in PrimitiveTopology::ALL.into_iter().filter(|topology| !topology.is_list()) {
                let strip = Strip::of(topology);
                let summaries: Vec<_> = (0..row.len())
                    .step_by(STRETCH)
                    .map(|at| summarize(row.as_slice(), at..row.len().min(at + STRETCH), strip).0)
                    .collect();
                let (table, count) = stretches(&summaries, row.len(), strip);
                for provoking in [ProvokingVertex::First, ProvokingVertex::Last] {
                    let parts = row.split(|&index| index == u32::MAX);
                    let expected: Vec<_> = parts.flat_map(|part| by_the_book(part, topology, provoking)).collect();
                    assert_eq!(count, expected.len());
                    let (indices, length) = (Indices::U32(&row), row.len());
                    let assembly = Assembly { indices, topology, provoking, restarts: true, length };
                    for first in (0..count).step_by(1 + count / 7) {
                        let mut found = vec![[0; 3]; (count - first).min(5_000)];
                        assembly.assemble(&table, first, 0, &mut found);
                        let expected = &expected[first..first + found.len()];
                        assert!(found == expected, "{topology:?} {provoking:?} from {first}");
                        let all = || expected.as_flattened().iter().copied();
                        let (low, high) = assembly.reach(&table, first, found.len());
                        assert!(low <= all().min().unwrap_or(0) && high >= all().max().unwrap_or(0));
                    }
                }
            }
        }
    }

    #[test]
    fn rows_without_restarts_are_the_same_by_any_name() {
        let row: Vec<u32> = (0..252).collect();
        let bytes: Vec<u8> = (0..252).collect();
        let shorts: Vec<u16> = (0..252).collect();
        for topology in PrimitiveTopology::ALL {
            for provoking in [ProvokingVertex::First, ProvokingVertex::Last] {
                let expected = by_the_book(&row, topology, provoking);
                for indices in [Indices::Sequential, Indices::U8(&bytes), Indices::U16(&shorts), Indices::U32(&row)] {
                    let assembly = Assembly { indices, topology, provoking, restarts: false, length: 252 };
                    for first in [0, 1, 13, expected.len() - 1] {
                        let mut found = vec![[0; 3]; expected.len() - first];
                        assembly.assemble(&[], first, 0, &mut found);
                        assert_eq!(found, expected[first..]);
                        let all = || expected[first..].as_flattened().iter().copied();
                        let reach = (all().min().unwrap_or(0), all().max().unwrap_or(0));
                        assert_eq!(assembly.reach(&[], first, found.len()), reach, "{topology:?} {indices:?}");
                    }
                }
            }
        }
    }
}
