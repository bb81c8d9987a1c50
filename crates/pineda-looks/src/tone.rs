//! From light without bounds to what a picture can show.

use pineda::{Lanes, Real, Vec3, shader};

/// Up to here light is shown as it is, so that base colours stay what they are.
const KNEE: f32 = 0.55;

/// Linear up to [`KNEE`], then a shoulder that never reaches 1: `KNEE + s t / (1 + t)` with `t = (x - KNEE) / s`, which
/// meets the line with its own slope. A division and no transcendental function, as deterministic as the rest.
#[shader]
pub(crate) fn shoulder<L: Lanes>(x: Real<L>) -> Real<L> {
    let above = (x - KNEE).max(0.0) / (1.0 - KNEE);
    x.min(KNEE) + (1.0 - KNEE) * (above / (1.0 + above))
}

/// [`shoulder`] on each channel, with a little of the light that one channel has too much of given to the others, as
/// film does: a highlight on a red thing is nearly white, not flat red.
#[shader]
pub(crate) fn tone<L: Lanes>(light: Vec3<L>) -> Vec3<L> {
    let excess = (light.x.max(light.y).max(light.z) - 1.0).max(0.0);
    let light = light + 0.15 * excess;
    Vec3::new(shoulder(light.x), shoulder(light.y), shoulder(light.z))
}

#[cfg(test)]
mod tests {
    use super::*;
    use pineda::Scalar;

    fn at(x: f32) -> f32 {
        f32::from(shoulder(Real::new(Scalar, x)))
    }

    #[test]
    fn tone_is_the_identity_in_the_dark_and_never_reaches_white() {
        assert_eq!([at(0.0), at(0.25), at(KNEE)], [0.0, 0.25, KNEE]);
        assert!(at(100.0) < 1.0 && at(100.0) > 0.99);
    }

    #[test]
    fn tone_rises_everywhere() {
        let curve: Vec<f32> = (0..4000).map(|i| at(i as f32 / 1000.0)).collect();
        assert!(curve.windows(2).all(|w| w[0] < w[1]));
    }
}
