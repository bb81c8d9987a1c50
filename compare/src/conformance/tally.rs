//! What a group of cases came to.

use std::collections::BTreeMap;
use std::fmt;

/// Differences that are shown in full, of each group.
const SHOWN: usize = 3;

/// A row of the table of differences in docs/conformance.md.
#[derive(Clone, Copy, Debug, Eq, Ord, PartialEq, PartialOrd)]
pub(crate) enum Row {
    Border,
    BiasUnit,
    MasksOfZero,
    EightBitBlending,
    SrgbPolynomial,
    ThinLines,
    LineCorners,
    AlphaToCoverage,
    LineBounds,
    EightBitFiltering,
    LinearLogarithm,
    Quads,
}

impl Row {
    /// As it stands in the table.
    pub(crate) fn as_str(self) -> &'static str {
        match self {
            Self::Border => "border",
            Self::BiasUnit => "bias unit",
            Self::MasksOfZero => "masks of 0",
            Self::EightBitBlending => "8-bit blending",
            Self::SrgbPolynomial => "sRGB polynomial",
            Self::ThinLines => "thin lines",
            Self::LineCorners => "line corners",
            Self::AlphaToCoverage => "alpha to coverage",
            Self::LineBounds => "line bounds",
            Self::EightBitFiltering => "8-bit filtering",
            Self::LinearLogarithm => "linear logarithm",
            Self::Quads => "quads",
        }
    }
}

/// Counts of one group.
#[derive(Debug, Default)]
pub(crate) struct Tally {
    pub(crate) cases: u64,
    pub(crate) pixels: u64,
    /// Of these, the ones to which `pineda` drew.
    pub(crate) drawn: u64,
    /// The largest difference that was allowed: a part of what is allowed.
    pub(crate) worst: f64,
    pub(crate) explained: BTreeMap<Row, u64>,
    pub(crate) unexplained: u64,
    /// The first difference of each row, and the first ones that have none.
    pub(crate) examples: Vec<(Option<Row>, String)>,
}

impl Tally {
    /// Of the columns that [`fmt::Display`] writes.
    pub(crate) const HEADINGS: &str = "   cases      pixels       drawn  unexplained  of allowed   explained";

    /// A pixel that differs by more than is allowed. `row` explains it, if one does.
    pub(crate) fn differs(&mut self, row: Option<Row>, describe: impl FnOnce() -> String) {
        match row {
            Some(row) => *self.explained.entry(row).or_default() += 1,
            None => self.unexplained += 1,
        }
        let is_new = row.is_none_or(|row| self.explained[&row] == 1);
        let shown = self.examples.iter().filter(|(row, _)| row.is_none()).count();
        if is_new && (row.is_some() || shown < SHOWN) {
            self.examples.push((row, format!("{}: {}", row.map_or("unexplained", Row::as_str), describe())));
        }
    }

    /// A pixel that differs by no more than is allowed: by this part of it.
    pub(crate) fn allow(&mut self, part: f64) {
        self.worst = self.worst.max(part);
    }

    /// Adds what a group came to.
    pub(crate) fn add(&mut self, other: Self, name: &str) {
        self.cases += other.cases;
        self.pixels += other.pixels;
        self.drawn += other.drawn;
        self.worst = self.worst.max(other.worst);
        self.unexplained += other.unexplained;
        for (row, count) in other.explained {
            *self.explained.entry(row).or_default() += count;
        }
        let named = |(row, example)| (row, format!("{name}: {example}"));
        self.examples.extend(other.examples.into_iter().map(named));
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { cases, pixels, drawn, worst, unexplained, .. } = self;
        let explained: Vec<_> = self.explained.iter().map(|(row, count)| format!("{count} {}", row.as_str())).collect();
        let explained = if explained.is_empty() { "0".to_owned() } else { explained.join(", ") };
        write!(f, "{cases:>8} {pixels:>11} {drawn:>11} {unexplained:>12} {worst:>11.3}   {explained}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_is_in_the_table() {
        let table = include_str!("../../../docs/conformance.md");
        for row in [
            Row::Border,
            Row::BiasUnit,
            Row::MasksOfZero,
            Row::EightBitBlending,
            Row::SrgbPolynomial,
            Row::ThinLines,
            Row::LineCorners,
            Row::AlphaToCoverage,
            Row::LineBounds,
            Row::EightBitFiltering,
            Row::LinearLogarithm,
            Row::Quads,
        ] {
            assert!(table.contains(&format!("| {} |", row.as_str())), "{row:?}");
        }
    }
}
