//! The camera that has the whole model in the picture.
//!
//! The sphere around the model's box is seen under exactly the field of view:
//!
//! ```text
//!            __
//!        ,-'    `-.
//!       /     c    \  r      D = r / sin(fov / 2)
//!       \     |\   /         near = D - 1.05 r, far = D + 1.05 r
//!        `-.__|_\-'
//!          \  | r\_/         a ray of the picture's border touches the sphere
//!           \ |  /           at a right angle, so that sin(fov / 2) = r / D
//!            \|D/
//!            eye
//! ```

use crate::vector::{Vec3, add, cross, dot, length, normalize, scale, sub};
use crate::{Bounds, Camera, Error, Projection};

/// From where and how wide to look.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Degrees around +y, from +z (0) towards +x (90). Default 30.
    pub azimuth: f64,
    /// Degrees above the horizon. Default 20.
    pub elevation: f64,
    /// Vertical field of view in degrees, above 0 and below 180. Default 40.
    pub fov: f64,
    /// The picture's width over its height. Default 1.
    pub aspect: f64,
    /// What is upwards in world space, not 0; of any length. Azimuth and elevation turn with it: they are meant for +y, the default, and from there the smallest rotation leads to it (to -y that
    /// about x).
    pub up: [f64; 3],
    /// Whether all things keep their size. From where one looks is the same as in perspective. Default false.
    pub orthographic: bool,
}

impl Default for View {
    fn default() -> Self {
        Self { azimuth: 30.0, elevation: 20.0, fov: 40.0, aspect: 1.0, up: [0.0, 1.0, 0.0], orthographic: false }
    }
}

/// A camera. All numbers are finite, `eye` is not `target`, `up` is not along the line between them, and
/// `0 < near < far` (`near` may be 0 or less with a parallel projection).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Framing {
    /// Where the camera stands, in world space.
    pub eye: [f64; 3],
    /// The middle of the picture: the box's centre.
    pub target: [f64; 3],
    /// What is upwards, or seen from straight above or below what turns up there.
    pub up: [f64; 3],
    /// How wide it looks.
    pub lens: Lens,
    /// Distance of the near plane along the view axis.
    pub near: f64,
    /// Distance of the far plane along the view axis.
    pub far: f64,
}

/// How wide a camera looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lens {
    /// Far things are smaller.
    Perspective {
        /// Vertical field of view in radians, within 0 to pi.
        fov_y: f64,
    },
    /// All things keep their size.
    Orthographic {
        /// From the middle of the picture to its upper border, above 0.
        half_height: f64,
    },
}

impl Framing {
    /// The camera that looks at the whole of `bounds`.
    ///
    /// In a picture that is not square the narrower dimension counts. A box that is a point, or so small for its
    /// distance from the origin that f32 coordinates cannot tell its corners apart, is taken for a slightly larger one.
    ///
    /// # Errors
    /// [`Error::View`] if a field of `view` is not finite or out of its range.
    pub fn new(bounds: &Bounds, view: &View) -> Result<Self, Error> {
        check("azimuth", view.azimuth, view.azimuth.is_finite(), "degrees, finite")?;
        check("elevation", view.elevation, view.elevation.is_finite(), "degrees, finite")?;
        check("fov", view.fov, view.fov > 0.0 && view.fov < 180.0, "degrees, above 0 and below 180")?;
        let up = normalize(view.up).ok_or(Error::View {
            name: "up",
            value: length(view.up),
            expected: "a vector, finite, and longer than 0",
        })?;
        let aspect_is_fine = view.aspect.is_finite() && view.aspect > 0.0;
        check("aspect", view.aspect, aspect_is_fine, "width over height, above 0")?;

        let target = bounds.center();
        let radius = radius_seen(bounds.radius(), length(target));
        let fov_y = view.fov.to_radians();
        let distance = radius / sin_half_fov(fov_y, view.aspect);
        let (azimuth, elevation) = (view.azimuth.to_radians(), view.elevation.to_radians());
        let (sin_az, cos_az) = (libm::sin(azimuth), libm::cos(azimuth));
        let (sin_el, cos_el) = (libm::sin(elevation), libm::cos(elevation));
        let towards_eye = turned(up, [cos_el * sin_az, sin_el, cos_el * cos_az]);
        Ok(Self {
            eye: add(target, scale(towards_eye, distance)),
            target,
            // At the poles "up" says nothing; the direction that it tends to there is away from the azimuth.
            up: if cos_el.abs() > 1e-6 { up } else { turned(up, [-sin_el * sin_az, 0.0, -sin_el * cos_az]) },
            lens: if view.orthographic {
                Lens::Orthographic { half_height: radius / if view.aspect < 1.0 { view.aspect } else { 1.0 } }
            } else {
                Lens::Perspective { fov_y }
            },
            near: larger(distance - 1.05 * radius, 0.001 * (distance - radius)),
            far: distance + 1.05 * radius,
        })
    }
}

/// A vector after the smallest rotation that turns +y to `up`, a unit vector.
fn turned(up: Vec3, v: Vec3) -> Vec3 {
    let [ux, uy, uz] = up;
    if uy == 1.0 {
        return v;
    }
    if uy < -1.0 + 1e-12 {
        return [v[0], -v[1], -v[2]];
    }
    // Rodrigues' formula about k = y x up = (uz, 0, -ux), whose length is the sine: v cos + k x v + k (k . v) / (1 + cos).
    let k = [uz, 0.0, -ux];
    let along = dot(k, v) / (1.0 + uy);
    add(add(scale(v, uy), cross(k, v)), scale(k, along))
}

impl Framing {
    /// A camera at `eye` that looks at `target`; near and far plane hold all of `bounds` that is in front of it.
    ///
    /// # Errors
    /// [`Error::View`] if the two are the same place, or numbers are not finite.
    pub fn looking(eye: Vec3, target: Vec3, up: Vec3, lens: Lens, bounds: &Bounds) -> Result<Self, Error> {
        let forward = sub(target, eye);
        let distance = length(forward);
        let fine = distance > 0.0 && distance.is_finite();
        check("distance", distance, fine, "the eye and what it looks at are two places, with finite coordinates")?;
        let forward = scale(forward, 1.0 / distance);
        let along = dot(sub(bounds.center(), eye), forward);
        let radius = radius_seen(bounds.radius(), length(bounds.center()));
        // With all of it behind the eye nothing is seen, whatever the planes.
        let far = larger(along + 1.05 * radius, 1e-3 * distance);
        let near = match lens {
            Lens::Perspective { .. } => larger(along - 1.05 * radius, 1e-3 * far),
            Lens::Orthographic { .. } => along - 1.05 * radius,
        };
        Ok(Self { eye, target, up, lens, near: if near < far { near } else { 0.5 * far }, far })
    }

    /// A model's own camera; where it says nothing of the far plane, that is behind all of `bounds`.
    ///
    /// # Errors
    /// [`Error::View`] if numbers are not finite.
    pub fn of_camera(camera: &Camera, bounds: &Bounds) -> Result<Self, Error> {
        let lens = match camera.projection {
            Projection::Perspective { fov_y, .. } => Lens::Perspective { fov_y },
            Projection::Orthographic { y_mag, .. } => Lens::Orthographic { half_height: y_mag },
        };
        // It looks at what is as far away as the middle of the box.
        let radius = radius_seen(bounds.radius(), length(bounds.center()));
        let along = dot(sub(bounds.center(), camera.eye), camera.forward);
        let target = add(camera.eye, scale(camera.forward, larger(along, radius)));
        let framing = Self::looking(camera.eye, target, camera.up, lens, bounds)?;
        let (near, far) = match camera.projection {
            Projection::Perspective { near, far, .. } => (near, far),
            Projection::Orthographic { near, far, .. } => (near, Some(far)),
        };
        Ok(Self { near, far: far.unwrap_or(larger(framing.far, 2.0 * near)), ..framing })
    }
}

fn check(name: &'static str, value: f64, fine: bool, expected: &'static str) -> Result<(), Error> {
    if fine { Ok(()) } else { Err(Error::View { name, value, expected }) }
}

/// The radius to show: at least 2^-22 of the centre's distance from the origin, four times what f32 can resolve there.
fn radius_seen(radius: f64, center_distance: f64) -> f64 {
    let radius = larger(radius, center_distance / f64::from(1 << 22));
    if radius > 0.0 { radius } else { 1.0 }
}

/// The sine of half the narrower field of view.
fn sin_half_fov(fov_y: f64, aspect: f64) -> f64 {
    if aspect >= 1.0 {
        return libm::sin(fov_y / 2.0);
    }
    // tan(fov_x / 2) = aspect tan(fov_y / 2), and sin(atan t) = t / sqrt(1 + t^2).
    let tan_half = aspect * libm::tan(fov_y / 2.0);
    tan_half / (1.0 + tan_half * tan_half).sqrt()
}

fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CUBE: Bounds = Bounds { min: [-1.0; 3], max: [1.0; 3] };

    #[test]
    fn framing_is_the_conventions_own() {
        let framing = Framing::new(&CUBE, &View::default()).unwrap();
        let r = 3f64.sqrt();
        let d = r / libm::sin(20f64.to_radians());
        let (az, el) = (30f64.to_radians(), 20f64.to_radians());
        let eye = [d * libm::cos(el) * libm::sin(az), d * libm::sin(el), d * libm::cos(el) * libm::cos(az)];
        assert!(length(sub(framing.eye, eye)) < 1e-14);
        assert_eq!((framing.target, framing.up), ([0.0; 3], [0.0, 1.0, 0.0]));
        assert_eq!((framing.near, framing.far), (d - 1.05 * r, d + 1.05 * r));
        assert_eq!(framing.lens, Lens::Perspective { fov_y: 40f64.to_radians() });
    }

    #[test]
    fn framing_bits_are_the_same_everywhere() {
        let framing =
            Framing::new(&CUBE, &View { azimuth: 123.0, elevation: -7.5, fov: 33.0, aspect: 0.75, ..View::default() })
                .unwrap();
        let bits = [4_619_162_814_199_971_841, 13_830_745_614_017_192_135, 13_839_913_543_229_666_767];
        assert_eq!(framing.eye.map(f64::to_bits), bits);
    }

    #[test]
    fn framing_touches_the_narrower_border() {
        for aspect in [0.3, 0.75, 1.0, 1.9] {
            let view = View { aspect, fov: 50.0, ..View::default() };
            let framing = Framing::new(&CUBE, &view).unwrap();
            let distance = length(sub(framing.eye, framing.target));
            let tan_y = libm::tan(25f64.to_radians());
            let half_narrow = libm::atan(if aspect < 1.0 { tan_y * aspect } else { tan_y });
            assert!((distance * libm::sin(half_narrow) - 3f64.sqrt()).abs() < 1e-12, "{aspect}");
        }
    }

    #[test]
    fn framing_of_degenerate_boxes_is_a_camera() {
        let far_away = [5.0, -3e38, 1e-40];
        let boxes = [
            CUBE,
            Bounds { min: [0.0; 3], max: [0.0; 3] },
            Bounds { min: [7.0; 3], max: [7.0; 3] },
            Bounds { min: far_away, max: far_away },
            Bounds { min: [-1.0, 0.0, 0.0], max: [1.0, 0.0, 0.0] },
            Bounds { min: [f64::from(f32::MIN); 3], max: [f64::from(f32::MAX); 3] },
            Bounds { min: [0.0; 3], max: [f64::from(f32::from_bits(1)); 3] },
        ];
        for bounds in boxes {
            for elevation in [-90.0, -89.0, 0.0, 20.0, 90.0, 120.0] {
                for fov in [0.01, 40.0, 150.0, 179.0] {
                    let view = View { elevation, fov, ..View::default() };
                    let framing = Framing::new(&bounds, &view).unwrap();
                    let axis = normalize(sub(framing.target, framing.eye)).unwrap();
                    assert!(framing.eye.iter().all(|c| c.is_finite()), "{bounds:?} {view:?}");
                    assert!(length(cross(axis, framing.up)) > 1e-4, "{bounds:?} {view:?} {framing:?}");
                    assert!(0.0 < framing.near && framing.near < framing.far, "{bounds:?} {view:?} {framing:?}");
                }
            }
        }
    }

    #[test]
    fn framing_from_above_is_continuous() {
        let up = |elevation: f64| {
            let framing = Framing::new(&CUBE, &View { elevation, ..View::default() }).unwrap();
            let axis = normalize(sub(framing.target, framing.eye)).unwrap();
            normalize(sub(framing.up, scale(axis, dot(framing.up, axis)))).unwrap()
        };
        for pole in [-90.0, 90.0] {
            assert!(length(sub(up(pole), up(pole * 0.9999))) < 1e-3, "{pole}");
        }
    }

    #[test]
    fn view_errors_name_the_field() {
        let fails = |view: View, name: &str| {
            let error = Framing::new(&CUBE, &view).unwrap_err().to_string();
            assert!(error.contains(name), "{error}");
        };
        fails(View { azimuth: f64::NAN, ..View::default() }, "azimuth");
        fails(View { elevation: f64::INFINITY, ..View::default() }, "elevation");
        fails(View { fov: 0.0, ..View::default() }, "fov");
        fails(View { fov: 180.0, ..View::default() }, "fov");
        fails(View { fov: f64::NAN, ..View::default() }, "fov");
        fails(View { aspect: 0.0, ..View::default() }, "aspect");
        fails(View { aspect: f64::INFINITY, ..View::default() }, "aspect");
    }
}
