//! A sheet drawn with `pineda`.

use super::sheet::{Colors, DepthFormat, Draw, Interpolation, Picture, Sheet, Vertex};
use anyhow::Result;
use pineda::{
    ColorBuffer, DepthBuffer, Fragment, Indices, Lanes, Mesh, Pass, Renderer, Rgba, Shader, Target, Vec4, shader,
    varyings,
};

varyings! { struct Smooth { color: Rgba } }
varyings! { struct Straight { #[noperspective] color: Rgba } }
varyings! { struct Plain { #[flat] color: Rgba } }

struct Perspective;
struct Linear;
struct Flat;

macro_rules! shows_its_color {
    ($shader:ident, $varyings:ident) => {
        #[shader]
        impl Shader for $shader {
            type Vertex = Vertex;
            type Varyings<L: Lanes> = $varyings<L>;
            fn vertex(&self, vertex: &Vertex) -> (Vec4, $varyings) {
                (vertex.position.into(), $varyings { color: vertex.color.into() })
            }
            fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
                f.color
            }
        }
    };
}

shows_its_color!(Perspective, Smooth);
shows_its_color!(Linear, Straight);
shows_its_color!(Flat, Plain);

/// Draws a sheet.
pub(crate) fn draw(renderer: &mut Renderer, sheet: &Sheet) -> Result<Picture> {
    let mut pass = Pass::new();
    (pass.clear_color, pass.clear_stencil) = (None, None);
    for Draw { vertices, indices, interpolation, state } in &sheet.draws {
        let indices = indices.as_deref().map_or(Indices::Sequential, Indices::U32);
        let mesh = Mesh { vertices, indices };
        match interpolation {
            Interpolation::Perspective => pass.draw(&Perspective, mesh, *state),
            Interpolation::Linear => pass.draw(&Linear, mesh, *state),
            Interpolation::Flat => pass.draw(&Flat, mesh, *state),
        };
    }
    let mut colors = sheet.colors.clone();
    let mut stencil = sheet.stencil.clone();
    let (mut floats, mut words, mut halves) = (Vec::new(), Vec::new(), Vec::new());
    let depth = match sheet.depth {
        DepthFormat::None => DepthBuffer::None,
        DepthFormat::Float32 => DepthBuffer::D32F(zeros(&mut floats, sheet)),
        DepthFormat::Unorm24 | DepthFormat::Unorm24Stencil8 => DepthBuffer::D24(zeros(&mut words, sheet)),
        DepthFormat::Unorm16 => DepthBuffer::D16(zeros(&mut halves, sheet)),
    };
    let color = match &mut colors {
        Colors::Unorm8(codes) => ColorBuffer::Rgba8(codes),
        Colors::Srgb8(codes) => ColorBuffer::Rgba8Srgb(codes),
        Colors::Float16(colors) => ColorBuffer::Rgba16F(colors),
        Colors::Float32(colors) => ColorBuffer::Rgba32F(colors),
    };
    let has_stencil = !stencil.is_empty();
    let mut target =
        Target { color, depth, stencil: has_stencil.then_some(&mut stencil), ..Target::new(sheet.side, sheet.side) };
    renderer.render(&pass, &mut target)?;
    let depth = match sheet.depth {
        DepthFormat::None => Vec::new(),
        DepthFormat::Float32 => floats.into_iter().map(f32::to_bits).collect(),
        DepthFormat::Unorm24 | DepthFormat::Unorm24Stencil8 => words,
        DepthFormat::Unorm16 => halves.into_iter().map(u32::from).collect(),
    };
    Ok(Picture { colors, depth, stencil })
}

fn zeros<'a, T: Copy + Default>(buffer: &'a mut Vec<T>, sheet: &Sheet) -> &'a mut [T] {
    buffer.resize(sheet.pixels(), T::default());
    buffer
}
