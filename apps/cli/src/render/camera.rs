//! Which camera the options ask for.

use crate::arguments::{CameraArguments, Frame};
use crate::failure::Failure;
use pineda_scene::{Bounds, Framing, Lens, Scene, Select, View};

/// The camera for a scene, in a picture that is `aspect` times as wide as high.
pub(crate) fn framing(arguments: &CameraArguments, scene: &Scene, aspect: f64) -> Result<Framing, Failure> {
    let bounds = Bounds::of(scene).ok_or_else(|| Failure::data("the model has nothing to draw"))?;
    if let Some(name) = &arguments.camera {
        let camera = scene.camera(&Select::from(name.as_str())).map_err(wrong)?;
        return Framing::of_camera(camera, &bounds).map_err(wrong);
    }
    if let (Some(eye), Some(target)) = (arguments.eye, arguments.look_at) {
        return looking(arguments, eye.0, target.0, &bounds);
    }
    let view = View {
        azimuth: arguments.azimuth,
        elevation: arguments.elevation,
        fov: arguments.fov,
        aspect,
        up: arguments.up.0,
        orthographic: arguments.orthographic,
    };
    let framing = Framing::new(&bounds, &view).map_err(wrong)?;
    Ok(match arguments.frame {
        Frame::Sphere => framing,
        Frame::Tight => framing.tightened(scene, aspect),
    })
}

fn looking(arguments: &CameraArguments, eye: [f64; 3], target: [f64; 3], bounds: &Bounds) -> Result<Framing, Failure> {
    let fov_y = arguments.fov.to_radians();
    let lens = if arguments.orthographic {
        // What is looked at is as large as with perspective.
        let distance = (0..3).map(|axis| (target[axis] - eye[axis]) * (target[axis] - eye[axis])).sum::<f64>().sqrt();
        Lens::Orthographic { half_height: distance * libm::tan(fov_y / 2.0) }
    } else {
        Lens::Perspective { fov_y }
    };
    let framing = Framing::looking(eye, target, arguments.up.0, lens, bounds).map_err(wrong)?;
    let near = arguments.near.unwrap_or(framing.near);
    let mut far = arguments.far.unwrap_or(framing.far);
    if arguments.far.is_none() && far <= near {
        far = 2.0 * near;
    }
    if near >= far {
        return Err(Failure::usage(format_args!("the near plane, at {near}, must lie before the far plane, at {far}"))
            .at("--near and --far"));
    }
    Ok(Framing { near, far, ..framing })
}

/// A model without the camera that was asked for, or numbers that make none.
fn wrong(error: pineda_scene::Error) -> Failure {
    match error {
        pineda_scene::Error::NoSuch { .. } => {
            Failure::data(format_args!("the model {error}")).help("`pineda info MODEL` lists its cameras")
        }
        error => Failure::usage(error).at("the camera"),
    }
}
