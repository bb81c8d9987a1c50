//! A small generator of random numbers: SplitMix64 (Steele, Lea, Flood 2014), the same on every machine for ever.

/// A stream of random numbers that its seed determines.
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The stream of a seed; seeds that differ in one bit give unrelated streams.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// An integer from `low` to `high`, both included.
    pub fn between(&mut self, low: i64, high: i64) -> i64 {
        low + (self.bits() % (high - low + 1) as u64) as i64
    }

    /// True once in `n` times.
    pub fn one_in(&mut self, n: u64) -> bool {
        self.bits().is_multiple_of(n)
    }

    /// One of the choices.
    pub fn pick<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.between(0, choices.len() as i64 - 1) as usize]
    }

    /// A positive integer whose order of magnitude is random: 1 to 2^`bits`, each doubling as likely as the next.
    pub fn size(&mut self, bits: i64) -> i64 {
        let top = 1 << self.between(1, bits);
        self.between(top / 2, top)
    }

    /// A multiple of 2^-24 in [0, 1).
    pub fn unit(&mut self) -> f32 {
        (self.bits() >> 40) as f32 / (1 << 24) as f32
    }

    /// A float in [`low`, `high`).
    pub fn real(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }

    /// A positive float in [2^`low`, 2^(`high` + 1)), each power of two as likely as the next.
    pub fn magnitude(&mut self, low: i64, high: i64) -> f32 {
        (1.0 + self.unit()) * 2f32.powi(self.between(low, high) as i32)
    }

    /// -1 or 1.
    pub fn sign(&mut self) -> f32 {
        self.pick(&[-1.0, 1.0])
    }
}
