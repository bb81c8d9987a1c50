//! Operations on plain arrays, for the level without vector instructions: loops, which LLVM takes as a whole.

/// The first way where there are no vector instructions, the second one elsewhere; for code that is generic over `S: Simd`.
///
/// The first way is a closure, and so a function of its own that need not be inlined: LLVM simplifies its loop once, not
/// again at each place where the operation stands.
macro_rules! by_level {
    ($plain:expr, $vector:expr) => {
        by_level!(!S::IS_PLAIN, $plain, $vector)
    };
    ($has_vector:expr, $plain:expr, $vector:expr) => {
        if $has_vector { $vector } else { plain::apart(|| $plain) }
    };
}

/// The value of a closure. Builds for debugging leave it a function: there, inlining it is most of what compiling a kernel takes.
#[cfg_attr(debug_assertions, inline(never))]
#[cfg_attr(not(debug_assertions), inline)]
pub(super) fn apart<T>(closure: impl FnOnce() -> T) -> T {
    closure()
}

/// An array of `count` values, each made of the values that the named arrays have at its place.
macro_rules! each_lane {
    ($count:literal, |$($lane:ident),+| $value:expr) => {{
        let mut result = [Default::default(); $count];
        let mut k = 0;
        while k < $count {
            $(let $lane = $lane[k];)+
            result[k] = $value;
            k += 1;
        }
        result
    }};
}

/// The lanes that the mask names, in order, from the first place on; then zeros.
#[inline(always)]
pub(super) fn compress<T: Copy + Default>(lanes: [T; 16], mask: [i32; 16]) -> [T; 16] {
    let mut result = [T::default(); 16];
    let mut count = 0;
    let mut k = 0;
    while k < 16 {
        if mask[k] != 0 {
            result[count & 15] = lanes[k];
            count += 1;
        }
        k += 1;
    }
    result
}

/// The lanes of `a` and `b` in turn: those of both first halves, and those of both second halves.
#[inline(always)]
pub(super) fn interleave(a: [u32; 16], b: [u32; 16]) -> ([u32; 16], [u32; 16]) {
    let (mut low, mut high) = ([0; 16], [0; 16]);
    let mut k = 0;
    while k < 8 {
        (low[2 * k], low[2 * k + 1]) = (a[k], b[k]);
        (high[2 * k], high[2 * k + 1]) = (a[k + 8], b[k + 8]);
        k += 1;
    }
    (low, high)
}

/// Every second lane of `a`, then of `b`, from lane `first` on.
#[inline(always)]
pub(super) fn every_second(a: [u32; 16], b: [u32; 16], first: usize) -> [u32; 16] {
    let mut result = [0; 16];
    let mut k = 0;
    while k < 8 {
        result[k] = a[2 * k + first];
        result[k + 8] = b[2 * k + first];
        k += 1;
    }
    result
}

/// Both arrays, one behind the other.
#[inline(always)]
pub(super) fn combine<T: Copy + Default, const HALF: usize, const WHOLE: usize>(
    low: [T; HALF],
    high: [T; HALF],
) -> [T; WHOLE] {
    let mut result = [T::default(); WHOLE];
    let mut k = 0;
    while k < HALF {
        result[k] = low[k];
        result[k + HALF] = high[k];
        k += 1;
    }
    result
}

/// The lower and the upper half of the lanes.
#[inline(always)]
pub(super) fn halves<T: Copy + Default>(lanes: [T; 16]) -> ([T; 8], [T; 8]) {
    let (mut low, mut high) = ([T::default(); 8], [T::default(); 8]);
    let mut k = 0;
    while k < 8 {
        low[k] = lanes[k];
        high[k] = lanes[k + 8];
        k += 1;
    }
    (low, high)
}
