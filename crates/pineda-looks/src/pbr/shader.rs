//! The surface itself: a material in light from all around, from a key light, and from lamps.

use super::brdf;
use super::environment::Environment;
use super::lamps::{self, Facing, Lamp};
use super::material::{Coating, Workflow};
use super::occlusion::Occlusion;
use super::shadow::Shadow;
use super::tone::ToneMapping;
use super::transmission::Behind;
use crate::Vertex;
use crate::gallery::{Map, UV_SETS};
use pineda::{Bool, Dual, Fragment, Lanes, Mat4, Real, Rgba, Shader, Vec2, Vec3, Vec4, shader, varyings};
use pineda_scene::AlphaMode;

varyings! {
    /// A surface at a pixel.
    pub struct Seen {
        /// On the stage.
        pub position: Vec3,
        /// Interpolated: not quite of length 1.
        pub normal: Vec3,
        /// The same, and the bitangent's sign.
        pub tangent: Vec4,
        /// The first set of texture coordinates.
        pub first: Vec2,
        /// The second one.
        pub second: Vec2,
        /// Linear light.
        pub color: Vec4,
    }
}

varyings! {
    /// The same without what only maps ask for.
    pub struct PlainlySeen {
        /// On the stage.
        pub position: Vec3,
        /// Interpolated: not quite of length 1.
        pub normal: Vec3,
        /// Linear light.
        pub color: Vec4,
    }
}

/// What all surfaces of a picture share.
#[derive(Debug)]
pub(super) struct Light<'a> {
    pub(super) clip_from_world: Mat4,
    pub(super) eye: [f32; 3],
    /// The eye, homogeneous: infinitely far away without perspective.
    pub(super) to_eye: [f32; 4],
    pub(super) environment: &'a Environment,
    /// The environment's frame in the stage's world: where its x, y and z point.
    pub(super) axes: [[f32; 3]; 3],
    /// What the key light gives where it falls straight on, and its shadow.
    pub(super) key: Option<([f32; 3], &'a Shadow)>,
    /// The scene's own lights.
    pub(super) lamps: &'a [Lamp],
    pub(super) occlusion: Option<&'a Occlusion>,
    pub(super) exposure: f32,
    pub(super) tone_mapping: ToneMapping,
}

impl Light<'_> {
    /// A direction of the stage's, in the environment.
    #[inline(always)]
    pub(super) fn around<L: Lanes>(&self, direction: Vec3<L>) -> Vec3<L> {
        let [x, y, z] = self.axes;
        Vec3::new(direction.dot(x), direction.dot(y), direction.dot(z))
    }
}

/// A surface without maps.
#[derive(Debug)]
pub(super) struct Plain<'a, 's>(pub(super) Surface<'a, 's>);
/// And with maps.
#[derive(Debug)]
pub(super) struct Mapped<'a, 's>(pub(super) Surface<'a, 's>);
/// And with holes.
#[derive(Debug)]
pub(super) struct Masked<'a, 's>(pub(super) Surface<'a, 's>);

/// A material in its light.
#[derive(Debug)]
pub(super) struct Surface<'a, 's> {
    pub(super) light: &'a Light<'a>,
    pub(super) coating: &'a Coating<'s>,
    /// Whether the vertices have tangents.
    pub(super) has_tangents: bool,
    /// What lies behind a surface that lets light through.
    pub(super) behind: Option<&'a Behind>,
    /// Whether light is left as it is, for [`Behind`].
    pub(super) is_raw: bool,
}

#[shader]
impl Shader for Plain<'_, '_> {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = PlainlySeen<L>;

    fn vertex(&self, vertex: &Vertex) -> (Vec4, PlainlySeen) {
        let (clip, Seen { position, normal, color, .. }) = self.0.seen(vertex);
        (clip, PlainlySeen { position, normal, color })
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let (none, zero) = (f.splat([0.0; 2]), f.splat([0.0; 3]));
        let PlainlySeen { position, normal, color } = f.varyings();
        let seen = Seen { position, normal, tangent: f.splat([0.0; 4]), first: none, second: none, color };
        let uvs = [none.with_derivatives(none, none); 2];
        let place = Place { uvs, steps: [zero; 2], is_front: f.front_facing(), pixel: Vec2::new(f.x(), f.y()) };
        self.0.color(&seen, &place)
    }
}

#[shader]
impl Shader for Mapped<'_, '_> {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Seen<L>;
    const DERIVATIVES: bool = true;

    fn vertex(&self, vertex: &Vertex) -> (Vec4, Seen) {
        self.0.seen(vertex)
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let (seen, place) = (f.varyings(), Place::of(f));
        self.0.color(&seen, &place)
    }
}

#[shader]
impl Shader for Masked<'_, '_> {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Seen<L>;
    const DERIVATIVES: bool = true;
    const DISCARDS: bool = true;

    fn vertex(&self, vertex: &Vertex) -> (Vec4, Seen) {
        self.0.seen(vertex)
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let (seen, place) = (f.varyings(), Place::of(f));
        let cutoff = if let AlphaMode::Mask { cutoff } = self.0.coating.alpha_mode { cutoff } else { 0.0 };
        f.discard(self.0.base_color(&seen, &place).a.lt(cutoff));
        self.0.color(&seen, &place)
    }
}

/// Where on a surface a fragment is.
struct Place<L: Lanes> {
    uvs: [Vec2<Dual<L>>; UV_SETS],
    /// By how much the position changes from a pixel to the next ones, right and down.
    steps: [Vec3<L>; 2],
    is_front: Bool<L>,
    /// In pixels.
    pixel: Vec2<L>,
}

impl<L: Lanes> Place<L> {
    /// With derivatives, for maps.
    #[inline(always)]
    fn of<S: Shader<Varyings<L> = Seen<L>>>(f: &Fragment<L, S>) -> Self {
        let dual = f.dual();
        let (uvs, steps) = ([dual.first, dual.second], [f.dx().position, f.dy().position]);
        Self { uvs, steps, is_front: f.front_facing(), pixel: Vec2::new(f.x(), f.y()) }
    }
}

/// A map's numbers, or ones.
#[shader(apart(place.pixel))]
fn numbers<L: Lanes>(map: &Option<Map<'_>>, place: &Place<L>) -> Rgba<L> {
    match map {
        Some(map) => map.sample(place.uvs),
        None => {
            let one = Real::new(place.pixel.lanes(), 1.0);
            Rgba { r: one, g: one, b: one, a: one }
        }
    }
}

/// `color` times a map's colour.
#[inline(always)]
fn tinted<L: Lanes>(color: [f32; 3], map: &Option<Map<'_>>, place: &Place<L>) -> Vec3<L> {
    numbers(map, place).rgb() * color
}

impl Surface<'_, '_> {
    fn seen(&self, vertex: &Vertex) -> (Vec4, Seen) {
        let position = Vec3::from(vertex.position);
        let [first, second] = vertex.uvs.map(Vec2::from);
        let (normal, tangent, color) = (vertex.normal.into(), vertex.tangent.into(), vertex.color.into());
        (self.light.clip_from_world * position.extend(1.0), Seen { position, normal, tangent, first, second, color })
    }

    #[inline(always)]
    fn base_color<L: Lanes>(&self, seen: &Seen<L>, place: &Place<L>) -> Rgba<L> {
        let Rgba { r, g, b, a } = numbers(&self.coating.base_color_map, place);
        let ([fr, fg, fb, fa], color) = (self.coating.base_color, seen.color);
        Rgba { r: r * fr * color.x, g: g * fg * color.y, b: b * fb * color.z, a: a * fa * color.w }
    }

    /// Tangent, bitangent and normal, turned to the eye. Without tangents of its own, the surface's first coordinate says where the tangent lies, by how it changes from pixel to pixel.
    #[shader(apart(seen.normal))]
    fn frame<L: Lanes>(&self, seen: &Seen<L>, place: &Place<L>) -> [Vec3<L>; 3] {
        let normal = seen.normal.normalize();
        let side = place.is_front.select(Real::new(normal.lanes(), 1.0), -1.0);
        if self.has_tangents {
            let tangent = seen.tangent.xyz().normalize();
            let bitangent = normal.cross(tangent) * seen.tangent.w;
            return [tangent * side, bitangent * side, normal * side];
        }
        // Mikkelsen 2020, "Surface Gradient-Based Bump Mapping Framework": what a step of u is, in the surface.
        let uv = place.uvs[0];
        let (dx, dy) = (uv.dx(), uv.dy());
        let determinant = dx.x * dy.y - dy.x * dx.y;
        let sign = determinant.ge(0.0).select(Real::new(normal.lanes(), 1.0), -1.0);
        let [right, down] = place.steps;
        let tangent = (right * dy.y - down * dx.y) * sign;
        let tangent = (tangent - normal * tangent.dot(normal)).normalize();
        // v grows downwards in images: the bitangent points to where it grows.
        let along = (down * dx.x - right * dy.x) * sign;
        let across = normal.cross(tangent);
        let bitangent = across.dot(along).ge(0.0).select(across, -across);
        // glTF's normal maps have y upwards, against v.
        [tangent * side, -bitangent * side, normal * side]
    }

    /// A normal map's normal.
    #[shader(apart(normal))]
    fn mapped_normal<L: Lanes>(
        &self,
        [tangent, bitangent, normal]: [Vec3<L>; 3],
        map: &Option<Map<'_>>,
        scale: f32,
        place: &Place<L>,
    ) -> Vec3<L> {
        let Some(map) = map else { return normal };
        let Vec3 { x, y, z } = map.sample(place.uvs).rgb() * 2.0 - 1.0;
        (tangent * (x * scale) + bitangent * (y * scale) + normal * z).normalize()
    }

    /// What reaches the eye, its alpha multiplied in: compiled once for all shaders that it is part of.
    #[shader(apart(place.pixel))]
    fn color<L: Lanes>(&self, seen: &Seen<L>, place: &Place<L>) -> Rgba<L> {
        let (light, coating) = (self.light, self.coating);
        let base = self.base_color(seen, place);
        let lanes = base.a.lanes();
        let one = Real::new(lanes, 1.0);
        let alpha = if coating.alpha_mode == AlphaMode::Blend { base.a.saturate() } else { one };
        if coating.unlit {
            return self.shown(base.rgb(), alpha, false);
        }
        let frame = self.frame(seen, place);
        let geometric = frame[2];
        let [x, y, z, w] = light.to_eye;
        let to_eye = ([x, y, z] - seen.position * w).normalize();
        let mapped = self.mapped_normal(frame, &coating.normal_map, coating.normal_scale, place);
        // Bent back to the outline where interpolation, or the map, has turned it away from the eye.
        let normal = (mapped - to_eye * mapped.dot(to_eye).min(0.0)).normalize();
        let n_dot_v = normal.dot(to_eye).clamp(1e-3, 1.0);

        // What the material is here.
        let (mut f0, albedo, roughness, strength);
        match &coating.workflow {
            Workflow::Metallic { metallic, roughness: factor, map } => {
                let map = numbers(map, place);
                let metallic = (map.b * *metallic).saturate();
                roughness = (map.g * *factor).clamp(0.03, 1.0);
                let (mut dielectric, mut specular) = (Vec3::new(one, one, one) * coating.reflectance, one);
                if let Some(layer) = &coating.specular {
                    specular = numbers(&layer.map, place).a * layer.factor;
                    dielectric = (dielectric * tinted(layer.color, &layer.color_map, place)).min([1.0; 3]);
                }
                f0 = dielectric.mix(base.rgb(), metallic);
                albedo = base.rgb() * (1.0 - metallic);
                strength = specular.mix(1.0, metallic);
            }
            Workflow::Specular { specular, glossiness, map } => {
                let map = numbers(map, place);
                f0 = map.rgb() * *specular;
                roughness = (1.0 - map.a * *glossiness).clamp(0.03, 1.0);
                albedo = base.rgb() * (1.0 - f0.x.max(f0.y).max(f0.z));
                strength = one;
            }
        }
        if let Some(film) = &coating.iridescence {
            let [low, high] = film.thickness;
            let thickness = Real::new(lanes, low).mix(high, numbers(&film.thickness_map, place).g);
            let factor = (numbers(&film.map, place).r * film.factor).saturate();
            f0 = f0.mix(brdf::thin_film(n_dot_v, film.ior, thickness, f0).min([1.0; 3]), factor);
        }
        let occlusion = 1.0 + (numbers(&coating.occlusion_map, place).r - 1.0) * coating.occlusion_strength;
        let mut open = occlusion;
        if let Some(all) = light.occlusion {
            open = open.min(all.open(place.pixel, seen.position - light.eye));
        }

        // Light from all around.
        let mut mirror = normal;
        if let Some(brushed) = &coating.anisotropy {
            let map = numbers(&brushed.map, place);
            let (x, y) = if brushed.map.is_some() { (map.r * 2.0 - 1.0, map.g * 2.0 - 1.0) } else { (one, one * 0.0) };
            let [c, s] = brushed.direction;
            let along = (frame[0] * (x * c - y * s) + frame[1] * (x * s + y * c)).normalize();
            // Bent as in the glTF sample viewer: reflections stretch across the direction.
            let bent = along.cross(along.cross(to_eye));
            let dull = 1.0 - map.b * brushed.strength * (1.0 - roughness);
            mirror = (-bent.normalize()).mix(normal, dull.powi(4)).normalize();
        }
        let reflected = mirror * (2.0 * mirror.dot(to_eye)) - to_eye;
        let shares = brdf::shares(f0, strength, n_dot_v, roughness);
        let mirrored = light.environment.mirrored(light.around(reflected), roughness);
        let scattered = light.environment.scattered(light.around(normal));
        // What is hidden from light from all around is partly hidden from what mirrors, too (Lagarde and de Rousiers 2014).
        let open_to_mirror = (n_dot_v + open).squared() - 1.0 + open;
        let open_to_mirror = open_to_mirror.saturate().max(open * open);
        let mut diffuse = scattered * open;
        if let Some((color, shadow)) = light.key {
            let falls = normal.dot(shadow.toward).max(0.0) * geometric.dot(shadow.toward).gt(0.0).select(one, 0.0);
            // Where no light falls, no shadow does.
            if falls.gt(0.0).any() {
                diffuse += Vec3::new(one, one, one) * color * (falls * shadow.lit(seen.position, geometric));
            }
        }
        let facing = Facing { position: seen.position, geometric, normal, to_eye, f0, strength, roughness };
        let mut glints = f0 * 0.0;
        if !light.lamps.is_empty() {
            let shone = lamps::shine(light.lamps, &facing);
            diffuse += shone.scattered;
            glints = shone.mirrored;
        }
        let mut matt = albedo * diffuse * shares.rest;
        if let (Some(glass), Some(behind)) = (&coating.transmission, self.behind) {
            let through = (numbers(&glass.map, place).r * glass.factor).saturate();
            let thickness = numbers(&glass.thickness_map, place).g * glass.thickness;
            let seen_through =
                behind.seen(light, seen.position, normal, to_eye, coating.ior, roughness, thickness, glass.absorption);
            matt = matt.mix(seen_through * base.rgb() * shares.rest, through);
        }
        let mut color = matt + mirrored * shares.mirrored * open_to_mirror + scattered * shares.again * open;
        if !light.lamps.is_empty() {
            color += glints;
        }

        // Layers on top.
        if let Some(sheen) = &coating.sheen {
            let tint = tinted(sheen.color, &sheen.color_map, place);
            let roughness = (numbers(&sheen.roughness_map, place).a * sheen.roughness).clamp(0.07, 1.0);
            let part = brdf::fibres(n_dot_v, roughness);
            color = color * (1.0 - tint.x.max(tint.y).max(tint.z) * part) + tint * part * diffuse;
        }
        color += tinted(coating.emissive, &coating.emissive_map, place);
        if let Some(coat) = &coating.clearcoat {
            let factor = (numbers(&coat.map, place).r * coat.factor).saturate();
            let roughness = (numbers(&coat.roughness_map, place).g * coat.roughness).clamp(0.03, 1.0);
            let normal = self.mapped_normal(frame, &coat.normal_map, coat.normal_scale, place);
            let n_dot_v = normal.dot(to_eye).clamp(1e-3, 1.0);
            let part = factor * brdf::schlick(0.04, n_dot_v);
            let (a, b) = brdf::reflected(n_dot_v, roughness);
            let reflected = normal * (2.0 * normal.dot(to_eye)) - to_eye;
            let gloss = light.environment.mirrored(light.around(reflected), roughness) * (a * 0.04 + b) * factor;
            color = color * (1.0 - part) + gloss * open_to_mirror;
            if !light.lamps.is_empty() {
                let f0 = Vec3::new(one, one, one) * 0.04;
                color +=
                    lamps::shine(light.lamps, &Facing { normal, f0, strength: factor, roughness, ..facing }).mirrored;
            }
        }
        self.shown(color, alpha, true)
    }

    #[inline(always)]
    fn shown<L: Lanes>(&self, color: Vec3<L>, alpha: Real<L>, is_lit: bool) -> Rgba<L> {
        let shown = if self.is_raw {
            // Halves end at 65504.
            color.min([1e4; 3])
        } else if is_lit {
            self.light.tone_mapping.apply(color * self.light.exposure)
        } else {
            color
        };
        Rgba::new(shown * alpha, alpha)
    }
}
