//! The key light's shadow: a map of what it sees, looked up with a wide filter ("percentage closer filtering", Reeves, Salesin and Cook 1987).

use super::caster::Caster;
use super::nearest::Nearest;
use crate::Vertex;
use crate::stage::{Prop, Stage};
use pineda::{
    Cull, DepthBias, DepthBuffer, DrawState, Error, Fragment, Lanes, Mat4, Pass, R32F, Real, Renderer, Rgba, Sampler,
    Shader, Target, Texture2d, Vec3, Vec4, Wrap, shader,
};

/// Texels of the map, across and down, for a picture whose longer side is so long: two a pixel and more, where the whole model is in the picture.
fn size_for(side: u32) -> u32 {
    if side <= 256 { 512 } else { 1024 }
}

/// Places around the one in question, on a disc of radius 1: Vogel's spiral.
pub(super) const DISC: [[f32; 2]; 12] = [
    [0.204, 0.0],
    [-0.261, 0.239],
    [0.040, -0.455],
    [0.328, 0.429],
    [-0.603, -0.107],
    [0.572, -0.364],
    [-0.191, 0.711],
    [-0.363, -0.702],
    [0.796, 0.286],
    [-0.826, 0.342],
    [0.391, -0.849],
    [0.296, 0.933],
];

/// What the key light sees of a stage.
#[derive(Debug)]
pub(super) struct Shadow {
    /// Towards the light.
    pub(super) toward: [f32; 3],
    /// The stage's world to the map: x and y 0 to 1, z its depth.
    map_from_world: Mat4,
    map: Texture2d<'static, R32F>,
    /// Texels of the map, across and down.
    size: u32,
    /// The filter's radius, in parts of the map.
    softness: f32,
    /// How far from a surface it is asked for, on the stage: two texels.
    offset: f32,
}

/// Depth, no colour.
struct Depths {
    clip_from_world: Mat4,
}

#[shader]
impl Shader for Depths {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = ();

    fn vertex(&self, vertex: &Vertex) -> (Vec4, ()) {
        (self.clip_from_world * Vec3::from(vertex.position).extend(1.0), ())
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        Rgba::gray(f.z())
    }
}

/// The depths of what casts a shadow, `size` x `size` of them.
pub(super) fn depths<'a, 's: 'a>(
    casters: impl Iterator<Item = &'a Caster<'a, 's>>,
    clip_from_world: Mat4,
    depth_bias: DepthBias,
    size: u32,
    renderer: &mut Renderer,
) -> Result<Vec<f32>, Error> {
    let shader = Depths { clip_from_world };
    let state = DrawState { depth_bias, cull: Cull::None, ..DrawState::default() };
    let casters: Vec<_> = casters.map(|caster| (caster.prop, caster.cut(clip_from_world))).collect();
    let mut pass = Pass::new();
    for (prop, cut) in &casters {
        match cut {
            Some(cut) => pass.draw(cut, prop.mesh(), state),
            None => pass.draw(&shader, prop.mesh(), state),
        };
    }
    let mut depths = vec![0.0; (size * size) as usize];
    renderer.render(&pass, &mut Target { depth: DepthBuffer::D32F(&mut depths), ..Target::new(size, size) })?;
    Ok(depths)
}

impl Shadow {
    /// Draws the map of what `casts` a shadow, for a picture whose longer side has `side` pixels.
    pub(super) fn new(
        stage: &Stage,
        toward: [f32; 3],
        side: u32,
        casters: &[Caster<'_, '_>],
        casts: impl Fn(&Prop) -> bool,
        renderer: &mut Renderer,
    ) -> Result<Self, Error> {
        let size = size_for(side);
        let [low, high] = stage.bounds;
        let center = [0, 1, 2].map(|axis| 0.5 * (low[axis] + high[axis]));
        let [x, y, z] = [0, 1, 2].map(|axis| 0.5 * (high[axis] - low[axis]));
        let radius = (x * x + y * y + z * z).sqrt().max(1e-6) * 1.01;
        let from = [0, 1, 2].map(|axis| center[axis] + 2.0 * radius * toward[axis]);
        let up = if toward[1].abs() > 0.99 { [0.0, 0.0, 1.0] } else { [0.0, 1.0, 0.0] };
        let clip_from_world = Mat4::orthographic(-radius, radius, -radius, radius, radius, 3.0 * radius)
            * Mat4::look_at(from, center, up);
        let depth_bias = DepthBias { constant: 0.0, slope: 1.5, clamp: 0.0 };
        let casters = casters.iter().filter(|caster| casts(caster.prop));
        let depth = depths(casters, clip_from_world, depth_bias, size, renderer)?;
        // y grows downwards in maps.
        let map_from_clip = Mat4::translation([0.5, 0.5, 0.0]) * Mat4::scale([0.5, -0.5, 1.0]);
        Ok(Self {
            toward,
            map_from_world: map_from_clip * clip_from_world,
            map: Texture2d::new(size, size, depth)?,
            size,
            softness: 0.006,
            offset: 4.0 * radius / size as f32,
        })
    }

    /// How much of the key light reaches a place, 0 to 1.
    #[inline(always)]
    pub(super) fn lit<L: Lanes>(&self, position: Vec3<L>, normal: Vec3<L>) -> Real<L> {
        self.lit_within(position + normal * self.offset, self.softness)
    }

    /// The same with another radius of the filter, for a place that casts no shadow itself.
    #[shader(apart(position))]
    pub(super) fn lit_within<L: Lanes>(&self, position: Vec3<L>, softness: f32) -> Real<L> {
        // Beyond the map everything is lit.
        let sampler = Sampler { wrap: [Wrap::Border; 3], border: [1.0; 4], ..Sampler::SHADOW };
        let place = self.seen_from_light(position);
        let mut sum = Real::new(position.lanes(), 0.0);
        for [x, y] in DISC {
            let place_there = place.xy() + [x * softness, y * softness];
            sum += self.map.sample_compare(&sampler, place_there, place.z);
        }
        sum * (1.0 / DISC.len() as f32)
    }

    /// Where a place lies in the map, and its depth there.
    #[shader]
    pub(super) fn seen_from_light<L: Lanes>(&self, position: Vec3<L>) -> Vec3<L> {
        let Vec3 { x, y, z } = (self.map_from_world * position.extend(1.0)).xyz();
        // Behind everything that the map shows it is no darker.
        Vec3::new(x, y, z.min(1.0))
    }

    /// What is nearest to the light around each place of the map.
    pub(super) fn nearest(&self) -> Result<Nearest, Error> {
        Nearest::new(self.map.texels(0), self.size as usize)
    }
}
