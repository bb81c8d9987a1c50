use super::PrimitiveTopology;

/// What became of the triangles, lines and points of a pass.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Statistics {
    /// Triangles that came in, of all instances, whatever is drawn of them.
    pub triangles: u64,
    /// Lines that came in, of all instances.
    pub lines: u64,
    /// Points that came in, of all instances.
    pub points: u64,
    /// Of all these, dropped because a vertex has a NaN or infinite position.
    pub non_finite: u64,
    /// Of those, left out because they lie wholly outside the view volume or the guard band.
    pub outside: u64,
    /// Of those, cut by the near plane, the far plane or the guard band, or with a w beyond 2^64 or 2^-64: these take a slower way.
    pub clipped: u64,
    /// How many times what had been collected was drawn before the pass went on: 1 unless its geometry is larger
    /// than [`Settings::memory`](crate::Settings::memory).
    pub flushes: u64,
}

impl Statistics {
    pub(crate) fn add(&mut self, other: &Self) {
        self.triangles += other.triangles;
        self.lines += other.lines;
        self.points += other.points;
        self.non_finite += other.non_finite;
        self.outside += other.outside;
        self.clipped += other.clipped;
        self.flushes += other.flushes;
    }

    /// Counts primitives by the numbers that they have, `each` of them; one counts where its first number does.
    pub(crate) fn count(&mut self, topology: PrimitiveTopology, first: usize, end: usize, each: usize) {
        let count = (end.div_ceil(each) - first.div_ceil(each)) as u64;
        match topology {
            PrimitiveTopology::PointList => self.points += count,
            _ if topology.is_of_lines() => self.lines += count,
            _ => self.triangles += count,
        }
    }
}
