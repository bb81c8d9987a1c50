//! `euc`: scalar, single-threaded, one vertex at a time through the caller's own functions.
//!
//! It has no index buffer; as in its examples the vertex is an index and the vertex function looks it up. Its image is a `Buffer2d` that the caller owns,
//! so it is read in place. Its depth test is "less or equal" where the others' is "less", and it has no fill rule: pixels on a shared edge are drawn twice.

use super::Backend;
use crate::scene::{BlinnPhong, CLEAR_CODES, Scene, Shading};
use anyhow::{Result, bail};
use euc::rasterizer::{BackfaceCullingDisabled, BackfaceCullingEnabled, Triangles};
use euc::{Interpolate, Pipeline, Target, buffer::Buffer2d};
use std::borrow::Cow;

pub(super) struct Euc {
    scene: Scene,
    color: Buffer2d<[u8; 4]>,
    depth: Buffer2d<f32>,
}

impl Euc {
    pub(super) fn new(scene: &Scene) -> Self {
        let size = scene.size.map(|pixels| pixels as usize);
        Self { scene: scene.clone(), color: Buffer2d::new(size, CLEAR_CODES), depth: Buffer2d::new(size, 1.0) }
    }
}

impl Backend for Euc {
    fn version(&self) -> String {
        let flags = if cfg!(target_feature = "fma") {
            "built with fma"
        } else {
            "built without fma, so that its mul_add are function calls"
        };
        format!("euc 0.5.3, {flags}")
    }

    fn draw(&mut self) -> Result<()> {
        self.color.clear(CLEAR_CODES);
        self.depth.clear(1.0);
        let depth = Some(&mut self.depth);
        match self.scene.shading {
            Shading::Textured(_) | Shading::Floor | Shading::Shadowed(_) | Shading::FiveTextures(_) => {
                bail!("euc is asked for surfaces without textures only")
            }
            Shading::Gouraud => {
                type Rasterizer<'a> = Triangles<'a, Buffer2d<f32>, BackfaceCullingDisabled>;
                Colored { scene: &self.scene }.draw::<Rasterizer<'_>, _>(&self.scene.indices, &mut self.color, depth);
            }
            Shading::BlinnPhong(uniforms) => {
                type Rasterizer<'a> = Triangles<'a, Buffer2d<f32>, BackfaceCullingEnabled>;
                let pipeline = Lit { scene: &self.scene, uniforms };
                pipeline.draw::<Rasterizer<'_>, _>(&self.scene.indices, &mut self.color, depth);
            }
        }
        Ok(())
    }

    fn picture(&self) -> Cow<'_, [[u8; 4]]> {
        Cow::Borrowed(self.color.as_ref())
    }
}

/// A vector that euc interpolates as its own do: by multiply-add.
#[derive(Clone, Copy)]
struct Varying([f32; 3]);

impl Interpolate for Varying {
    #[inline(always)]
    fn lerp2(a: Self, b: Self, x: f32, y: f32) -> Self {
        Self(std::array::from_fn(|axis| a.0[axis].mul_add(x, b.0[axis] * y)))
    }

    #[inline(always)]
    fn lerp3(a: Self, b: Self, c: Self, x: f32, y: f32, z: f32) -> Self {
        Self(std::array::from_fn(|axis| a.0[axis].mul_add(x, b.0[axis].mul_add(y, c.0[axis] * z))))
    }
}

struct Colored<'a> {
    scene: &'a Scene,
}

impl Pipeline for Colored<'_> {
    type Vertex = u32;
    type VsOut = Varying;
    type Pixel = [u8; 4];

    #[inline(always)]
    fn vert(&self, &index: &u32) -> ([f32; 4], Varying) {
        let vertex = &self.scene.vertices[index as usize];
        (transform(&self.scene.draws[0].clip_from_world, vertex.position), Varying(vertex.color))
    }

    #[inline(always)]
    fn frag(&self, color: &Varying) -> [u8; 4] {
        encode(color.0)
    }
}

struct Lit<'a> {
    scene: &'a Scene,
    uniforms: BlinnPhong,
}

impl Pipeline for Lit<'_> {
    type Vertex = u32;
    /// Position and normal in world space.
    type VsOut = (Varying, Varying);
    type Pixel = [u8; 4];

    #[inline(always)]
    fn vert(&self, &index: &u32) -> ([f32; 4], Self::VsOut) {
        let vertex = &self.scene.vertices[index as usize];
        let clip = transform(&self.scene.draws[0].clip_from_world, vertex.position);
        (clip, (Varying(vertex.position), Varying(vertex.normal)))
    }

    #[inline(always)]
    fn frag(&self, (position, normal): &Self::VsOut) -> [u8; 4] {
        let BlinnPhong { eye, light, albedo, ambient, specular } = self.uniforms;
        let normal = normalize(normal.0);
        let view = normalize(std::array::from_fn(|axis| eye[axis] - position.0[axis]));
        let half = normalize(std::array::from_fn(|axis| light[axis] + view[axis]));
        let diffuse = ambient + dot(normal, light).max(0.0);
        let highlight = specular * dot(normal, half).max(0.0).powi(32);
        encode(albedo.map(|channel| channel * diffuse + highlight))
    }
}

#[inline(always)]
fn transform(rows: &[[f32; 4]; 4], [x, y, z]: [f32; 3]) -> [f32; 4] {
    rows.map(|row| row[0] * x + row[1] * y + row[2] * z + row[3])
}

#[inline(always)]
fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn normalize(v: [f32; 3]) -> [f32; 3] {
    let scale = 1.0 / dot(v, v).sqrt();
    v.map(|component| component * scale)
}

/// Linear colour to the nearest code; `as` clamps.
#[inline(always)]
fn encode([red, green, blue]: [f32; 3]) -> [u8; 4] {
    [(255.0 * red + 0.5) as u8, (255.0 * green + 0.5) as u8, (255.0 * blue + 0.5) as u8, 255]
}
