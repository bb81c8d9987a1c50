//! `pineda` itself, as a program that depends on it would use it.

use super::Backend;
use crate::scene::{BlinnPhong, CLEAR_COLOR, HEIGHT, Scene, Shading, Vertex, WIDTH};
use anyhow::Result;
use pineda::{
    ColorBuffer, Cull, DrawState, Fragment, Indices, Lanes, Mat4, Mesh, Pass, Renderer, Rgba, Settings, Shader, Simd,
    Target, Vec3, Vec4, shader, varyings,
};

pub(super) struct Pineda {
    renderer: Renderer,
    scene: Scene,
    pixels: Vec<[u8; 4]>,
}

impl Pineda {
    pub(super) fn new(scene: &Scene, threads: usize) -> Result<Self> {
        Ok(Self {
            renderer: Renderer::new(Settings { threads, ..Settings::default() })?,
            scene: scene.clone(),
            pixels: vec![[0; 4]; (WIDTH * HEIGHT) as usize],
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
        let lit;
        let mut pass = Pass::new();
        pass.clear_color = Some(CLEAR_COLOR);
        match self.scene.shading {
            Shading::Gouraud => pass.draw(&colored, mesh, DrawState::default()),
            Shading::BlinnPhong(uniforms) => {
                lit = Lit { clip_from_world, uniforms };
                pass.draw(&lit, mesh, DrawState { cull: Cull::Back, ..DrawState::default() })
            }
        };
        let color = ColorBuffer::Rgba8(&mut self.pixels);
        let mut target = Target { color, ..Target::new(WIDTH, HEIGHT) };
        self.renderer.render(&pass, &mut target)?;
        Ok(())
    }

    fn pixels(&self) -> &[[u8; 4]] {
        &self.pixels
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
