//! Textures: colours of nearest and linear filtering within one code of 8 bits, levels of detail within 1/64, answers of comparisons.

use super::Bench;
use super::depth::{cells, is_fat, point};
use super::lookups::{self, Format, How, Kind, Lookups, Place, Surfaces, Texture};
use super::reference;
use super::sheet::{Sheet, Vertex, clip_position};
use super::tally::{Row, Tally};
use super::theirs::lookups::SIDE;
use anyhow::Result;
use pineda::{Compare, Filter, MipFilter, Sampler, Wrap, f32_to_f16};
use pineda_oracle::cases::Random;

/// One code of 8 bits.
const CODE: f64 = 1.0 / 255.0;
/// Of levels of detail.
const STEP: f64 = 1.0 / 64.0;
/// Of a triangle, in pixels.
const CELL: u32 = 64;

const COLORS: [Format; 8] = [
    Format::Rgba8,
    Format::Rgba8Srgb,
    Format::R8,
    Format::Rg8,
    Format::R16F,
    Format::Rgba16F,
    Format::R32F,
    Format::Rgba32F,
];

/// The texel that a place lies in.
pub(crate) fn nearest(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    colors(bench, tally, Filter::Nearest, MipFilter::Nearest, &[Kind::Flat, Kind::Array, Kind::Volume])
}

/// The texels around it, of the nearest level.
pub(crate) fn linear(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    colors(bench, tally, Filter::Linear, MipFilter::Nearest, &[Kind::Flat, Kind::Array, Kind::Volume])
}

/// And of two levels.
pub(crate) fn trilinear(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    colors(bench, tally, Filter::Linear, MipFilter::Linear, &[Kind::Flat, Kind::Array, Kind::Volume])
}

/// All of that on the faces of cubes, and across their edges.
pub(crate) fn cubes(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    colors(bench, tally, Filter::Nearest, MipFilter::Nearest, &[Kind::Cube])?;
    colors(bench, tally, Filter::Linear, MipFilter::Linear, &[Kind::Cube])
}

fn colors(bench: &mut Bench, tally: &mut Tally, filter: Filter, mip_filter: MipFilter, kinds: &[Kind]) -> Result<()> {
    for format in COLORS {
        if matches!(format, Format::R32F | Format::Rgba32F)
            && filter == Filter::Linear
            && !bench.theirs.filters_floats()
        {
            continue;
        }
        for seed in bench.seed..bench.seed + 6 * bench.times {
            let mut random = Random::new(seed);
            let kind = random.pick(kinds);
            let texture = texture(&mut random, kind, format);
            let wraps = [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp, Wrap::Border];
            let wrap = [0; 3].map(|_| random.pick(&wraps));
            let sampler = Sampler {
                wrap,
                mag_filter: filter,
                min_filter: filter,
                mip_filter,
                border: [1.0; 4],
                ..Sampler::TRILINEAR
            };
            let places = (0..SIDE * SIDE)
                .map(|_| Place {
                    at: [0; 3].map(|_| coordinate(&mut random, kind)),
                    extra: level(&mut random, &texture),
                    layer: random.between(-1, 4) as f32,
                    ..Place::default()
                })
                .collect();
            let lookups = Lookups { texture, sampler, how: How::Level, places };
            look_up(bench, tally, seed, &lookups, CODE, |place, [our, their]| {
                if filter == Filter::Nearest {
                    return if at_a_border(&lookups, place, [our, their]) {
                        Verdict::Allowed
                    } else {
                        Verdict::Unexplained
                    };
                }
                let is_row = kind != Kind::Cube && is_8_bit_filtering(&lookups, place, our, their);
                if is_row { Verdict::Explained(Row::EightBitFiltering) } else { Verdict::Unexplained }
            })?;
        }
    }
    Ok(())
}

/// What a difference is that is larger than allowed.
enum Verdict {
    /// No difference after all: both are right.
    Allowed,
    Explained(Row),
    Unexplained,
}

/// Has both look up the same and asks for a verdict on each place where they find what is further apart than allowed.
fn look_up(
    bench: &mut Bench,
    tally: &mut Tally,
    seed: u64,
    lookups: &Lookups,
    allowed: f64,
    judge: impl Fn(&Place, [[f32; 4]; 2]) -> Verdict,
) -> Result<()> {
    let (ours, theirs) = (lookups::ours(lookups)?, bench.theirs.look_up(lookups)?);
    tally.cases += 1;
    for ((place, our), their) in lookups.places.iter().zip(ours).zip(theirs) {
        tally.pixels += 1;
        tally.drawn += 1;
        let difference = distance(our, their);
        if difference <= allowed {
            tally.allow(difference / allowed);
            continue;
        }
        let row = match judge(place, [our, their]) {
            Verdict::Allowed => continue,
            Verdict::Explained(row) => Some(row),
            Verdict::Unexplained => None,
        };
        tally.differs(row, || {
            let (Texture { kind, format, size, .. }, sampler) = (&lookups.texture, &lookups.sampler);
            format!(
                "seed {seed}, {kind:?} {format:?} {size:?}: pineda {our:?}, lavapipe {their:?}; {sampler:?}, {place:?}"
            )
        });
    }
    Ok(())
}

/// Whether a place lies so near the border of two texels that a rounding or two of its coordinates makes either of both: so each found one of them.
fn at_a_border(lookups: &Lookups, place: &Place, found: [[f32; 4]; 2]) -> bool {
    const ROUNDINGS: [f32; 3] = [1.0, 1.0 - 2.0 * f32::EPSILON, 1.0 + 2.0 * f32::EPSILON];
    let moved = |k: usize| {
        let [x, y, z] = place.at;
        let at = [x * ROUNDINGS[k % 3], y * ROUNDINGS[k / 3 % 3], z * ROUNDINGS[k / 9]];
        reference::color(lookups, &Place { at, ..*place }).color
    };
    let around: Vec<_> = (0..27).map(moved).collect();
    let is = |found: [f32; 4], color: &[f64; 4]| (0..4).all(|k| (f64::from(found[k]) - color[k]).abs() < 0.5 * CODE);
    found.iter().all(|&found| around.iter().any(|color| is(found, color)))
}

/// Whether `our` colour is right, and `their` one what comes of weights of 8 bits and steps rounded to codes: one along each axis, one between two levels.
fn is_8_bit_filtering(lookups: &Lookups, place: &Place, our: [f32; 4], their: [f32; 4]) -> bool {
    let exact = reference::color(lookups, place);
    let steps = if lookups.texture.kind == Kind::Volume { 4.0 } else { 3.0 };
    matches!(lookups.texture.format, Format::R8 | Format::Rg8 | Format::Rgba8)
        && (0..4).all(|k| {
            let (our, their) = (f64::from(our[k]) - exact.color[k], f64::from(their[k]) - exact.color[k]);
            our.abs() < 0.01 * CODE && their.abs() < exact.moves[k] + 0.5 * steps * CODE
        })
}

fn distance(our: [f32; 4], their: [f32; 4]) -> f64 {
    (0..4).map(|k| (f64::from(our[k]) - f64::from(their[k])).abs()).fold(0.0, f64::max)
}

/// Random texels of 0 to 1.
fn texture(random: &mut Random, kind: Kind, format: Format) -> Texture {
    let side = random.pick(&[1, 2, 8, 13, 32, 100, 128]);
    let other = random.pick(&[1, 4, 7, 64, 100]);
    let size = match kind {
        Kind::Flat => [side, other, 1],
        Kind::Array => [side, other, 3],
        Kind::Cube => [side, side, 6],
        Kind::Volume => [side.min(16), other.min(16), random.pick(&[1, 3, 8])],
    };
    let longest = if kind == Kind::Volume { size[0].max(size[1]).max(size[2]) } else { size[0].max(size[1]) };
    let mut texture = Texture { kind, format, size, levels: longest.ilog2() + 1, bytes: Vec::new() };
    for _ in 0..texture.texels_before(texture.levels) * format.channels() {
        let number = random.unit();
        match format.channel_size() {
            1 => texture.bytes.push(random.bits() as u8),
            2 if format == Format::Depth16 => texture.bytes.extend((random.bits() as u16).to_le_bytes()),
            2 => texture.bytes.extend(f32_to_f16(number).to_le_bytes()),
            _ => texture.bytes.extend(number.to_le_bytes()),
        }
    }
    texture
}

/// A level of detail, but none half way between two levels: Vulkan lets either be the nearest (16.6.10).
fn level(random: &mut Random, texture: &Texture) -> f32 {
    loop {
        let level = random.real(-1.0, texture.levels as f32);
        if level - level.floor() != 0.5 {
            return level;
        }
    }
}

fn coordinate(random: &mut Random, kind: Kind) -> f32 {
    match kind {
        Kind::Cube => random.real(-1.0, 1.0),
        _ => random.real(-1.5, 2.5),
    }
}

/// Depths next to a reference.
pub(crate) fn comparisons(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    const COMPARES: [Compare; 8] = [
        Compare::Never,
        Compare::Less,
        Compare::Equal,
        Compare::LessEqual,
        Compare::Greater,
        Compare::NotEqual,
        Compare::GreaterEqual,
        Compare::Always,
    ];
    for (compare, seed) in COMPARES.into_iter().zip(bench.seed..).cycle().take(24 * bench.times as usize) {
        for filter in [Filter::Nearest, Filter::Linear] {
            let mut random = Random::new(seed);
            let kind = random.pick(&[Kind::Flat, Kind::Array, Kind::Cube]);
            let texture = texture(&mut random, kind, Format::Depth16);
            let sampler = Sampler { mag_filter: filter, min_filter: filter, compare, ..Sampler::SHADOW };
            let places = (0..SIDE * SIDE)
                .map(|_| Place {
                    at: [0; 3].map(|_| coordinate(&mut random, kind)),
                    extra: random.between(0, 65535) as f32 / 65535.0,
                    layer: random.between(-1, 4) as f32,
                    ..Place::default()
                })
                .collect();
            let lookups = Lookups { texture, sampler, how: How::Compare, places };
            look_up(bench, tally, seed, &lookups, CODE, |_, _| Verdict::Unexplained)?;
        }
    }
    Ok(())
}

/// A texture whose levels show their numbers.
fn numbered(random: &mut Random, kind: Kind) -> Texture {
    let side = random.pick(&[64, 200, 1024]);
    let other = random.pick(&[32, 100, 1024]);
    let size = match kind {
        Kind::Flat => [side, other, 1],
        Kind::Array => [side, other, 2],
        Kind::Cube => [side, side, 6],
        Kind::Volume => [side.min(64), other.min(64), random.pick(&[3, 16, 64])],
    };
    let longest = size[..if kind == Kind::Volume { 3 } else { 2 }].iter().max().copied().unwrap_or(1);
    let mut texture = Texture { kind, format: Format::Rgba16F, size, levels: longest.ilog2() + 1, bytes: Vec::new() };
    for level in 0..texture.levels {
        let texels = texture.texels_before(level + 1) - texture.texels_before(level);
        let texel = [level as f32, 0.0, 0.0, 1.0].map(f32_to_f16);
        texture.bytes.extend(bytemuck::cast_slice::<_, u8>(&vec![texel; texels]));
    }
    texture
}

/// Levels of detail of gradients.
pub(crate) fn gradients(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    for kind in [Kind::Flat, Kind::Array, Kind::Volume, Kind::Cube] {
        for seed in bench.seed..bench.seed + 4 * bench.times {
            let mut random = Random::new(seed);
            let texture = numbered(&mut random, kind);
            let sampler = Sampler::TRILINEAR;
            let places = (0..SIDE * SIDE)
                .map(|_| {
                    let mut vector = || {
                        let size = random.magnitude(-11, 1);
                        [0; 3].map(|_| size * random.real(-1.0, 1.0))
                    };
                    let (right, down) = (vector(), vector());
                    Place { at: [0; 3].map(|_| coordinate(&mut random, kind)), right, down, ..Place::default() }
                })
                .collect();
            let lookups = Lookups { texture, sampler, how: How::Gradient, places };
            look_up(bench, tally, seed, &lookups, STEP, |place, [our, their]| {
                let squared = reference::longest_squared(&lookups.texture, place);
                let is_row = is_linear_logarithm(&lookups.texture, squared, our, their);
                if is_row { Verdict::Explained(Row::LinearLogarithm) } else { Verdict::Unexplained }
            })?;
        }
    }
    Ok(())
}

/// Whether `our` level of detail is right, and `their` one what their logarithm makes of the same square.
fn is_linear_logarithm(texture: &Texture, squared: f64, our: [f32; 4], their: [f32; 4]) -> bool {
    let exact = [reference::level_of_detail(texture, squared), reference::lavapipe_level_of_detail(texture, squared)];
    (f64::from(our[0]) - exact[0]).abs() < 0.01 && (f64::from(their[0]) - exact[1]).abs() < 0.01
}

/// Levels of detail of surfaces.
pub(crate) fn surfaces(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    for seed in bench.seed..bench.seed + 16 * bench.times {
        let mut random = Random::new(seed);
        let texture = numbered(&mut random, Kind::Flat);
        let sheet = Sheet::new(SIDE);
        let mut vertices = Vec::new();
        for origin in cells(SIDE, CELL) {
            let corners = loop {
                let corners = [0; 3].map(|_| point(&mut random, origin, CELL));
                if is_fat(corners) {
                    break corners;
                }
            };
            let size = random.magnitude(-8, 3);
            for corner in corners {
                let w = if seed % 2 == 0 { 1.0 } else { random.pick(&[0.5, 1.0, 2.0]) };
                let [u, v] = [0; 2].map(|_| size * random.real(-1.0, 1.0));
                vertices.push(Vertex {
                    position: clip_position(&sheet.viewport(), corner, 0.5, w),
                    color: [u, v, 0.0, 1.0],
                });
            }
        }
        let surfaces = Surfaces { texture, sampler: Sampler::TRILINEAR, vertices };
        tally.cases += surfaces.vertices.len() as u64 / 3;
        let ours = lookups::draw_surfaces(&mut bench.ours, &surfaces, SIDE)?;
        let theirs = bench.theirs.draw_surfaces(&surfaces)?;
        for (at, (our, their)) in ours.into_iter().zip(theirs).enumerate() {
            tally.pixels += 1;
            tally.drawn += u64::from(our[3] > 0.0);
            let difference = distance(our, their);
            if difference <= STEP {
                tally.allow(difference / STEP);
                continue;
            }
            let pixel = [at as u32 % SIDE, at as u32 / SIDE];
            let cell = (pixel[1] / CELL * (SIDE / CELL) + pixel[0] / CELL) as usize;
            let triangle = [0, 1, 2].map(|k| surfaces.vertices[3 * cell + k]);
            let row = why_levels_differ(&surfaces.texture, triangle, pixel, our, their);
            tally.differs(row, || {
                let size = surfaces.texture.size;
                format!("seed {seed}, pixel {pixel:?}, {size:?}: pineda {our:?}, lavapipe {their:?}; {triangle:?}")
            });
        }
    }
    Ok(())
}

/// The first of the rows that makes `their` level of detail of what they may know, where `our` one is right.
fn why_levels_differ(
    texture: &Texture,
    triangle: [Vertex; 3],
    pixel: [u32; 2],
    our: [f32; 4],
    their: [f32; 4],
) -> Option<Row> {
    let surface = reference::Surface::new(triangle, SIDE);
    let exact = surface.longest_squared(texture, pixel);
    if is_linear_logarithm(texture, exact, our, their) {
        return Some(Row::LinearLogarithm);
    }
    let of_quad = reference::lavapipe_level_of_detail(texture, surface.longest_squared_of_quad(texture, pixel));
    let is_ours_right = (f64::from(our[0]) - reference::level_of_detail(texture, exact)).abs() < 0.01;
    (is_ours_right && (f64::from(their[0]) - of_quad).abs() < 0.01).then_some(Row::Quads)
}
