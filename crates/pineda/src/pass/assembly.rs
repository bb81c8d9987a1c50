//! Primitive assembly: which vertices make the triangles of strips and fans, of 8 and 16 bit indices, of instances.
//!
//! What comes after it knows lists of three places only; a list of 32 bit indices is one already. All else is turned into such a list, the stretch of a batch at a
//! time. A triangle's provoking vertex comes first in it, which turns the triangle round and changes nothing else.
//!
//! Triangles are counted. Without restarts, triangle i ends at the vertex with the number 3 i + 2 or i + 2 of the row; where there are restarts, a
//! table of every [`STRETCH`] indices says how many triangles end before, and where the strip began that goes on.

use super::draw_call::DrawCall;
use super::{Indices, PrimitiveTopology, ProvokingVertex};
use std::ops::Range;

/// Indices between two entries of the table of restarts.
pub(crate) const STRETCH: usize = 1 << 12;

/// How a draw's vertices make triangles.
#[derive(Clone, Copy)]
pub(crate) struct Assembly<'p> {
    pub(crate) indices: Indices<'p>,
    pub(crate) topology: PrimitiveTopology,
    pub(crate) provoking: ProvokingVertex,
    /// Whether the largest index means a restart.
    pub(crate) restarts: bool,
}

/// A stretch of indices in which strips or fans may end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Stretch {
    /// How many triangles end before it.
    triangles: usize,
    /// Where the strip or fan begins that goes on in it.
    start: usize,
}

/// What a stretch's own indices say of it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct StretchSummary {
    /// Its first and last restart.
    restarts: Option<[usize; 2]>,
    /// How many triangles end after the first one.
    triangles_after: usize,
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
        Self { indices, topology: state.topology, provoking: state.provoking_vertex, restarts }
    }

    /// Whether triangle i is row 3 i, 3 i + 1, 3 i + 2, in the order that the rest wants.
    pub(crate) fn is_plain_list(&self) -> bool {
        self.topology == PrimitiveTopology::TriangleList && self.provoking == ProvokingVertex::First
    }

    /// Triangles `first` on, as many as `out` holds: the places of their vertices, of which vertex `first_vertex` has the first.
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
            topology => {
                let is_fan = topology == PrimitiveTopology::TriangleFan;
                let mut walk = Ends::from(row, stretches, first);
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

    /// The smallest and largest vertex of `count` triangles from `first` on; there must be one.
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

    /// The part of the row that some triangles come from, and the first vertex of a fan, which may lie before it.
    fn places<R: Row>(&self, row: R, stretches: &[Stretch], first: usize, count: usize) -> (Range<usize>, usize) {
        let is_fan = self.topology == PrimitiveTopology::TriangleFan;
        if self.topology == PrimitiveTopology::TriangleList {
            return (3 * first..3 * (first + count), 3 * first);
        }
        let skipped = if is_fan { 1 } else { 2 };
        if !self.restarts {
            return (first + 2 - skipped..first + count + 2, if is_fan { 0 } else { first });
        }
        let mut walk = Ends::from(row, stretches, first);
        let begin = walk.next(row) - skipped;
        let hub = if is_fan { walk.start } else { begin };
        let last = Ends::from(row, stretches, first + count - 1).next(row);
        (begin..last + 1, hub)
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

/// Goes through a row with restarts, from the end of one triangle to the end of the next.
struct Ends {
    /// Where the strip or fan began.
    start: usize,
    /// The next place to look at.
    at: usize,
}

impl Ends {
    /// Before the end of triangle `number`.
    fn from<R: Row>(row: R, stretches: &[Stretch], number: usize) -> Self {
        let after = stretches.partition_point(|stretch| stretch.triangles <= number);
        let stretch = stretches[after - 1];
        let mut this = Self { start: stretch.start, at: (after - 1) * STRETCH };
        for _ in stretch.triangles..number {
            this.next(row);
        }
        this
    }

    /// The place of the next triangle's last vertex. There must be one.
    #[inline(always)]
    fn next<R: Row>(&mut self, row: R) -> usize {
        loop {
            let at = self.at;
            self.at += 1;
            if row.at(at) == R::RESTART {
                self.start = self.at;
            } else if at >= self.start + 2 {
                return at;
            }
        }
    }
}

/// Looks for restarts in a stretch that begins at `first`; and its smallest and largest index.
pub(crate) fn summarize<R: Row>(row: R, places: Range<usize>) -> (StretchSummary, u32, u32) {
    let mut summary = StretchSummary::default();
    let (mut low, mut high) = (u32::MAX, 0);
    for at in places {
        let index = row.at(at);
        if index == R::RESTART {
            summary.restarts = Some([summary.restarts.map_or(at, |[first, _]| first), at]);
        } else {
            (low, high) = (low.min(index), high.max(index));
            summary.triangles_after += usize::from(summary.restarts.is_some_and(|[_, last]| at > last + 2));
        }
    }
    (summary, low, high)
}

/// The table of the stretches of a row of `length`, and how many triangles there are.
pub(crate) fn stretches(summaries: &[StretchSummary], length: usize) -> (Vec<Stretch>, usize) {
    let mut next = Stretch::default();
    let mut table = Vec::with_capacity(summaries.len());
    for (k, summary) in summaries.iter().enumerate() {
        table.push(next);
        let (begin, end) = (k * STRETCH, length.min((k + 1) * STRETCH));
        let goes_on_until = summary.restarts.map_or(end, |[first, _]| first);
        next.triangles += goes_on_until.saturating_sub(begin.max(next.start + 2)) + summary.triangles_after;
        if let Some([_, last]) = summary.restarts {
            next.start = last + 1;
        }
    }
    (table, next.triangles)
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
        };
        let count = match topology {
            PrimitiveTopology::TriangleList => v.len() / 3,
            _ => v.len().saturating_sub(2),
        };
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
    fn triangles_are_those_of_the_book() {
        for row in rows() {
            let summaries: Vec<_> = (0..row.len())
                .step_by(STRETCH)
                .map(|at| summarize(row.as_slice(), at..row.len().min(at + STRETCH)).0)
                .collect();
            let (table, count) = stretches(&summaries, row.len());
            for topology in [PrimitiveTopology::TriangleStrip, PrimitiveTopology::TriangleFan] {
                for provoking in [ProvokingVertex::First, ProvokingVertex::Last] {
                    let parts = row.split(|&index| index == u32::MAX);
                    let expected: Vec<_> = parts.flat_map(|part| by_the_book(part, topology, provoking)).collect();
                    assert_eq!(count, expected.len());
                    let assembly = Assembly { indices: Indices::U32(&row), topology, provoking, restarts: true };
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
        for topology in
            [PrimitiveTopology::TriangleList, PrimitiveTopology::TriangleStrip, PrimitiveTopology::TriangleFan]
        {
            for provoking in [ProvokingVertex::First, ProvokingVertex::Last] {
                let expected = by_the_book(&row, topology, provoking);
                for indices in [Indices::Sequential, Indices::U8(&bytes), Indices::U16(&shorts), Indices::U32(&row)] {
                    let assembly = Assembly { indices, topology, provoking, restarts: false };
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
