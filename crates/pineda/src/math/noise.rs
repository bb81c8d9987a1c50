//! Random numbers and noise for procedural textures, over lanes: the same bits on every machine.
//!
//! | what | |
//! | --- | --- |
//! | [`hash1`] to [`hash4`] | random integers from one to four integers; [`Uint::to_unit`](crate::Uint::to_unit) makes a float from 0 to 1 of one |
//! | [`gradient2`], [`gradient3`] | Perlin's noise, in the plane and in space; `.._with_slope` with its derivatives |
//! | [`fbm2`], [`fbm3`], [`turbulence3`] | sums of octaves: clouds, wood, marble |
//!
//! Noise is as fine as its argument: p * 8.0 has eight times as many waves. Where a wave is smaller than a pixel it flickers; leave out
//! the octaves for which [`dx` and `dy`](crate::Frag::dx) say so.

pub use super::gradient_noise::{
    fbm2, fbm3, gradient2, gradient2_with_slope, gradient3, gradient3_with_slope, turbulence3,
};
pub use super::hash::{hash1, hash2, hash3, hash4};
