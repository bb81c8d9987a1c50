//! Sixteen lanes: `fearless_simd`'s vectors where the level has vector instructions, loops over arrays where it has none.
//!
//! `fearless_simd`'s `Fallback` level spells its sixteen lanes out. That is so much code that LLVM's time grows with the square
//! of a function's length: one `powf` took 40 s to compile, and of the 150 s that this crate took, 110 were the kernels at that
//! one level. As loops over arrays they take a few. (LLVM makes vectors of the loops at whatever level the target has; the bits
//! are the same.)
//!
//! The types have the names and the methods of those that they stand for, as far as they are used here. Which of the two
//! ways an operation takes is a constant of its level ([`Simd::IS_PLAIN`]), so the other one is never compiled. Integers wrap around.

#![allow(
    clippy::redundant_closure_call,
    clippy::suspicious_arithmetic_impl,
    reason = "the plain side of an operation is a closure, so that it is a function of its own, with a loop's counter in it"
)]

#[macro_use]
mod plain;
#[macro_use]
mod operator;
mod float;
mod int;
mod level;
mod mask;

pub(crate) use float::{f32x16, f64x8, f64x16};
pub(crate) use int::{i32x16, i64x8, u32x4, u32x8, u32x16};
pub(crate) use level::{Simd, dispatch, dispatch_shader};
pub(crate) use mask::{Words, mask32x16};
