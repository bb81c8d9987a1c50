//! What is seen through a surface: the opaque part of the picture, looked up where a refracted ray leaves the body, blurred as the surface is rough (KHR_materials_transmission's and
//! _volume's "screen space" way: one surface behind another that lets light through is not seen through it).

use super::shader::Light;
use pineda::{Error, Lanes, Mat4, Real, Rgba16F, Sampler, Texture2d, Vec3, Wrap, shader};

/// The opaque part of a picture, in linear light.
#[derive(Debug)]
pub(super) struct Behind {
    picture: Texture2d<'static, Rgba16F>,
    clip_from_world: Mat4,
    /// Of its sides the longer one's logarithm to base 2.
    levels: f32,
}

impl Behind {
    pub(super) fn new(width: u32, height: u32, pixels: Vec<[u16; 4]>, clip_from_world: Mat4) -> Result<Self, Error> {
        let picture = Texture2d::<Rgba16F>::new(width, height, pixels)?.with_mips()?;
        Ok(Self { picture, clip_from_world, levels: libm::log2f(width.max(height) as f32) })
    }

    /// What comes through a surface at `position`, at the end of a body as thick as `thickness`.
    #[expect(clippy::too_many_arguments, reason = "a ray and what it goes through")]
    #[shader(apart(position))]
    pub(super) fn seen<L: Lanes>(
        &self,
        light: &Light<'_>,
        position: Vec3<L>,
        normal: Vec3<L>,
        to_eye: Vec3<L>,
        ior: f32,
        roughness: Real<L>,
        thickness: Real<L>,
        absorption: [f32; 3],
    ) -> Vec3<L> {
        let ray = (-to_eye).refract(normal, 1.0 / ior);
        let clip = self.clip_from_world * (position + ray * thickness).extend(1.0);
        let place = clip.xy() / clip.w * [0.5, -0.5] + 0.5;
        // The less a body refracts, the less its roughness blurs (as in the glTF sample viewer).
        let blur = roughness * (2.0 * ior - 2.0).clamp(0.0, 1.0);
        let sampler = Sampler { wrap: [Wrap::Clamp; 3], ..Sampler::TRILINEAR };
        let seen = self.picture.sample_level(&sampler, place, blur * self.levels);
        let seen = seen.rgb() + light.environment.mirrored(light.around(ray), blur) * (1.0 - seen.a).saturate();
        let [r, g, b] = absorption.map(|absorption| (thickness * absorption).exp());
        Vec3::new(seen.x * r, seen.y * g, seen.z * b)
    }
}
