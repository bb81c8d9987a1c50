//! Lanes look up what a single one does, at every SIMD level that shaders are compiled for. What that is, `tests/textures.rs` judges.

use super::*;
use crate::lanes::conformance::shader_levels;
use crate::lanes::{Lanes, Packet, Scalar};
use crate::math::{Real, Rgba, RgbaI, Vec3};
use crate::pass::Compare;
use crate::wide::dispatch_shader;
use pineda_oracle::cases::Random;

fn texels<F: Filterable>(random: &mut Random, count: u32) -> Vec<F::Texel> {
    (0..count).map(|_| F::nearest([random.unit(), random.unit(), random.unit(), random.unit()])).collect()
}

/// Sixteen lookups of each kind, as rows of bits. Those at a level are made of what those by gradients are made of.
#[inline(always)]
fn all_kinds<L: Lanes>(
    lanes: L,
    rows: &[[f32; 16]; 10],
    sampler: &Sampler,
    textures: &Textures,
    first: usize,
) -> Vec<Vec<i32>> {
    let row = |k: usize| Real::<L>::load(lanes, &rows[k][first..]);
    let (at, dx, dy) =
        (Vec3::new(row(0), row(1), row(2)), Vec3::new(row(3), row(4), row(5)), Vec3::new(row(6), row(7), row(8)));
    let (layer, level) = (row(9).to_int(), row(9) * 0.5);
    let Textures { flat, array, cube, volume, depth, numbers } = textures;
    let (x, y) = ((at.x * 8.0).to_int(), (at.y * 8.0).to_int());
    let compared = |x: Real<L>| Rgba::new(Vec3::new(x, x, x), x);
    let colors = [
        flat.sample_bias(sampler, at.xy().with_derivatives(dx.xy(), dy.xy()), level),
        array.sample_grad(sampler, at.xy(), layer, dx.xy(), dy.xy()),
        cube.sample(sampler, at.with_derivatives(dx, dy)),
        volume.sample_grad(sampler, at, dx, dy),
        compared(depth.sample_compare(sampler, at.xy(), row(2))),
        flat.fetch(x, y, layer),
    ];
    let mut all = Vec::new();
    let mut push = |number: L::I| {
        let mut row = vec![0; L::N];
        L::store_int(number, &mut row);
        all.push(row);
    };
    for color in colors {
        for channel in [color.r, color.g, color.b, color.a] {
            push(L::f_bits(channel.0));
        }
    }
    let number: RgbaI<L> = numbers.fetch(x, y, layer);
    push(number.r.0);
    push(number.a.0);
    all
}

struct Textures {
    flat: Texture2d<'static, Rgba8>,
    array: Texture2dArray<'static, Rgba8Srgb>,
    cube: TextureCube<'static, Rgba16F>,
    volume: Texture3d<'static, Rg16>,
    depth: Texture2d<'static, R32F>,
    numbers: Texture2d<'static, R32I>,
}

#[test]
fn all_levels_look_up_what_one_lane_does() {
    let mut random = Random::new(99);
    let textures = Textures {
        flat: Texture2d::new(13, 8, texels::<Rgba8>(&mut random, 13 * 8)).and_then(|t| t.with_mips()).unwrap(),
        array: Texture2dArray::new(8, 8, 3, texels::<Rgba8Srgb>(&mut random, 192)).and_then(|t| t.with_mips()).unwrap(),
        cube: TextureCube::new(8, texels::<Rgba16F>(&mut random, 384)).and_then(|t| t.with_mips()).unwrap(),
        volume: Texture3d::new(4, 5, 6, texels::<Rg16>(&mut random, 120)).and_then(|t| t.with_mips()).unwrap(),
        depth: Texture2d::new(8, 8, texels::<R32F>(&mut random, 64)).unwrap(),
        numbers: Texture2d::new(8, 8, (0..64).map(|k| k * -7).collect::<Vec<i32>>()).unwrap(),
    };
    for _ in 0..40 {
        let wraps = [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp, Wrap::Border];
        let filters = [Filter::Nearest, Filter::Linear, Filter::Linear];
        let sampler = Sampler {
            wrap: [random.pick(&wraps), random.pick(&wraps), random.pick(&wraps)],
            mag_filter: random.pick(&filters),
            min_filter: random.pick(&filters),
            mip_filter: random.pick(&[MipFilter::Base, MipFilter::Nearest, MipFilter::Linear]),
            anisotropy: random.pick(&[1, 1, 2, 7, 16, 0, 255]),
            border: [0.25, 0.5, 0.75, 1.0],
            compare: random.pick(&Compare::ALL),
            ..Sampler::TRILINEAR
        };
        let steepness = random.pick(&[0.02, 0.3, 3.0]);
        let mut rows = [[0.0; 16]; 10];
        for row in &mut rows[..3] {
            *row = std::array::from_fn(|_| match random.between(0, 15) {
                0 => random.pick(&[f32::NAN, f32::INFINITY, -1e30, 1.0, -1e-9]),
                _ => random.real(-1.5, 2.5),
            });
        }
        for row in &mut rows[3..9] {
            *row = std::array::from_fn(|_| random.real(-steepness, steepness));
        }
        rows[9] = std::array::from_fn(|_| random.between(-1, 4) as f32);
        if random.one_in(8) {
            rows[4][3] = f32::NAN;
            rows[6][5] = f32::INFINITY;
            rows[7][9] = 0.0;
        }
        for level in shader_levels() {
            let found = dispatch_shader!(level, simd => all_kinds(Packet(simd), &rows, &sampler, &textures, 0));
            for lane in 0..16 {
                let wanted = all_kinds(Scalar, &rows, &sampler, &textures, lane);
                for (k, (found, wanted)) in found.iter().zip(&wanted).enumerate() {
                    assert_eq!(
                        found[lane],
                        wanted[0],
                        "lookup {}, channel {}, lane {lane}, {level:?}, {sampler:?}",
                        k / 4,
                        k % 4
                    );
                }
            }
        }
    }
}

#[test]
fn lanes_decode_every_format_as_numbers_are() {
    #[inline(always)]
    fn rows<F: Filterable, L: Lanes>(lanes: L, words: &[[i32; 16]; 4], first: usize) -> [Vec<f32>; 4] {
        let words = words.each_ref().map(|row| lanes.load_int(&row[first..]));
        F::scaled::<L>(F::channels::<L>(words)).map(|channel| {
            let mut row = vec![0.0; L::N];
            channel.store(&mut row);
            row
        })
    }
    fn check<F: Filterable>() {
        let mut random = Random::new(5);
        let texels: Vec<F::Texel> = (0..16)
            .map(|_| {
                bytemuck::pod_read_unaligned(
                    &std::array::from_fn::<u8, 16, _>(|_| random.bits() as u8)[..size_of::<F::Texel>()],
                )
            })
            .collect();
        let mut words = [[0; 16]; 4];
        for (k, &texel) in texels.iter().enumerate() {
            let texel = F::words(texel, super::format::decoded::<F>());
            for (row, word) in words.iter_mut().zip(texel) {
                row[k] = word.cast_signed();
            }
        }
        for level in shader_levels() {
            let found = dispatch_shader!(level, simd => rows::<F, _>(Packet(simd), &words, 0));
            for lane in 0..16 {
                let wanted = rows::<F, _>(Scalar, &words, lane);
                for (found, wanted) in found.iter().zip(&wanted) {
                    let same =
                        found[lane].to_bits() == wanted[0].to_bits() || (found[lane].is_nan() && wanted[0].is_nan());
                    assert!(same, "{} {level:?}: {} {}", std::any::type_name::<F>(), found[lane], wanted[0]);
                }
            }
        }
    }
    check::<R8>();
    check::<Rg8>();
    check::<Rgba8>();
    check::<R8Srgb>();
    check::<Rg8Srgb>();
    check::<Rgba8Srgb>();
    check::<R16>();
    check::<Rg16>();
    check::<Rgba16>();
    check::<R16F>();
    check::<Rg16F>();
    check::<Rgba16F>();
    check::<R32F>();
    check::<Rg32F>();
    check::<Rgba32F>();
}
