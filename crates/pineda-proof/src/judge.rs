//! One case, from its number to the verdict.

use crate::numbers::{BARYCENTRIC_ULPS, DEPTH_ROUNDINGS, VARYING_ROUNDINGS};
use crate::{Renderers, conservative, coverage, draw_case, every_setting, numbers};
use pineda::{Cull, DrawState, FrontFace};
use pineda_oracle::cases::{Case, Random};
use std::fmt;

/// Judges cases and counts what it saw.
#[derive(Debug, Default)]
pub struct Judge {
    renderers: Renderers,
    tally: Tally,
}

/// What was looked at, and the largest errors of numbers; see `numbers.rs` for their units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tally {
    /// Cases.
    pub cases: u64,
    /// Pixels whose coverage was compared.
    pub pixels: u64,
    /// How often one was covered.
    pub hits: u64,
    /// Clip-space cases whose snapped corners are certain, so that every pixel had to be right.
    pub certain: u64,
    /// Pixels of other clip-space cases so near an edge that either answer can be right, and that were not the exact triangle's.
    pub doubtful: u64,
    /// Pixels whose barycentric coordinates, varyings and depth were compared with the exact ones.
    pub numbers: u64,
    /// Pixels of clipped triangles whose barycentric coordinates were.
    pub clipped_numbers: u64,
    /// Drawings that had to be the same bits as another one.
    pub repeats: u64,
    /// Pixels whose conservative coverage was compared, of either kind.
    pub conservative: u64,
    /// The largest error of a barycentric coordinate, in units in the last place.
    pub worst_barycentric: f64,
    /// The largest error of a varying.
    pub worst_varying: f64,
    /// The largest error of a depth.
    pub worst_depth: f64,
}

impl Tally {
    /// Adds what another judge saw.
    pub fn add(&mut self, other: &Self) {
        self.cases += other.cases;
        self.pixels += other.pixels;
        self.hits += other.hits;
        self.certain += other.certain;
        self.doubtful += other.doubtful;
        self.numbers += other.numbers;
        self.clipped_numbers += other.clipped_numbers;
        self.repeats += other.repeats;
        self.conservative += other.conservative;
        self.worst_barycentric = self.worst_barycentric.max(other.worst_barycentric);
        self.worst_varying = self.worst_varying.max(other.worst_varying);
        self.worst_depth = self.worst_depth.max(other.worst_depth);
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { cases, pixels, hits, certain, doubtful, numbers, clipped_numbers, repeats, conservative, .. } = self;
        writeln!(f, "{cases} cases, {pixels} pixels covered {hits} times in all")?;
        writeln!(f, "{repeats} drawings repeated with other settings and another order of the corners: the same bits")?;
        writeln!(
            f,
            "{certain} clip-space cases with certain corners; of the others, {doubtful} pixels too near an edge to say"
        )?;
        writeln!(
            f,
            "{numbers} pixels' numbers compared with the exact ones, and {clipped_numbers} of clipped triangles"
        )?;
        writeln!(f, "{conservative} pixels' conservative coverage compared with the exact one")?;
        let (b, v, z) = (self.worst_barycentric, self.worst_varying, self.worst_depth);
        write!(f, "largest errors: barycentric coordinates {b:.2} ulp of {BARYCENTRIC_ULPS:.0}; ")?;
        write!(f, "varyings {v:.2} roundings of {VARYING_ROUNDINGS:.0}; depth {z:.2} of {DEPTH_ROUNDINGS:.0}")
    }
}

impl Judge {
    /// What has been seen so far.
    pub fn tally(&self) -> &Tally {
        &self.tally
    }

    /// Draws a case and compares it with the oracle; draws it again with other settings and with the corners in another order, which must
    /// give the same bits; every fiftieth time with all settings; every fourth time with each culling; and every eighth time
    /// conservatively.
    ///
    /// # Errors
    /// What is wrong, and the case.
    pub fn judge(&mut self, seed: u64) -> Result<(), String> {
        let case = Case::from_seed(seed);
        // `seed` alone would give each family always the same settings.
        let mut random = Random::new(seed ^ 0x5e77_1265);
        self.tally.cases += 1;
        self.judge_case(&case, &mut random).map_err(|problem| format!("{problem}\n{case}"))
    }

    fn judge_case(&mut self, case: &Case, random: &mut Random) -> Result<(), String> {
        let (renderers, tally) = (&mut self.renderers, &mut self.tally);
        let first = random.bits();
        let drawing = draw_case(renderers.nth(first), case, 0, DrawState::default())?;
        coverage::judge(case, &drawing, tally)?;
        numbers::judge(case, &drawing, tally)?;

        let all = random.one_in(50);
        for k in 0..if all { renderers.count() } else { 1 } {
            let (settings, order) = (if all { k } else { random.bits() }, 1 + random.bits() % 5);
            let repeat = draw_case(renderers.nth(settings), case, order as usize, DrawState::default())?;
            tally.repeats += 1;
            if let Some(difference) = drawing.difference(&repeat) {
                let [a, b] = [first, settings].map(|n| every_setting()[(n % renderers.count()) as usize].clone());
                return Err(format!("{a:?} with order 0 and {b:?} with order {order} differ: {difference}"));
            }
        }
        if random.one_in(4) {
            let front_face = random.pick(&[FrontFace::Clockwise, FrontFace::CounterClockwise]);
            let (settings, order) = (random.bits(), random.between(0, 5) as usize);
            let mut culled = |cull| {
                draw_case(renderers.nth(settings), case, order, DrawState { cull, front_face, ..DrawState::default() })
            };
            let (backs, fronts) = (culled(Cull::Front)?, culled(Cull::Back)?);
            let sums = backs.hits.iter().zip(&fronts.hits).map(|(back, front)| back + front);
            if let Some(at) = sums.zip(&drawing.hits).position(|(sum, &all)| sum != all) {
                let hits = [backs.hits[at], fronts.hits[at], drawing.hits[at]];
                return Err(format!("pixel {at}: back faces, front faces and all hit it {hits:?} times"));
            }
        }
        if random.one_in(8) {
            conservative::judge(case, &drawing, renderers, random, tally)?;
        }
        Ok(())
    }
}
