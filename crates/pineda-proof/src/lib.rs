//! Judges `pineda` by `pineda-oracle`, case by case: what the tests and `cargo xtask prove` have in common.
//!
//! | file | what |
//! | --- | --- |
//! | `settings.rs` | every combination of SIMD level, threads and tile size |
//! | `drawing.rs` | a case drawn: all outputs of a target, and where two drawings differ |
//! | `probe.rs` | the shader that shows its interpolated varyings as a colour |
//! | `coverage.rs` | is every pixel covered as often as the oracle says? |
//! | `conservative.rs` | are those pixels covered that a triangle touches, or covers whole? |
//! | `numbers.rs` | are barycentric coordinates, depth and varyings within their bounds of the exact ones? |
//! | `judge.rs` | all of it for one case: what `prove` runs a hundred million times |
//! | `ulp.rs` | how near do shaders' functions come to the true values? What `cargo xtask ulp` asks of every float |
//!
//! ```
//! use pineda_proof::Judge;
//! let mut judge = Judge::default();
//! for seed in 0..100 {
//!     judge.judge(seed).unwrap();
//! }
//! assert_eq!(judge.tally().cases, 100);
//! ```

mod conservative;
mod coverage;
mod drawing;
mod judge;
mod numbers;
mod probe;
mod settings;
pub mod ulp;

pub use drawing::{Drawing, draw_case, draw_case_with_samples};
pub use judge::{Judge, Tally};
pub use numbers::{BARYCENTRIC_ULPS, DEPTH_ROUNDINGS, VARYING_ROUNDINGS};
pub use probe::{Probe, ProbeVertex, Probed};
pub use settings::{Renderers, every_setting};

/// The README's example is compiled and run with the documented ones.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
