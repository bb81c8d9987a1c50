//! Colour buffers and draws that do not go together are errors that leave everything as it was.

use pineda::*;

const CORNERS: [[f32; 2]; 3] = [[0.0, 0.0], [8.0, 0.0], [0.0, 8.0]];
const MESH: Mesh<'_, [f32; 2]> = Mesh { vertices: &CORNERS, indices: Indices::Sequential };
const STATE: DrawState = DrawState { space: Space::Raster, ..DrawState::DEFAULT };

fn place(&[x, y]: &[f32; 2]) -> (Vec4, ()) {
    ([x, y, 0.0, 1.0].into(), ())
}

/// Renders to an 8-bit and an integer buffer, or to one of them, after a draw that is right.
fn error_of(record: impl FnOnce(&mut Pass<'_>), buffers: &str) -> Option<Error> {
    let (mut pixels, mut ids) = ([[7u8; 4]; 64], [9u32; 64]);
    let mut target = match buffers {
        "color" => Target { color: ColorBuffer::Rgba8(&mut pixels), ..Target::new(8, 8) },
        "ids" => Target { color: ColorBuffer::R32U(&mut ids), ..Target::new(8, 8) },
        "none, ids" => Target { more_colors: vec![ColorBuffer::R32U(&mut ids)], ..Target::new(8, 8) },
        "" => Target::new(8, 8),
        _ => Target {
            color: ColorBuffer::Rgba8(&mut pixels),
            more_colors: vec![ColorBuffer::R32U(&mut ids)],
            ..Target::new(8, 8)
        },
    };
    let mut pass = Pass::new();
    match buffers {
        "color" => pass.draw_with(MESH, STATE, place, |f| Rgba::gray(f.x())),
        "ids" => pass.draw_with(MESH, STATE, place, |f| f.splat(1u32)),
        _ => pass.draw_with(MESH, STATE, place, |f| (Rgba::gray(f.x()), f.splat(1u32))),
    };
    record(&mut pass);
    let error = Renderer::new(Settings::default()).expect("the best level").render(&pass, &mut target).err();
    if let Some(error) = &error {
        assert!(pixels == [[7; 4]; 64] && ids == [9; 64], "{error}");
    }
    error
}

fn draw_gray(state: DrawState) -> impl FnOnce(&mut Pass<'_>) {
    move |pass| {
        pass.draw_with(MESH, state, place, |f| Rgba::gray(f.x()));
    }
}

fn draw_both(state: DrawState) -> impl FnOnce(&mut Pass<'_>) {
    move |pass| {
        pass.draw_with(MESH, state, place, |f| (Rgba::gray(f.x()), f.splat(1u32)));
    }
}

#[test]
fn there_are_as_many_outputs_as_buffers() {
    let wrong = |outputs, colors| Some(Error::OutputCount { draw: 1, outputs, colors });
    assert_eq!(error_of(draw_gray(STATE), "color, ids"), wrong(1, 2));
    assert_eq!(error_of(draw_both(STATE), "color"), wrong(2, 1));
    let nothing = |pass: &mut Pass<'_>| {
        pass.draw_with(MESH, STATE, place, |_| ());
    };
    assert_eq!(error_of(nothing, "color"), wrong(0, 1));
    // What is masked need not be there, and without buffers nothing is asked.
    let mut first_only = STATE;
    first_only.colors[1] = Some(ColorState { mask: ColorMask::NONE, ..ColorState::default() });
    assert_eq!(error_of(draw_gray(first_only), "color, ids"), None);
    let masked = DrawState { color_mask: ColorMask::NONE, ..STATE };
    assert_eq!(error_of(draw_both(masked), "color"), None);
    assert_eq!(error_of(draw_both(STATE), ""), None);
    assert_eq!(error_of(draw_gray(STATE), ""), None);
}

#[test]
fn outputs_are_of_the_kind_that_the_buffer_holds() {
    let (returned, holds) = (OutputKind::Float, OutputKind::Uint);
    let error = error_of(draw_gray(STATE), "ids").expect("wrong");
    assert_eq!(error, Error::OutputKind { draw: 1, color: 0, returned, holds });
    let message = "draw 1: the fragment stage returns floats for colour buffer 0, which holds unsigned integers";
    assert_eq!(error.to_string(), message);
    let signed = |pass: &mut Pass<'_>| {
        pass.draw_with(MESH, STATE, place, |f| (Rgba::gray(f.x()), f.splat(1i32)));
    };
    let error = Some(Error::OutputKind { draw: 1, color: 1, returned: OutputKind::Int, holds });
    assert_eq!(error_of(signed, "color, ids"), error);
    // What is dropped may be anything.
    let two = |pass: &mut Pass<'_>| {
        pass.draw_with(MESH, STATE, place, |f| [f.splat(1u32); 2]);
    };
    assert_eq!(error_of(two, "none, ids"), None);
}

#[test]
fn integers_are_not_blended() {
    let mut state = DrawState { blend: Blend::ALPHA, ..STATE };
    assert_eq!(error_of(draw_both(state), "color, ids"), Some(Error::BlendedIntegers { draw: 1, color: 1 }));
    state.colors[1] = Some(ColorState::default());
    assert_eq!(error_of(draw_both(state), "color, ids"), None);
}

#[test]
fn a_second_source_is_there_and_there_is_one_buffer() {
    let component = BlendComponent { target: BlendFactor::OneMinusSource1Alpha, ..BlendComponent::REPLACE };
    let state = DrawState { blend: Blend::both(component), ..STATE };
    assert_eq!(error_of(draw_gray(state), "color"), Some(Error::NoSecondSource { draw: 1 }));
    let dual = move |pass: &mut Pass<'_>| {
        pass.draw_with(MESH, state, place, |f| DualSource { color: Rgba::gray(f.x()), factor: Rgba::gray(f.y()) });
    };
    assert_eq!(error_of(dual, "color"), None);
    let mut both = state;
    both.colors[1] = Some(ColorState::default());
    assert_eq!(error_of(draw_both(both), "color, ids"), Some(Error::SecondSourceColors { draw: 1, colors: 2 }));
    // Minimum and maximum have no factors.
    let component = BlendComponent { operation: BlendOperation::Min, ..component };
    assert_eq!(error_of(draw_gray(DrawState { blend: Blend::both(component), ..STATE }), "color"), None);
}

#[test]
fn buffers_are_cleared_to_what_they_hold() {
    let clear = |k: usize, color: ClearColor| move |pass: &mut Pass<'_>| pass.color_ops[k].load = Load::Clear(color);
    let error = |color, clear, holds| Some(Error::ClearKind { color, clear, holds });
    let (float, uint, int) = (OutputKind::Float, OutputKind::Uint, OutputKind::Int);
    assert_eq!(error_of(clear(0, [1u32; 4].into()), "color, ids"), error(0, uint, float));
    assert_eq!(error_of(clear(1, [1.0; 4].into()), "color, ids"), error(1, float, uint));
    assert_eq!(error_of(clear(1, [1i32; 4].into()), "color, ids"), error(1, int, uint));
    assert_eq!(error_of(clear(1, [1u32; 4].into()), "color, ids"), None);
    // There is no such buffer.
    assert_eq!(error_of(clear(5, [1i32; 4].into()), "color, ids"), None);
    assert_eq!(error_of(clear(0, [1i32; 4].into()), "none, ids"), None);
}

#[test]
fn there_are_eight_buffers_at_most_and_each_holds_one_element_a_pixel() {
    let mut renderer = Renderer::new(Settings::default()).expect("the best level");
    for more in [7, 8] {
        let mut ids = vec![[3u32; 4]; more];
        let more_colors = ids.iter_mut().map(|ids| ColorBuffer::R32U(ids)).collect();
        let mut target = Target { more_colors, ..Target::new(2, 2) };
        let result = renderer.render(&Pass::new(), &mut target).map(drop);
        let wanted = if more == 7 { Ok(()) } else { Err(Error::TooManyColors { colors: 9 }) };
        assert_eq!(result, wanted);
        assert!(ids.iter().all(|ids| *ids == if more == 7 { [0; 4] } else { [3; 4] }));
    }
    let mut short = [0u16; 3];
    let mut target = Target { more_colors: vec![ColorBuffer::R16F(&mut short)], ..Target::new(2, 2) };
    let error = renderer.render(&Pass::new(), &mut target).expect_err("one element is missing");
    let buffer = "more_colors";
    assert_eq!(error, Error::BufferLength { buffer, length: 3, expected: 4, width: 2, height: 2, samples: 1 });
}
