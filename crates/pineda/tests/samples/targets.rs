//! Several colour buffers at once, of any formats: what is loaded, cleared, drawn, blended, masked and stored, against a pixel-by-pixel reference.

use crate::blending::random_blend;
use crate::common::{HEIGHT, PIXELS, WIDTH, channel, second_of, settings};
use crate::formats::{Encoding, FLOATS, Picture, Value};
use pineda::*;
use pineda_oracle::cases::Random;

varyings! {
    struct Given {
        #[flat]
        color: Rgba,
        number: RgbaU,
    }
}

outputs! {
    struct Eight {
        a: Rgba,
        b: RgbaU,
        c: Real,
        d: RgbaI,
        e: Vec2,
        f: Uint,
        g: Vec3,
        h: Int,
    }
}

/// A fragment's colour, and integers of any bits.
type Pixel = ([f32; 4], [u32; 4]);

/// Shaders that make several things of a pixel's colour and integers.
macro_rules! shaders {
    ($($name:ident $holes:ident: |$f:ident| -> $output:ty $do:block)+) => {$(
        struct $name;

        #[shader]
        impl Shader for $name {
            type Vertex = ([f32; 2], Pixel);
            type Varyings<L: Lanes> = Given<L>;
            fn vertex(&self, &([x, y], (color, number)): &Self::Vertex) -> (Vec4, Given) {
                ([x, y, 0.0, 1.0].into(), Given { color: color.into(), number: number.into() })
            }
            fn fragment<L: Lanes>(&self, $f: &mut Fragment<L, Self>) -> $output $do
        }

        struct $holes;

        #[shader]
        impl Shader for $holes {
            type Vertex = ([f32; 2], Pixel);
            type Varyings<L: Lanes> = Given<L>;
            const DISCARDS: bool = true;
            fn vertex(&self, vertex: &Self::Vertex) -> (Vec4, Given) {
                $name.vertex(vertex)
            }
            fn fragment<L: Lanes>(&self, $f: &mut Fragment<L, Self>) -> $output {
                $f.discard($f.color.a.lt(0.25));
                $do
            }
        }
    )+};
}

shaders! {
    Single SingleHoles: |f| -> DualSource<L> {
        let Rgba { r, g, b, a } = f.color;
        DualSource { color: f.color, factor: Rgba { r: a - 0.25, g: r, b: g * 0.5, a: b } }
    }
    Integers IntegersHoles: |f| -> RgbaU<L> {
        f.number
    }
    Pair PairHoles: |f| -> (Rgba<L>, RgbaU<L>) {
        (f.color, f.number)
    }
    Three ThreeHoles: |f| -> [Rgba<L>; 3] {
        let Rgba { r, g, b, a } = f.color;
        [f.color, Rgba { r: a, g: r, b: g, a: b }, Rgba { r: b, g: a, b: r, a: g }]
    }
    All AllHoles: |f| -> Eight<L> {
        let (color, number) = (f.color, f.number);
        Eight {
            a: color,
            b: number,
            c: color.g,
            d: RgbaI { r: number.b.to_int(), g: number.a.to_int(), b: number.g.to_int(), a: number.r.to_int() },
            e: Vec2 { x: color.b, y: color.a },
            f: number.g,
            g: Vec3 { x: color.a, y: color.r, z: color.g },
            h: (number.b ^ number.a).to_int(),
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Look {
    Single,
    Integers,
    Pair,
    Three,
    All,
}

impl Look {
    const ALL: [Self; 5] = [Self::Single, Self::Integers, Self::Pair, Self::Three, Self::All];

    fn kinds(self) -> Vec<OutputKind> {
        use OutputKind::{Float, Int, Uint};
        match self {
            Self::Single => vec![Float],
            Self::Integers => vec![Uint],
            Self::Pair => vec![Float, Uint],
            Self::Three => vec![Float; 3],
            Self::All => vec![Float, Uint, Float, Int, Float, Uint, Float, Int],
        }
    }

    fn values(self, ([r, g, b, a], n): Pixel) -> Vec<Value> {
        use Value::{Bits, Floats};
        match self {
            Self::Single => vec![Floats([r, g, b, a])],
            Self::Integers => vec![Bits(n)],
            Self::Pair => vec![Floats([r, g, b, a]), Bits(n)],
            Self::Three => vec![Floats([r, g, b, a]), Floats([a, r, g, b]), Floats([b, a, r, g])],
            Self::All => vec![
                Floats([r, g, b, a]),
                Bits(n),
                Floats([g, 0.0, 0.0, 1.0]),
                Bits([n[2], n[3], n[1], n[0]]),
                Floats([b, a, 0.0, 1.0]),
                Bits([n[1], 0, 0, 1]),
                Floats([a, r, g, 1.0]),
                Bits([n[2] ^ n[3], 0, 0, 1]),
            ],
        }
    }
}

/// A fragment for every pixel, as one triangle each.
struct Layer {
    look: Look,
    discards: bool,
    state: DrawState,
    pixels: Vec<Pixel>,
    vertices: Vec<([f32; 2], Pixel)>,
}

impl Layer {
    fn random(random: &mut Random, look: Look) -> Self {
        let pixels: Vec<Pixel> =
            (0..PIXELS).map(|_| ([0; 4].map(|_| channel(random)), [0; 4].map(|_| random.bits() as u32))).collect();
        let mut vertices = Vec::new();
        for (at, &pixel) in pixels.iter().enumerate() {
            let (x, y) = ((at % WIDTH as usize) as f32, (at / WIDTH as usize) as f32);
            vertices.extend([([x - 0.5, y], pixel), ([x + 1.5, y], pixel), ([x + 0.5, y + 1.0], pixel)]);
        }
        let depth = DepthState { compare: Compare::Always, write: random.one_in(2) };
        let mut state = DrawState { space: Space::Raster, depth, ..DrawState::default() };
        (state.blend, state.color_mask) = (blend(random, look), mask(random));
        for (k, kind) in look.kinds().into_iter().enumerate() {
            let is_wrong = kind != OutputKind::Float && state.blend != Blend::OPAQUE;
            if is_wrong || random.one_in(3) {
                let blend = if kind == OutputKind::Float { blend(random, look) } else { Blend::OPAQUE };
                state.colors[k] = Some(ColorState { blend, mask: mask(random) });
            }
        }
        Self { look, discards: random.one_in(3), state, pixels, vertices }
    }

    fn draw<'a>(&'a self, pass: &mut Pass<'a>) {
        let (mesh, state) = (Mesh { vertices: &self.vertices, indices: Indices::Sequential }, self.state);
        match (self.look, self.discards) {
            (Look::Single, false) => pass.draw(&Single, mesh, state),
            (Look::Single, true) => pass.draw(&SingleHoles, mesh, state),
            (Look::Integers, false) => pass.draw(&Integers, mesh, state),
            (Look::Integers, true) => pass.draw(&IntegersHoles, mesh, state),
            (Look::Pair, false) => pass.draw(&Pair, mesh, state),
            (Look::Pair, true) => pass.draw(&PairHoles, mesh, state),
            (Look::Three, false) => pass.draw(&Three, mesh, state),
            (Look::Three, true) => pass.draw(&ThreeHoles, mesh, state),
            (Look::All, false) => pass.draw(&All, mesh, state),
            (Look::All, true) => pass.draw(&AllHoles, mesh, state),
        };
    }

    /// The same, pixel by pixel.
    fn refer(&self, pictures: &mut [Option<Picture>]) {
        for (at, &(color, number)) in self.pixels.iter().enumerate() {
            if self.discards && color[3] < 0.25 {
                continue;
            }
            for (k, value) in self.look.values((color, number)).into_iter().enumerate() {
                let common = ColorState { blend: self.state.blend, mask: self.state.color_mask };
                if let Some(picture) = &mut pictures[k] {
                    picture.draw(at, value, second_of(color), &self.state.colors[k].unwrap_or(common));
                }
            }
        }
    }
}

fn mask(random: &mut Random) -> ColorMask {
    let [r, g, b, a] = [0; 4].map(|_| random.one_in(2));
    random.pick(&[ColorMask::ALL, ColorMask::ALL, ColorMask::NONE, ColorMask::COLOR, ColorMask { r, g, b, a }])
}

fn blend(random: &mut Random, look: Look) -> Blend {
    use BlendFactor::{OneMinusSource1, OneMinusSource1Alpha, Source1, Source1Alpha};
    if random.one_in(2) {
        return random.pick(&[Blend::OPAQUE, Blend::OPAQUE, Blend::ALPHA, Blend::ADD, Blend::MIN, Blend::MULTIPLY]);
    }
    let mut blend = random_blend(random);
    if look != Look::Single {
        for component in [&mut blend.color, &mut blend.alpha] {
            for factor in [&mut component.source, &mut component.target] {
                if [Source1, OneMinusSource1, Source1Alpha, OneMinusSource1Alpha].contains(factor) {
                    *factor = BlendFactor::SourceAlpha;
                }
            }
        }
    }
    blend
}

/// A pass's settings and layers.
struct Part {
    clear_color: Option<[f32; 4]>,
    ops: [ColorOps; MAX_COLORS],
    layers: Vec<Layer>,
}

impl Part {
    fn random(random: &mut Random, look: Look) -> Self {
        let mut ops = [ColorOps::default(); MAX_COLORS];
        for (op, kind) in ops.iter_mut().zip(look.kinds()) {
            let clear = match kind {
                OutputKind::Float => [0; 4].map(|_| channel(random)).into(),
                OutputKind::Uint => [0; 4].map(|_| random.bits() as u32).into(),
                OutputKind::Int => [0; 4].map(|_| random.bits() as i32).into(),
            };
            op.load = random.pick(&[Load::ByPass, Load::Keep, Load::Clear(clear)]);
            op.store = if random.one_in(6) { Store::Discard } else { Store::Keep };
        }
        let clear_color = random.one_in(2).then(|| [0; 4].map(|_| channel(random)));
        let layers = (0..random.between(0, 3)).map(|_| Layer::random(random, look)).collect();
        Self { clear_color, ops, layers }
    }

    fn draw(&self, renderer: &mut Renderer, pictures: &mut [Option<Picture>]) -> Statistics {
        let mut pass = Pass::new();
        (pass.clear_color, pass.color_ops) = (self.clear_color, self.ops);
        self.layers.iter().for_each(|layer| layer.draw(&mut pass));
        let mut buffers = pictures.iter_mut().map(|p| p.as_mut().map_or(ColorBuffer::None, Picture::buffer));
        let color = buffers.next().expect("a first one");
        let mut target = Target { color, more_colors: buffers.collect(), ..Target::new(WIDTH, HEIGHT) };
        renderer.render(&pass, &mut target).expect("valid")
    }

    fn refer(&self, pictures: &mut [Option<Picture>]) {
        let before = pictures.to_vec();
        for (picture, op) in pictures.iter_mut().zip(&self.ops) {
            let clear = match op.load {
                Load::ByPass => self.clear_color.map(ClearColor::Float),
                Load::Keep => None,
                Load::Clear(color) => Some(color),
            };
            if let (Some(picture), Some(color)) = (picture, clear) {
                picture.clear(color);
            }
        }
        self.layers.iter().for_each(|layer| layer.refer(pictures));
        for ((picture, before), op) in pictures.iter_mut().zip(before).zip(&self.ops) {
            if op.store == Store::Discard {
                *picture = before;
            }
        }
    }
}

fn random_pictures(random: &mut Random, look: Look) -> Vec<Option<Picture>> {
    let picture = |kind| {
        let encoding = match kind {
            OutputKind::Float => random.pick(&FLOATS),
            OutputKind::Uint => Encoding::Uint,
            OutputKind::Int => Encoding::Int,
        };
        let channels = random.pick(&[1, 2, 4]);
        (look == Look::Single || !random.one_in(8)).then(|| Picture::random(random, (encoding, channels)))
    };
    look.kinds().into_iter().map(picture).collect()
}

fn check(seed: u64, look: Look, start: &[Option<Picture>], parts: &[Part], memory: usize) {
    let mut wanted = start.to_vec();
    parts.iter().for_each(|part| part.refer(&mut wanted));
    for settings in settings(seed) {
        let settings = Settings { memory, ..settings };
        let mut found = start.to_vec();
        let mut renderer = Renderer::new(settings.clone()).expect("available");
        for part in parts {
            let statistics = part.draw(&mut renderer, &mut found);
            assert!(memory > 0 || statistics.flushes > 1, "{statistics:?}");
        }
        for (k, (found, wanted)) in found.iter().zip(&wanted).enumerate() {
            let (Some(found), Some(wanted)) = (found, wanted) else { continue };
            for at in 0..PIXELS {
                let states: Vec<_> =
                    parts.iter().flat_map(|part| &part.layers).map(|layer| (layer.pixels[at], layer.state)).collect();
                assert!(
                    found.codes(at) == wanted.codes(at),
                    "scene {seed}, {look:?}, buffer {k}: {:?}, pixel {at}: {:x?} instead of {:x?}, {settings:?}, {states:?}",
                    found.format,
                    found.codes(at),
                    wanted.codes(at),
                );
            }
        }
    }
}

#[test]
fn passes_of_any_states_on_buffers_of_any_formats() {
    for seed in 0..500 {
        let mut random = Random::new(seed);
        let look = Look::ALL[(seed % 5) as usize];
        let start = random_pictures(&mut random, look);
        let parts: Vec<Part> = (0..random.between(1, 2)).map(|_| Part::random(&mut random, look)).collect();
        check(seed, look, &start, &parts, 512 << 20);
    }
}

#[test]
fn several_flushes_are_one_pass() {
    for seed in 0..10 {
        let mut random = Random::new(!seed);
        let look = Look::ALL[(seed % 5) as usize];
        let start = random_pictures(&mut random, look);
        let mut part = Part::random(&mut random, look);
        part.layers = (0..12).map(|_| Layer::random(&mut random, look)).collect();
        check(seed, look, &start, &[part], 0);
    }
}

#[test]
fn a_second_source_goes_to_no_buffer() {
    let corners = [[-9.0, -9.0], [99.0, -9.0], [-9.0, 99.0]];
    for blend in [Blend::OPAQUE, Blend::ADD] {
        let mut state = DrawState { space: Space::Raster, blend, ..DrawState::default() };
        state.colors[1] = Some(ColorState { mask: ColorMask::NONE, ..ColorState::default() });
        let mut pass = Pass::new();
        pass.color_ops[1].load = Load::Keep;
        pass.draw_with(
            Mesh { vertices: &corners, indices: Indices::Sequential },
            state,
            |&[x, y]| (Vec4::from([x, y, 0.0, 1.0]), ()),
            |f| DualSource { color: Rgba::gray(f.splat(1.0)), factor: Rgba::gray(f.splat(2.0)) },
        );
        let (mut colors, mut numbers) = ([[0; 4]; 16], [7; 16]);
        let (color, more_colors) = (ColorBuffer::Rgba8(&mut colors), vec![ColorBuffer::R32U(&mut numbers)]);
        let mut renderer = Renderer::new(Settings::default()).expect("the best level");
        renderer.render(&pass, &mut Target { color, more_colors, ..Target::new(4, 4) }).expect("valid");
        assert_eq!((colors, numbers), ([[255; 4]; 16], [7; 16]));
    }
}
