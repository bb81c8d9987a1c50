//! *How* to draw, kept apart from *what*: nothing here changes a bit of any output.

use crate::Error;
use fearless_simd::Level;
use std::fmt;
use std::str::FromStr;

/// How a [`Renderer`](crate::Renderer) goes about its work. No setting changes a bit of what is drawn.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Settings {
    /// The SIMD level; [`Simd::Auto`] takes the best that this CPU has.
    pub simd: Simd,
    /// Threads to draw with, the calling one included; 0 takes as many as there are cores.
    pub threads: usize,
    /// The side of the square tiles that a picture is cut into.
    pub tile: TileSize,
    /// Bytes of working memory for geometry. A pass that needs more is drawn in several flushes, with the same result.
    pub memory: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self { simd: Simd::Auto, threads: 0, tile: TileSize::T64, memory: 512 << 20 }
    }
}

impl Settings {
    /// The number of threads after 0 has been replaced by the number of cores; between 1 and 256.
    pub(crate) fn thread_count(&self) -> usize {
        let threads = match self.threads {
            0 => std::thread::available_parallelism().map_or(1, usize::from),
            n => n,
        };
        threads.clamp(1, 256)
    }
}

/// The side of a tile in pixels. 64 is the quickest almost always; the others exist to prove that it does not matter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum TileSize {
    /// 16 x 16 pixels.
    T16,
    /// 32 x 32 pixels.
    T32,
    /// 64 x 64 pixels.
    #[default]
    T64,
}

impl TileSize {
    /// Every size.
    pub const ALL: [Self; 3] = [Self::T16, Self::T32, Self::T64];

    /// log2 of the side.
    pub(crate) fn log2(self) -> u32 {
        match self {
            Self::T16 => 4,
            Self::T32 => 5,
            Self::T64 => 6,
        }
    }
}

/// A set of vector instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Simd {
    /// The best that this CPU has.
    #[default]
    Auto,
    /// No vector instructions: plain Rust on arrays, and none of the ways that are there for speed alone, so that the other levels have something to be compared with. Shaders are not compiled for it on
    /// x86-64 and ARM; their stages run at the baseline there.
    Scalar,
    /// x86-64's baseline, for CPUs of before 2008; none of the ways that are there for speed alone.
    Sse2,
    /// x86-64-v2. Shaders are not compiled for it either: they do without its rounding, selecting and multiplying.
    Sse4_2,
    /// x86-64-v3.
    Avx2,
    /// AVX-512 as Ice Lake and Zen 4 have it.
    Avx512,
    /// 64-bit ARM's baseline.
    Neon,
    /// WebAssembly's 128-bit vectors, chosen when the module is built.
    Simd128,
}

impl Simd {
    /// Every name, whether this machine has it or not.
    pub const ALL: [Self; 8] =
        [Self::Auto, Self::Scalar, Self::Sse2, Self::Sse4_2, Self::Avx2, Self::Avx512, Self::Neon, Self::Simd128];

    /// The levels that this CPU and this build have, [`Simd::Auto`] left out; the best one last.
    #[must_use]
    pub fn available() -> Vec<Self> {
        Self::ALL.into_iter().filter(|&simd| simd != Self::Auto && simd.level().is_some()).collect()
    }

    pub(crate) fn require(self) -> Result<Level, Error> {
        self.level().ok_or_else(|| Error::SimdUnavailable { asked: self, available: Self::available() })
    }

    fn level(self) -> Option<Level> {
        let best = Level::new();
        match self {
            Self::Auto => Some(best),
            Self::Scalar => Some(Level::fallback()),
            #[cfg(target_arch = "x86_64")]
            Self::Sse2 => best.as_sse2().map(Level::Sse2),
            #[cfg(target_arch = "x86_64")]
            Self::Sse4_2 => best.as_sse4_2().map(Level::Sse4_2),
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => best.as_avx2().map(Level::Avx2),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => best.as_avx512().map(Level::Avx512),
            #[cfg(target_arch = "aarch64")]
            Self::Neon => best.as_neon().map(Level::Neon),
            #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
            Self::Simd128 => best.as_wasm_simd128().map(Level::WasmSimd128),
            _ => None,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Scalar => "scalar",
            Self::Sse2 => "sse2",
            Self::Sse4_2 => "sse4.2",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
            Self::Neon => "neon",
            Self::Simd128 => "simd128",
        }
    }
}

impl fmt::Display for Simd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// The name is not one of [`Simd`]'s.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is not a SIMD level; the levels are auto, scalar, sse2, sse4.2, avx2, avx512, neon, simd128")]
pub struct UnknownSimd(pub String);

impl FromStr for Simd {
    type Err = UnknownSimd;

    fn from_str(name: &str) -> Result<Self, UnknownSimd> {
        Self::ALL.into_iter().find(|simd| simd.name() == name).ok_or_else(|| UnknownSimd(name.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_back() {
        for simd in Simd::ALL {
            assert_eq!(simd.to_string().parse(), Ok(simd));
        }
        assert!("sse3".parse::<Simd>().is_err());
    }

    #[test]
    fn scalar_is_always_there_and_a_foreign_level_is_an_error() {
        assert!(Simd::available().contains(&Simd::Scalar));
        let foreign = if cfg!(target_arch = "aarch64") { Simd::Avx2 } else { Simd::Neon };
        assert!(matches!(foreign.require(), Err(Error::SimdUnavailable { .. })));
    }
}
