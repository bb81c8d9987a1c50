//! Light from all around, filtered once so that a surface of any roughness can look it up.
//!
//! - What mirrors: a cube map whose levels are what surfaces of more and more roughness reflect (Karis 2013, "Real Shading in Unreal Engine 4", the first sum of two). Each texel is a mean over
//!   directions drawn from the GGX lobe around it, each looked up in a level as coarse as the draws are far apart (Křivánek and Colbert 2008, "Filtered importance sampling").
//! - What scatters: nine numbers a colour (Ramamoorthi and Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps").
//!
//! The filtering is drawn, with this very library. It takes longer than all the rest of a small picture: that of the studio was done once and lies in `studio.bin`.

use super::paint::{self, Paint};
use super::studio::Studio;
use pineda::{
    Error, Lanes, Real, Renderer, Rgba, Rgba16F, Sampler, Texture2d, TextureCube, Vec2, Vec3, Wrap, f16_to_f32,
    f32_to_f16, shader,
};
use std::borrow::Cow;
use std::f32::consts::{FRAC_1_PI, PI};

/// Texels of a face's sides in level 0.
const SIZE: u32 = 128;
/// Levels of roughness, from a mirror's to the roughest, whose faces have 4 x 4 texels.
const LEVELS: u32 = 6;
/// Directions drawn for each texel of each level but the first.
const DRAWS: [u32; LEVELS as usize - 1] = [16, 24, 32, 48, 64];

/// The studio's [`Filtered`] light. A test computes it anew and compares; `PINEDA_BLESS=1 cargo test --release -p pineda-looks --lib environment` writes it.
static STUDIO: &Aligned<[u8]> = &Aligned(*include_bytes!("studio.bin"));

/// Where texels can begin.
#[repr(C, align(8))]
struct Aligned<B: ?Sized>(B);

/// Light that comes from infinitely far away, from all around.
#[derive(Clone, Debug)]
pub struct Environment {
    mirrored: TextureCube<'static, Rgba16F>,
    /// Irradiance over pi as a polynomial of the normal: 1, y, z, x, xy, yz, 3z^2 - 1, xz, x^2 - y^2.
    scattered: [[f32; 3]; 9],
    /// Whether it turns with the camera.
    pub(super) is_studio: bool,
    /// Whether the key light shines beside it: what it gives is missing in what scatters.
    pub(super) has_key: bool,
}

/// What light from all around becomes by filtering.
#[derive(Debug, PartialEq)]
struct Filtered {
    /// What mirrors, all levels.
    levels: Cow<'static, [[u16; 4]]>,
    /// What scatters.
    scattered: [[f32; 3]; 9],
}

/// How bright the studio is beside other lights.
const DIMMED: f32 = 0.25;

impl Environment {
    /// The studio that is made in code.
    ///
    /// Errors: none that are known; they are a texture's.
    pub fn studio() -> Result<Self, Error> {
        Ok(Self { is_studio: true, has_key: true, ..Self::new(Filtered::from_bytes(&STUDIO.0))? })
    }

    /// The studio with its key light off and the others dimmed, to be there beside a scene's own lights. It takes some milliseconds.
    ///
    /// Errors: no memory.
    pub fn dim_studio(renderer: &mut Renderer) -> Result<Self, Error> {
        let dimmed = |size: u32, renderer: &mut Renderer| {
            let mut faces = paint::faces(&Paint::Studio(Studio { first: 1 }), size, renderer)?;
            for texel in &mut faces {
                let [r, g, b, a] = *texel;
                let [r, g, b] = [r, g, b].map(|light| f32_to_f16(f16_to_f32(light) * DIMMED));
                *texel = [r, g, b, a];
            }
            Ok::<_, Error>(faces)
        };
        let scattered = harmonics(&dimmed(16, renderer)?, 16);
        let filtered = Filtered::new(dimmed(SIZE, renderer)?, scattered, renderer)?;
        Ok(Self { is_studio: true, ..Self::new(filtered)? })
    }

    /// A panorama: an image, in linear light, of all directions, that of -z in the middle, those of +y along its first row and of -y along its last (as in .hdr and .exr files of environments).
    ///
    /// Errors: sizes that textures cannot have, or another number of pixels; no memory.
    pub fn panorama(width: u32, height: u32, pixels: &[[f32; 3]], renderer: &mut Renderer) -> Result<Self, Error> {
        // Halves end at 65504, and what no light is gives none.
        let half = |x: f32| f32_to_f16(if x > 0.0 { if x < 65504.0 { x } else { 65504.0 } } else { 0.0 });
        let halves: Vec<[u16; 4]> = pixels.iter().map(|&[r, g, b]| [half(r), half(g), half(b), half(1.0)]).collect();
        let picture = Texture2d::<Rgba16F>::new(width, height, halves)?.with_mips()?;
        // A texel of a face is as wide as this many of the panorama's, or level 0 is finer than that.
        let level = (width as f32 / (4 * SIZE) as f32).max(1.0);
        let small = Panorama { picture: picture.clone(), level: libm::log2f((width as f32 / 64.0).max(1.0)) };
        let scattered = harmonics(&paint::faces(&Paint::Panorama(small), 16, renderer)?, 16);
        let panorama = Panorama { picture, level: libm::log2f(level) };
        let faces = paint::faces(&Paint::Panorama(panorama), SIZE, renderer)?;
        Self::new(Filtered::new(faces, scattered, renderer)?)
    }

    /// Of no studio, without a key light.
    fn new(Filtered { levels, scattered }: Filtered) -> Result<Self, Error> {
        let mirrored = TextureCube::with_levels(SIZE, LEVELS, levels)?;
        Ok(Self { mirrored, scattered, is_studio: false, has_key: false })
    }

    /// What a surface of a roughness reflects, whose mirror image would be what lies in a direction.
    #[inline(always)]
    pub(super) fn mirrored<L: Lanes>(&self, direction: Vec3<L>, roughness: Real<L>) -> Vec3<L> {
        self.mirrored.sample_level(&Sampler::TRILINEAR, direction, roughness * (LEVELS - 1) as f32).rgb()
    }

    /// Irradiance over pi: what a white, matt surface looks like.
    #[shader(apart(normal))]
    pub(super) fn scattered<L: Lanes>(&self, normal: Vec3<L>) -> Vec3<L> {
        let Vec3 { x, y, z } = normal;
        let terms = [y, z, x, x * y, y * z, 3.0 * z * z - 1.0, x * z, x * x - y * y];
        let channel = |c: usize| {
            let mut sum = Real::new(normal.lanes(), self.scattered[0][c]);
            let mut k = 0;
            while k < 8 {
                sum += terms[k] * self.scattered[k + 1][c];
                k += 1;
            }
            sum.max(0.0)
        };
        Vec3::new(channel(0), channel(1), channel(2))
    }
}

impl Filtered {
    /// From what is seen in each direction, faces of `SIZE` x `SIZE` texels.
    fn new(faces: Vec<[u16; 4]>, scattered: [[f32; 3]; 9], renderer: &mut Renderer) -> Result<Self, Error> {
        let source = TextureCube::<Rgba16F>::new(SIZE, &faces[..])?.with_mips()?;
        let mut levels = faces.clone();
        for (level, draws) in (1..LEVELS).zip(DRAWS) {
            let roughness = level as f32 / (LEVELS - 1) as f32;
            let prefilter = Paint::Prefilter(Prefilter { source: &source, lobe: lobe(roughness, draws) });
            levels.append(&mut paint::faces(&prefilter, SIZE >> level, renderer)?);
        }
        Ok(Self { levels: levels.into(), scattered })
    }

    /// From bytes that hold the colours of what mirrors as halves, and then what scatters as f32; all little-endian. Where the machine is, too, the colours stay where they are.
    fn from_bytes(bytes: &'static [u8]) -> Self {
        let mut scattered = [[0.0; 3]; 9];
        let (texels, rest) = bytes.split_at(bytes.len() - size_of_val(&scattered));
        for (number, bytes) in scattered.as_flattened_mut().iter_mut().zip(rest.as_chunks().0) {
            *number = f32::from_le_bytes(*bytes);
        }
        let levels = match bytemuck::try_cast_slice(texels) {
            Ok(texels) if cfg!(target_endian = "little") => Cow::Borrowed(texels),
            _ => {
                let texel =
                    |&[r, s, g, h, b, c, a, d]: &[u8; 8]| [[r, s], [g, h], [b, c], [a, d]].map(u16::from_le_bytes);
                texels.as_chunks().0.iter().map(texel).collect()
            }
        };
        Self { levels, scattered }
    }
}

/// The coefficients of what scatters, of a level with `size` x `size` texels a face.
fn harmonics(texels: &[[u16; 4]], size: usize) -> [[f32; 3]; 9] {
    let mut sums = [[0.0f64; 3]; 9];
    for (k, texel) in texels.iter().enumerate() {
        let (face, y, x) = (k / (size * size), k / size % size, k % size);
        let [s, t] = [x, y].map(|x| (2 * x + 1) as f32 / size as f32 - 1.0);
        let direction = paint::direction(face, [s, t]).map(f64::from);
        let squared: f64 = direction.iter().map(|x| x * x).sum();
        let [x, y, z] = direction.map(|x| x / squared.sqrt());
        // The solid angle of the texel.
        let weight = 4.0 / ((size * size) as f64 * squared * squared.sqrt());
        let basis = [1.0, y, z, x, x * y, y * z, 3.0 * z * z - 1.0, x * z, x * x - y * y];
        for (sum, basis) in sums.iter_mut().zip(basis) {
            for c in 0..3 {
                sum[c] += f64::from(f16_to_f32(texel[c])) * basis * weight;
            }
        }
    }
    // The squares of the basis' norms, and by how much each band is dulled: pi, 2 pi / 3, pi / 4, here over pi.
    let pi = std::f64::consts::PI;
    let (one, two) = (3.0 / (4.0 * pi) * (2.0 / 3.0), 15.0 / (4.0 * pi) * 0.25);
    let factors = [1.0 / (4.0 * pi), one, one, one, two, two, two / 12.0, two, two / 4.0];
    std::array::from_fn(|k| sums[k].map(|sum| (sum * factors[k]) as f32))
}

/// Directions around +z that a surface reflects to an eye there, drawn from the GGX lobe (Walter et al. 2007): x, y, z (their weight, too) and the level to look up.
fn lobe(roughness: f32, draws: u32) -> Vec<[f32; 4]> {
    let alpha_squared = (roughness * roughness) * (roughness * roughness);
    let mut lobe = Vec::new();
    for k in 0..draws {
        // Hammersley's points.
        let u = (k as f32 + 0.5) / draws as f32;
        let v = k.reverse_bits() as f32 / 4_294_967_296.0;
        let cosine_squared = (1.0 - u) / (1.0 + (alpha_squared - 1.0) * u);
        let (cosine, sine) = (cosine_squared.sqrt(), (1.0 - cosine_squared).max(0.0).sqrt());
        let z = 2.0 * cosine_squared - 1.0;
        if z <= 0.0 {
            continue;
        }
        let angle = 2.0 * PI * v;
        let [x, y] = [libm::cosf(angle), libm::sinf(angle)].map(|c| 2.0 * cosine * sine * c);
        let d = cosine_squared * (alpha_squared - 1.0) + 1.0;
        let density = alpha_squared * FRAC_1_PI / (d * d) / 4.0;
        let (of_draw, of_texel) = (1.0 / (draws as f32 * density), 4.0 * PI / (6 * SIZE * SIZE) as f32);
        lobe.push([x, y, z, (0.5 * libm::log2f(of_draw / of_texel) + 1.0).max(0.0)]);
    }
    lobe
}

/// A level of what mirrors.
#[derive(Debug)]
pub(super) struct Prefilter<'a> {
    source: &'a TextureCube<'static, Rgba16F>,
    lobe: Vec<[f32; 4]>,
}

impl Prefilter<'_> {
    #[shader(apart(normal))]
    pub(super) fn color<L: Lanes>(&self, normal: Vec3<L>) -> Rgba<L> {
        let normal = normal.normalize();
        let (tangent, bitangent) = frame(normal);
        let (mut sum, mut weight) = (normal * 0.0, 0.0);
        for &[x, y, z, level] in &self.lobe {
            let direction = tangent * x + bitangent * y + normal * z;
            sum += self.source.sample_level(&Sampler::TRILINEAR, direction, level).rgb() * z;
            weight += z;
        }
        Rgba::opaque(sum / weight)
    }
}

/// Two unit vectors at right angles to a third and to each other (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
#[shader]
fn frame<L: Lanes>(n: Vec3<L>) -> (Vec3<L>, Vec3<L>) {
    let sign = n.z.ge(0.0).select(Real::new(n.lanes(), 1.0), -1.0);
    let a = -1.0 / (sign + n.z);
    let b = n.x * n.y * a;
    (Vec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x), Vec3::new(b, sign + n.y * n.y * a, -n.y))
}

/// A panorama, by direction.
#[derive(Debug)]
pub(super) struct Panorama {
    picture: Texture2d<'static, Rgba16F>,
    level: f32,
}

impl Panorama {
    #[shader(apart(direction))]
    pub(super) fn color<L: Lanes>(&self, direction: Vec3<L>) -> Rgba<L> {
        let Vec3 { x, y, z } = direction.normalize();
        let u = x.atan2(-z) * (0.5 * FRAC_1_PI) + 0.5;
        let v = 0.5 - y.clamp(-1.0, 1.0).asin() * FRAC_1_PI;
        let sampler = Sampler { wrap: [Wrap::Repeat, Wrap::Clamp, Wrap::Clamp], ..Sampler::TRILINEAR };
        let light = self.picture.sample_level(&sampler, Vec2::new(u, v), self.level).rgb();
        // A sun's disc would leave specks.
        Rgba::opaque(light.min([500.0; 3]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pineda::Settings;

    fn to_bytes(filtered: &Filtered) -> Vec<u8> {
        let mut bytes: Vec<u8> = filtered.levels.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
        bytes.extend(filtered.scattered.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
        bytes
    }

    #[test]
    fn environment_of_the_studio_is_what_its_file_holds() {
        let mut renderer = Renderer::new(Settings::default()).unwrap();
        let mut faces = |first, size| paint::faces(&Paint::Studio(Studio { first }), size, &mut renderer).unwrap();
        // The key light scatters by itself, with a shadow.
        let (mirrored, scattered) = (faces(0, SIZE), harmonics(&faces(1, 16), 16));
        let computed = Filtered::new(mirrored, scattered, &mut renderer).unwrap();
        if std::env::var_os("PINEDA_BLESS").is_some() {
            let path = concat!(env!("CARGO_MANIFEST_DIR"), "/src/pbr/studio.bin");
            return std::fs::write(path, to_bytes(&computed)).unwrap();
        }
        assert!(Filtered::from_bytes(&STUDIO.0) == computed, "the studio has changed: see `STUDIO`");
    }

    #[test]
    fn environment_of_the_studio_is_the_same_wherever_its_bytes_lie() {
        // Where no texel can begin, they are decoded one by one.
        let moved = [&[0], &STUDIO.0].concat().leak();
        let decoded = Filtered::from_bytes(&moved[1..]);
        assert!(matches!(decoded.levels, Cow::Owned(_)));
        assert!(decoded == Filtered::from_bytes(&STUDIO.0));
    }
}
