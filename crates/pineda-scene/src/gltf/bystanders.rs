//! Cameras and lights: what nodes hold beside meshes.

use super::schema::{self, Node, Root, Spot};
use super::transform::Affine;
use crate::camera::forward_and_up;
use crate::text::shown;
use crate::{Camera, Light, LightKind, Projection};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

/// The node's camera; `None` also if it sees nothing.
pub(super) fn camera(root: &Root, node: &Node, world: &Affine) -> Option<Camera> {
    let camera = root.cameras.get(node.camera?.index())?;
    let projection = projection(camera)?;
    let eye = world.point([0.0; 3]);
    let (forward, up) = forward_and_up(world.vector([0.0, 1.0, 0.0]), world.vector([0.0, 0.0, 1.0]));
    let name = camera.name.as_deref().or(node.name()).unwrap_or_default();
    let is_somewhere = eye.iter().all(|c| c.is_finite());
    is_somewhere.then(|| Camera { name: shown(name.as_bytes()).into(), eye, forward, up, projection })
}

fn projection(camera: &schema::Camera) -> Option<Projection> {
    let is_size = |size: f64| size > 0.0 && size.is_finite();
    if let Some(p) = &camera.perspective {
        let far = p.zfar.filter(|&far| far > p.znear && far.is_finite());
        let sees = is_size(p.yfov) && p.yfov < 2.0 * FRAC_PI_2 && is_size(p.znear);
        let aspect = p.aspect_ratio.filter(|&aspect| is_size(aspect));
        return sees.then_some(Projection::Perspective { fov_y: p.yfov, aspect, near: p.znear, far });
    }
    let o = camera.orthographic.as_ref()?;
    // Negative sizes turn the picture around; nobody means that.
    let (x_mag, y_mag) = (o.xmag.abs(), o.ymag.abs());
    let sees = is_size(x_mag) && is_size(y_mag) && o.znear.is_finite() && o.zfar > o.znear && o.zfar.is_finite();
    sees.then_some(Projection::Orthographic { x_mag, y_mag, near: o.znear, far: o.zfar })
}

/// The node's light; `None` also if it is of no known kind.
pub(super) fn light(root: &Root, node: &Node, world: &Affine) -> Option<Light> {
    let number = node.extensions.light.as_ref()?.light;
    let light = root.extensions.lights.as_ref()?.lights.get(number.index())?;
    let kind = match light.kind.as_str() {
        "directional" => LightKind::Directional,
        "point" => LightKind::Point,
        "spot" => spot(light.spot.as_ref()),
        _ => return None,
    };
    let position = world.point([0.0; 3]);
    let (direction, _) = forward_and_up(world.vector([0.0, 1.0, 0.0]), world.vector([0.0, 0.0, 1.0]));
    let name = light.name.as_deref().or(node.name()).unwrap_or_default();
    let is_somewhere = position.iter().all(|c| c.is_finite());
    is_somewhere.then(|| Light {
        name: shown(name.as_bytes()).into(),
        color: light
            .color
            .map(|color| color.map(|c| c as f32))
            .filter(|color| color.iter().all(|c| c.is_finite()))
            .unwrap_or([1.0; 3]),
        intensity: light.intensity.map(|i| i as f32).filter(|i| i.is_finite()).unwrap_or(1.0),
        range: light.range.map(|range| range as f32).filter(|&range| range > 0.0).unwrap_or(f32::INFINITY),
        position,
        direction,
        kind,
    })
}

fn spot(spot: Option<&Spot>) -> LightKind {
    let outer = spot.and_then(|spot| spot.outer_cone_angle).unwrap_or(FRAC_PI_4);
    let outer_cone_angle = if outer > 0.0 && outer <= FRAC_PI_2 { outer } else { FRAC_PI_4 };
    let inner = spot.and_then(|spot| spot.inner_cone_angle).unwrap_or(0.0);
    let inner_cone_angle = if inner >= 0.0 && inner < outer_cone_angle { inner } else { 0.0 };
    LightKind::Spot { inner_cone_angle, outer_cone_angle }
}
