//! The ground below a model: nothing but the shadow that falls on it, so that the model stands somewhere on whatever is behind it.
//!
//! Two shadows: the key light's, and that of the light from all around, which is dark where something is close above. Both are smooth, and so they are drawn once to a small map of the ground.

use super::caster::Caster;
use super::nearest::Nearest;
use super::overhead;
use super::paint::{self, Corner, Paint};
use super::shadow::{self, Shadow};
use crate::stage::Stage;
use pineda::{
    ColorBuffer, Compare, DepthBias, DepthState, DrawState, Error, Lanes, Mat4, R32F, Real, Renderer, Rgba, Sampler,
    Target, Texture2d, Vec2, Vec3, Viewport, Wrap, shader,
};

/// Texels of both maps, across and down.
const SIZE: u32 = 256;
/// How far the ground reaches, in the model's own reach.
const REACH: f32 = 2.6;
/// How soft the key light's shadow is, in parts of its map: near what casts it and far from it.
const SOFTNESS: [f32; 2] = [0.012, 0.06];
const _: () = assert!(SOFTNESS[1] < Nearest::WITHIN);

/// The ground's shadow, and where it lies.
#[derive(Debug)]
pub(super) struct Ground {
    map: Texture2d<'static, R32F>,
    corners: [[f32; 3]; 4],
}

/// How dark the ground is.
#[derive(Debug)]
pub(super) struct Darkness<'a> {
    /// How much is hidden from light from all around.
    hidden: &'a Texture2d<'a, R32F>,
    /// And what is nearest to the light.
    shadow: Option<(&'a Shadow, Nearest)>,
    /// Half the ground's side.
    reach: f32,
    center: [f32; 3],
}

impl Darkness<'_> {
    /// Most of the ground is lit: no filter is asked there, for it would say so.
    #[shader(apart(pixel))]
    pub(super) fn color<L: Lanes>(&self, pixel: Vec2<L>) -> Rgba<L> {
        let at = pixel * (1.0 / SIZE as f32);
        let away = (at - 0.5) * 2.0;
        let fade = 1.0 - away.length().smoothstep(0.55, 1.0);
        let is_seen = fade.gt(0.0);
        let hidden = self.hidden.fetch(pixel.x.floor().to_int(), pixel.y.floor().to_int(), 0).r;
        let mut open = 1.0 - 0.75 * hidden;
        if let Some((shadow, nearest)) = &self.shadow {
            let [x, y, z] = self.center;
            let place = Vec3::new(away.x * self.reach + x, Real::new(at.lanes(), y), away.y * self.reach + z);
            let there = shadow.seen_from_light(place);
            if (is_seen & there.z.gt(nearest.around(there.xy()))).any() {
                // Softer where it is farther from what casts it, which is where it is farther from the middle.
                let soft = away.length().smoothstep(0.15, 0.8);
                let [sharp, blurred] = [shadow.lit_within(place, SOFTNESS[0]), shadow.lit_within(place, SOFTNESS[1])];
                open *= 1.0 - 0.42 * (1.0 - sharp.mix(blurred, soft));
            }
        }
        Rgba::gray((1.0 - open) * fade)
    }
}

/// The ground in the picture: black, as transparent as it is lit.
#[derive(Debug)]
pub(super) struct Cast<'a> {
    ground: &'a Ground,
}

impl Cast<'_> {
    #[shader(apart(place))]
    pub(super) fn color<L: Lanes>(&self, place: Vec2<L>) -> Rgba<L> {
        let sampler = Sampler { wrap: [Wrap::Clamp; 3], ..Sampler::BILINEAR };
        let darkness = self.ground.map.sample_level(&sampler, place, 0.0).r;
        let none = darkness * 0.0;
        Rgba { r: none, g: none, b: none, a: darkness }
    }
}

impl Ground {
    /// `None` where the eye is not above the ground.
    pub(super) fn new(
        stage: &Stage,
        casters: &[Caster<'_, '_>],
        shadow: Option<&Shadow>,
        renderer: &mut Renderer,
    ) -> Result<Option<Self>, Error> {
        let [low, high] = stage.bounds;
        let size = [0, 1, 2].map(|axis| (high[axis] - low[axis]).max(1e-6));
        if stage.camera.eye[1] <= low[1] {
            return Ok(None);
        }
        let reach = REACH * 0.5 * (size[0] * size[0] + size[2] * size[2]).sqrt().max(0.5 * size[1]);
        // A little lower, so that a floor of the model's own hides it.
        let center = [0.5 * (low[0] + high[0]), low[1] - 1e-3 * reach, 0.5 * (low[2] + high[2])];
        let high = 0.35 * (size[0] * size[0] + size[1] * size[1] + size[2] * size[2]).sqrt();
        let [x, y, z] = center;
        let from_below = Mat4::orthographic(-reach, reach, -reach, reach, 0.0, high)
            * Mat4::look_at(center, [x, y + 1.0, z], [0.0, 0.0, -1.0]);
        let mut heights = shadow::depths(casters.iter(), from_below, DepthBias::NONE, SIZE, renderer)?;
        // Seen from below, x runs to the left.
        for row in heights.chunks_exact_mut(SIZE as usize) {
            row.reverse();
        }
        let hidden = Texture2d::new(SIZE, SIZE, overhead::hidden(&heights, SIZE as usize))?;
        let shadow = match shadow {
            Some(shadow) => Some((shadow, shadow.nearest()?)),
            None => None,
        };
        let darkness = Paint::Darkness(Darkness { hidden: &hidden, shadow, reach, center });
        let mut map = vec![0.0; (SIZE * SIZE) as usize];
        let color = ColorBuffer::R32F(&mut map);
        paint::map(&darkness, Target { color, ..Target::new(SIZE, SIZE) }, renderer)?;
        let corners = [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]];
        let corners = corners.map(|[s, t]: [f32; 2]| [x + s * reach, y, z + t * reach]);
        Ok(Some(Self { map: Texture2d::new(SIZE, SIZE, map)?, corners }))
    }

    /// Its corners in the picture, with where they lie in the map.
    pub(super) fn corners(&self, clip_from_world: Mat4) -> [Corner; 6] {
        let corner = |k: usize, [s, t]: [f32; 2]| {
            (<[f32; 4]>::from(clip_from_world * Vec3::from(self.corners[k]).extend(1.0)), [s, t, 0.0])
        };
        let [a, b, c, d] = [corner(0, [0.0, 0.0]), corner(1, [0.0, 1.0]), corner(2, [1.0, 1.0]), corner(3, [1.0, 0.0])];
        [a, b, c, a, c, d]
    }

    pub(super) fn paint(&self) -> Paint<'_> {
        Paint::Cast(Cast { ground: self })
    }

    /// For the first draw of a cleared picture, where replacing is blending. It stays behind all that is drawn later, and what that hides is never shaded.
    pub(super) fn state([width, height]: [u32; 2]) -> DrawState {
        DrawState {
            viewport: Some(Viewport { min_depth: 1.0, ..Viewport::whole(width, height) }),
            depth: DepthState { compare: Compare::LessEqual, ..DepthState::default() },
            // It reaches beyond the camera's far plane.
            depth_clamp: true,
            ..DrawState::default()
        }
    }
}
