//! Ambient occlusion: how much of the light from all around a place is hidden from by what is near it.
//!
//! In screen space, at half the picture's size: around each pixel some places are looked at, and what lies above the surface there hides (McGuire, Mara and Luebke 2012, "Scalable Ambient
//! Obscurance"). Each pixel turns the places by an angle of its own; a mean over 4 x 4 pixels at the same distance takes the noise out again.

use super::caster::Caster;
use super::paint::{self, Paint};
use crate::Vertex;
use crate::stage::{Prop, Stage};
use pineda::{
    Bool, ColorBuffer, Compare, DepthBuffer, DepthState, DrawState, Error, Fragment, Int, Lanes, Mat4, Pass, Real,
    Renderer, Rg32F, Rgba, Rgba32F, Shader, Target, Texture2d, Vec2, Vec3, Vec4, outputs, shader, varyings,
};
use std::f32::consts::TAU;

/// Places looked at around each pixel.
const PLACES: u32 = 14;
/// How often their spiral turns round; no divisor of their number.
const TURNS: f32 = 5.0;

/// The distance of what is not there.
const BEYOND: f32 = 1e30;

/// How open each place of the picture is.
#[derive(Debug)]
pub(super) struct Occlusion {
    /// At half the picture's size: openness, and the distance along the view axis, [`BEYOND`] where nothing is.
    map: Texture2d<'static, Rg32F>,
    forward: [f32; 3],
}

varyings! {
    /// A surface.
    struct Relief {
        position: Vec3,
        normal: Vec3,
    }
}

outputs! {
    /// A surface's place, relative to the eye, and its normal.
    struct Geometry {
        place: Rgba,
        normal: Rgba,
    }
}

/// Draws [`Geometry`].
struct Survey {
    clip_from_world: Mat4,
    eye: [f32; 3],
}

#[shader]
impl Shader for Survey {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Relief<L>;
    type Output<L: Lanes> = Geometry<L>;

    fn vertex(&self, vertex: &Vertex) -> (Vec4, Relief) {
        let position = Vec3::from(vertex.position);
        (
            self.clip_from_world * position.extend(1.0),
            Relief { position: position - self.eye, normal: vertex.normal.into() },
        )
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Geometry<L> {
        let normal = f.normal.normalize();
        Geometry { place: Rgba::opaque(f.position), normal: Rgba::opaque(f.front_facing().select(normal, -normal)) }
    }
}

/// Looks around each pixel.
#[derive(Debug)]
pub(super) struct LookAround<'a> {
    places: &'a Texture2d<'a, Rgba32F>,
    normals: &'a Texture2d<'a, Rgba32F>,
    forward: [f32; 3],
    /// How far is near, on the stage.
    radius: f32,
    /// Pixels that a unit at distance 1 is wide.
    focal: f32,
    /// Whether it is so wide at any distance.
    is_orthographic: bool,
}

impl LookAround<'_> {
    #[shader(apart(pixel))]
    pub(super) fn color<L: Lanes>(&self, pixel: Vec2<L>) -> Rgba<L> {
        let Vec2 { x, y } = pixel;
        let (column, row) = (x.floor().to_int(), y.floor().to_int());
        let here = self.places.fetch(column, row, 0);
        let is_there = here.a.gt(0.5);
        let zero = x * 0.0;
        if !is_there.any() {
            return Rgba { r: zero, g: zero + BEYOND, b: zero, a: zero };
        }
        let normal = self.normals.fetch(column, row, 0).rgb();
        let distance = here.rgb().dot(self.forward);
        let smaller = if self.is_orthographic { distance * 0.0 + 1.0 } else { distance.max(1e-3) };
        let reach = (self.radius * self.focal / smaller).min(200.0);
        // Interleaved gradient noise (Jimenez 2014).
        let noise = (52.982_918 * (0.067_110_56 * x + 0.005_837_15 * y).fract()).fract();
        let (sine, cosine) = (noise * TAU).sin_cos();
        let squared = self.radius * self.radius;
        let mut hidden = zero;
        for k in 0..PLACES {
            let part = (k as f32 + 0.5) / PLACES as f32;
            let angle = part * TURNS * TAU;
            let [c, s] = [libm::cosf(angle) * part, libm::sinf(angle) * part];
            let across = ((cosine * c - sine * s) * reach + x).floor().to_int();
            let down = ((sine * c + cosine * s) * reach + y).floor().to_int();
            let there = self.places.fetch(across, down, 0);
            let way = there.rgb() - here.rgb();
            let length = way.length_squared();
            let above = way.dot(normal) - 0.02 * self.radius;
            let near = (squared - length).max(0.0) * (1.0 / squared);
            let hides = near * near * near * (above / (length + 1e-2 * squared)).max(0.0);
            hidden += there.a.gt(0.5).select(hides, 0.0);
        }
        let open = (1.0 - hidden * (2.2 * self.radius / PLACES as f32)).max(0.0);
        Rgba { r: open, g: is_there.select(distance, BEYOND), b: zero, a: zero }
    }
}

/// The mean of 4 x 4 pixels, as far as they lie at the same distance.
#[derive(Debug)]
pub(super) struct Smooth<'a> {
    map: &'a Texture2d<'a, Rg32F>,
    radius: f32,
}

impl Smooth<'_> {
    #[shader(apart(pixel))]
    pub(super) fn color<L: Lanes>(&self, pixel: Vec2<L>) -> Rgba<L> {
        let (column, row) = (pixel.x.floor().to_int(), pixel.y.floor().to_int());
        let here = self.map.fetch(column, row, 0);
        if !is_there(here.g).any() {
            return here;
        }
        let (mut sum, mut weights) = (here.r * 1e-3, Real::new(pixel.lanes(), 1e-3));
        for k in 0..16 {
            let there = self.map.fetch(column + (k % 4 - 1), row + (k / 4 - 1), 0);
            let weight = (1.0 - (there.g - here.g).abs() * (4.0 / self.radius)).max(0.0);
            let weight = is_there(there.g).select(weight, 0.0);
            sum += there.r * weight;
            weights += weight;
        }
        Rgba { r: sum / weights, ..here }
    }
}

/// Whether there is anything at a distance.
#[shader]
fn is_there<L: Lanes>(distance: Real<L>) -> Bool<L> {
    distance.lt(BEYOND)
}

impl Occlusion {
    /// `size` is the picture's. `hides` says which props hide anything.
    pub(super) fn new(
        stage: &Stage,
        casters: &[Caster<'_, '_>],
        size: [u32; 2],
        hides: impl Fn(&Prop) -> bool,
        renderer: &mut Renderer,
    ) -> Result<Self, Error> {
        let camera = stage.camera;
        let [width, height] = size.map(|side| side.div_ceil(2));
        let length = camera.eye.iter().map(|x| x * x).sum::<f32>().sqrt();
        let forward = camera.eye.map(|x| -x / length);
        let survey = Survey { clip_from_world: camera.clip_from_world, eye: camera.eye };
        let count = (width * height) as usize;
        // As in `layers.rs`: what is left of surfaces with holes is found again by its depth.
        let casters = casters.iter().filter(|caster| hides(caster.prop));
        let casters: Vec<_> = casters.map(|caster| (caster.prop, caster.cut(camera.clip_from_world))).collect();
        let mut depths = vec![1.0; count];
        if casters.iter().any(|(_, cut)| cut.is_some()) {
            let mut pass = Pass::new();
            for (prop, cut) in &casters {
                if let Some(cut) = cut {
                    pass.draw(cut, prop.mesh(), prop.state());
                }
            }
            let depth = DepthBuffer::D32F(&mut depths);
            renderer.render(&pass, &mut Target { depth, ..Target::new(width, height) })?;
        }
        let mut pass = Pass::new();
        pass.clear_color = Some([0.0; 4]);
        pass.clear_depth = None;
        for (prop, cut) in &casters {
            let left = DepthState { compare: Compare::Equal, write: false };
            let depth = if cut.is_some() { left } else { DepthState::default() };
            pass.draw(&survey, prop.mesh(), DrawState { depth, ..prop.state() });
        }
        let (mut places, mut normals) = (vec![[0.0; 4]; count], vec![[0.0; 4]; count]);
        let mut target = Target::new(width, height);
        target.color = ColorBuffer::Rgba32F(&mut places);
        target.more_colors = vec![ColorBuffer::Rgba32F(&mut normals)];
        target.depth = DepthBuffer::D32F(&mut depths);
        renderer.render(&pass, &mut target)?;

        let [low, high] = stage.bounds;
        let [x, y, z] = [0, 1, 2].map(|axis| high[axis] - low[axis]);
        let radius = 0.09 * (x * x + y * y + z * z).sqrt().max(1e-6);
        let Mat4([[_, a, ..], [_, b, ..], [_, c, ..], _]) = camera.clip_from_world;
        let focal = 0.5 * height as f32 * (a * a + b * b + c * c).sqrt();
        let (places, normals) = (Texture2d::new(width, height, places)?, Texture2d::new(width, height, normals)?);
        let mut painted = |paint: &Paint<'_>| {
            let mut pixels = vec![[0.0; 2]; count];
            let color = ColorBuffer::Rg32F(&mut pixels);
            paint::map(paint, Target { color, ..Target::new(width, height) }, renderer)?;
            Texture2d::<Rg32F>::new(width, height, pixels)
        };
        let is_orthographic = camera.is_orthographic;
        let look = LookAround { places: &places, normals: &normals, forward, radius, focal, is_orthographic };
        let noisy = painted(&Paint::LookAround(look))?;
        Ok(Self { map: painted(&Paint::Smooth(Smooth { map: &noisy, radius }))?, forward })
    }

    /// How open a pixel's surface is, 0 to 1: the mean of the four around in the map, as far as they are at the surface's own distance. `from_eye` is where the surface is.
    #[shader(apart(pixel))]
    pub(super) fn open<L: Lanes>(&self, pixel: Vec2<L>, from_eye: Vec3<L>) -> Real<L> {
        let distance = from_eye.dot(self.forward);
        let at = pixel * 0.5 - 0.5;
        let (left, top) = (at.x.floor(), at.y.floor());
        let (across, down) = (at.x - left, at.y - top);
        let (column, row) = (left.to_int(), top.to_int());
        let (mut sum, mut weights) = (Real::new(distance.lanes(), 1e-4), Real::new(distance.lanes(), 1e-4));
        let mut k = 0;
        while k < 4 {
            let there =
                self.map.fetch(column + Int::new(distance.lanes(), k % 2), row + Int::new(distance.lanes(), k / 2), 0);
            let weight = if k % 2 == 0 { 1.0 - across } else { across } * if k / 2 == 0 { 1.0 - down } else { down };
            let near = (1.0 - (there.g - distance).abs() / (0.02 * distance)).max(0.0);
            let weight = is_there(there.g).select(weight * near, 0.0);
            sum += there.r * weight;
            weights += weight;
            k += 1;
        }
        sum / weights
    }
}
