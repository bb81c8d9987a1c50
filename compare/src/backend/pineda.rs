//! `pineda` itself, as a program that depends on it would use it.

use super::Backend;
use crate::scene::{BlinnPhong, CLEAR_COLOR, Draw, Output, Scene, Shading, State, TEXTURE_SIZE, Vertex, gray};
use anyhow::Result;
use pineda::{
    Blend, ColorBuffer, Compare, Cull, DepthBuffer, DepthState, DrawState, Fragment, Indices, Lanes, Mat4, Mesh, Pass,
    R16, Real, Renderer, Rgba, Rgba8, Sampler, Samples, Settings, Shader, Simd, Target, Texture2d, Vec2, Vec3, Vec4,
    Wrap, shader, varyings,
};
use std::borrow::Cow;

pub(super) struct Pineda {
    renderer: Renderer,
    scene: Scene,
    pixels: Vec<[u8; 4]>,
    depth: Vec<f32>,
    ids: Vec<u32>,
    textures: Vec<Texture2d<'static, Rgba8>>,
}

impl Pineda {
    pub(super) fn new(scene: &Scene, threads: usize) -> Result<Self> {
        let [width, height] = scene.size;
        let pixels = |output| if scene.output == output { (width * height) as usize } else { 0 };
        Ok(Self {
            renderer: Renderer::new(Settings { threads, ..Settings::default() })?,
            scene: scene.clone(),
            pixels: vec![[0; 4]; pixels(Output::Color)],
            depth: vec![0.0; pixels(Output::Depth)],
            ids: vec![0; pixels(Output::Ids)],
            textures: scene.textures.iter().map(texture).collect::<Result<_>>()?,
        })
    }
}

fn texture(texture: &crate::scene::Texture) -> Result<Texture2d<'static, Rgba8>> {
    let levels = texture.levels.len() as u32;
    Ok(Texture2d::with_levels(TEXTURE_SIZE, TEXTURE_SIZE, levels, texture.levels.concat())?)
}

impl Backend for Pineda {
    fn version(&self) -> String {
        let best = Simd::available().last().map_or_else(String::new, |simd| format!(", {simd}"));
        let flags = if cfg!(target_feature = "avx2") { ", built for this machine only" } else { "" };
        format!("this repository's{best}{flags}")
    }

    fn draw(&mut self) -> Result<()> {
        let Self { scene, renderer, textures, .. } = self;
        let shadow_map = match &scene.shadow_map[..] {
            [] => None,
            texels => Some(Texture2d::new(TEXTURE_SIZE, TEXTURE_SIZE, texels)?),
        };
        let shaders: Vec<AnyShader<'_>> =
            scene.draws.iter().map(|draw| AnyShader::new(scene, draw, textures, shadow_map.as_ref())).collect();
        let mut pass = Pass::new();
        pass.clear_color = Some(CLEAR_COLOR);
        for (draw, shader) in scene.draws.iter().zip(&shaders) {
            let indices = &scene.indices[draw.indices.start as usize..draw.indices.end as usize];
            let mesh = Mesh { vertices: &scene.vertices, indices: Indices::U32(indices) };
            let state = draw_state(draw.state);
            match shader {
                AnyShader::Colored(shader) => pass.draw(shader, mesh, state),
                AnyShader::Translucent(shader) => pass.draw(shader, mesh, state),
                AnyShader::Lit(shader) => pass.draw(shader, mesh, state),
                AnyShader::Textured(shader) => pass.draw(shader, mesh, state),
                AnyShader::Floor(shader) => pass.draw(shader, mesh, state),
                AnyShader::Shadowed(shader) => pass.draw(shader, mesh, state),
                AnyShader::FiveTextures(shader) => pass.draw(shader, mesh, state),
            };
        }
        let samples = if scene.samples == 4 { Samples::Four } else { Samples::One };
        let [width, height] = scene.size;
        let mut target = Target { samples, ..Target::new(width, height) };
        match scene.output {
            Output::Color => target.color = ColorBuffer::Rgba8(&mut self.pixels),
            Output::Depth => target.depth = DepthBuffer::D32F(&mut self.depth),
            Output::Ids => target.triangle_ids = Some(&mut self.ids),
        }
        renderer.render(&pass, &mut target)?;
        Ok(())
    }

    fn picture(&self) -> Cow<'_, [[u8; 4]]> {
        match self.scene.output {
            Output::Color => Cow::Borrowed(&self.pixels),
            Output::Depth => self.depth.iter().map(|&z| gray(z)).collect(),
            Output::Ids => self.ids.iter().map(|id| id.to_le_bytes()).collect(),
        }
    }
}

fn draw_state(state: State) -> DrawState {
    let depth = DepthState {
        compare: if state.passes_equal { Compare::LessEqual } else { Compare::Less },
        write: !state.blends,
    };
    DrawState {
        cull: if state.culls_back_faces { Cull::Back } else { Cull::None },
        blend: if state.blends { Blend::ALPHA } else { Blend::default() },
        depth,
        ..DrawState::default()
    }
}

/// A draw's shader.
enum AnyShader<'a> {
    Colored(Colored),
    Translucent(Translucent),
    Lit(Lit),
    Textured(Textured<'a>),
    Floor(Floor<'a>),
    Shadowed(Shadowed<'a>),
    FiveTextures(FiveTextures<'a>),
}

impl<'a> AnyShader<'a> {
    fn new(
        scene: &Scene,
        draw: &Draw,
        textures: &'a [Texture2d<'static, Rgba8>],
        shadow_map: Option<&'a Texture2d<'a, R16>>,
    ) -> Self {
        let clip_from_world = Mat4(transposed(draw.clip_from_world));
        let sampler = Sampler::TRILINEAR;
        match scene.shading {
            Shading::Gouraud if draw.state.blends => Self::Translucent(Translucent { clip_from_world }),
            Shading::Gouraud => Self::Colored(Colored { clip_from_world }),
            Shading::BlinnPhong(uniforms) => Self::Lit(Lit { clip_from_world, uniforms }),
            Shading::Textured(uniforms) => {
                Self::Textured(Textured { clip_from_world, uniforms, albedo: &textures[0], sampler })
            }
            Shading::Floor => {
                Self::Floor(Floor { clip_from_world, albedo: &textures[0], sampler: Sampler::ANISOTROPIC })
            }
            Shading::Shadowed(uniforms) => {
                let sampler = Sampler { wrap: [Wrap::Repeat; 3], ..Sampler::SHADOW };
                let shadow_map = shadow_map.expect("the scene has a shadow map");
                Self::Shadowed(Shadowed { clip_from_world, uniforms, shadow_map, sampler })
            }
            Shading::FiveTextures(uniforms) => {
                let [albedo, normal, metal, occlusion, emission] = std::array::from_fn(|k| &textures[k]);
                let five =
                    FiveTextures { clip_from_world, uniforms, albedo, normal, metal, occlusion, emission, sampler };
                Self::FiveTextures(five)
            }
        }
    }
}

struct Colored {
    clip_from_world: Mat4,
}

#[shader]
impl Shader for Colored {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Vec3<L>;

    fn vertex(&self, vertex: &Vertex) -> (Vec4, Vec3) {
        (self.clip_from_world * Vec3::from(vertex.position).extend(1.0), vertex.color.into())
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        Rgba::opaque(f.varyings())
    }
}

struct Translucent {
    clip_from_world: Mat4,
}

#[shader]
impl Shader for Translucent {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Vec3<L>;

    fn vertex(&self, vertex: &Vertex) -> (Vec4, Vec3) {
        (self.clip_from_world * Vec3::from(vertex.position).extend(1.0), vertex.color.into())
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        Rgba::new(f.varyings(), f.splat(0.5))
    }
}

varyings! {
    /// In world space.
    struct Surface {
        position: Vec3,
        normal: Vec3,
    }
}

struct Lit {
    clip_from_world: Mat4,
    uniforms: BlinnPhong,
}

#[shader]
impl Shader for Lit {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Surface<L>;

    fn vertex(&self, vertex: &Vertex) -> (Vec4, Surface) {
        let position = Vec3::from(vertex.position);
        (self.clip_from_world * position.extend(1.0), Surface { position, normal: vertex.normal.into() })
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let BlinnPhong { eye, light, albedo, ambient, specular } = self.uniforms;
        let normal = f.normal.normalize();
        let view = (eye - f.position).normalize();
        let half = (light + view).normalize();
        let diffuse = ambient + normal.dot(light).max(0.0);
        let highlight = specular * normal.dot(half).max(0.0).powi(32);
        Rgba::opaque(albedo * diffuse + highlight)
    }
}

varyings! {
    /// In world space.
    struct Mapped {
        position: Vec3,
        normal: Vec3,
        uv: Vec2,
    }
}

impl Mapped {
    fn of(vertex: &Vertex) -> Self {
        let [u, v, _] = vertex.color;
        Self { position: vertex.position.into(), normal: vertex.normal.into(), uv: [u, v].into() }
    }
}

#[shader]
impl BlinnPhong {
    /// How much of the light the surface scatters, and how much it mirrors.
    fn light<L: Lanes>(&self, position: Vec3<L>, normal: Vec3<L>) -> (Real<L>, Real<L>) {
        let normal = normal.normalize();
        let view = (self.eye - position).normalize();
        let half = (self.light + view).normalize();
        (normal.dot(self.light).max(0.0), self.specular * normal.dot(half).max(0.0).powi(32))
    }
}

struct Textured<'a> {
    clip_from_world: Mat4,
    uniforms: BlinnPhong,
    albedo: &'a Texture2d<'a, Rgba8>,
    sampler: Sampler,
}

#[shader]
impl Shader for Textured<'_> {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Mapped<L>;
    const DERIVATIVES: bool = true;

    fn vertex(&self, vertex: &Vertex) -> (Vec4, Mapped) {
        (self.clip_from_world * Vec3::from(vertex.position).extend(1.0), Mapped::of(vertex))
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let (diffuse, highlight) = self.uniforms.light(f.position, f.normal);
        let albedo = self.albedo.sample(&self.sampler, f.dual().uv);
        Rgba::opaque(albedo.rgb() * (self.uniforms.ambient + diffuse) + highlight)
    }
}

struct Floor<'a> {
    clip_from_world: Mat4,
    albedo: &'a Texture2d<'a, Rgba8>,
    sampler: Sampler,
}

#[shader]
impl Shader for Floor<'_> {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Vec2<L>;
    const DERIVATIVES: bool = true;

    fn vertex(&self, vertex: &Vertex) -> (Vec4, Vec2) {
        let [u, v, _] = vertex.color;
        (self.clip_from_world * Vec3::from(vertex.position).extend(1.0), [u, v].into())
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        self.albedo.sample(&self.sampler, f.dual())
    }
}

struct Shadowed<'a> {
    clip_from_world: Mat4,
    uniforms: BlinnPhong,
    shadow_map: &'a Texture2d<'a, R16>,
    sampler: Sampler,
}

#[shader]
impl Shader for Shadowed<'_> {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Surface<L>;

    fn vertex(&self, vertex: &Vertex) -> (Vec4, Surface) {
        let position = Vec3::from(vertex.position);
        (self.clip_from_world * position.extend(1.0), Surface { position, normal: vertex.normal.into() })
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        const TEXEL: f32 = 1.0 / TEXTURE_SIZE as f32;
        let (diffuse, highlight) = self.uniforms.light(f.position, f.normal);
        let (place, depth) = (f.position.xy() * 0.1 + 0.5, 0.5 - 0.1 * f.position.z);
        let mut lit = f.splat(0.0);
        for y in [-TEXEL, 0.0, TEXEL] {
            for x in [-TEXEL, 0.0, TEXEL] {
                lit += self.shadow_map.sample_compare(&self.sampler, place + [x, y], depth);
            }
        }
        let lit = lit * (1.0 / 9.0);
        Rgba::opaque(self.uniforms.albedo * (self.uniforms.ambient + diffuse * lit) + highlight * lit)
    }
}

struct FiveTextures<'a> {
    clip_from_world: Mat4,
    uniforms: BlinnPhong,
    albedo: &'a Texture2d<'a, Rgba8>,
    normal: &'a Texture2d<'a, Rgba8>,
    metal: &'a Texture2d<'a, Rgba8>,
    occlusion: &'a Texture2d<'a, Rgba8>,
    emission: &'a Texture2d<'a, Rgba8>,
    sampler: Sampler,
}

#[shader]
impl Shader for FiveTextures<'_> {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Mapped<L>;
    const DERIVATIVES: bool = true;

    fn vertex(&self, vertex: &Vertex) -> (Vec4, Mapped) {
        (self.clip_from_world * Vec3::from(vertex.position).extend(1.0), Mapped::of(vertex))
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let (uv, sampler) = (f.dual().uv, &self.sampler);
        let albedo = self.albedo.sample(sampler, uv).rgb();
        let bump = self.normal.sample(sampler, uv).rgb() - 0.5;
        let metal = self.metal.sample(sampler, uv);
        let (roughness, metalness) = (metal.g * 0.7 + 0.2, metal.b);
        let occlusion = self.occlusion.sample(sampler, uv).r;
        let emission = self.emission.sample(sampler, uv).rgb() * 0.05;

        let BlinnPhong { eye, light, ambient, .. } = self.uniforms;
        let normal = (f.normal + bump).normalize();
        let view = (eye - f.position).normalize();
        let half = (light + view).normalize();
        let (n_l, n_v) = (normal.dot(light).max(0.0), normal.dot(view).max(1e-3));
        let (n_h, v_h) = (normal.dot(half).max(0.0), view.dot(half).max(0.0));

        // GGX with height-correlated Smith, each without the factors that cancel.
        let alpha = roughness * roughness;
        let alpha2 = alpha * alpha;
        let spread = n_h * n_h * (alpha2 - 1.0) + 1.0;
        let smith =
            n_l * (n_v * n_v * (1.0 - alpha2) + alpha2).sqrt() + n_v * (n_l * n_l * (1.0 - alpha2) + alpha2).sqrt();
        let mirrored = alpha2 / (spread * spread * smith.max(1e-4) * (2.0 * std::f32::consts::PI));
        let f0 = albedo * metalness + (1.0 - metalness) * 0.04;
        let grazing = (1.0 - v_h).powi(5);
        let fresnel = f0 + (1.0 - f0) * grazing;
        let scattered = albedo * (1.0 - metalness) * (1.0 - fresnel) * (1.0 / std::f32::consts::PI);
        let lit = (scattered + fresnel * mirrored) * (n_l * std::f32::consts::PI);
        Rgba::opaque(lit + albedo * (occlusion * ambient) + emission)
    }
}

/// Rows to columns.
fn transposed(rows: [[f32; 4]; 4]) -> [[f32; 4]; 4] {
    std::array::from_fn(|column| rows.map(|row| row[column]))
}
