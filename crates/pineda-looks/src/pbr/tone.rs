//! From light without bounds to what a picture can show.

use pineda::{Lanes, Vec3, shader};

/// How light beyond 1 is brought into a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ToneMapping {
    /// Khronos PBR Neutral: colours up to 0.8 are shown as they are, whatever is brighter loses a little of its colour.
    #[default]
    Neutral,
    /// The Academy's filmic curve, in the fit of Stephen Hill.
    Aces,
    /// Cut off at 1.
    None,
}

impl ToneMapping {
    /// Linear light, 0 to 1 in each channel.
    #[shader(apart(light))]
    pub(crate) fn apply<L: Lanes>(self, light: Vec3<L>) -> Vec3<L> {
        match self {
            Self::Neutral => neutral(light),
            Self::Aces => aces(light),
            Self::None => light,
        }
        .clamp([0.0; 3], [1.0; 3])
    }
}

/// Khronos PBR Neutral Tone Mapper, Specification 1.0.
#[shader]
fn neutral<L: Lanes>(light: Vec3<L>) -> Vec3<L> {
    const START: f32 = 0.8 - 0.04;
    const DESATURATION: f32 = 0.15;
    let least = light.x.min(light.y).min(light.z);
    let offset = least.lt(0.08).select(least - 6.25 * least * least, 0.04);
    let light = light - offset;
    let peak = light.x.max(light.y).max(light.z);
    let room = 1.0 - START;
    let compressed = 1.0 - room * room / (peak.max(START) + room - START);
    let white = 1.0 - 1.0 / (DESATURATION * (peak - compressed) + 1.0);
    let bright = (light * (compressed / peak.max(START))).mix(Vec3::new(compressed, compressed, compressed), white);
    let is_dark = peak.lt(START);
    Vec3::new(is_dark.select(light.x, bright.x), is_dark.select(light.y, bright.y), is_dark.select(light.z, bright.z))
}

/// Stephen Hill's fit of the Academy's reference rendering and output transforms (BakingLab, 2016).
#[shader]
fn aces<L: Lanes>(light: Vec3<L>) -> Vec3<L> {
    let light = light / 0.6;
    let light = Vec3::new(
        light.dot([0.59719, 0.35458, 0.04823]),
        light.dot([0.07600, 0.90834, 0.01566]),
        light.dot([0.02840, 0.13383, 0.83777]),
    );
    let light = (light * (light + 0.024_578_6) - 0.000_090_537) / (light * (light * 0.983_729 + 0.432_951) + 0.238_081);
    Vec3::new(
        light.dot([1.60475, -0.53108, -0.07367]),
        light.dot([-0.10208, 1.10813, -0.00605]),
        light.dot([-0.00327, -0.07276, 1.07602]),
    )
}
