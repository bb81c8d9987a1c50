//! Scenes of strips, fans, restarts and instances.

use crate::looks::Vertex;
use crate::scenes::{Layer, Look, RASTER};
use crate::shapes::Shape;
use core::f32::consts::TAU;
use libm::{cosf, sinf};
use pineda::*;

/// Which vertices are drawn.
pub(crate) enum Row {
    Sequential,
    U8(Vec<u8>),
    U16(Vec<u16>),
}

impl Row {
    pub(crate) fn indices(&self) -> Indices<'_> {
        match self {
            Self::Sequential => Indices::Sequential,
            Self::U8(indices) => Indices::U8(indices),
            Self::U16(indices) => Indices::U16(indices),
        }
    }
}

varyings! {
    pub(crate) struct Facet {
        #[flat]
        color: Rgba,
        light: Real,
    }
}

/// Each triangle in its provoking vertex's colour; the other vertices' shows a little in its brightness.
pub(crate) struct Facets;

#[shader]
impl Shader for Facets {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Facet<L>;
    fn vertex(&self, v: &Vertex) -> (Vec4, Facet) {
        (v.position.into(), Facet { color: v.color.into(), light: v.normal[0].into() })
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let Rgba { r, g, b, a } = f.color;
        Rgba { r: r * f.light, g: g * f.light, b: b * f.light, a }
    }
}

/// An instance: where it stands, how it is turned and how large it is, and its colour.
#[derive(Clone, Copy)]
pub(crate) struct Sprite {
    middle: [f32; 3],
    turn: [f32; 2],
    color: [f32; 4],
}

/// Instances in their own colours, the mesh's colours mixed in.
pub(crate) struct Sprites;

#[shader]
impl Shader for Sprites {
    type Vertex = Instanced<Vertex, Sprite>;
    type Varyings<L: Lanes> = Rgba<L>;
    fn vertex(&self, v: &Instanced<Vertex, Sprite>) -> (Vec4, Rgba) {
        let Sprite { middle: [mx, my, mz], turn: [c, s], color } = v.instance;
        let [x, y, z, w] = v.vertex.position;
        let mixed = [0, 1, 2, 3].map(|k| color[k] * (0.4 + 0.6 * v.vertex.color[k]));
        (Vec4::from([mx + c * x - s * y, my + s * x + c * y, mz + z, w]), mixed.into())
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        f.varyings()
    }
}

/// A vertex whose colour goes once round the rainbow as `hue` goes from 0 to 1; every other one is darker.
fn vertex([x, y]: [f32; 2], hue: f32, light: f32) -> Vertex {
    let channel = |shift: f32| 0.5 + 0.5 * cosf((hue + shift) * TAU);
    let color = [channel(0.0), channel(0.667), channel(0.333), 1.0];
    Vertex { position: [x, y, 0.5, 1.0], normal: [light, 0.0, 0.0], color }
}

/// A wave from (x, y) on to the right, a strip of `count` vertices.
fn ribbon([x, y]: [f32; 2], count: u16) -> Vec<Vertex> {
    let corner = |k: u16| {
        let t = f32::from(k / 2);
        let side = if k.is_multiple_of(2) { -11.0 } else { 11.0 };
        let at = [x + t * 10.0 + if side > 0.0 { 5.0 } else { 0.0 }, y + 9.0 * sinf(t * 0.6) + side];
        vertex(at, f32::from(k) / f32::from(count), if side > 0.0 { 1.0 } else { 0.55 })
    };
    (0..count).map(corner).collect()
}

/// A disc with a hole cut out of its right, a fan of `count` vertices.
fn disc([x, y]: [f32; 2], radius: f32, count: u16) -> Vec<Vertex> {
    let corner = |k: u16| match k {
        0 => vertex([x, y], 0.0, 1.0),
        _ => {
            let t = f32::from(k - 1) / f32::from(count - 2);
            let a = (0.08 + 0.84 * t) * TAU;
            vertex([x + radius * cosf(a), y + radius * sinf(a)], t, if k.is_multiple_of(2) { 1.0 } else { 0.55 })
        }
    };
    (0..count).map(corner).collect()
}

fn facets(vertices: Vec<Vertex>, row: Row, state: DrawState) -> Layer {
    Layer { shape: Shape { vertices, indices: Vec::new() }, look: Look::Facets(row), state }
}

/// Above a strip, below a fan; on the left with the first vertex provoking, on the right with the last. Back faces are left out, and there are none.
pub(crate) fn strips_and_fans() -> Vec<Layer> {
    let mut layers = Vec::new();
    for (x, provoking_vertex) in [(8.0, ProvokingVertex::First), (166.0, ProvokingVertex::Last)] {
        let strip = DrawState {
            topology: PrimitiveTopology::TriangleStrip,
            provoking_vertex,
            cull: Cull::Back,
            front_face: FrontFace::CounterClockwise,
            ..RASTER
        };
        layers.push(facets(ribbon([x, 35.0], 28), Row::Sequential, strip));
        let fan = DrawState { topology: PrimitiveTopology::TriangleFan, front_face: FrontFace::Clockwise, ..strip };
        let backwards = Row::U8((0..16).collect());
        layers.push(facets(disc([x + 68.0, 130.0], 62.0, 16), backwards, fan));
    }
    layers
}

/// A strip and a fan of each kind of indices, with pieces left out by restarts; some pieces are too short for a triangle.
pub(crate) fn restarts() -> Vec<Layer> {
    let strip = DrawState { topology: PrimitiveTopology::TriangleStrip, primitive_restart: true, ..RASTER };
    let fan = DrawState { topology: PrimitiveTopology::TriangleFan, ..strip };
    let none = u16::MAX;
    let pieces = vec![
        none, 0, 1, 2, 3, 4, none, 7, 8, 9, none, none, 10, 11, none, 12, none, 13, 14, 15, 16, 17, 18, 19, none, 22,
        23, 24, 25, 26, 27, 28, 29, 30, 31, none, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43, 44, 45, 46, 47, 48, 49, 50,
        51, none,
    ];
    let sectors = |first: u8| -> Vec<u8> {
        let sector = |k: u8| [0, first + k, first + k + 1, first + k + 2, u8::MAX];
        (0..5).flat_map(|k| sector(3 * k)).collect()
    };
    vec![
        facets(ribbon([8.0, 35.0], 60), Row::U16(pieces), strip),
        facets(disc([76.0, 130.0], 62.0, 18), Row::U8(sectors(1)), fan),
        facets(disc([234.0, 130.0], 62.0, 18), Row::U8(sectors(2)), fan),
    ]
}

/// A sunflower: the seeds are instances of a square of a strip, the leaves of a triangle.
pub(crate) fn instances() -> Vec<Layer> {
    let square = [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]];
    let leaf = [[0.0, -0.35], [1.0, 0.0], [0.0, 0.35]];
    let shape = |corners: &[[f32; 2]]| {
        let vertex = |(k, &[x, y]): (usize, &[f32; 2])| {
            let color = [[0.0; 4], [1.0; 4], [0.5; 4], [1.0; 4]][k];
            Vertex { position: [x, y, 0.0, 1.0], color, ..Vertex::default() }
        };
        Shape {
            vertices: corners.iter().enumerate().map(vertex).collect(),
            indices: (0..corners.len() as u32).collect(),
        }
    };
    let around = |angle: f32, radius: f32| [158.5 + radius * cosf(angle), 101.5 + radius * sinf(angle)];
    let leaves = (0..29u8).map(|k| {
        let angle = f32::from(k) / 29.0 * TAU;
        let [x, y] = around(angle, 58.0);
        let long = if k.is_multiple_of(2) { 40.0 } else { 34.0 };
        Sprite {
            middle: [x, y, 0.5 + f32::from(k % 3) * 0.1],
            turn: [cosf(angle) * long, sinf(angle) * long],
            color: [1.0, 0.75 - 0.15 * f32::from(k % 3), 0.05, 1.0],
        }
    });
    let seeds = (0..420u16).map(|k| {
        let angle = f32::from(k) * 2.399_963_2;
        let [x, y] = around(angle, 3.0 * f32::from(k).sqrt());
        let size = 1.3 + 0.004 * f32::from(k);
        let t = f32::from(k) / 420.0;
        Sprite {
            middle: [x, y, 0.25],
            turn: [cosf(angle) * size, sinf(angle) * size],
            color: [0.35 + 0.4 * t, 0.45 - 0.15 * t, 0.15, 1.0],
        }
    });
    let strip = DrawState { topology: PrimitiveTopology::TriangleStrip, ..RASTER };
    vec![
        Layer { shape: shape(&leaf), look: Look::Sprites(leaves.collect()), state: RASTER },
        Layer { shape: shape(&square), look: Look::Sprites(seeds.collect()), state: strip },
    ]
}
