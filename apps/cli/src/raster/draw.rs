//! A drawing to a picture of what was asked for.

use super::file::{Drawing, Vertex};
use crate::arguments::Show;
use crate::failure::Failure;
use crate::heat::count_color;
use crate::picture::{Picture, Pixels};
use crate::render::depth_code;
use pineda::{
    Blend, ColorBuffer, Compare, DepthBuffer, DepthState, DrawState, Indices, Mesh, NO_ID, Pass, Renderer, Rgba,
    Target, Vec4,
};

pub(crate) fn draw(drawing: &Drawing, show: Show, renderer: &mut Renderer) -> Result<Picture, Failure> {
    let count = drawing.size.pixels();
    let pixels = match show {
        Show::Colour => {
            let mut colors = vec![[0; 4]; count];
            execute(drawing, renderer, |target| Target { color: ColorBuffer::Rgba8(&mut colors), ..target })?;
            Pixels::Rgb8(colors.into_iter().map(|[r, g, b, _]| [r, g, b]).collect())
        }
        Show::Count => {
            let mut hits = vec![0; count];
            execute(drawing, renderer, |target| Target { hits: Some(&mut hits), ..target })?;
            Pixels::Rgb8(hits.into_iter().map(count_color).collect())
        }
        Show::Barycentric => {
            let mut barycentrics = vec![[0.0; 3]; count];
            execute(drawing, renderer, |target| Target { barycentrics: Some(&mut barycentrics), ..target })?;
            Pixels::Rgb8(barycentrics.into_iter().map(|b| b.map(|x: f32| (x * 255.0 + 0.5) as u8)).collect())
        }
        Show::Depth => {
            let (mut depth, mut ids) = (vec![0.0; count], vec![0; count]);
            execute(drawing, renderer, |target| Target {
                depth: DepthBuffer::D32F(&mut depth),
                triangle_ids: Some(&mut ids),
                ..target
            })?;
            let codes = depth.into_iter().zip(ids).map(|(z, id)| depth_code((id != NO_ID).then_some(z)));
            Pixels::Gray16(codes.collect())
        }
        Show::Id => {
            let mut ids = vec![0; count];
            execute(drawing, renderer, |target| Target { triangle_ids: Some(&mut ids), ..target })?;
            Pixels::Rgb8(ids.into_iter().map(id_color).collect())
        }
    };
    Ok(Picture { size: drawing.size, pixels })
}

/// Draws to the target that `buffers` completes.
fn execute<'a>(
    drawing: &Drawing,
    renderer: &mut Renderer,
    buffers: impl FnOnce(Target<'a>) -> Target<'a>,
) -> Result<(), Failure> {
    let compare = if drawing.depth_test { Compare::Less } else { Compare::Always };
    let blends = drawing.vertices.iter().any(|vertex| vertex.color[3] < 1.0);
    let state = DrawState {
        space: drawing.space,
        cull: drawing.cull,
        front_face: drawing.front_face,
        depth: DepthState { compare, write: true },
        blend: if blends { Blend::ALPHA } else { Blend::OPAQUE },
        ..DrawState::default()
    };
    let [r, g, b] = drawing.background;
    let mut pass = Pass::new();
    pass.clear_color = Some([r, g, b, 1.0]);
    pass.draw_with(
        Mesh { vertices: &drawing.vertices, indices: Indices::U32(drawing.triangles.as_flattened()) },
        state,
        |vertex: &Vertex| (Vec4::from(vertex.position), Rgba::from(vertex.color)),
        |f| f.varyings(),
    );
    let target = Target::new(drawing.size.width, drawing.size.height);
    renderer.render(&pass, &mut buffers(target))?;
    Ok(())
}

/// The bits of the number plus 1, dealt to red, green and blue in turn, from the brightest of each on: neighbours differ
/// visibly, no two of the first 2^24 - 1 numbers share a colour, and black is none.
fn id_color(id: u32) -> [u8; 3] {
    let number = id.wrapping_add(1);
    let mut color = [0u8; 3];
    for bit in 0..24 {
        color[bit % 3] |= ((number >> bit & 1) as u8) << (7 - bit / 3);
    }
    color
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn id_colors_can_be_read_back() {
        let number =
            |color: [u8; 3]| (0..24).fold(0u32, |n, bit| n | u32::from(color[bit % 3] >> (7 - bit / 3) & 1) << bit);
        for id in [0, 1, 2, 3, 1000, 123_456, (1 << 24) - 2] {
            assert_eq!(number(id_color(id)), id + 1);
        }
        assert_eq!(
            [id_color(NO_ID), id_color(0), id_color(1), id_color(2)],
            [[0, 0, 0], [128, 0, 0], [0, 128, 0], [128, 128, 0]]
        );
    }
}
