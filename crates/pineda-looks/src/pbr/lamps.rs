//! The model's own lights (KHR_lights_punctual): places without a size, cones from such places, and directions.
//!
//! A surface gets colour x intensity x window / d^2 x cone x max(0, n . l) of each, by the extension's formulas, and reflects it as glTF 2.0's appendix B says. They cast no shadows.
//!
//! All kinds are one to the loop over them: what is infinitely far away has w = 0, d = 1 and no window, and what is no cone has one that is full everywhere.

use pineda::{Lanes, Real, Vec3, shader};
use pineda_scene::{Light, LightKind};
use std::f32::consts::FRAC_1_PI;

/// A light on the stage, as the loop wants it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Lamp {
    /// Where it is, homogeneous.
    place: [f32; 4],
    /// Colour times intensity.
    color: [f32; 3],
    /// One over the square of its range.
    window: f32,
    /// Where it goes.
    axis: [f32; 3],
    /// What the cosine of the angle with the axis is multiplied by, and what is added: at least 1 in the inner cone, at most 0 outside of the outer one.
    cone: [f32; 2],
}

/// A surface, as far as lamps ask.
#[derive(Clone, Copy)]
pub(super) struct Facing<L: Lanes> {
    pub(super) position: Vec3<L>,
    /// Of the triangle, turned to the eye: what is behind it gives no light.
    pub(super) geometric: Vec3<L>,
    pub(super) normal: Vec3<L>,
    pub(super) to_eye: Vec3<L>,
    /// What it mirrors head-on, and a factor for that at any angle.
    pub(super) f0: Vec3<L>,
    pub(super) strength: Real<L>,
    pub(super) roughness: Real<L>,
}

/// Light from all lamps.
pub(super) struct Shone<L: Lanes> {
    /// What a white, matt surface looks like.
    pub(super) scattered: Vec3<L>,
    /// What this one mirrors.
    pub(super) mirrored: Vec3<L>,
}

impl Lamp {
    /// One of [`Stage::lights`](crate::Stage).
    pub(super) fn new(light: &Light) -> Self {
        let [x, y, z] = light.position.map(|x| x as f32);
        let axis = light.direction.map(|x| x as f32);
        let place = match light.kind {
            LightKind::Directional => [-axis[0], -axis[1], -axis[2], 0.0],
            LightKind::Point | LightKind::Spot { .. } => [x, y, z, 1.0],
        };
        let window = match light.kind {
            LightKind::Directional => 0.0,
            LightKind::Point | LightKind::Spot { .. } => 1.0 / (light.range * light.range),
        };
        let cone = match light.kind {
            LightKind::Spot { inner_cone_angle, outer_cone_angle } => {
                let (inner, outer) = (libm::cos(inner_cone_angle), libm::cos(outer_cone_angle));
                let scale = 1.0 / (inner - outer).max(0.001);
                [scale as f32, (-outer * scale) as f32]
            }
            LightKind::Directional | LightKind::Point => [0.0, 1.0],
        };
        // Sums stay finite whatever a file says, and nothing takes light away.
        let color = light.color.map(|c| c * light.intensity).map(|c| if c > 0.0 { c.min(1e16) } else { 0.0 });
        Self { place, color, window: window.min(1e20), axis, cone }
    }
}

/// What a surface gets from `lamps`.
#[shader(apart(surface.position))]
pub(super) fn shine<L: Lanes>(lamps: &[Lamp], surface: &Facing<L>) -> Shone<L> {
    let Facing { position, geometric, normal, to_eye, f0, strength, roughness } = *surface;
    let zero = Vec3::new(strength * 0.0, strength * 0.0, strength * 0.0);
    let mut shone = Shone { scattered: zero, mirrored: zero };
    let one = Real::new(strength.lanes(), 1.0);
    let a2 = roughness.squared().squared();
    let n_dot_v = normal.dot(to_eye).clamp(1e-3, 1.0);
    for lamp in lamps {
        let [x, y, z, w] = lamp.place;
        let away = [x, y, z] - position * w;
        // Right at a lamp there would be no end of light. The eye is at distance 1: this is less than a pixel.
        let d2 = away.length_squared().max(1e-8);
        let toward = away / d2.sqrt();
        let window = (1.0 - (d2 * lamp.window).squared()).max(0.0);
        let cone = (lamp.cone[1] - toward.dot(lamp.axis) * lamp.cone[0]).saturate().squared();
        let n_dot_l = normal.dot(toward).max(0.0);
        let falls = geometric.dot(toward).gt(0.0).select(n_dot_l, 0.0);
        let light = Vec3::new(one, one, one) * lamp.color * (falls * window * cone / d2);
        shone.scattered += light * FRAC_1_PI;

        // GGX's distribution, Smith's masking of both ways together (Heitz 2014), Schlick's approximation of Fresnel's equations.
        let half = (toward + to_eye).normalize();
        let (n_dot_h, v_dot_h) = (normal.dot(half), to_eye.dot(half).saturate());
        // n . h is near 1 where it matters: 1 - (n . h)^2 would be all rounding.
        let d = a2 * n_dot_h.squared() + normal.cross(half).length_squared();
        let masked = n_dot_l * (n_dot_v.squared() * (1.0 - a2) + a2).sqrt()
            + n_dot_v * (n_dot_l.squared() * (1.0 - a2) + a2).sqrt();
        let facets = a2 * (0.5 * FRAC_1_PI) / (d * d * masked).max(1e-20);
        let fresnel = f0 + (1.0 - f0) * (1.0 - v_dot_h).powi(5);
        shone.mirrored += light * fresnel * (strength * facets);
    }
    shone
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_3, PI};

    type Vector = [f64; 3];

    /// Half a turn from up, 2 above the ground.
    fn light(kind: LightKind) -> Light {
        Light {
            name: "".into(),
            color: [1.0, 0.5, 0.25],
            intensity: 80.0,
            range: f32::INFINITY,
            position: [0.25, 2.0, 0.5],
            direction: [0.0, -1.0, 0.0],
            kind,
        }
    }

    fn dot(a: Vector, b: Vector) -> f64 {
        a.iter().zip(b).map(|(a, b)| a * b).sum()
    }

    fn unit(a: Vector) -> Vector {
        a.map(|x| x / dot(a, a).sqrt())
    }

    /// What falls on a place of the ground, y = 0, by the extension's words.
    fn falls(light: &Light, place: Vector) -> (Vector, Vector) {
        let away = [0, 1, 2].map(|k| light.position[k] - place[k]);
        let distance = dot(away, away).sqrt();
        let range = f64::from(light.range);
        let window = (1.0 - (distance / range).powi(4)).clamp(0.0, 1.0) / (distance * distance);
        let (toward, share) = match light.kind {
            LightKind::Directional => (light.direction.map(|x| -x), 1.0),
            LightKind::Point => (unit(away), window),
            LightKind::Spot { inner_cone_angle, outer_cone_angle } => {
                let cosine = -dot(unit(away), light.direction);
                let (inner, outer) = (inner_cone_angle.cos(), outer_cone_angle.cos());
                (unit(away), window * ((cosine - outer) / (inner - outer)).clamp(0.0, 1.0).powi(2))
            }
        };
        let cosine = toward[1].max(0.0);
        (light.color.map(|c| f64::from(c) * f64::from(light.intensity) * share * cosine), toward)
    }

    /// glTF 2.0, appendix B.3.2 and B.3.3, of the ground.
    fn mirrors(toward: Vector, to_eye: Vector, f0: f64, roughness: f64) -> f64 {
        let half = unit([0, 1, 2].map(|k| toward[k] + to_eye[k]));
        let a2 = roughness.powi(4);
        let distribution = a2 / (PI * (half[1] * half[1] * (a2 - 1.0) + 1.0).powi(2));
        let masking = |cosine: f64| cosine + (a2 + (1.0 - a2) * cosine * cosine).sqrt();
        // The glTF sample viewer's and Filament's form, which is height-correlated; for one direction only it is Smith's G over 2 cosine.
        let (l, v) = (toward[1], to_eye[1]);
        let together = 0.5 / (l * (masking(v) - v) + v * (masking(l) - l));
        (f0 + (1.0 - f0) * (1.0 - dot(to_eye, half)).powi(5)) * distribution * together
    }

    fn check(light: &Light, place: Vector) {
        let (to_eye, f0, roughness) = (unit([0.4, 1.0, 0.3]), 0.04, 0.45);
        let facing = Facing {
            position: place.map(|x| x as f32).into(),
            geometric: [0.0, 1.0, 0.0].into(),
            normal: [0.0, 1.0, 0.0].into(),
            to_eye: to_eye.map(|x| x as f32).into(),
            f0: [f0 as f32; 3].into(),
            strength: 1.0.into(),
            roughness: (roughness as f32).into(),
        };
        let shone = shine(&[Lamp::new(light)], &facing);
        let (light_there, toward) = falls(light, place);
        let reflected = if toward[1] > 0.0 { mirrors(toward, to_eye, f0, roughness) } else { 0.0 };
        let near = |ours: Vec3, theirs: Vector| {
            for (ours, theirs) in <[f32; 3]>::from(ours).into_iter().zip(theirs) {
                let ours = f64::from(ours);
                assert!((ours - theirs).abs() <= 1e-5 * theirs, "{light:?} at {place:?}: {ours} instead of {theirs}");
            }
        };
        near(shone.scattered, light_there.map(|x| x / PI));
        near(shone.mirrored, light_there.map(|x| x * reflected));
    }

    const PLACES: [Vector; 5] =
        [[0.25, 0.0, 0.5], [1.0, 0.0, 0.0], [-2.0, 0.0, 3.0], [30.0, 0.0, -4.0], [0.5, 1.75, 0.5]];

    #[test]
    fn lamps_points_fall_off_with_the_square() {
        PLACES.iter().for_each(|&place| check(&light(LightKind::Point), place));
    }

    #[test]
    fn lamps_ranges_end_smoothly() {
        for range in [2.0, 2.5, 4.0, 100.0] {
            PLACES.iter().for_each(|&place| check(&Light { range, ..light(LightKind::Point) }, place));
        }
    }

    #[test]
    fn lamps_cones_are_full_inside_and_end_outside() {
        for (inner_cone_angle, outer_cone_angle) in [(0.0, FRAC_PI_3), (0.3, 0.8), (1.0, FRAC_PI_2)] {
            let spot = light(LightKind::Spot { inner_cone_angle, outer_cone_angle });
            PLACES.iter().for_each(|&place| check(&spot, place));
            for angle in [0.2, 0.5, 0.7, 1.2] {
                check(&spot, [0.25 + 2.0 * libm::tan(angle), 0.0, 0.5]);
            }
        }
    }

    #[test]
    fn lamps_infinitely_far_away_are_the_same_everywhere() {
        for direction in [[0.0, -1.0, 0.0], unit([0.5, -1.0, 0.8]), unit([0.0, 1.0, 0.2])] {
            let sun = Light { direction, range: 0.1, ..light(LightKind::Directional) };
            PLACES.iter().for_each(|&place| check(&sun, place));
        }
    }

    #[test]
    fn lamps_below_the_surface_give_nothing() {
        let below = Light { position: [0.25, -1.0, 0.5], ..light(LightKind::Point) };
        PLACES[..4].iter().for_each(|&place| check(&below, place));
    }

    #[test]
    fn lamps_of_any_numbers_give_finite_light() {
        for intensity in [f32::MAX, f32::INFINITY, f32::NAN, -1.0] {
            for range in [f32::MIN_POSITIVE, f32::INFINITY] {
                let lamp = Lamp::new(&Light { intensity, range, ..light(LightKind::Point) });
                for position in [[0.25, 2.0, 0.5], [0.0; 3]] {
                    let facing = Facing {
                        position: position.into(),
                        geometric: [0.0, 1.0, 0.0].into(),
                        normal: [0.0, 1.0, 0.0].into(),
                        to_eye: [0.0, 1.0, 0.0].into(),
                        f0: [1.0; 3].into(),
                        strength: 1.0.into(),
                        roughness: 0.03.into(),
                    };
                    let Shone { scattered, mirrored } = shine(&[lamp], &facing);
                    let all = [<[f32; 3]>::from(scattered), mirrored.into()];
                    assert!(
                        all.as_flattened().iter().all(|x| *x >= 0.0 && x.is_finite()),
                        "{intensity} {range}: {all:?}"
                    );
                }
            }
        }
    }
}
