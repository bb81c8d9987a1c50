//! Scenes of lines, points, and triangles drawn as edges and corners.

use crate::looks::{Gouraud, Vertex};
use crate::primitives::Row;
use crate::scenes::{Layer, Look, RASTER};
use crate::shapes::{Shape, ground, knot};
use core::f32::consts::TAU;
use libm::{cosf, sinf};
use pineda::*;

/// Discs with a ring, as large as the first number of the normal says.
pub(crate) struct Dots;

#[shader]
impl Shader for Dots {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Rgba<L>;
    const POINT_COORD: bool = true;
    const DISCARDS: bool = true;
    fn vertex(&self, v: &Vertex) -> (Vec4, Rgba) {
        (v.position.into(), v.color.into())
    }
    fn point_size(&self, v: &Vertex) -> Option<f32> {
        Some(v.normal[0])
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let Vec2 { x, y } = f.point_coord();
        let away = Vec2::new(x - 0.5, y - 0.5).length();
        f.discard(away.gt(0.5));
        let light = away.gt(0.38).select(0.35, 1.0 - 0.8 * (x - 0.3) * y);
        let Rgba { r, g, b, a } = f.varyings();
        Rgba { r: r * light, g: g * light, b: b * light, a }
    }
}

fn hue(t: f32) -> [f32; 4] {
    let channel = |shift: f32| 0.55 + 0.45 * cosf((t + shift) * TAU);
    [channel(0.0), channel(0.667), channel(0.333), 1.0]
}

fn vertex([x, y]: [f32; 2], color: [f32; 4]) -> Vertex {
    Vertex { position: [x, y, 0.5, 1.0], normal: [1.0; 3], color }
}

fn lines(vertices: Vec<Vertex>, camera: Mat4, state: DrawState) -> Layer {
    let indices = (0..vertices.len() as u32).collect();
    Layer { shape: Shape { vertices, indices }, look: Look::Gouraud(Gouraud { camera }), state }
}

/// Lines from near a middle outwards, white to coloured.
fn star([x, y]: [f32; 2], count: u16, [inner, outer]: [f32; 2]) -> Vec<Vertex> {
    let ray = |k: u16| {
        let t = f32::from(k) / f32::from(count);
        let (c, s) = (cosf(t * TAU), sinf(t * TAU));
        [vertex([x + inner * c, y + inner * s], [1.0; 4]), vertex([x + outer * c, y + outer * s], hue(t))]
    };
    (0..count).flat_map(ray).collect()
}

/// Rounds of a spiral.
fn spiral([x, y]: [f32; 2], count: u8, radius: f32, rounds: f32) -> Vec<Vertex> {
    let corner = |k: u8| {
        let t = f32::from(k) / f32::from(count);
        let (c, s) = (cosf(rounds * t * TAU), sinf(rounds * t * TAU));
        vertex([x + radius * t * c, y + radius * t * s], hue(t))
    };
    (0..count).map(corner).collect()
}

const LIST: DrawState = DrawState { topology: PrimitiveTopology::LineList, ..RASTER };
const SMOOTH: DrawState = DrawState { smooth_lines: true, blend: Blend::ALPHA, depth: DepthState::OFF, ..LIST };

/// A star; strips and loops with restarts, the last vertex's colour in each line; a floor of lines that goes on behind the eye, seen in perspective.
pub(crate) fn thin_lines() -> Vec<Layer> {
    let strip = DrawState {
        topology: PrimitiveTopology::LineStrip,
        primitive_restart: true,
        provoking_vertex: ProvokingVertex::Last,
        ..RASTER
    };
    let pieces = (0..120).map(|k| if k % 13 == 12 { u8::MAX } else { k }).collect();
    let polygons = (0..120).map(|k| if k % 5 == 4 { u8::MAX } else { k }).collect();
    let shape = |vertices| Shape { vertices, indices: Vec::new() };
    let camera = Mat4::perspective(0.9, 317.0 / 203.0, 0.1, 40.0)
        * Mat4::look_at([0.4, 0.8, 4.0], [0.0, 0.6, 0.0], [0.0, 1.0, 0.0]);
    let floor = (-12i8..=12).flat_map(|k| {
        let at = f32::from(k) * 0.5;
        let color = hue(f32::from(k) / 25.0);
        let ends = [[at, 0.0, -9.0], [at, 0.0, 9.0], [-6.0, 0.0, at], [6.0, 0.0, at]];
        ends.map(|[x, y, z]| Vertex {
            position: [x, y, z, 1.0],
            normal: [1.0; 3],
            color: if z > 5.0 { [1.0; 4] } else { color },
        })
    });
    vec![
        lines(floor.collect(), camera, DrawState { space: Space::Clip, ..LIST }),
        lines(star([60.0, 62.0], 72, [4.0, 56.0]), Mat4::IDENTITY, LIST),
        Layer {
            shape: shape(spiral([168.0, 58.0], 120, 54.0, 5.0)),
            look: Look::Facets(Row::U8(pieces)),
            state: strip,
        },
        Layer {
            shape: shape(spiral([268.0, 58.0], 120, 54.0, 11.3)),
            look: Look::Facets(Row::U8(polygons)),
            state: DrawState { topology: PrimitiveTopology::LineLoop, ..strip },
        },
    ]
}

/// Above wide lines, below smooth ones: stars of several widths, and a curve of many short lines.
pub(crate) fn wide_and_smooth_lines() -> Vec<Layer> {
    let mut layers = Vec::new();
    for (k, width) in [1.0, 1.7, 4.0, 11.0].into_iter().enumerate() {
        let x = 40.0 + 79.0 * k as f32;
        let count = if width > 8.0 { 9 } else { 19 };
        for (y, state) in [(36.5, LIST), (106.5, SMOOTH)] {
            let state = DrawState { line_width: width, ..state };
            layers.push(lines(star([x, y], count, [7.0, 32.0]), Mat4::IDENTITY, state));
        }
    }
    for (x, line_width) in [(10.0, 1.0), (90.0, 2.5), (170.0, 6.0), (250.0, 0.0)] {
        let curve = |k: u16| {
            let t = f32::from(k) / 60.0;
            vertex([x + 58.0 * t, 172.0 + 24.0 * sinf(t * 9.0)], hue(t))
        };
        let state = if line_width > 0.0 { DrawState { line_width, ..SMOOTH } } else { LIST };
        let state = DrawState { topology: PrimitiveTopology::LineStrip, ..state };
        layers.push(lines((0..60).map(curve).collect(), Mat4::IDENTITY, state));
    }
    layers
}

/// Squares of growing size, between centres of pixels and on them, some over the border; and discs of sizes of their own.
pub(crate) fn points() -> Vec<Layer> {
    let list = DrawState { topology: PrimitiveTopology::PointList, ..RASTER };
    let mut layers = Vec::new();
    for (k, size) in [0.5, 1.0, 1.5, 2.0, 3.25, 5.0, 8.0, 17.5, 40.0].into_iter().enumerate() {
        let row = |i: u16| {
            let x = 6.0 + size * 0.8 + f32::from(i) * (size * 1.25 + 2.125);
            Vertex {
                position: [x, 5.0 + [0.0, 4.0, 8.0, 13.0, 19.0, 27.0, 38.0, 56.0, 90.0][k], 0.5, 1.0],
                ..vertex([0.0; 2], hue(f32::from(i) / 12.0))
            }
        };
        let vertices = (0..if k == 8 { 5 } else { 12 }).map(row).collect();
        layers.push(lines(vertices, Mat4::IDENTITY, DrawState { point_size: size, ..list }));
    }
    let disc = |k: u16| {
        let t = f32::from(k) / 160.0;
        let (c, s) = (cosf(t * 40.0), sinf(t * 40.0));
        let position = [230.0 + 95.0 * t * c, 110.0 + 95.0 * t * s, 1.0 - t, 1.0];
        Vertex { position, normal: [2.0 + 34.0 * t * t, 0.0, 0.0], color: hue(t * 2.0) }
    };
    let vertices: Vec<_> = (0..160).map(disc).collect();
    let indices = (0..160).collect();
    layers.push(Layer { shape: Shape { vertices, indices }, look: Look::Dots, state: list });
    layers
}

/// A knot: its edges, those of its back left out; its corners, over the solid; smooth edges over the solid, kept in front by a bias. And the edges of a floor that goes
/// through the eye.
pub(crate) fn fill_modes() -> Vec<Layer> {
    let camera = |x: f32| {
        Mat4::translation([x, 0.12, 0.0])
            * Mat4::perspective(0.9, 317.0 / 203.0, 0.5, 50.0)
            * Mat4::look_at([2.0, 3.0, 16.0], [0.0; 3], [0.0, 1.0, 0.0])
    };
    let plain = DrawState { cull: Cull::Back, front_face: FrontFace::Clockwise, ..DrawState::default() };
    let layer = |x, shape, state| Layer { shape, look: Look::Gouraud(Gouraud { camera: camera(x) }), state };
    let bright = |mut shape: Shape, by: f32| {
        shape.vertices.iter_mut().for_each(|v| v.color = [v.color[0] * by, v.color[1] * by, v.color[2] * by, 0.8]);
        shape
    };
    let behind = DrawState { depth_bias: DepthBias { constant: 2.0, slope: 2.0, clamp: 0.0 }, ..plain };
    let edges = DrawState { polygon_mode: PolygonMode::Line, ..plain };
    let smooth = DrawState {
        smooth_lines: true,
        line_width: 1.2,
        blend: Blend::ALPHA,
        depth: DepthState { compare: Compare::LessEqual, write: false },
        ..edges
    };
    let corners = DrawState { polygon_mode: PolygonMode::Point, point_size: 2.0, ..plain };
    let floor_camera = Mat4::perspective(0.9, 317.0 / 203.0, 0.1, 40.0)
        * Mat4::look_at([0.4, 1.6, 4.0], [0.0, 2.0, 0.0], [0.0, 1.0, 0.0]);
    let floor = Layer {
        shape: ground(9.0, 14),
        look: Look::Gouraud(Gouraud { camera: floor_camera }),
        state: DrawState { polygon_mode: PolygonMode::Line, ..DrawState::default() },
    };
    vec![
        floor,
        layer(-0.62, knot(64, 9), edges),
        layer(0.0, bright(knot(64, 9), 0.2), behind),
        layer(0.0, bright(knot(64, 9), 1.4), corners),
        layer(0.62, bright(knot(64, 9), 0.25), behind),
        layer(0.62, bright(knot(64, 9), 1.5), smooth),
    ]
}
