//! `pineda` itself, as a program that depends on it would use it.

use super::Backend;
use crate::scene::{BlinnPhong, CLEAR_COLOR, HEIGHT, Output, Scene, Shading, Vertex, WIDTH, gray};
use anyhow::Result;
use pineda::{
    Blend, ColorBuffer, Cull, DepthBuffer, DepthState, DrawState, Fragment, Indices, Lanes, Mat4, Mesh, Pass, Renderer,
    Rgba, Samples, Settings, Shader, Simd, Target, Vec3, Vec4, shader, varyings,
};
use std::borrow::Cow;

pub(super) struct Pineda {
    renderer: Renderer,
    scene: Scene,
    pixels: Vec<[u8; 4]>,
    depth: Vec<f32>,
    ids: Vec<u32>,
}

impl Pineda {
    pub(super) fn new(scene: &Scene, threads: usize) -> Result<Self> {
        let pixels = |output| if scene.output == output { (WIDTH * HEIGHT) as usize } else { 0 };
        Ok(Self {
            renderer: Renderer::new(Settings { threads, ..Settings::default() })?,
            scene: scene.clone(),
            pixels: vec![[0; 4]; pixels(Output::Color)],
            depth: vec![0.0; pixels(Output::Depth)],
            ids: vec![0; pixels(Output::Ids)],
        })
    }
}

impl Backend for Pineda {
    fn version(&self) -> String {
        let best = Simd::available().last().map_or_else(String::new, |simd| format!(", {simd}"));
        let flags = if cfg!(target_feature = "avx2") { ", built for this machine only" } else { "" };
        format!("this repository's{best}{flags}")
    }

    fn draw(&mut self) -> Result<()> {
        let mesh = Mesh { vertices: &self.scene.vertices, indices: Indices::U32(&self.scene.indices) };
        let clip_from_world = Mat4(transposed(self.scene.clip_from_world));
        let colored = Colored { clip_from_world };
        let translucent = Translucent { clip_from_world };
        let lit;
        let mut pass = Pass::new();
        pass.clear_color = Some(CLEAR_COLOR);
        match self.scene.shading {
            Shading::Gouraud => pass.draw(&colored, mesh, DrawState::default()),
            Shading::Translucent => {
                let depth = DepthState { write: false, ..DepthState::default() };
                pass.draw(&translucent, mesh, DrawState { depth, blend: Blend::ALPHA, ..DrawState::default() })
            }
            Shading::BlinnPhong(uniforms) => {
                lit = Lit { clip_from_world, uniforms };
                pass.draw(&lit, mesh, DrawState { cull: Cull::Back, ..DrawState::default() })
            }
        };
        let samples = if self.scene.samples == 4 { Samples::Four } else { Samples::One };
        let mut target = Target { samples, ..Target::new(WIDTH, HEIGHT) };
        match self.scene.output {
            Output::Color => target.color = ColorBuffer::Rgba8(&mut self.pixels),
            Output::Depth => target.depth = DepthBuffer::D32F(&mut self.depth),
            Output::Ids => target.triangle_ids = Some(&mut self.ids),
        }
        self.renderer.render(&pass, &mut target)?;
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

/// Rows to columns.
fn transposed(rows: [[f32; 4]; 4]) -> [[f32; 4]; 4] {
    std::array::from_fn(|column| rows.map(|row| row[column]))
}
