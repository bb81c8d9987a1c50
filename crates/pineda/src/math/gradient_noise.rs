//! Gradient noise: Perlin's improved noise (2002, "Improving noise"), with hashes instead of his table, and its derivative.
//!
//! At each point of the lattice of whole numbers stands a random gradient, and there the noise is 0. In between, the planes that the gradients
//! of the cell's corners span are mixed by 6t⁵ - 15t⁴ + 10t³, whose first and second derivatives are 0 at both ends. The derivative follows by the product rule
//! (Quilez 2017, "Gradient noise derivatives"): of a mixture a + u (b - a) it is the mixture of theirs, and u' (b - a) along the axis.

use super::hash::hash1;
use super::{Bool, Real, Uint, Vec2, Vec3};
use crate::lanes::Lanes;
use crate::shader;

/// 2^32 over the powers of the plastic number, made odd. Their multiples lie far apart, so that neighbours in the lattice hash different numbers
/// (Roberts 2018, "The unreasonable effectiveness of quasirandom sequences").
const STEPS_2: [u32; 2] = [0xc13f_a9a9, 0x91e1_0da5];
/// The same for three dimensions.
const STEPS_3: [u32; 3] = [0xd1b5_4a33, 0xabc9_8389, 0x8cb9_2ba7];

/// Bring the extremes to just within ±1: were all gradients of a cell as they would have to be, the sums would come to 0.7153 and to 1.0362.
const SCALE_2: f32 = 1.39;
const SCALE_3: f32 = 0.96;

/// How each octave's lattice lies to the one before, in its own units, so that not all are 0 at the same points.
const OCTAVE_SHIFT: [f32; 3] = [0.371, 0.617, 0.243];

/// Smooth random numbers in the plane, from -1 to 1: 0 at whole numbers, with waves about one unit long. The same everywhere
/// for the same `seed`. NaN where a coordinate is infinite or NaN; 0 beyond ±2^23, where all floats are whole numbers.
///
/// ```
/// use pineda::{noise, Vec2};
/// let at = |x: f32, y: f32| f32::from(noise::gradient2(Vec2::from([x, y]), 0));
/// assert_eq!(at(3.0, -5.0), 0.0);
/// assert!((at(3.4, 1.2) - at(3.401, 1.2)).abs() < 0.01);
/// ```
#[shader(apart)]
pub fn gradient2<L: Lanes>(p: Vec2<L>, seed: u32) -> Real<L> {
    value_and_slope2(p, seed).0
}

/// Smooth random numbers in space, from -1 to 1 and mostly from -0.6 to 0.6; see [`gradient2`].
#[shader(apart)]
pub fn gradient3<L: Lanes>(p: Vec3<L>, seed: u32) -> Real<L> {
    value_and_slope3(p, seed).0
}

/// [`gradient2`], and its derivatives by x and y.
#[shader(apart)]
pub fn gradient2_with_slope<L: Lanes>(p: Vec2<L>, seed: u32) -> (Real<L>, Vec2<L>) {
    value_and_slope2(p, seed)
}

#[inline(always)]
fn value_and_slope2<L: Lanes>(p: Vec2<L>, seed: u32) -> (Real<L>, Vec2<L>) {
    let cell = p.floor();
    let d = p - cell;
    let [x, y] = STEPS_2;
    let first = cell.x.to_int().to_uint() * x + cell.y.to_int().to_uint() * y + seed;
    let (right, below) = (d.x - 1.0, d.y - 1.0);
    let (u, v) = (fade(d.x), fade(d.y));
    let upper = mix2::<L, 0>(plane2(first, d.x, d.y), plane2(first + x, right, d.y), u);
    let lower = mix2::<L, 0>(plane2(first + y, d.x, below), plane2(first + x.wrapping_add(y), right, below), u);
    let (value, slope) = mix2::<L, 1>(upper, lower, v);
    (value * SCALE_2, slope * SCALE_2)
}

/// [`gradient3`], and its derivatives by x, y and z: for bumps without a second and a third look at it.
///
/// ```
/// use pineda::{noise, Vec3};
/// let p = Vec3::from([0.3, 7.6, -2.2]);
/// let (value, slope) = noise::gradient3_with_slope(p, 1);
/// let further = noise::gradient3(p + [0.001, 0.0, 0.0], 1);
/// assert!(f32::from((further - value) / 0.001 - slope.x).abs() < 0.01);
/// ```
#[shader(apart)]
pub fn gradient3_with_slope<L: Lanes>(p: Vec3<L>, seed: u32) -> (Real<L>, Vec3<L>) {
    value_and_slope3(p, seed)
}

#[inline(always)]
fn value_and_slope3<L: Lanes>(p: Vec3<L>, seed: u32) -> (Real<L>, Vec3<L>) {
    let cell = p.floor();
    let d = p - cell;
    let [x, y, z] = STEPS_3;
    let (column, row, layer) = (cell.x.to_int().to_uint(), cell.y.to_int().to_uint(), cell.z.to_int().to_uint());
    let first = column * x + row * y + layer * z + seed;
    let (u, v, w) = (fade(d.x), fade(d.y), fade(d.z));
    let near = square3(first, d, u, v);
    let far = square3(first + z, Vec3::new(d.x, d.y, d.z - 1.0), u, v);
    let (value, slope) = mix3::<L, 2>(near, far, w);
    (value * SCALE_3, slope * SCALE_3)
}

/// A sum of `octaves` of noise, each with half the waves and half the height of the one before: fractional Brownian motion, from about
/// -1 to 1 (Musgrave in Ebert et al. 2003, "Texturing and modeling", chapter 16).
#[inline(always)]
pub fn fbm2<L: Lanes>(p: Vec2<L>, octaves: u32, seed: u32) -> Real<L> {
    let [x, y, _] = OCTAVE_SHIFT;
    let (mut p, mut height) = (p, 0.5);
    let mut sum = p.x * 0.0;
    let mut octave = 0;
    while octave < octaves {
        sum += gradient2(p, seed.wrapping_add(octave)) * height;
        p = p * 2.0 + [x, y];
        height *= 0.5;
        octave += 1;
    }
    sum
}

/// [`fbm2`] in space.
#[inline(always)]
pub fn fbm3<L: Lanes>(p: Vec3<L>, octaves: u32, seed: u32) -> Real<L> {
    let (mut p, mut height) = (p, 0.5);
    let mut sum = p.x * 0.0;
    let mut octave = 0;
    while octave < octaves {
        sum += gradient3(p, seed.wrapping_add(octave)) * height;
        p = p * 2.0 + OCTAVE_SHIFT;
        height *= 0.5;
        octave += 1;
    }
    sum
}

/// [`fbm3`] of the octaves' absolute values, from 0 to about 1: with creases, as in marble and flames (Perlin 1985, "An image synthesizer").
#[inline(always)]
pub fn turbulence3<L: Lanes>(p: Vec3<L>, octaves: u32, seed: u32) -> Real<L> {
    let (mut p, mut height) = (p, 0.5);
    let mut sum = p.x * 0.0;
    let mut octave = 0;
    while octave < octaves {
        sum += gradient3(p, seed.wrapping_add(octave)).abs() * height;
        p = p * 2.0 + OCTAVE_SHIFT;
        height *= 0.5;
        octave += 1;
    }
    sum
}

/// 6t⁵ - 15t⁴ + 10t³, and its derivative 30t⁴ - 60t³ + 30t².
#[inline(always)]
fn fade<L: Lanes>(t: Real<L>) -> (Real<L>, Real<L>) {
    let squared = t * t;
    (squared * t * (t * (t * 6.0 - 15.0) + 10.0), squared * (t * (t - 2.0) + 1.0) * 30.0)
}

/// The plane through 0 at a corner, whose gradient its hash says, at (x, y) from there: one of eight directions, none of them along an axis or a diagonal.
#[inline(always)]
fn plane2<L: Lanes>(corner: Uint<L>, x: Real<L>, y: Real<L>) -> (Real<L>, Vec2<L>) {
    const TAN_PI_8: f32 = 0.414_213_57;
    let hash = hash1(corner);
    let is_steep: Bool<L> = (hash & 4).eq(0);
    let slope = Vec2::new(
        is_steep.select(TAN_PI_8, 1.0).times_sign_of((hash << 31).bits_to_real()),
        is_steep.select(1.0, TAN_PI_8).times_sign_of((hash << 30).bits_to_real()),
    );
    (slope.x * x + slope.y * y, slope)
}

/// The plane through 0 at a corner at `d` from there. Its gradient is one of the twelve from a cube's middle to its edges, as Perlin's.
#[inline(always)]
fn plane3<L: Lanes>(corner: Uint<L>, d: Vec3<L>) -> (Real<L>, Vec3<L>) {
    let hash = hash1(corner);
    // Three numbers, as often as 16 bits allow.
    let zero = ((hash >> 16) * 3) >> 16;
    let slope = Vec3::new(
        zero.eq(0).select(0.0, 1.0).times_sign_of((hash << 31).bits_to_real()),
        zero.eq(1).select(0.0, 1.0).times_sign_of((hash << 30).bits_to_real()),
        zero.eq(2).select(0.0, 1.0).times_sign_of((hash << 29).bits_to_real()),
    );
    (slope.dot(d), slope)
}

/// The planes of four corners of one z, mixed.
#[shader(apart)]
fn square3<L: Lanes>(first: Uint<L>, d: Vec3<L>, u: (Real<L>, Real<L>), v: (Real<L>, Real<L>)) -> (Real<L>, Vec3<L>) {
    let [x, y, _] = STEPS_3;
    let (right, below) = (d.x - 1.0, d.y - 1.0);
    let a = plane3(first, d);
    let b = plane3(first + x, Vec3::new(right, d.y, d.z));
    let c = plane3(first + y, Vec3::new(d.x, below, d.z));
    let e = plane3(first + x.wrapping_add(y), Vec3::new(right, below, d.z));
    mix3::<L, 1>(mix3::<L, 0>(a, b, u), mix3::<L, 0>(c, e, u), v)
}

/// From `a` to `b` along an axis, by a weight and its derivative: value and slope.
#[inline(always)]
fn mix2<L: Lanes, const AXIS: usize>(
    a: (Real<L>, Vec2<L>),
    b: (Real<L>, Vec2<L>),
    (weight, change): (Real<L>, Real<L>),
) -> (Real<L>, Vec2<L>) {
    let difference = b.0 - a.0;
    let mut slope = a.1.mix(b.1, weight);
    match AXIS {
        0 => slope.x += difference * change,
        _ => slope.y += difference * change,
    }
    (a.0 + difference * weight, slope)
}

/// [`mix2`] in space.
#[inline(always)]
fn mix3<L: Lanes, const AXIS: usize>(
    a: (Real<L>, Vec3<L>),
    b: (Real<L>, Vec3<L>),
    (weight, change): (Real<L>, Real<L>),
) -> (Real<L>, Vec3<L>) {
    let difference = b.0 - a.0;
    let mut slope = a.1.mix(b.1, weight);
    match AXIS {
        0 => slope.x += difference * change,
        1 => slope.y += difference * change,
        _ => slope.z += difference * change,
    }
    (a.0 + difference * weight, slope)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::Scalar;
    use crate::lanes::conformance::{Random, conformance, pairs};

    #[test]
    fn noise_has_the_same_bits_at_every_level() {
        conformance! {
            check_in_shaders &pairs();
            float gradient2<L>(lanes, a, b) = gradient2(Vec2::<L>::new(Real(a), Real(b)), 3).0;
            float slope2<L>(lanes, a, b) = gradient2_with_slope(Vec2::<L>::new(Real(a), Real(b)), 3).1.dot([1.0, 10.0]).0;
            float gradient3<L>(lanes, a, b) = gradient3(Vec3::<L>::new(Real(a), Real(b), Real(a) * 0.3), 5).0;
            float slope3<L>(lanes, a, b) = {
                gradient3_with_slope(Vec3::<L>::new(Real(a), Real(b), Real(a) * 0.3), 5).1.dot([1.0, 10.0, 100.0]).0
            };
            float fbm2<L>(lanes, a, b) = fbm2(Vec2::<L>::new(Real(a), Real(b)), 4, 3).0;
            float turbulence3<L>(lanes, a, b) = turbulence3(Vec3::<L>::new(Real(a), Real(b), Real(b) * 0.7), 3, 0).0;
        }
    }

    #[test]
    fn slopes_are_the_derivatives() {
        let mut random = Random(7);
        for _ in 0..2000 {
            let p = Vec3::from([random.number(50.0), random.number(50.0), random.number(50.0)]);
            let (value, slope) = gradient3_with_slope(p, 9);
            let (value2, slope2) = gradient2_with_slope(p.xy(), 9);
            let step = 1.0 / 512.0;
            for (axis, found) in [slope.x, slope.y, slope.z].into_iter().enumerate() {
                let mut by = [0.0; 3];
                by[axis] = step;
                let change = (gradient3(p + by, 9) - value) / step;
                assert!((change - found).abs().0 < 0.03, "{p:?}, axis {axis}: {found:?} and not {change:?}");
            }
            let change = (gradient2(p.xy() + [0.0, step], 9) - value2) / step;
            assert!((change - slope2.y).abs().0 < 0.03, "{p:?}: {slope2:?} and not {change:?}");
        }
    }

    #[test]
    fn noise_is_0_in_the_lattice_and_within_1_elsewhere() {
        let mut random = Random(8);
        let (mut largest, mut sum) = ([0.0f32; 2], [0.0f64; 2]);
        for _ in 0..100_000 {
            let p = Vec3::from([random.number(500.0), random.number(500.0), random.number(500.0)]);
            let found = [gradient2(p.xy(), 1).0, gradient3(p, 1).0];
            for k in 0..2 {
                largest[k] = if found[k].abs() > largest[k] { found[k].abs() } else { largest[k] };
                sum[k] += f64::from(found[k]);
            }
            let whole = p.floor();
            assert_eq!([gradient2(whole.xy(), 1).0.abs(), gradient3(whole, 1).0.abs()], [0.0; 2], "{whole:?}");
        }
        assert!(largest.into_iter().all(|x| x > 0.8 && x <= 1.0), "{largest:?}");
        assert!(sum.into_iter().all(|sum| sum.abs() < 500.0), "{sum:?}");
    }

    #[test]
    fn noise_has_no_place_where_it_panics() {
        for x in crate::lanes::conformance::SPECIAL {
            let found = gradient3(Vec3::<Scalar>::from([x, 0.5, -x]), 0).0;
            assert_eq!(found.is_nan(), !x.is_finite(), "{x}");
            assert!(x.abs() < 8_388_608.0 || !x.is_finite() || found.abs() <= 1.0, "{x}");
        }
    }
}
