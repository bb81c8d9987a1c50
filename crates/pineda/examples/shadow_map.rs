//! Shadow mapping: a picture of depths from where the light is, and from it, whether the light sees what the eye sees.
//!
//! The first pass has a depth buffer and nothing else. When it is drawn, the buffer is a texture; the second pass looks up, for each fragment, what the light saw in
//! that direction. Nine comparisons, each filtered, make borders soft (Reeves, Salesin and Cook 1987, "percentage closer filtering").
//!
//! `cargo run --release -p pineda --example shadow_map [OUT.png]`

use pineda::*;
use std::fs::File;
use std::path::PathBuf;

/// Pixels across and down.
pub const SIZE: u32 = 512;

/// Texels of the shadow map, across and down.
const MAP: u32 = 1024;

/// Position and normal.
type Corner = ([f32; 3], [f32; 3]);

/// What the light sees: depth, no colour.
struct FromLight {
    light: Mat4,
}

#[shader]
impl Shader for FromLight {
    type Vertex = Corner;
    type Varyings<L: Lanes> = ();

    fn vertex(&self, (position, _): &Corner) -> (Vec4, ()) {
        (self.light * Vec3::from(*position).extend(1.0), ())
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        Rgba::gray(f.z())
    }
}

varyings! {
    struct Surface {
        normal: Vec3,
        from_light: Vec4,
    }
}

struct Shadowed<'a> {
    camera: Mat4,
    light: Mat4,
    toward_light: [f32; 3],
    map: Texture2d<'a, R32F>,
    sampler: Sampler,
}

#[shader]
impl Shader for Shadowed<'_> {
    type Vertex = Corner;
    type Varyings<L: Lanes> = Surface<L>;

    fn vertex(&self, (position, normal): &Corner) -> (Vec4, Surface) {
        let position = Vec3::from(*position).extend(1.0);
        (self.camera * position, Surface { normal: (*normal).into(), from_light: self.light * position })
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let seen = f.from_light.xyz() / f.from_light.w;
        let place = seen.xy() * [0.5, -0.5] + 0.5;
        let mut lit = f.splat(0.0);
        for y in [-1.0, 0.0, 1.0] {
            for x in [-1.0, 0.0, 1.0] {
                let offset = [1.5 * x / MAP as f32, 1.5 * y / MAP as f32];
                lit += self.map.sample_compare(&self.sampler, place + offset, seen.z);
            }
        }
        let sun = f.normal.normalize().dot(self.toward_light).max(0.0) * lit * (1.0 / 9.0);
        let sky = f.normal.y * 0.5 + 0.5;
        Rgba::opaque([0.10, 0.13, 0.20] * sky + [0.85, 0.72, 0.55] * sun)
    }
}

/// A box from corner to corner, as twelve triangles.
fn add_box(out: &mut Vec<Corner>, low: [f32; 3], high: [f32; 3]) {
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for (side, sign) in [(low, -1.0), (high, 1.0)] {
            let mut normal = [0.0; 3];
            normal[axis] = sign;
            let mut quad = [side; 4];
            for (corner, (at_u, at_v)) in quad.iter_mut().zip([(low, low), (high, low), (high, high), (low, high)]) {
                (corner[u], corner[v]) = (at_u[u], at_v[v]);
            }
            if sign < 0.0 {
                quad.reverse();
            }
            out.extend([0, 1, 2, 0, 2, 3].map(|k| (quad[k], normal)));
        }
    }
}

/// A temple: a ring of columns under a roof of beams, on three steps.
fn temple() -> Vec<Corner> {
    let mut mesh = Vec::new();
    add_box(&mut mesh, [-30.0, -1.0, -30.0], [30.0, 0.0, 30.0]);
    for step in 0..3 {
        let (out, up) = (5.2 - 0.4 * step as f32, 0.25 * step as f32);
        add_box(&mut mesh, [-out, up, -out], [out, up + 0.25, out]);
    }
    for k in 0..7 {
        let along = -3.9 + 1.3 * k as f32;
        for (x, z) in [(along, -3.9), (along, 3.9), (-3.9, along), (3.9, along)] {
            add_box(&mut mesh, [x - 0.25, 0.75, z - 0.25], [x + 0.25, 4.2, z + 0.25]);
        }
        add_box(&mut mesh, [along - 0.15, 4.6, -4.4], [along + 0.15, 4.9, 4.4]);
    }
    for (low, high) in
        [([-4.4, -4.4], [4.4, -3.5]), ([-4.4, 3.5], [4.4, 4.4]), ([-4.4, -3.5], [-3.5, 3.5]), ([3.5, -3.5], [4.4, 3.5])]
    {
        add_box(&mut mesh, [low[0], 4.2, low[1]], [high[0], 4.6, high[1]]);
    }
    mesh
}

/// The picture, row by row from the top.
pub fn draw(settings: Settings) -> Result<Vec<[u8; 4]>, Error> {
    let mut renderer = Renderer::new(settings)?;
    let corners = temple();
    let mesh = Mesh { vertices: &corners, indices: Indices::Sequential };
    let toward_light = Vec3::from([0.55, 0.62, 0.56]).normalize().into();

    let light = Mat4::orthographic(-11.0, 11.0, -11.0, 11.0, 1.0, 60.0)
        * Mat4::look_at([16.5, 18.6, 16.8], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let from_light = FromLight { light };
    // Surfaces that the light grazes must not shadow themselves.
    let depth_bias = DepthBias { constant: 0.0, slope: 4.0, clamp: 0.0 };
    let mut pass = Pass::new();
    pass.draw(&from_light, mesh, DrawState { cull: Cull::Back, depth_bias, ..DrawState::default() });
    let mut depth = vec![0.0; (MAP * MAP) as usize];
    renderer.render(&pass, &mut Target { depth: DepthBuffer::D32F(&mut depth), ..Target::new(MAP, MAP) })?;

    let camera =
        Mat4::perspective(0.75, 1.0, 1.0, 100.0) * Mat4::look_at([-7.0, 9.0, 15.0], [0.0, 1.6, 0.0], [0.0, 1.0, 0.0]);
    // Beyond the map everything is lit.
    let sampler = Sampler { wrap: [Wrap::Border; 3], border: [1.0; 4], ..Sampler::SHADOW };
    let shadowed = Shadowed { camera, light, toward_light, map: Texture2d::new(MAP, MAP, &depth)?, sampler };
    let mut pass = Pass::new();
    pass.clear_color = Some([0.25, 0.35, 0.50, 1.0]);
    pass.draw(&shadowed, mesh, DrawState { cull: Cull::Back, ..DrawState::default() });
    let mut pixels = vec![[0; 4]; (SIZE * SIZE) as usize];
    renderer.render(&pass, &mut Target { color: ColorBuffer::Rgba8Srgb(&mut pixels), ..Target::new(SIZE, SIZE) })?;
    Ok(pixels)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).map_or("shadow_map.png".into(), PathBuf::from);
    let mut png = png::Encoder::new(File::create(path)?, SIZE, SIZE);
    png.set_color(png::ColorType::Rgba);
    png.write_header()?.write_image_data(draw(Settings::default())?.as_flattened())?;
    Ok(())
}
