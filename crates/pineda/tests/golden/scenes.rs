//! The golden scenes.

use crate::conservative;
use crate::formats::{self, Tile};
use crate::functions::{self, Functions};
use crate::looks::{BlinnPhong, CutOpen, Gouraud, Holes, Stripes};
use crate::multisample;
use crate::primitives::{self, Facets, Row, Sprite, Sprites};
use crate::shapes::{Shape, ground, knot, rectangle, slivers, soup};
use crate::strokes::{self, Dots};
use crate::textures::{self, Textured};
use pineda::*;

/// The format of a scene's picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    Linear,
    Srgb,
    Float,
}

/// A picture to be drawn.
pub(crate) struct Scene {
    pub(crate) name: &'static str,
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) format: Format,
    pub(crate) clear: [f32; 4],
    pub(crate) clear_depth: f32,
    /// Of the depth buffer: 16, 24 or 32.
    pub(crate) depth_bits: u32,
    pub(crate) samples: Samples,
    pub(crate) layers: Vec<Layer>,
}

/// One draw.
pub(crate) struct Layer {
    pub(crate) shape: Shape,
    pub(crate) look: Look,
    pub(crate) state: DrawState,
}

pub(crate) enum Look {
    Gouraud(Gouraud),
    BlinnPhong(BlinnPhong),
    Stripes(Stripes),
    Holes(Holes),
    Facets(Row),
    Sprites(Vec<Sprite>),
    CutOpen(CutOpen),
    Dots,
    Functions,
    Textured(Textured),
    Tile(Tile),
}

impl Scene {
    /// Whether a stencil buffer is among its outputs.
    pub(crate) fn has_stencil(&self) -> bool {
        self.layers.iter().any(|layer| layer.state.stencil.is_some())
    }
}

impl Layer {
    pub(crate) fn draw<'a>(&'a self, pass: &mut Pass<'a>) {
        let mesh = Mesh { vertices: &self.shape.vertices, indices: Indices::U32(&self.shape.indices) };
        match &self.look {
            Look::Gouraud(look) => pass.draw(look, mesh, self.state),
            Look::BlinnPhong(look) => pass.draw(look, mesh, self.state),
            Look::Stripes(look) => pass.draw(look, mesh, self.state),
            Look::Holes(look) => pass.draw(look, mesh, self.state),
            Look::Facets(row) => pass.draw(&Facets, Mesh { indices: row.indices(), ..mesh }, self.state),
            Look::CutOpen(look) => pass.draw(look, mesh, self.state),
            Look::Dots => pass.draw(&Dots, mesh, self.state),
            Look::Functions => pass.draw(&Functions, mesh, self.state),
            Look::Textured(look) => pass.draw(look, mesh, self.state),
            Look::Tile(tile) => {
                tile.draw(pass, mesh, self.state);
                pass
            }
            Look::Sprites(sprites) => pass.draw_instanced(&Sprites, mesh, sprites, self.state),
        };
    }
}

const WIDTH: u32 = 317;
const HEIGHT: u32 = 203;
const SIZE: [f32; 2] = [WIDTH as f32, HEIGHT as f32];
pub(crate) const RASTER: DrawState = DrawState { space: Space::Raster, ..DrawState::DEFAULT };
const IDENTITY: Mat4 = Mat4::IDENTITY;

/// Every scene.
pub(crate) fn all() -> Vec<Scene> {
    vec![
        scene("small_triangles", vec![gouraud(soup(1, 9_000, 2.5, SIZE), RASTER)]),
        scene("mid_triangles", vec![gouraud(soup(2, 300, 30.0, SIZE), RASTER)]),
        scene("large_triangles", vec![gouraud(soup(3, 40, 4_000.0, SIZE), RASTER)]),
        scene("slivers", vec![gouraud(slivers(4, 600, SIZE), RASTER)]),
        scene("strips_and_fans", primitives::strips_and_fans()),
        scene("restarts", primitives::restarts()),
        scene("instances", primitives::instances()),
        Scene { format: Format::Srgb, ..scene("thin_lines", strokes::thin_lines()) },
        Scene { format: Format::Srgb, ..scene("wide_and_smooth_lines", strokes::wide_and_smooth_lines()) },
        Scene { format: Format::Srgb, ..scene("points", strokes::points()) },
        Scene { format: Format::Srgb, ..scene("fill_modes", strokes::fill_modes()) },
        Scene { format: Format::Srgb, ..scene("knot", vec![lit_knot(None)]) },
        Scene { format: Format::Srgb, ..scene("four_viewports", four_viewports()) },
        Scene { format: Format::Srgb, ..scene("clip_distances", vec![cut_open()]) },
        scene("tutorial_triangle", vec![tutorial_triangle()]),
        Scene {
            format: Format::Srgb,
            clear: [0.2, 0.3, 0.6, 1.0],
            ..scene("ground_through_the_near_plane", near_plane())
        },
        Scene { format: Format::Srgb, ..scene("blended_layers", blended_layers()) },
        Scene { format: Format::Float, ..scene("premultiplied_over_brightness", brightness()) },
        Scene { clear_depth: 0.0, ..scene("reversed_depth", comparisons(&[Compare::Greater, Compare::GreaterEqual])) },
        scene("every_comparison", comparisons(&Compare::ALL)),
        scene("flat_and_noperspective", vec![stripes()]),
        scene("holes", holes()),
        Scene { format: Format::Srgb, ..scene("srgb_gradients", gradients()) },
        Scene { format: Format::Srgb, ..scene("blend_factors", blend_factors()) },
        Scene { format: Format::Srgb, ..scene("scissors_and_upside_down_viewports", windows()) },
        Scene { depth_bits: 24, format: Format::Srgb, ..scene("depth_bias", decals()) },
        Scene { format: Format::Srgb, ..scene("depth_clamp", clamped()) },
        Scene { depth_bits: 16, clear_depth: 0.0, ..scene("depth_of_16_bits_reversed", steps()) },
        scene("stencil_operations", stencil_operations()),
        scene("stencil_outline_and_shadow", stencil_outline()),
        Scene { clear: [0.0; 4], ..scene("blend_operations_and_color_masks", blend_operations()) },
        small("samples_2", Samples::Two, multisample::pinwheel()),
        small("samples_4", Samples::Four, multisample::pinwheel()),
        small("samples_8", Samples::Eight, multisample::pinwheel()),
        small("samples_16", Samples::Sixteen, multisample::pinwheel()),
        small("where_fragments_are_shaded", Samples::Four, multisample::samplings()),
        small("sample_masks_and_alpha_to_coverage", Samples::Eight, multisample::masks()),
        Scene {
            format: Format::Srgb,
            samples: Samples::Four,
            ..scene("lines_and_points_of_4_samples", multisample::strokes())
        },
        Scene {
            format: Format::Srgb,
            clear: [0.2, 0.3, 0.6, 1.0],
            samples: Samples::Eight,
            ..scene("clipped_discarded_and_blended_samples", multisampled_mix())
        },
        Scene { samples: Samples::Four, ..scene("stencil_of_4_samples", stencil_outline()) },
        Scene {
            width: conservative::SIZE[0],
            height: conservative::SIZE[1],
            ..scene("conservative", conservative::three_columns())
        },
        Scene {
            width: functions::SIZE[0],
            height: functions::SIZE[1],
            format: Format::Float,
            ..scene("noise_and_refraction", functions::functions())
        },
        Scene { format: Format::Srgb, ..scene("texture_filters", textures::filters()) },
        Scene { format: Format::Srgb, ..scene("texture_wraps", textures::wraps()) },
        Scene { format: Format::Srgb, ..scene("texture_kinds", textures::kinds()) },
        Scene { format: Format::Srgb, ..scene("texture_levels", textures::levels()) },
        Scene { format: Format::Srgb, ..scene("texture_checks", textures::checks()) },
        Scene { format: Format::Srgb, samples: Samples::Four, ..scene("textures_of_4_samples", textures::samples()) },
        Scene { format: Format::Srgb, ..scene("texture_formats", formats::sheet()) },
    ]
}

fn scene(name: &'static str, layers: Vec<Layer>) -> Scene {
    let clear = [0.0, 0.0, 0.0, 1.0];
    Scene {
        name,
        width: WIDTH,
        height: HEIGHT,
        format: Format::Linear,
        clear,
        clear_depth: 1.0,
        depth_bits: 32,
        samples: Samples::One,
        layers,
    }
}

/// A small picture, to be looked at enlarged.
fn small(name: &'static str, samples: Samples, layers: Vec<Layer>) -> Scene {
    Scene { width: 120, height: 90, format: Format::Srgb, samples, ..scene(name, layers) }
}

/// All ways in which fragments come to be shaded: clipped ones, those that are discarded, those that blend.
fn multisampled_mix() -> Vec<Layer> {
    let over = DrawState { blend: Blend::ALPHA, depth: DepthState { write: false, ..DepthState::default() }, ..RASTER };
    let veil = gouraud(soup(6, 40, 25.0, SIZE), over);
    near_plane().into_iter().chain(holes().into_iter().skip(1).take(1)).chain([veil]).collect()
}

fn gouraud(shape: Shape, state: DrawState) -> Layer {
    Layer { shape, look: Look::Gouraud(Gouraud { camera: IDENTITY }), state }
}

fn camera(eye: [f32; 3], target: [f32; 3]) -> Mat4 {
    Mat4::perspective(0.7, SIZE[0] / SIZE[1], 0.5, 50.0) * Mat4::look_at(eye, target, [0.0, 1.0, 0.0])
}

fn lit_knot(viewport: Option<Viewport>) -> Layer {
    let eye = [2.0, 3.0, 8.5];
    let look = BlinnPhong { camera: camera(eye, [0.0; 3]), eye, light: [0.36, 0.48, 0.8] };
    let state = DrawState { cull: Cull::Back, front_face: FrontFace::Clockwise, viewport, ..DrawState::default() };
    Layer { shape: knot(160, 24), look: Look::BlinnPhong(look), state }
}

/// A knot cut by eight planes: one sees what is inside.
fn cut_open() -> Layer {
    let look = CutOpen { camera: camera([2.0, 3.0, 8.5], [0.0; 3]), radius: 1.9 };
    let state = DrawState { front_face: FrontFace::Clockwise, ..DrawState::default() };
    Layer { shape: knot(160, 24), look: Look::CutOpen(look), state }
}

/// None of them begins or ends on a block of 4 x 4 pixels, two overlap, one hangs over the border.
fn four_viewports() -> Vec<Layer> {
    let rectangles =
        [[3.0, 5.0, 150.0, 90.0], [101.0, 61.0, 99.0, 99.0], [210.5, 3.25, 90.5, 60.0], [230.0, 120.0, 170.0, 130.0]];
    let viewport = |[x, y, width, height]: [f32; 4]| Viewport { x, y, width, height, min_depth: 0.1, max_depth: 0.9 };
    rectangles.into_iter().map(|rectangle| lit_knot(Some(viewport(rectangle)))).collect()
}

/// Red, green and blue, with the tutorial's own numbers in a picture of 512 x 512.
fn tutorial_triangle() -> Layer {
    let corners = [([491.407, 411.407], 0), ([148.593, 68.5928], 1), ([148.593, 411.407], 2)];
    let mut shape = Shape { indices: vec![0, 1, 2], ..Shape::default() };
    for ([x, y], channel) in corners {
        let mut color = [0.0, 0.0, 0.0, 1.0];
        color[channel] = 1.0;
        let position = [x * 0.6, y * 0.4, 0.5, 1.0];
        shape.vertices.push(crate::looks::Vertex { position, color, ..Default::default() });
    }
    gouraud(shape, RASTER)
}

/// A floor that goes on behind the eye, and a knot that stands in it.
fn near_plane() -> Vec<Layer> {
    let eye = [0.3, 1.2, 6.0];
    let camera = camera(eye, [0.0, 0.3, 0.0]);
    let floor = Layer { shape: ground(30.0, 24), look: Look::Gouraud(Gouraud { camera }), state: DrawState::default() };
    let look = BlinnPhong { camera: camera * Mat4::scale([0.4; 3]), eye, light: [0.36, 0.48, 0.8] };
    let state = DrawState { cull: Cull::Back, front_face: FrontFace::Clockwise, ..DrawState::default() };
    vec![floor, Layer { shape: knot(120, 16), look: Look::BlinnPhong(look), state }]
}

fn blended_layers() -> Vec<Layer> {
    let over = DrawState { blend: Blend::ALPHA, depth: DepthState { write: false, ..DepthState::default() }, ..RASTER };
    vec![
        gouraud(soup(5, 12, 60.0, SIZE), RASTER),
        gouraud(soup(6, 150, 25.0, SIZE), over),
        gouraud(soup(7, 12, 40.0, SIZE), RASTER),
        gouraud(soup(8, 60, 40.0, SIZE), DrawState { depth: DepthState::OFF, ..over }),
    ]
}

/// Colours from 0 to 8, seen through premultiplied ones.
fn brightness() -> Vec<Layer> {
    let bright = [[8.0, 0.0, 0.0, 1.0], [0.0, 4.0, 0.0, 1.0], [0.0, 0.0, 2.0, 1.0], [0.5, 0.5, 0.5, 0.0]];
    let over = DrawState { blend: Blend::PREMULTIPLIED, depth: DepthState::OFF, ..RASTER };
    vec![gouraud(rectangle([10.3, 9.7, 300.1, 190.9], 0.5, bright), RASTER), gouraud(soup(9, 80, 30.0, SIZE), over)]
}

fn comparisons(compares: &[Compare]) -> Vec<Layer> {
    let state = |compare| DrawState { depth: DepthState { compare, write: true }, ..RASTER };
    let layer = |(k, &compare): (usize, &Compare)| gouraud(soup(20 + k as u64, 60, 30.0, SIZE), state(compare));
    let wall = gouraud(soup(10, 20, 60.0, SIZE), state(Compare::Always));
    [wall].into_iter().chain(compares.iter().enumerate().map(layer)).collect()
}

fn stripes() -> Layer {
    let look = Look::Stripes(Stripes { camera: camera([3.0, 4.0, 5.0], [0.0, -0.5, 0.0]) });
    Layer { shape: ground(2.5, 3), look, state: DrawState::default() }
}

fn holes() -> Vec<Layer> {
    let camera = camera([3.0, 4.0, 5.0], [0.0, -0.5, 0.0]);
    let hole = |shape| Layer { shape, look: Look::Holes(Holes { camera }), state: DrawState::default() };
    vec![hole(ground(2.5, 1)), hole(knot(60, 12)), gouraud(soup(11, 10, 50.0, SIZE), RASTER)]
}

fn gradients() -> Vec<Layer> {
    let (black, white) = ([0.0, 0.0, 0.0, 1.0], [1.0; 4]);
    let ([r, g, b], clear) = ([[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0]], [0.0; 4]);
    let over = DrawState { blend: Blend::ALPHA, depth: DepthState::OFF, ..RASTER };
    vec![
        gouraud(rectangle([0.0, 0.0, 317.0, 60.0], 0.5, [black, white, white, black]), RASTER),
        gouraud(rectangle([0.0, 60.0, 317.0, 203.0], 0.5, [r, g, b, white]), RASTER),
        gouraud(rectangle([40.0, 20.0, 280.0, 180.0], 0.25, [white, clear, black, clear]), over),
    ]
}

/// Each factor of the source (down) with each of the target (across), added: warm colours over a gradient, alpha from left to right.
fn blend_factors() -> Vec<Layer> {
    let (dark, light) = ([0.05, 0.1, 0.3, 0.25], [0.3, 0.8, 0.9, 0.75]);
    let mut layers = vec![gouraud(rectangle([0.0, 0.0, 317.0, 203.0], 0.5, [dark, light, light, dark]), RASTER)];
    // Those that take a second source are another scene.
    let factors = &BlendFactor::ALL[..15];
    for (j, source) in factors.iter().copied().enumerate() {
        for (i, target) in factors.iter().copied().enumerate() {
            let component = BlendComponent { source, operation: BlendOperation::Add, target };
            let blend = Blend { constant: [0.9, 0.2, 0.5, 0.6], ..Blend::both(component) };
            layers.push(cell([i, j], [21.0, 13.4], DrawState { blend, depth: DepthState::OFF, ..RASTER }));
        }
    }
    layers
}

/// Each operation (down) with masks (across): all channels, colour, alpha, red, green, blue, none.
fn blend_operations() -> Vec<Layer> {
    let (dark, light) = ([0.1, 0.6, 0.3, 0.25], [0.9, 0.4, 0.5, 1.0]);
    let mut layers = vec![gouraud(rectangle([0.0, 0.0, 317.0, 203.0], 0.5, [light, light, dark, dark]), RASTER)];
    let none = ColorMask::NONE;
    let channels = [ColorMask { r: true, ..none }, ColorMask { g: true, ..none }, ColorMask { b: true, ..none }];
    let masks = [[ColorMask::ALL, ColorMask::COLOR, ColorMask::ALPHA].as_slice(), &channels, &[none]].concat();
    for (j, operation) in BlendOperation::ALL.into_iter().enumerate() {
        for (i, &color_mask) in masks.iter().enumerate() {
            let (source, target) = (BlendFactor::One, BlendFactor::One);
            let blend = Blend::both(BlendComponent { source, operation, target });
            let state = DrawState { blend, color_mask, depth: DepthState::OFF, ..RASTER };
            layers.push(cell([i, j], [45.0, 40.0], state));
        }
    }
    layers
}

/// A rectangle of a grid, a little smaller than its cell.
fn cell([i, j]: [usize; 2], [width, height]: [f32; 2], state: DrawState) -> Layer {
    let (x, y) = (i as f32 * width + 2.0, j as f32 * height + 1.5);
    let colors = [[0.9, 0.3, 0.1, 0.1], [0.9, 0.6, 0.2, 0.9], [0.4, 0.5, 0.1, 0.9], [0.5, 0.1, 0.0, 0.1]];
    gouraud(rectangle([x, y, x + width - 3.0, y + height - 2.5], 0.5, colors), state)
}

/// A knot through four scissor rectangles, one of which hangs over the border; beside it one upside down, whose front is its back, and
/// one in a viewport that is mostly elsewhere.
fn windows() -> Vec<Layer> {
    let scissors = [[7, 11, 60, 81], [70, 30, 51, 43], [69, 77, 40, 120], [-20, 101, 66, 500]];
    let scissored = scissors.map(|[x, y, width, height]| {
        let scissor = Some(Scissor { x, y, width: width as u32, height: height as u32 });
        let mut layer = lit_knot(Some(Viewport { width: 130.0, ..Viewport::whole(WIDTH, HEIGHT) }));
        layer.state.scissor = scissor;
        layer
    });
    let mut flipped =
        lit_knot(Some(Viewport { x: 130.0, y: 150.5, width: 100.0, height: -120.25, ..Viewport::whole(1, 1) }));
    flipped.state.front_face = FrontFace::CounterClockwise;
    let elsewhere =
        lit_knot(Some(Viewport { x: 180.0, y: -90.0, width: 400.0, height: 220.0, ..Viewport::whole(1, 1) }));
    scissored.into_iter().chain([flipped, elsewhere]).collect()
}

/// Tilted squares on a floor that they lie in: without a bias, with a constant one that is too small, with one by the slope, and with one away from the eye.
fn decals() -> Vec<Layer> {
    let camera = camera([1.0, 2.5, 7.0], [0.0, 0.0, 1.0]);
    let floor = Layer { shape: ground(6.0, 12), look: Look::Gouraud(Gouraud { camera }), state: DrawState::default() };
    let biases = [[0.0, 0.0], [-16.0, 0.0], [0.0, -1.0], [4.0, 4.0]];
    let decal = |(k, [constant, slope]): (usize, [f32; 2])| {
        let mut shape = ground(0.8, 9);
        for vertex in &mut shape.vertices {
            let [x, _, z, _] = vertex.position;
            vertex.position = [0.9 * x - 0.4 * z + k as f32 * 1.9 - 2.2, 0.0, 0.4 * x + 0.9 * z + 2.0, 1.0];
            vertex.color = [1.0, 0.6, 0.1, 1.0];
        }
        let state = DrawState { depth_bias: DepthBias { constant, slope, clamp: 0.0 }, ..DrawState::default() };
        Layer { shape, look: Look::Gouraud(Gouraud { camera }), state }
    };
    [floor].into_iter().chain(biases.into_iter().enumerate().map(decal)).collect()
}

/// A knot that sticks out of the view volume before the near and beyond the far plane: clipped on the left, clamped on the right.
fn clamped() -> Vec<Layer> {
    let half = |x: f32, depth_clamp: bool| {
        let mut layer = lit_knot(Some(Viewport { x, width: WIDTH as f32 / 2.0, ..Viewport::whole(WIDTH, HEIGHT) }));
        let eye = [2.0, 3.0, 8.5];
        let view =
            Mat4::perspective(0.7, SIZE[0] / 2.0 / SIZE[1], 8.0, 10.0) * Mat4::look_at(eye, [0.0; 3], [0.0, 1.0, 0.0]);
        layer.look = Look::BlinnPhong(BlinnPhong { camera: view, eye, light: [0.36, 0.48, 0.8] });
        layer.state.cull = Cull::None;
        layer.state.depth_clamp = depth_clamp;
        layer
    };
    vec![half(0.0, false), half(WIDTH as f32 / 2.0, true)]
}

/// Two planes that cross at so small an angle that a depth of 16 bits makes steps of the line between them; 1 is near.
fn steps() -> Vec<Layer> {
    let state = DrawState { depth: DepthState { compare: Compare::Greater, write: true }, ..RASTER };
    let plane = |color: [f32; 4], [left, right]: [f32; 2], [top, bottom]: [f32; 2]| {
        let mut shape = rectangle([4.0, 4.0, 313.0, 199.0], 0.0, [color; 4]);
        let depths = [left + top, right + top, right + bottom, left + bottom];
        shape.vertices.iter_mut().zip(depths).for_each(|(vertex, z)| vertex.position[2] = z);
        gouraud(shape, state)
    };
    vec![
        plane([0.9, 0.5, 0.1, 1.0], [0.5, 0.5003], [0.0, 0.0001]),
        plane([0.1, 0.4, 0.7, 1.0], [0.5003, 0.5], [0.0002, 0.0]),
        gouraud(
            soup(31, 40, 20.0, SIZE),
            DrawState { depth_bias: DepthBias { constant: -32_768.0, ..DepthBias::NONE }, ..state },
        ),
    ]
}

const UNTESTED: DrawState = DrawState { depth: DepthState::OFF, ..RASTER };

fn stenciled(face: StencilFace, state: DrawState) -> DrawState {
    DrawState { stencil: Some(StencilState::both(face)), ..state }
}

/// Stencil values as grey: seven values down, the eight operations across; the right half of each cell is a back face, whose operation
/// changes the lower four bits only.
fn stencil_operations() -> Vec<Layer> {
    let unseen = DrawState { color_mask: ColorMask::NONE, ..UNTESTED };
    let mut layers = Vec::new();
    for (j, reference) in [0, 1, 60, 85, 170, 254, 255].into_iter().enumerate() {
        let y = j as f32 * 29.0;
        let set = StencilFace { pass: StencilOperation::Replace, reference, ..StencilFace::IGNORE };
        layers.push(gouraud(rectangle([0.0, y, 317.0, y + 29.0], 0.5, [[0.0; 4]; 4]), stenciled(set, unseen)));
    }
    for (i, pass) in StencilOperation::ALL.into_iter().enumerate() {
        let front = StencilFace { pass, reference: 100, ..StencilFace::IGNORE };
        let back = StencilFace { write_mask: 0x0f, ..front };
        let stencil = Some(StencilState { front, back });
        let state = DrawState { stencil, front_face: FrontFace::Clockwise, ..unseen };
        for j in 0..7 {
            let (x, y) = (i as f32 * 39.0 + 6.0, j as f32 * 29.0 + 5.0);
            layers.push(gouraud(rectangle([x, y, x + 14.0, y + 19.0], 0.5, [[0.0; 4]; 4]), state));
            layers.push(gouraud(rectangle([x + 28.0, y, x + 14.0, y + 19.0], 0.5, [[0.0; 4]; 4]), state));
        }
    }
    for bit in 0..8 {
        let mask = 1 << bit;
        let test = StencilFace { compare: Compare::Equal, read_mask: mask, reference: mask, ..StencilFace::IGNORE };
        let light = f32::from(mask) / 255.0;
        let state = stenciled(test, DrawState { blend: Blend::ADD, ..UNTESTED });
        layers.push(gouraud(rectangle([0.0, 0.0, 317.0, 203.0], 0.5, [[light, light, light, 0.0]; 4]), state));
    }
    layers
}

/// A knot with an outline: marked as it is drawn, then drawn larger where there is no mark. The wall behind it lies in the shadow of a
/// box, by counting the faces of its shadow volume behind the wall (Carmack's reverse).
fn stencil_outline() -> Vec<Layer> {
    let mark =
        StencilFace { pass: StencilOperation::Replace, reference: 0x80, write_mask: 0x80, ..StencilFace::IGNORE };
    let unmarked = StencilFace { compare: Compare::Equal, read_mask: 0x80, ..StencilFace::IGNORE };
    let wall = rectangle(
        [0.0, 0.0, 317.0, 203.0],
        0.9999,
        [[0.8, 0.7, 0.4, 1.0], [0.6, 0.6, 0.5, 1.0], [0.3, 0.3, 0.3, 1.0], [0.5, 0.4, 0.3, 1.0]],
    );
    // A prism that goes through the wall: its front before it, its back behind it.
    let volume = |z: [f32; 2], state| {
        let mut shape = rectangle([170.0, 30.0, 300.0, 170.0], 0.0, [[0.0; 4]; 4]);
        shape.vertices.iter_mut().zip([z[0], z[0], z[1], z[1]]).for_each(|(vertex, z)| vertex.position[2] = z);
        gouraud(shape, state)
    };
    let unseen = DrawState {
        color_mask: ColorMask::NONE,
        depth: DepthState { write: false, ..DepthState::default() },
        ..RASTER
    };
    let count =
        |operation| stenciled(StencilFace { depth_fail: operation, write_mask: 0x7f, ..StencilFace::IGNORE }, unseen);
    let shadowed = StencilFace { compare: Compare::NotEqual, read_mask: 0x7f, ..StencilFace::IGNORE };
    let dark = DrawState { blend: Blend::MULTIPLY, ..UNTESTED };
    let mut knot = lit_knot(None);
    knot.state.stencil = Some(StencilState::both(mark));
    let mut outline = lit_knot(None);
    let eye = [2.0, 3.0, 8.5];
    outline.look = Look::Gouraud(Gouraud { camera: camera(eye, [0.0; 3]) });
    for vertex in &mut outline.shape.vertices {
        for k in 0..3 {
            vertex.position[k] += 0.12 * vertex.normal[k];
        }
        vertex.color = [1.0, 1.0, 1.0, 1.0];
    }
    outline.state.stencil = Some(StencilState::both(unmarked));
    vec![
        gouraud(wall, RASTER),
        volume([1.0, 1.0], count(StencilOperation::IncrementWrap)),
        volume([1.0, 0.9997], count(StencilOperation::DecrementWrap)),
        knot,
        outline,
        gouraud(rectangle([0.0, 0.0, 317.0, 203.0], 0.5, [[0.3, 0.3, 0.5, 1.0]; 4]), stenciled(shadowed, dark)),
    ]
}
