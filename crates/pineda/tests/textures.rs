//! Textures, next to two plain programs that share no line with the lookups.
//!
//! - `plain` computes in f32, operation by operation, what `src/texture/filter.rs` says is computed: lookups must have its bits.
//! - `truth` computes in f64 what Vulkan 1.4 says in "Image Operations" (16.6), from unnormalised coordinates and with whole numbers wrapped: lookups must be near it.

#![allow(missing_docs, reason = "a test")]

use pineda::*;
use pineda_oracle::cases::Random;

/// A texel of a format, before it is scaled.
trait Plain: Filterable {
    fn units(texel: Self::Texel) -> [f32; 4];
    fn scale(channels: [f32; 4]) -> [f32; 4];
}

fn over_255(x: f32) -> f32 {
    let part = f32::from_bits((1.0f32 / 255.0).to_bits() & !0xff);
    x * part + x * (1.0 / 255.0 - f64::from(part)) as f32
}

fn srgb(code: u8) -> f32 {
    let v = f64::from(code) / 255.0;
    (if v <= 0.04045 { v / 12.92 } else { libm::pow((v + 0.055) / 1.055, 2.4) }) as f32
}

macro_rules! plain {
    ($($name:ident: |$texel:ident| $units:expr, |$c:ident| $scale:expr;)+) => {$(
        impl Plain for $name {
            fn units($texel: Self::Texel) -> [f32; 4] {
                $units
            }
            fn scale($c: [f32; 4]) -> [f32; 4] {
                $scale
            }
        }
    )+};
}

plain! {
    R8: |t| [t.into(), 0.0, 0.0, 0.0], |c| [over_255(c[0]), 0.0, 0.0, 1.0];
    Rg8: |t| [t[0].into(), t[1].into(), 0.0, 0.0], |c| [over_255(c[0]), over_255(c[1]), 0.0, 1.0];
    Rgba8: |t| t.map(f32::from), |c| c.map(over_255);
    R8Srgb: |t| [srgb(t), 0.0, 0.0, 0.0], |c| [c[0], 0.0, 0.0, 1.0];
    Rg8Srgb: |t| [srgb(t[0]), srgb(t[1]), 0.0, 0.0], |c| [c[0], c[1], 0.0, 1.0];
    Rgba8Srgb: |t| [srgb(t[0]), srgb(t[1]), srgb(t[2]), t[3].into()], |c| [c[0], c[1], c[2], over_255(c[3])];
    R16: |t| [t.into(), 0.0, 0.0, 0.0], |c| [c[0] / 65_535.0, 0.0, 0.0, 1.0];
    Rg16: |t| [t[0].into(), t[1].into(), 0.0, 0.0], |c| [c[0] / 65_535.0, c[1] / 65_535.0, 0.0, 1.0];
    Rgba16: |t| t.map(f32::from), |c| c.map(|c| c / 65_535.0);
    R16F: |t| [half::f16::from_bits(t).to_f32(), 0.0, 0.0, 0.0], |c| [c[0], 0.0, 0.0, 1.0];
    Rg16F: |t| [half::f16::from_bits(t[0]).to_f32(), half::f16::from_bits(t[1]).to_f32(), 0.0, 0.0], |c| [c[0], c[1], 0.0, 1.0];
    Rgba16F: |t| t.map(|t| half::f16::from_bits(t).to_f32()), |c| c;
    R32F: |t| [t, 0.0, 0.0, 0.0], |c| [c[0], 0.0, 0.0, 1.0];
    Rg32F: |t| [t[0], t[1], 0.0, 0.0], |c| [c[0], c[1], 0.0, 1.0];
    Rgba32F: |t| t, |c| c;
}

/// Levels of texels, each with its width, height and slices.
struct Levels<F: Filterable>(Vec<([i64; 3], Vec<F::Texel>)>);

impl<F: Plain> Levels<F> {
    fn texel(&self, level: usize, [x, y, z]: [i64; 3]) -> [f32; 4] {
        let ([width, height, _], texels) = &self.0[level];
        F::units(texels[((z * height + y) * width + x) as usize])
    }
}

/// Mostly in and around the texture, sometimes on its texels' borders, seldom anything at all.
fn coordinate(random: &mut Random) -> f32 {
    const ODD: [f32; 11] =
        [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30, -3e38, -0.0, 1e-40, -1e-9, 1.0, 2.0, -1.0];
    match random.between(0, 15) {
        0 => random.pick(&ODD),
        1 | 2 => random.real(-1e4, 1e4),
        3..=5 => random.between(-32, 64) as f32 / 32.0,
        _ => random.real(-1.5, 2.5),
    }
}

fn any_sampler(random: &mut Random) -> Sampler {
    let wraps = [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp, Wrap::Border];
    let filters = [Filter::Nearest, Filter::Linear, Filter::Linear];
    Sampler {
        wrap: [random.pick(&wraps), random.pick(&wraps), random.pick(&wraps)],
        mag_filter: random.pick(&filters),
        min_filter: random.pick(&filters),
        mip_filter: random.pick(&[MipFilter::Base, MipFilter::Nearest, MipFilter::Linear]),
        lod_bias: random.pick(&[0.0, 0.5, -1.0]),
        lod_min: random.pick(&[0.0, 0.0, 1.25]),
        lod_max: random.pick(&[f32::INFINITY, 100.0, 1.75]),
        border: [0.25, 0.5, 0.75, 1.0],
        ..Sampler::TRILINEAR
    }
}

/// A number of x texels, in f32 as lookups compute it.
fn texels_plain(wrap: Wrap, s: f32, size: f32) -> f32 {
    let clamp = |s: f32, low: f32, high: f32| if s > low { if s < high { s } else { high } } else { low };
    match wrap {
        Wrap::Repeat => clamp(s - s.floor(), 0.0, 1.0) * size,
        Wrap::Mirror => {
            let twice = clamp(s - 2.0 * (0.5 * s).floor(), 0.0, 2.0);
            (if twice < 2.0 - twice { twice } else { 2.0 - twice }) * size
        }
        Wrap::Clamp => clamp(s, 0.0, 1.0) * size,
        Wrap::Border => clamp(if s.is_nan() { 0.0 } else { s * size }, -1.0, size + 1.0),
    }
}

/// Vulkan's wrapping of a texel's number; `None` is the border.
fn wrapped(wrap: Wrap, i: i64, size: i64) -> Option<i64> {
    match wrap {
        Wrap::Repeat => Some(i.rem_euclid(size)),
        Wrap::Mirror => {
            let i = i.rem_euclid(2 * size);
            Some(if i < size { i } else { 2 * size - 1 - i })
        }
        Wrap::Clamp => Some(i.clamp(0, size - 1)),
        Wrap::Border => (0..size).contains(&i).then_some(i),
    }
}

/// The two texels along an axis, and the part of the second one; the same twice with `Nearest`.
fn along(filter: Filter, wrap: Wrap, s: f32, size: i64) -> ([Option<i64>; 2], f32) {
    let x = texels_plain(wrap, s, size as f32);
    if filter == Filter::Nearest {
        let last = if wrap == Wrap::Border { size } else { size - 1 };
        let i = wrapped(wrap, (x.floor() as i64).min(last), size);
        return ([i, i], 0.0);
    }
    let low = (x - 0.5).floor();
    let both = [low as i64, low as i64 + 1];
    // What was mirrored already must not be again.
    let wrap = if wrap == Wrap::Mirror { Wrap::Clamp } else { wrap };
    (both.map(|i| wrapped(wrap, i, size)), x - 0.5 - low)
}

fn mix(a: [f32; 4], b: [f32; 4], part: f32) -> [f32; 4] {
    std::array::from_fn(|c| a[c] + (b[c] - a[c]) * part)
}

/// What a lookup at a level of detail is, before it is scaled: `slice` where slices are not depth.
fn plain<F: Plain>(levels: &Levels<F>, sampler: &Sampler, at: [f32; 3], slice: Option<i64>, lod: f32) -> [f32; 4] {
    let last = levels.0.len() - 1;
    let filter = if lod > 0.0 { sampler.min_filter } else { sampler.mag_filter };
    let units = F::UNITS;
    let at_level = |level: usize| {
        let size = levels.0[level].0;
        let [x, y, z] = [0, 1, 2].map(|k| along(filter, sampler.wrap[k], at[k], size[k]));
        let z = slice.map_or(z, |slice| ([Some(slice); 2], 0.0));
        let texel = |i: Option<i64>, j: Option<i64>, k: Option<i64>| match (i, j, k) {
            (Some(i), Some(j), Some(k)) => levels.texel(level, [i, j, k]),
            _ => std::array::from_fn(|c| sampler.border[c] * units[c]),
        };
        if filter == Filter::Nearest {
            return texel(x.0[0], y.0[0], z.0[0]);
        }
        let in_slice = |k: Option<i64>| {
            let row = |j: Option<i64>| mix(texel(x.0[0], j, k), texel(x.0[1], j, k), x.1);
            mix(row(y.0[0]), row(y.0[1]), y.1)
        };
        if slice.is_some() { in_slice(z.0[0]) } else { mix(in_slice(z.0[0]), in_slice(z.0[1]), z.1) }
    };
    let clamped = |lod: f32| if lod > 0.0 { lod.min(last as f32) } else { 0.0 };
    match sampler.mip_filter {
        MipFilter::Base => at_level(0),
        MipFilter::Nearest => at_level(clamped((lod + 0.5).floor()) as usize),
        MipFilter::Linear => {
            let lod = clamped(lod);
            let (first, part) = (lod.floor(), lod - lod.floor());
            let value = at_level(first as usize);
            if part > 0.0 { mix(value, at_level((first as usize + 1).min(last)), part) } else { value }
        }
    }
}

/// The level of detail that counts.
fn in_range(sampler: &Sampler, lod: f32) -> f32 {
    let lod = lod + sampler.lod_bias;
    let lod = if lod > sampler.lod_min { lod } else { sampler.lod_min };
    if lod < sampler.lod_max { lod } else { sampler.lod_max }
}

/// The same in f64, by Vulkan's rules, scaled; for finite coordinates of any size.
fn truth<F: Plain>(levels: &Levels<F>, sampler: &Sampler, at: [f32; 3], slice: Option<i64>, lod: f32) -> [f64; 4] {
    let last = levels.0.len() - 1;
    let filter = if lod > 0.0 { sampler.min_filter } else { sampler.mag_filter };
    let at_level = |level: usize| {
        let size = levels.0[level].0;
        let mut sum = [0.0; 4];
        for corner in 0..8 {
            let (mut texel, mut weight, mut is_border) = ([0; 3], 1.0, false);
            for axis in 0..3 {
                let is_high = corner >> axis & 1 == 1;
                if let (2, Some(slice)) = (axis, slice) {
                    (texel[2], weight) = (slice, if is_high { 0.0 } else { weight });
                    continue;
                }
                let u = f64::from(at[axis]) * size[axis] as f64;
                let (i, part) = match filter {
                    Filter::Nearest => (u.floor(), 0.0),
                    Filter::Linear => ((u - 0.5).floor(), (u - 0.5) - (u - 0.5).floor()),
                };
                weight *= if is_high { part } else { 1.0 - part };
                match wrapped(sampler.wrap[axis], i as i64 + i64::from(is_high), size[axis]) {
                    Some(i) => texel[axis] = i,
                    None => is_border = true,
                }
            }
            let units = if is_border { sampler.border } else { F::scale(levels.texel(level, texel)) };
            let missing = F::scale([0.0; 4]);
            for (c, channel) in sum.iter_mut().enumerate() {
                let unit = if c >= F::CHANNELS { missing[c] } else { units[c] };
                *channel += weight * f64::from(unit);
            }
        }
        sum
    };
    let lod = f64::from(lod);
    match sampler.mip_filter {
        MipFilter::Base => at_level(0),
        MipFilter::Nearest => at_level((lod + 0.5).floor().clamp(0.0, last as f64) as usize),
        MipFilter::Linear => {
            let lod = lod.clamp(0.0, last as f64);
            let (a, b) = (at_level(lod.floor() as usize), at_level((lod.floor() as usize + 1).min(last)));
            std::array::from_fn(|c| a[c] + (b[c] - a[c]) * (lod - lod.floor()))
        }
    }
}

fn bits(color: Rgba) -> [u32; 4] {
    [color.r, color.g, color.b, color.a].map(|x| f32::from(x).to_bits())
}

/// Sizes that are powers of two and that are not, narrow ones, single texels.
const SIZES: [[u32; 3]; 6] = [[8, 8, 4], [5, 7, 3], [16, 1, 2], [1, 1, 1], [13, 4, 5], [3, 32, 1]];

/// Numbers of a format that neither overflow nor drown when they are mixed.
fn texels<F: Plain>(random: &mut Random, count: u32) -> Vec<F::Texel> {
    (0..count).map(|_| F::nearest(std::array::from_fn(|_| random.unit()))).collect()
}

fn levels_of<F: Plain>(
    extents: impl Fn(u32) -> [u32; 3],
    count: u32,
    texels: impl Fn(u32) -> Vec<F::Texel>,
) -> Levels<F> {
    Levels((0..count).map(|level| (extents(level).map(i64::from), texels(level))).collect())
}

/// Everything that a format can do in two and three dimensions, next to both plain programs.
fn check<F: Plain>(seed: u64) {
    let mut random = Random::new(seed);
    for [width, height, depth] in SIZES {
        let flat = Texture2dArray::<F>::new(width, height, depth, texels::<F>(&mut random, width * height * depth))
            .and_then(|texture| texture.with_mips())
            .unwrap();
        let volume = Texture3d::<F>::new(width, height, depth, texels::<F>(&mut random, width * height * depth))
            .and_then(|texture| texture.with_mips())
            .unwrap();
        let of_flat = levels_of::<F>(
            |level| [flat.size(level)[0], flat.size(level)[1], depth],
            flat.levels(),
            |level| flat.texels(level).to_vec(),
        );
        let of_volume =
            levels_of::<F>(|level| volume.size(level), volume.levels(), |level| volume.texels(level).to_vec());
        for _ in 0..60 {
            let sampler = any_sampler(&mut random);
            let at = [coordinate(&mut random), coordinate(&mut random), coordinate(&mut random)];
            let lod = random.pick(&[0.0, 0.3, 1.0, 2.7, -1.0, 30.0, f32::NAN]);
            let layer = random.between(-4, 8) as i32;
            let [u, v, w] = at.map(Real::<Scalar>::from);
            let slice = Some(i64::from(layer).clamp(0, i64::from(depth) - 1));
            let found_flat = flat.sample_level(&sampler, Vec2::new(u, v), Int::<Scalar>::from(layer), lod);
            let found_volume = volume.sample_level(&sampler, Vec3::new(u, v, w), lod);
            let lod = in_range(&sampler, lod);
            for (found, levels, slice) in [(found_flat, &of_flat, slice), (found_volume, &of_volume, None)] {
                let wanted = F::scale(plain(levels, &sampler, at, slice, lod)).map(f32::to_bits);
                assert_eq!(bits(found), wanted, "{sampler:?} {at:?} {lod} {slice:?} {width} {height} {depth}");
                // Far away, f32 itself leaves no place in between to be at.
                if at.iter().any(|s| s.abs() > 4.0 || s.is_nan())
                    || sampler.min_filter != Filter::Linear
                    || sampler.mag_filter != Filter::Linear
                {
                    continue;
                }
                let wanted = truth(levels, &sampler, at, slice, lod);
                for (found, wanted) in [found.r, found.g, found.b, found.a].into_iter().zip(wanted) {
                    let error = (f64::from(f32::from(found)) - wanted).abs();
                    // Coordinates up to 4 in 32 texels leave 17 bits of weight, along each of three axes.
                    assert!(error < 1.0 / 16_384.0, "{found:?}, not {wanted}: {sampler:?} {at:?} {lod}");
                }
            }
        }
    }
}

#[test]
fn lookups_have_the_bits_that_they_promise_and_are_near_the_truth() {
    check::<R8>(1);
    check::<Rg8>(2);
    check::<Rgba8>(3);
    check::<R8Srgb>(4);
    check::<Rg8Srgb>(5);
    check::<Rgba8Srgb>(6);
    check::<R16>(7);
    check::<Rg16>(8);
    check::<Rgba16>(9);
    check::<R16F>(10);
    check::<Rg16F>(11);
    check::<Rgba16F>(12);
    check::<R32F>(13);
    check::<Rg32F>(14);
    check::<Rgba32F>(15);
}

#[test]
fn what_is_not_filtered_is_what_the_texel_stands_for() {
    fn code(code: u8) -> [f32; 4] {
        [srgb(code), f32::from(code) / 255.0, 0.0, 1.0]
    }
    for k in 0..=255u8 {
        let (linear, curved) = ([[k, 0, 0, k]], [[k, 0, 0, k]]);
        let (linear, curved) = (Texture2d::<Rgba8>::new(1, 1, &linear), Texture2d::<Rgba8Srgb>::new(1, 1, &curved));
        let (linear, curved) = (linear.unwrap(), curved.unwrap());
        for sampler in [Sampler::NEAREST, Sampler::TRILINEAR] {
            let at = Vec2::<Scalar>::from([0.37, 0.81]);
            assert_eq!(f32::from(curved.sample_level(&sampler, at, 0.0).r), code(k)[0]);
            assert_eq!(f32::from(curved.sample_level(&sampler, at, 0.0).a), code(k)[1]);
            assert_eq!(f32::from(linear.sample_level(&sampler, at, 0.0).r), code(k)[1]);
        }
    }
    for k in (0..=u16::MAX).step_by(251) {
        let texture = Texture2d::<R16>::new(1, 1, vec![k]).unwrap();
        let found = texture.sample_level(&Sampler::NEAREST, Vec2::<Scalar>::from([0.5, 0.5]), 0.0);
        assert_eq!(f32::from(found.r), f32::from(k) / 65_535.0);
    }
}

#[test]
fn the_level_of_detail_is_log2_of_the_longer_step() {
    // Each level holds its own number.
    let texels: Vec<f32> = (0..11u32).flat_map(|level| vec![level as f32; 1 << (2 * (10 - level))]).collect();
    let texture = Texture2d::<R32F>::with_levels(1024, 1024, 11, texels).unwrap();
    let mut random = Random::new(3);
    for _ in 0..2_000 {
        let steps: [f32; 4] = std::array::from_fn(|_| random.real(-1.0, 1.0) * libm::exp2f(random.real(-14.0, 0.0)));
        let uv = Vec2::<Scalar>::from([random.real(-3.0, 3.0), random.real(-3.0, 3.0)]);
        let (dx, dy) = ([steps[0], steps[1]], [steps[2], steps[3]]);
        let found = f64::from(f32::from(texture.sample_grad(&Sampler::TRILINEAR, uv, dx.into(), dy.into()).r));
        let length = |[u, v]: [f32; 2]| libm::hypot(f64::from(u) * 1024.0, f64::from(v) * 1024.0);
        let wanted = libm::log2(length(dx).max(length(dy))).clamp(0.0, 10.0);
        assert!((found - wanted).abs() < 1.0 / 262_144.0 * 4.0, "{found}, not {wanted}");
    }
}

#[test]
fn anisotropic_lookups_keep_the_level_of_the_shorter_side() {
    let texels: Vec<f32> = (0..11u32).flat_map(|level| vec![level as f32; 1 << (2 * (10 - level))]).collect();
    let texture = Texture2d::<R32F>::with_levels(1024, 1024, 11, texels).unwrap();
    let at = |dx: [f32; 2], dy: [f32; 2], anisotropy| {
        let sampler = Sampler { anisotropy, ..Sampler::TRILINEAR };
        let uv = Vec2::<Scalar>::from([0.3, 0.7]);
        f32::from(texture.sample_grad(&sampler, uv, dx.map(|d| d / 1024.0).into(), dy.map(|d| d / 1024.0).into()).r)
    };
    assert_eq!(at([4.0, 0.0], [0.0, 32.0], 16), 2.0, "eight lookups of squares of 4");
    assert_eq!(at([4.0, 0.0], [0.0, 32.0], 4), 3.0, "four lookups of squares of 8");
    assert_eq!(at([4.0, 0.0], [0.0, 32.0], 1), 5.0);
    assert_eq!(at([4.0, 0.0], [0.0, 4.0], 16), 2.0, "isotropic");
    assert_eq!(at([0.0, 0.0], [0.0, 0.0], 16), 0.0, "no size at all");
    assert_eq!(
        at([16.0, 16.0], [16.0, 16.0], 16),
        at([16.0, 16.0], [16.0, 16.0], 255),
        "a line, and as many as there can be"
    );
}

#[test]
fn anisotropic_lookups_are_the_mean_along_the_footprint() {
    // A ramp across: its mean along a symmetric line is its value in the middle.
    let ramp: Vec<f32> = (0..64 * 64).map(|k| (k % 64) as f32).collect();
    let texture = Texture2d::<R32F>::new(64, 64, &ramp).unwrap();
    for count in 1..=16u8 {
        let sampler = Sampler { anisotropy: 16, ..Sampler::TRILINEAR };
        let (dx, dy) = ([f32::from(count) / 64.0, 0.0], [0.0, 1.0 / 64.0]);
        let found = texture.sample_grad(&sampler, Vec2::<Scalar>::from([0.5, 0.5]), dx.into(), dy.into());
        assert!((f32::from(found.r) - 31.5).abs() < 1e-4, "{count}: {found:?}");
    }
}

#[test]
fn no_seam_shows_in_a_cube_that_is_lit_evenly_and_corners_are_means_of_three() {
    let faces: Vec<f32> = (0..6).flat_map(|face| [f32::from(1u8 << face); 16]).collect();
    let cube = TextureCube::<R32F>::new(4, &faces).unwrap();
    let at = |d: [f32; 3]| f32::from(cube.sample_level(&Sampler::BILINEAR, Vec3::<Scalar>::from(d), 0.0).r);
    assert_eq!(at([1.0, 1.0, 1.0]), (1.0 + 4.0 + 16.0) / 3.0, "a corner");
    assert_eq!(at([1.0, 1.0, 0.0]), (1.0 + 4.0) / 2.0, "an edge");
    assert_eq!(at([-1.0, 0.0, -1.0]), (2.0 + 32.0) / 2.0);
    assert_eq!(at([0.0, 0.0, -3.0]), 32.0, "the middle of a face");
    let mut random = Random::new(8);
    for _ in 0..5_000 {
        // The same from both faces of every edge, as near as the coordinates can be.
        let mut d: [f32; 3] = std::array::from_fn(|_| random.real(-1.0, 1.0));
        let axis = random.between(0, 2) as usize;
        let size = d[(axis + 1) % 3].abs().max(d[axis].abs());
        (d[axis], d[(axis + 1) % 3]) = (size.copysign(d[axis]), size.copysign(d[(axis + 1) % 3]));
        let (mut one, mut other) = (d, d);
        one[axis] *= 1.00001;
        other[(axis + 1) % 3] *= 1.00001;
        if d[(axis + 2) % 3].abs() < 0.99 * size {
            assert!((at(one) - at(other)).abs() < 0.01, "{d:?}: {} and {}", at(one), at(other));
        }
    }
}

#[test]
fn cubes_are_plain_textures_away_from_edges() {
    let mut random = Random::new(21);
    let all = texels::<Rgba8>(&mut random, 6 * 64);
    let cube = TextureCube::<Rgba8>::new(8, all.clone()).unwrap();
    let faces = Texture2dArray::<Rgba8>::new(8, 8, 6, all).unwrap();
    let sampler = Sampler { wrap: [Wrap::Clamp; 3], ..Sampler::BILINEAR };
    for _ in 0..1_000 {
        let [s, t] = [random.real(-0.86, 0.86), random.real(-0.86, 0.86)];
        // Vulkan's table of faces, from s and t to a direction of any length.
        let face = random.between(0, 5) as i32;
        let [x, y, z] = match face {
            0 => [1.0, -t, -s],
            1 => [-1.0, -t, s],
            2 => [s, 1.0, t],
            3 => [s, -1.0, -t],
            4 => [s, -t, 1.0],
            _ => [-s, -t, -1.0],
        };
        let found = cube.sample_level(&sampler, Vec3::<Scalar>::from([x * 4.0, y * 4.0, z * 4.0]), 0.0);
        let uv = Vec2::<Scalar>::from([0.5 * s + 0.5, 0.5 * t + 0.5]);
        assert_eq!(
            bits(found),
            bits(faces.sample_level(&sampler, uv, Int::<Scalar>::from(face), 0.0)),
            "{face} {s} {t}"
        );
    }
}

#[test]
fn comparisons_are_filtered_after_they_are_made() {
    let map = Texture2d::<R32F>::new(2, 1, &[0.25, 0.75]).unwrap();
    let lit =
        |u: f32, depth: f32| f32::from(map.sample_compare(&Sampler::SHADOW, Vec2::<Scalar>::from([u, 0.5]), depth));
    assert_eq!([0.2, 0.5, 0.8].map(|depth| lit(0.5, depth)), [1.0, 0.5, 0.0]);
    assert_eq!([0.25, 0.375, 0.5, 0.75].map(|u| lit(u, 0.5)), [0.0, 0.25, 0.5, 1.0]);
    let nearest = Sampler { mag_filter: Filter::Nearest, ..Sampler::SHADOW };
    let equal = Sampler { compare: Compare::Equal, ..nearest };
    let at = Vec2::<Scalar>::from([0.2, 0.5]);
    assert_eq!(f32::from(map.sample_compare(&equal, at, 0.25)), 1.0);
    assert_eq!(f32::from(map.sample_compare(&nearest, at, f32::NAN)), 0.0, "NaN is lit by nothing");
}

#[test]
fn texels_beyond_the_borders_are_zero_when_fetched() {
    let texture = Texture2d::<R32U>::new(2, 2, &[10, 20, 30, 40]).unwrap();
    let at = |x: i32, y: i32, level: i32| {
        let RgbaU { r, a, .. } = texture.fetch(Int::<Scalar>::from(x), y.into(), level);
        [r, a].map(u32::from)
    };
    assert_eq!([at(0, 0, 0), at(1, 0, 0), at(0, 1, 0)], [[10, 1], [20, 1], [30, 1]]);
    for (x, y, level) in
        [(-1, 0, 0), (2, 0, 0), (0, 2, 0), (0, i32::MIN, 0), (i32::MAX, 0, 0), (0, 0, 1), (0, 0, -1), (0, 0, 99)]
    {
        assert_eq!(at(x, y, level), [0, 1], "{x} {y} {level}");
    }
}

#[test]
fn what_cannot_be_a_texture_is_an_error() {
    let four = [[0u8; 4]; 4];
    assert!(matches!(Texture2d::<Rgba8>::new(0, 2, &four), Err(Error::TextureSize { width: 0, .. })));
    assert!(matches!(Texture2d::<Rgba8>::new(2, 16_385, &four), Err(Error::TextureSize { most: 16_384, .. })));
    assert!(matches!(Texture3d::<Rgba8>::new(2, 2, 2_049, &four), Err(Error::TextureSize { most_slices: 2_048, .. })));
    assert!(matches!(Texture2dArray::<Rgba8>::new(2, 2, 0, &four), Err(Error::TextureSize { slices: 0, .. })));
    assert!(matches!(Texture2d::<Rgba8>::new(2, 3, &four), Err(Error::TextureLength { length: 4, expected: 6 })));
    assert!(matches!(
        Texture2d::<Rgba8>::from_channels(2, 2, &[0; 15]),
        Err(Error::TextureLength { length: 15, expected: 16 })
    ));
    assert!(matches!(
        Texture2d::<Rgba8>::from_channels(2, 2, &[0; 20]),
        Err(Error::TextureLength { length: 5, expected: 4 })
    ));
    assert!(matches!(
        Texture2d::<Rgba8>::with_levels(2, 2, 0, &four),
        Err(Error::TextureLevels { levels: 0, most: 2, .. })
    ));
    assert!(matches!(
        Texture2d::<Rgba8>::with_levels(2, 2, 3, &four),
        Err(Error::TextureLevels { levels: 3, most: 2, .. })
    ));
    assert!(matches!(Texture2d::<Rgba8>::with_levels(2, 2, 2, &four), Err(Error::TextureLength { expected: 5, .. })));
    assert!(matches!(Texture2dArray::<R8>::new(16_384, 16_384, 9, &[0]), Err(Error::TextureTooLarge { .. })));
    for error in [Texture2d::<R8>::new(0, 1, &[]).unwrap_err(), Texture2d::<R8>::new(1, 1, &[]).unwrap_err()] {
        assert!(!error.to_string().is_empty());
    }
    let borrowed = Texture2d::<Rgba8>::new(2, 2, &four).unwrap();
    assert!(std::ptr::eq(borrowed.texels(0), &four[..]), "what is borrowed is not copied");
    assert!(borrowed.texels(1).is_empty());
}
