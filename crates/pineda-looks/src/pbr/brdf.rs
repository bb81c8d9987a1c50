//! How surfaces reflect: what is left of glTF 2.0's appendix B when the light comes from all around and has been filtered before.

use pineda::{Lanes, Real, Vec3, shader};

/// The part of the light that GGX surfaces reflect: `f0 * x + y` (Karis 2014, "Physically Based Shading on Mobile": a fit of the second sum of two).
#[shader]
pub(super) fn reflected<L: Lanes>(n_dot_v: Real<L>, roughness: Real<L>) -> (Real<L>, Real<L>) {
    let (x, y) = (1.0 - roughness, roughness * -0.0275 + 0.0425);
    let (z, w) = (roughness * -0.572 + 1.022, roughness * 0.022 - 0.04);
    let a = (x * x).min((n_dot_v * -9.28).exp2()) * x + y;
    (a * -1.04 + z, a * 1.04 + w)
}

/// What a surface mirrors and what it scatters, as factors of both.
pub(super) struct Shares<L: Lanes> {
    pub(super) mirrored: Vec3<L>,
    /// Mirrored more than once between the facets: light from all around.
    pub(super) again: Vec3<L>,
    /// Not mirrored at all.
    pub(super) rest: Vec3<L>,
}

/// Light that is reflected once and more often, energy conserved (Fdez-Agüera 2019, "A Multiple-Scattering Microfacet Model for Real-Time Image-based Lighting").
#[shader(apart)]
pub(super) fn shares<L: Lanes>(f0: Vec3<L>, strength: Real<L>, n_dot_v: Real<L>, roughness: Real<L>) -> Shares<L> {
    let (a, b) = reflected(n_dot_v, roughness);
    // At grazing angles smooth surfaces reflect everything (Lagarde's form of Schlick's term).
    let smooth = 1.0 - roughness;
    let grazing = f0.max(Vec3::new(smooth, smooth, smooth)) - f0;
    let fresnel = (f0 + grazing * (1.0 - n_dot_v).powi(5)) * strength;
    let once = fresnel * a + strength * b;
    let missed = 1.0 - (a + b);
    let average = f0 * strength + (1.0 - f0) * (1.0 / 21.0) * strength;
    let again = once * average * missed / (1.0 - average * missed);
    Shares { mirrored: once, again, rest: 1.0 - (once + again) }
}

/// Schlick's approximation of Fresnel's equations.
#[shader]
pub(super) fn schlick<L: Lanes>(f0: f32, cosine: Real<L>) -> Real<L> {
    f0 + (1.0 - f0) * (1.0 - cosine).powi(5)
}

/// The part of the light from all around that cloth's fibres reflect (a fit of Charlie's distribution, Estevez and Kulla 2017, as in three.js r150 and later).
#[shader(apart)]
pub(super) fn fibres<L: Lanes>(n_dot_v: Real<L>, roughness: Real<L>) -> Real<L> {
    let squared = roughness * roughness;
    let is_smooth = roughness.lt(0.25);
    let a = is_smooth.select(squared * -339.2 + roughness * 161.4 - 25.9, squared * -8.48 + roughness * 14.3 - 9.95);
    let b = is_smooth.select(squared * 44.0 - roughness * 23.7 + 3.26, squared * 1.97 - roughness * 3.27 + 0.72);
    let more = is_smooth.select(0.0, 0.1 * (roughness - 0.25));
    ((a * n_dot_v + b).exp() + more).clamp(0.0, 1.0)
}

/// Head-on reflection of a thin film over a surface (Belcour and Barla 2017, "A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence", as in the glTF sample viewer).
///
/// `thickness` in nanometres.
#[shader(apart)]
pub(super) fn thin_film<L: Lanes>(cosine: Real<L>, ior: f32, thickness: Real<L>, f0: Vec3<L>) -> Vec3<L> {
    let lanes = cosine.lanes();
    // The film fades away where it gets too thin.
    let ior = Real::new(lanes, 1.0).mix(ior, thickness.smoothstep(0.0, 30.0));
    let sine_squared = (1.0 - cosine * cosine) / (ior * ior);
    let inside = (1.0 - sine_squared).max(0.0).sqrt();
    let r0 = ((ior - 1.0) / (ior + 1.0)).squared();
    let r12 = r0 + (1.0 - r0) * (1.0 - cosine).powi(5);
    let t121 = 1.0 - r12;
    let channel = |f0: Real<L>, frequency: f32| {
        // The index of refraction that the base's reflectance says.
        let root = f0.clamp(0.0, 0.9999).sqrt();
        let base = (1.0 + root) / (1.0 - root);
        let r1 = ((base - ior) / (base + ior)).squared();
        let r23 = r1 + (1.0 - r1) * (1.0 - inside).powi(5);
        // What is reflected at the denser side has its phase turned.
        let turned = base.lt(ior).select(Real::new(lanes, 0.5), 0.0) + 0.5;
        let turns = 2.0 * ior * thickness * inside * frequency + turned;
        let both = (r12 * r23).clamp(1e-5, 0.9999);
        let root = both.sqrt();
        let series = t121 * t121 * r23 / (1.0 - both);
        let first = (turns * std::f32::consts::TAU).cos();
        let second = (turns * (2.0 * std::f32::consts::TAU)).cos();
        // Two terms of the series; a colour's band is wide, so that later ones cancel.
        let fringes = root * first * 1.4 + both * second * 0.6;
        (r12 + series + (series - t121) * fringes).max(0.0)
    };
    // One over the middle wavelengths of red, green and blue, in nanometres.
    Vec3::new(channel(f0.x, 1.0 / 611.0), channel(f0.y, 1.0 / 549.0), channel(f0.z, 1.0 / 464.0))
}
