//! The attribute and the derive that [`pineda`](https://docs.rs/pineda) shaders are written with. `pineda` exports
//! both: depend on that crate, not on this one.

mod shader;
mod varyings;

use proc_macro::TokenStream;

/// Makes shader code fit for SIMD: every function inside becomes `#[inline(always)]`.
///
/// It goes above `impl Shader for X`, above any other `impl`, above a function that a fragment stage calls, or above a
/// whole inline `mod`. A function that is not inlined is compiled without the instructions of the SIMD level that the
/// caller runs at: the picture is the same, but it takes several times as long. On `impl Shader for X` the attribute
/// is required, and leaving it out is an error; nothing can notice a helper function that lacks it.
///
/// `#[shader(apart)]` above a function that is long, or called from several places, makes a function of its own of it,
/// which has the level's instructions all the same: the compiler's time grows with the square of the length of what is
/// inlined into one another. A call costs a few nanoseconds for sixteen fragments. The first argument says at which
/// level: a number, a vector, the fragment. Where it cannot, name another: `#[shader(apart(normal))]`. The functions of
/// `pineda` that take longer than a call (powers, sines, noise, textures) are that way already.
///
/// Closures that are bound with `let` or passed as an argument become inline too. Functions of the standard library
/// that call them (`map`, `fold`, ...) do not: write loops in lane code.
#[proc_macro_attribute]
pub fn shader(arguments: TokenStream, item: TokenStream) -> TokenStream {
    shader::expand(arguments.into(), item.into()).unwrap_or_else(syn::Error::into_compile_error).into()
}

/// Takes a struct of numbers and vectors apart into a row of numbers and puts it together again, so that the
/// rasterizer can interpolate it; `pineda::varyings!` writes it for you.
///
/// The struct has one type parameter, its width, and fields that are varyings themselves at that width:
/// `struct Lit<L: Lanes = Scalar> { normal: Vec3<L> }`. `#[flat]` above a field takes the provoking vertex's value,
/// `#[noperspective]` interpolates it on the screen. `Clone` and `Copy` are implemented too.
#[proc_macro_derive(Varyings, attributes(flat, noperspective))]
pub fn varyings(item: TokenStream) -> TokenStream {
    varyings::expand(item.into()).unwrap_or_else(syn::Error::into_compile_error).into()
}
