//! `medium`: a tube of 70,000 triangles around a (2, 3) torus knot, seen in perspective and lit per pixel.
//!
//! The knot is stretched to the picture's shape so that about half of the screen is covered. The tube keeps its round cross-section: a circle in the plane
//! of two unit vectors perpendicular to the knot's tangent, one of them the stretched torus's own normal.

use super::{BlinnPhong, FULL_HD, Scene, Shading, Size, State, Texture, Vertex, matrix};

/// 70,000 triangles.
pub(super) const FINE: Segments = Segments { along: 875, around: 40 };
/// 10,000 triangles.
pub(super) const COARSE: Segments = Segments { along: 250, around: 20 };
/// Widens the knot to fill the 16:9 picture.
const STRETCH: f32 = 1.75;
const TUBE_RADIUS: f32 = 0.74;
const EYE_DISTANCE: f32 = 10.5;
/// In a 16:9 picture; others are as wide.
const FOV_Y: f32 = 40.0 * std::f32::consts::PI / 180.0;

/// Into how many pieces the tube is cut.
#[derive(Clone, Copy)]
pub(super) struct Segments {
    along: u32,
    around: u32,
}

pub(super) fn lit_knot(size: Size, segments: Segments) -> Scene {
    let Segments { along: all_along, around: all_around } = segments;
    let mut vertices = Vec::with_capacity((all_along * all_around) as usize);
    for along in 0..all_along {
        let ring = Ring::new(std::f32::consts::TAU * along as f32 / all_along as f32);
        for around in 0..all_around {
            vertices.push(ring.vertex(std::f32::consts::TAU * around as f32 / all_around as f32));
        }
    }
    let mut indices = Vec::with_capacity((6 * all_along * all_around) as usize);
    for along in 0..all_along {
        let next_along = (along + 1) % all_along;
        for around in 0..all_around {
            let next_around = (around + 1) % all_around;
            let [a, b, c, d] = [(along, around), (next_along, around), (next_along, next_around), (along, next_around)]
                .map(|(along, around)| along * all_around + around);
            indices.extend([a, d, c, a, c, b]);
        }
    }
    let [width, height] = size;
    let fov_y = if size == FULL_HD {
        FOV_Y
    } else {
        2.0 * libm::atanf(libm::tanf(0.5 * FOV_Y) * 16.0 / 9.0 * height as f32 / width as f32)
    };
    let lit = Shading::BlinnPhong(BlinnPhong {
        eye: [0.0, 0.0, EYE_DISTANCE],
        light: normalize([0.4, 0.7, 0.9]),
        albedo: [0.75, 0.3, 0.15],
        ambient: 0.1,
        specular: 0.4,
    });
    let clip_from_world = matrix::camera_on_z(EYE_DISTANCE, fov_y, size, 5.0, 20.0);
    Scene { size, ..Scene::plain(vertices, indices, clip_from_world, State::FRONT, lit) }
}

/// The same knot with texture coordinates for colours: the texture goes three times around the tube, and twenty times along it.
pub(super) fn textured_knot(textures: u32, shading: fn(BlinnPhong) -> Shading) -> Scene {
    let lit = lit_knot(FULL_HD, FINE);
    let Segments { along: all_along, around: all_around } = FINE;
    let Shading::BlinnPhong(uniforms) = lit.shading else { unreachable!("the knot is lit") };
    // The last ring and the last place of each have other coordinates than the first, where they are.
    let places = all_around + 1;
    let mut vertices = Vec::with_capacity(((all_along + 1) * places) as usize);
    for along in 0..=all_along {
        for around in 0..=all_around {
            let first = (along % all_along) * all_around + around % all_around;
            let uv = [20.0 * along as f32 / all_along as f32, 3.0 * around as f32 / all_around as f32];
            vertices.push(Vertex { color: [uv[0], uv[1], 0.0], ..lit.vertices[first as usize] });
        }
    }
    let mut indices = Vec::with_capacity(lit.indices.len());
    for along in 0..all_along {
        for around in 0..all_around {
            let a = along * places + around;
            let (b, d) = (a + places, a + 1);
            indices.extend([a, d, d + places, a, d + places, b]);
        }
    }
    let textures = (0..textures).map(Texture::bricks).collect();
    Scene { vertices, indices, shading: shading(uniforms), textures, ..lit }
}

/// One cross-section of the tube.
struct Ring {
    center: [f32; 3],
    /// Unit vectors that span the plane of the ring, perpendicular to the knot.
    outward: [f32; 3],
    sideways: [f32; 3],
}

impl Ring {
    /// The knot (2 + cos 3t) (cos 2t, sin 2t), sin 3t, which winds on a torus of radii 2 and 1.
    fn new(t: f32) -> Self {
        let (sin2, cos2) = libm::sincosf(2.0 * t);
        let (sin3, cos3) = libm::sincosf(3.0 * t);
        let radius = 2.0 + cos3;
        let tangent = [
            STRETCH * (-3.0 * sin3 * cos2 - 2.0 * radius * sin2),
            -3.0 * sin3 * sin2 + 2.0 * radius * cos2,
            3.0 * cos3,
        ];
        // Normals go with the inverse transpose of the stretch, so this one stays perpendicular to the tangent.
        let outward = normalize([cos3 * cos2 / STRETCH, cos3 * sin2, sin3]);
        Self {
            center: [STRETCH * radius * cos2, radius * sin2, sin3],
            outward,
            sideways: cross(normalize(tangent), outward),
        }
    }

    fn vertex(&self, angle: f32) -> Vertex {
        let (sin, cos) = libm::sincosf(angle);
        let normal: [f32; 3] = std::array::from_fn(|axis| cos * self.outward[axis] + sin * self.sideways[axis]);
        Vertex {
            position: std::array::from_fn(|axis| self.center[axis] + TUBE_RADIUS * normal[axis]),
            normal,
            color: normal.map(|component| 0.5 + 0.5 * component),
        }
    }
}

fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn normalize(v: [f32; 3]) -> [f32; 3] {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    v.map(|component| component / length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn front_faces_look_outwards() {
        let scene = lit_knot(FULL_HD, FINE);
        let mut agree = 0;
        for triangle in scene.indices.chunks_exact(3) {
            let [a, b, c] = [0, 1, 2].map(|corner| scene.vertices[triangle[corner] as usize]);
            let edge = |to: Vertex| std::array::from_fn(|axis| to.position[axis] - a.position[axis]);
            let face = cross(edge(b), edge(c));
            let dot = (0..3).map(|axis| face[axis] * a.normal[axis]).sum::<f32>();
            agree += usize::from(dot > 0.0);
        }
        assert_eq!(agree, 70_000);
    }
}
