//! A photographer's studio: a large key light, a cool fill light opposite, a strip light behind, and a white room.
//!
//! ```text
//!              rim                     the lamps turn with the camera, so that every view is lit well;
//!               \                      sky and ground stay where they are, so that up stays up
//!     key        model
//!        \      /
//!         eye      fill
//! ```
//!
//! Diffuse light wraps softly around edges (Valve's half-Lambert, generalised); highlights are GGX's (Walter et al. 2007)
//! with the visibility term approximated as in Karis's mobile BRDF (2014) and Schlick's Fresnel term.

use crate::base_color::BaseColor;
use crate::surface::{Surface, Vertex, seen_normal, surface};
use crate::tone::tone;
use pineda::{Fragment, Lanes, Mat4, Real, Rgba, Scalar, Shader, Vec3, Vec4, shader};

/// A distant lamp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lamp {
    /// Towards the lamp, in world space, of length 1.
    pub direction: [f32; 3],
    /// Linear light.
    pub color: [f32; 3],
    /// How far its light reaches around edges: 0 as a point light does, 1 to the far side.
    pub wrap: f32,
}

/// Soft studio light that flatters whatever it falls on.
#[derive(Clone, Debug)]
pub struct Studio<'s> {
    /// World space to clip space.
    pub clip_from_world: Mat4,
    /// World space.
    pub eye: [f32; 3],
    /// The surface's.
    pub base: BaseColor<'s>,
    /// The lamps: key, fill and rim.
    pub lamps: [Lamp; 3],
    /// Light from straight above (+y) and from straight below, mixed by the normal.
    pub sky: [f32; 3],
    /// See [`sky`](Self::sky).
    pub ground: [f32; 3],
    /// Of the highlights, above 0 (a mirror) to 1 (chalk).
    pub roughness: f32,
}

impl<'s> Studio<'s> {
    /// The studio around a camera at `eye` that looks at `target`, with `up` upwards; all in world space.
    #[must_use]
    pub fn new(clip_from_world: Mat4, eye: [f32; 3], target: [f32; 3], up: [f32; 3], base: BaseColor<'s>) -> Self {
        let back = unit(subtract(eye, target));
        let right = unit(cross(up, back));
        let up = cross(back, right);
        let towards = |[x, y, z]: [f32; 3]| unit([0, 1, 2].map(|axis| right[axis] * x + up[axis] * y + back[axis] * z));
        Self {
            clip_from_world,
            eye,
            base,
            lamps: [
                Lamp { direction: towards([-0.55, 0.75, 0.6]), color: [0.95, 0.90, 0.82], wrap: 0.15 },
                Lamp { direction: towards([0.9, 0.1, 0.45]), color: [0.07, 0.09, 0.12], wrap: 0.5 },
                Lamp { direction: towards([0.45, 0.5, -0.75]), color: [0.30, 0.32, 0.36], wrap: 0.0 },
            ],
            sky: [0.20, 0.22, 0.25],
            ground: [0.085, 0.075, 0.07],
            roughness: 0.42,
        }
    }
}

#[shader]
impl Shader for Studio<'_> {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Surface<L>;
    const DERIVATIVES: bool = true;

    fn vertex(&self, vertex: &Vertex) -> (Vec4, Surface<Scalar>) {
        surface(self.clip_from_world, vertex)
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let to_eye = (self.eye - f.position).normalize();
        let normal = facing(seen_normal::<L, Self>(f, f.normal), to_eye);
        let Surface { uv, uv_1, .. } = f.dual();
        let base = self.base.at(f.color, [uv, uv_1]);
        let albedo = base.rgb();

        let upward = normal.y * 0.5 + 0.5;
        let around = f.splat(self.ground).mix(self.sky, upward);
        let grazing = 1.0 - normal.dot(to_eye).clamp(0.0, 1.0);
        let fresnel = grazing.powi(5);

        let mut diffuse = around;
        // What the room itself reflects, stronger towards the outline.
        let mut specular = around * (0.04 + 0.45 * fresnel * upward);
        let [key, fill, rim] = self.lamps;
        diffuse += f.splat(key.color) * wrapped(normal, key);
        diffuse += f.splat(fill.color) * wrapped(normal, fill);
        diffuse += f.splat(rim.color) * wrapped(normal, rim);
        specular += highlight(normal, to_eye, key, self.roughness);
        specular += highlight(normal, to_eye, rim, self.roughness);
        Rgba::new(tone(albedo * diffuse + specular), base.a)
    }
}

/// The normal, bent back to the outline where interpolation has turned it away from the eye.
#[shader]
fn facing<L: Lanes>(normal: Vec3<L>, to_eye: Vec3<L>) -> Vec3<L> {
    let away = normal.dot(to_eye).min(0.0);
    (normal - to_eye * away).normalize()
}

/// `max(0, (n . l + wrap) / (1 + wrap))^(1 + wrap)`, the power approximated by mixing the first and the second.
#[shader]
fn wrapped<L: Lanes>(normal: Vec3<L>, lamp: Lamp) -> Real<L> {
    let x = ((normal.dot(lamp.direction) + lamp.wrap) / (1.0 + lamp.wrap)).max(0.0);
    x.mix(x * x, lamp.wrap)
}

/// The lamp's mirror image in a rough surface that reflects 4 % at right angles.
#[shader]
fn highlight<L: Lanes>(normal: Vec3<L>, to_eye: Vec3<L>, lamp: Lamp, roughness: f32) -> Vec3<L> {
    let half = (to_eye + lamp.direction).normalize();
    let n_dot_h = normal.dot(half).max(0.0);
    let l_dot_h = half.dot(lamp.direction).max(0.0);
    let alpha_squared = roughness * roughness * roughness * roughness;
    let d = n_dot_h * n_dot_h * (alpha_squared - 1.0) + 1.0;
    let visible = (l_dot_h * l_dot_h).max(0.1) * (roughness * 4.0 + 2.0) * d * d;
    let fresnel = 0.04 + 0.96 * (1.0 - l_dot_h).powi(5);
    let lit = normal.dot(lamp.direction).max(0.0);
    let strength = fresnel * lit * (alpha_squared / visible);
    let [r, g, b] = lamp.color;
    Vec3::new(strength * r, strength * g, strength * b)
}

fn subtract(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(v: [f32; 3]) -> [f32; 3] {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    v.map(|x| x / length)
}
