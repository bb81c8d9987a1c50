//! Embree: no rasterizer but the best known ray tracer for CPUs. One ray through each pixel's middle, in packets of 4 x 4 that know that they are coherent, says what is seen there and how far away
//! it is: the same answer by other means. The hierarchy over the triangles is built before the clock starts.

use super::Backend;
use crate::scene::{Output, Scene, Size, gray};
use anyhow::{Context, Result, bail};
use embree3::{
    BufferUsage, Device, DeviceProperty, Format, GeometryKind, Hit16, INVALID_ID, IntersectContext, Ray16, RayHit16,
    SceneFlags, ValidMaskN,
};
use std::borrow::Cow;
use std::sync::Mutex;

pub(super) struct Embree {
    version: String,
    scene: embree3::Scene<'static>,
    camera: Camera,
    size: Size,
    threads: usize,
    output: Output,
    /// Numbers of triangles, or the bits of depths.
    pixels: Vec<u32>,
}

impl Embree {
    pub(super) fn new(scene: &Scene, threads: usize) -> Result<Self> {
        if scene.output == Output::Color {
            bail!("Embree is asked for depths and numbers of triangles only");
        }
        let device = Device::new().map_err(wrong).context("no device")?;
        // 31305 is 3.13.5.
        let number = device.get_property(DeviceProperty::VERSION).map_err(wrong)?;
        let version = format!("{}.{}.{}", number / 10_000, number / 100 % 100, number % 100);
        let mut triangles = device.create_geometry(GeometryKind::TRIANGLE).map_err(wrong)?;
        triangles
            .set_new_buffer::<[f32; 3]>(BufferUsage::VERTEX, 0, Format::FLOAT3, 12, scene.vertices.len())
            .map_err(wrong)?
            .copy_from_slice(&scene.vertices.iter().map(|vertex| vertex.position).collect::<Vec<_>>());
        let (indices, _) = scene.indices.as_chunks::<3>();
        triangles
            .set_new_buffer::<[u32; 3]>(BufferUsage::INDEX, 0, Format::UINT3, 12, indices.len())
            .map_err(wrong)?
            .copy_from_slice(indices);
        let mut built = device.create_scene().map_err(wrong)?;
        // Edges that two triangles share are to have no gap.
        built.set_flags(SceneFlags::ROBUST);
        built.attach_geometry(&triangles.commit());
        built.commit();
        let threads = if threads == 0 { std::thread::available_parallelism().map_or(1, usize::from) } else { threads };
        Ok(Self {
            version,
            scene: built,
            camera: Camera::new(scene.draws[0].clip_from_world, scene.size),
            size: scene.size,
            threads,
            output: scene.output,
            pixels: vec![0; (scene.size[0] * scene.size[1]) as usize],
        })
    }
}

fn wrong(error: embree3::Error) -> anyhow::Error {
    anyhow::anyhow!("Embree: {error:?}")
}

impl Backend for Embree {
    fn version(&self) -> String {
        format!("Embree {}, 16 coherent rays at a time, robust, hierarchy built before", self.version)
    }

    fn draw(&mut self) -> Result<()> {
        let Self { scene, camera, output, size: [width, _], .. } = self;
        // Four rows at a time, for whoever is free.
        let bands = Mutex::new(self.pixels.chunks_mut(4 * *width as usize).enumerate());
        let next = || bands.lock().ok()?.next();
        std::thread::scope(|scope| {
            for _ in 0..self.threads {
                scope.spawn(|| {
                    while let Some((number, band)) = next() {
                        trace(scene, camera, *output, *width as usize, 4 * number, band);
                    }
                });
            }
        });
        Ok(())
    }

    fn picture(&self) -> Cow<'_, [[u8; 4]]> {
        match self.output {
            Output::Depth => self.pixels.iter().map(|&bits| gray(f32::from_bits(bits))).collect(),
            Output::Color | Output::Ids => self.pixels.iter().map(|id| id.to_le_bytes()).collect(),
        }
    }
}

/// Up to four rows, 4 x 4 pixels at a time.
fn trace(
    scene: &embree3::Scene<'_>,
    camera: &Camera,
    output: Output,
    width: usize,
    first_row: usize,
    band: &mut [u32],
) {
    let mut context = IntersectContext::coherent();
    let all = ValidMaskN::<16>::all_active();
    let rows = band.len() / width;
    for column in (0..width).step_by(4) {
        let mut rays = camera.rays(column, first_row);
        scene.intersect16(&mut context, &mut rays, &all);
        for lane in 0..16 {
            let (x, y) = (column + lane % 4, lane / 4);
            if x < width && y < rows {
                let is_hit = rays.hit.geomID[lane] != INVALID_ID;
                band[y * width + x] = match output {
                    Output::Depth if is_hit => camera.depth(rays.ray.tfar[lane]).to_bits(),
                    Output::Depth => 1.0f32.to_bits(),
                    Output::Color | Output::Ids => rays.hit.primID[lane],
                };
            }
        }
    }
}

/// A camera on the z axis, as the scenes have it: where on a ray one is, is how far away along -z.
struct Camera {
    /// On the z axis.
    eye: f32,
    /// Of a pixel: x is `right.0 + right.1 * column`, y likewise.
    right: [f32; 2],
    up: [f32; 2],
    /// Clip space's z is `depth[0] * z + depth[1]`.
    depth: [f32; 2],
    near: f32,
    far: f32,
}

impl Camera {
    fn new(rows: [[f32; 4]; 4], [width, height]: Size) -> Self {
        let (across, down) = (2.0 / width as f32, 2.0 / height as f32);
        let [scale, offset] = [rows[2][2], rows[2][3]];
        let eye = rows[3][3];
        Self {
            eye,
            right: [(0.5 * across - 1.0) / rows[0][0], across / rows[0][0]],
            up: [(1.0 - 0.5 * down) / rows[1][1], -down / rows[1][1]],
            depth: [scale, offset],
            near: eye + offset / scale,
            far: (scale * eye + offset) / (1.0 + scale),
        }
    }

    fn rays(&self, column: usize, row: usize) -> RayHit16 {
        let mut rays = RayHit16 { ray: Ray16::empty(), hit: Hit16::new() };
        let ray = &mut rays.ray;
        for lane in 0..16 {
            ray.dir_x[lane] = self.right[0] + self.right[1] * (column + lane % 4) as f32;
            ray.dir_y[lane] = self.up[0] + self.up[1] * (row + lane / 4) as f32;
        }
        ray.org_z = [self.eye; 16];
        ray.dir_z = [-1.0; 16];
        ray.tnear = [self.near; 16];
        ray.tfar = [self.far; 16];
        rays
    }

    fn depth(&self, distance: f32) -> f32 {
        (self.depth[0] * (self.eye - distance) + self.depth[1]) / distance
    }
}
