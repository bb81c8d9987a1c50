//! Depths that the fragment stage writes, against scalar references: clamped, rounded, compared and stored one after the other.

use crate::common::{HEIGHT, PIXELS, WIDTH, passes, settings};
use crate::depths::{Depths, Format};
use pineda::*;
use pineda_oracle::cases::Random;

varyings! {
    struct Written {
        #[flat]
        color: Rgba,
        #[flat]
        depth: Real,
        /// Whether the depth is written at all.
        #[flat]
        writes: Real,
    }
}

/// A point for each pixel, which covers it whole: its colour, the depth that it writes, and whether it does.
struct Points;

/// The same, without fragments whose alpha is below 1/4.
struct PointsWithHoles;

type Point = ([f32; 2], [f32; 4], Option<f32>);

/// The depth of all points themselves.
const OWN: f32 = 0.375;

macro_rules! points {
    ($shader:ident, $discards:literal, |$f:ident| {$($first:stmt;)?}) => {
        #[shader]
        impl Shader for $shader {
            type Vertex = Point;
            type Varyings<L: Lanes> = Written<L>;
            const DISCARDS: bool = $discards;
            const WRITES_DEPTH: bool = true;
            fn vertex(&self, &([x, y], color, depth): &Point) -> (Vec4, Written) {
                let writes = if depth.is_some() { 1.0 } else { 0.0 };
                let depth = depth.unwrap_or_default().into();
                (Vec4::from([x, y, OWN, 1.0]), Written { color: color.into(), depth, writes: Real::from(writes) })
            }
            fn fragment<L: Lanes>(&self, $f: &mut Fragment<L, Self>) -> Rgba<L> {
                $($first;)?
                // As a shader does that writes in a branch.
                let own = $f.z();
                $f.set_depth($f.writes.gt(0.5).select($f.depth, own));
                $f.color
            }
        }
    };
}

points!(Points, false, |f| {});
points!(PointsWithHoles, true, |f| {
    f.discard(f.color.a.lt(0.25));
});

#[derive(Debug)]
struct Layer {
    points: Vec<Point>,
    state: DrawState,
    discards: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Pixel {
    color: [f32; 4],
    depth: u32,
    stencil: u8,
    draw: u32,
}

impl Pixel {
    /// One fragment more. Whether it passed.
    fn draw(&mut self, format: Format, draw: usize, layer: &Layer, at: usize) -> bool {
        let (state, (_, color, written)) = (&layer.state, layer.points[at]);
        if layer.discards && color[3] < 0.25 {
            return false;
        }
        let viewport = state.viewport.unwrap_or(Viewport::whole(WIDTH, HEIGHT));
        let [a, b] = [viewport.min_depth, viewport.max_depth];
        let own = OWN * (b - a) + a;
        let (low, high) = (a.min(b), a.max(b));
        let z = written.unwrap_or(own);
        let z = if z > low { z.min(high) } else { low };
        let z = format.stored(z);
        let depth_passes = passes(state.depth.compare, z, self.depth);
        let mut all_pass = depth_passes;
        if let Some(StencilState { front, .. }) = state.stencil {
            let stencil_passes = passes(front.compare, front.reference, self.stencil);
            let operation = match (stencil_passes, depth_passes) {
                (false, _) => front.fail,
                (true, false) => front.depth_fail,
                (true, true) => front.pass,
            };
            self.stencil = match operation {
                StencilOperation::Keep => self.stencil,
                StencilOperation::Replace => front.reference,
                StencilOperation::Invert => !self.stencil,
                _ => self.stencil.wrapping_add(1),
            };
            all_pass &= stencil_passes;
        }
        if all_pass {
            self.draw = draw as u32;
            if state.depth.write {
                self.depth = z;
            }
            if state.color_mask == ColorMask::ALL {
                let sum = [0, 1, 2, 3].map(|k| self.color[k] + color[k]);
                self.color = if state.blend == Blend::ADD { sum } else { color };
            }
        }
        all_pass
    }
}

fn written(random: &mut Random) -> Option<f32> {
    match random.between(0, 6) {
        0 => None,
        1 => Some(random.pick(&[0.0, -0.0, 1.0, -1.0, 2.0, f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY])),
        2 | 3 => Some(random.between(0, 8) as f32 / 8.0),
        4 => Some(OWN),
        _ => Some(random.real(-0.25, 1.25)),
    }
}

fn random_layer(random: &mut Random) -> Layer {
    let (min_depth, max_depth) = random.pick(&[(0.0, 1.0), (0.0, 1.0), (0.25, 0.75), (1.0, 0.0), (0.5, 0.5)]);
    let face = StencilFace {
        compare: random.pick(&Compare::ALL),
        fail: random.pick(&[StencilOperation::Keep, StencilOperation::Invert]),
        depth_fail: random.pick(&[StencilOperation::Keep, StencilOperation::IncrementWrap]),
        pass: random.pick(&[StencilOperation::Keep, StencilOperation::Replace]),
        reference: random.pick(&[0, 1, 255]),
        ..StencilFace::IGNORE
    };
    let state = DrawState {
        space: Space::Raster,
        topology: PrimitiveTopology::PointList,
        depth: DepthState { compare: random.pick(&Compare::ALL), write: !random.one_in(4) },
        // Never added to what is written.
        depth_bias: DepthBias { constant: 0.0, slope: random.pick(&[0.0, 1000.0]), clamp: 0.0 },
        stencil: random.one_in(2).then(|| StencilState::both(face)),
        blend: random.pick(&[Blend::OPAQUE, Blend::ADD]),
        color_mask: random.pick(&[ColorMask::ALL, ColorMask::ALL, ColorMask::NONE]),
        sampling: random.pick(&[Sampling::Centroid, Sampling::Center, Sampling::Sample]),
        viewport: Some(Viewport { min_depth, max_depth, ..Viewport::whole(WIDTH, HEIGHT) }),
        ..DrawState::default()
    };
    let point = |at: usize| {
        let place = [(at % WIDTH as usize) as f32 + 0.5, (at / WIDTH as usize) as f32 + 0.5];
        (place, [1.0, 0.5, 0.0, random.unit()], written(random))
    };
    let points = (0..PIXELS).map(point).collect();
    Layer { points, state, discards: random.one_in(3) }
}

/// Every comparison, format, range and stencil operation; numbers that are none and such that lie out of range; one sample or four, of which each has the fragment's depth.
#[test]
fn written_depths_are_clamped_rounded_and_compared_as_they_are_stored() {
    for seed in 0..if cfg!(debug_assertions) { 150 } else { 400 } {
        let mut random = Random::new(seed);
        let layers: Vec<Layer> = (0..random.between(1, 4)).map(|_| random_layer(&mut random)).collect();
        let format = random.pick(&Format::ALL);
        let samples = random.pick(&[Samples::One, Samples::Four]);
        let (clear, count) = (random.pick(&[0.0f32, 0.5, 1.0]), samples.count());
        let mut passed = vec![0; layers.len()];
        let wanted: Vec<Pixel> = (0..PIXELS)
            .map(|at| {
                let mut pixel = Pixel { color: [0.0; 4], depth: format.stored(clear), stencil: 0, draw: NO_ID };
                for (draw, layer) in layers.iter().enumerate() {
                    passed[draw] += count as u64 * u64::from(pixel.draw(format, draw, layer, at));
                }
                pixel
            })
            .collect();
        for (n, settings) in settings(seed).enumerate() {
            let settings = Settings { memory: if n % 2 == 0 { 0 } else { 1 << 29 }, ..settings };
            let mut pass = Pass::new();
            pass.clear_depth = Some(clear);
            for Layer { points, state, discards } in &layers {
                let mesh = Mesh { vertices: &points[..], indices: Indices::Sequential };
                if *discards {
                    pass.draw(&PointsWithHoles, mesh, *state);
                } else {
                    pass.draw(&Points, mesh, *state);
                }
            }
            let all = PIXELS * count;
            let (mut color, mut stencil, mut ids) = (vec![[9.0; 4]; all], vec![9; all], vec![0; all]);
            let mut depths = Depths::zeros(format, all);
            let mut renderer = Renderer::new(settings.clone()).expect("available");
            for counts in [true, false] {
                let mut target = Target {
                    samples,
                    color: ColorBuffer::Rgba32F(&mut color),
                    depth: depths.buffer(),
                    stencil: Some(&mut stencil),
                    draw_ids: Some(&mut ids),
                    ..Target::new(WIDTH, HEIGHT)
                };
                if counts {
                    let draws = renderer.render_counted(&pass, &mut target).expect("valid");
                    let found: Vec<u64> = draws.iter().map(|draw| draw.samples_passed).collect();
                    assert_eq!(found, passed, "scene {seed}, {settings:?}");
                } else {
                    renderer.render(&pass, &mut target).expect("valid");
                }
                for at in 0..all {
                    let depth = depths.get(at);
                    let found = Pixel { color: color[at], depth, stencil: stencil[at], draw: ids[at] };
                    let wanted = wanted[at % PIXELS];
                    assert_eq!(
                        found,
                        wanted,
                        "scene {seed}, {samples:?}, pixel {at}, {format:?}, {settings:?}, {:#?}",
                        layers
                            .iter()
                            .map(|layer| (layer.state, layer.points[at % PIXELS], layer.discards))
                            .collect::<Vec<_>>()
                    );
                }
            }
        }
    }
}

/// A ball: its middle and its radius, in pixels; and a shade.
type Ball = ([f32; 3], f32, f32);

/// Balls on squares, seen along z; `DEEP` is what lies between the depths 0 and 1.
struct Balls {
    is_reversed: bool,
}

const DEEP: f32 = 64.0;

varyings! {
    struct OfBall {
        #[flat]
        middle: Vec3,
        #[flat]
        radius: Real,
        #[flat]
        shade: Real,
    }
}

#[shader]
impl Shader for Balls {
    type Vertex = Instanced<[f32; 2], Ball>;
    type Varyings<L: Lanes> = OfBall<L>;
    const DISCARDS: bool = true;
    const WRITES_DEPTH: bool = true;
    fn vertex(&self, v: &Self::Vertex) -> (Vec4, OfBall) {
        let ([u, v], (middle, radius, shade)) = (v.vertex, v.instance);
        let corner = Vec4::from([middle[0] + u * radius, middle[1] + v * radius, 0.5, 1.0]);
        (corner, OfBall { middle: middle.into(), radius: radius.into(), shade: shade.into() })
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let (x, y) = (f.x() - f.middle.x, f.y() - f.middle.y);
        let height2 = f.radius * f.radius - x * x - y * y;
        f.discard(height2.lt(0.0));
        let z = (f.middle.z - height2.sqrt()) / DEEP;
        f.set_depth(if self.is_reversed { 1.0 - z } else { z });
        Rgba { r: f.shade, g: height2, b: f.splat(0.0), a: f.splat(1.0) }
    }
}

/// The ball that a place shows, and how deep; by trying all of them, in f32 as the shader does.
fn nearest(balls: &[Ball], place: [f32; 2], is_reversed: bool, format: Format) -> ([f32; 4], u32) {
    let mut shown = ([0.0; 4], format.stored(if is_reversed { 0.0 } else { 1.0 }));
    for &([mx, my, mz], radius, shade) in balls {
        let [x, y] = [place[0] - mx, place[1] - my];
        let in_square = x >= -radius && x < radius && y >= -radius && y < radius;
        let height2 = radius * radius - x * x - y * y;
        if !in_square || height2 < 0.0 {
            continue;
        }
        let z = (mz - height2.sqrt()) / DEEP;
        let z = format.stored(if is_reversed { 1.0 - z } else { z }.clamp(0.0, 1.0));
        if if is_reversed { z > shown.1 } else { z < shown.1 } {
            shown = ([shade, height2, 0.0, 1.0], z);
        }
    }
    shown
}

/// Balls that pass through each other show what a search through all of them says: near 0 or near 1, in every format, a pixel at a time or a sample.
#[test]
fn ray_cast_balls_cut_each_other_where_balls_do() {
    const SIZE: u32 = 64;
    let square = [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]];
    for seed in 0..if cfg!(debug_assertions) { 12 } else { 24 } {
        let mut random = Random::new(seed);
        let mut place = |low: i64, high: i64| random.between(low, high) as f32;
        // Their squares' borders lie between pixels, so that all samples of a pixel are covered or none.
        let ball = |k: i32| ([place(0, 64), place(0, 64), place(-40, 640) / 10.0], place(3, 20), k as f32);
        let balls: Vec<Ball> = (1..14).map(ball).collect();
        let format = Format::ALL[seed as usize % 3];
        let is_reversed = seed / 3 % 2 == 1;
        let samples = [Samples::One, Samples::Four, Samples::Eight][random.between(0, 2) as usize];
        let sampling = random.pick(&[Sampling::Centroid, Sampling::Sample]);
        let shader = Balls { is_reversed };
        let compare = if is_reversed { Compare::Greater } else { Compare::Less };
        let state = DrawState {
            space: Space::Raster,
            topology: PrimitiveTopology::TriangleStrip,
            depth: DepthState { compare, write: true },
            sampling,
            ..DrawState::default()
        };
        let mut pass = Pass::new();
        pass.clear_depth = Some(if is_reversed { 0.0 } else { 1.0 });
        let mesh = Mesh { vertices: &square, indices: Indices::Sequential };
        pass.draw_instanced(&shader, mesh, &balls, state);
        let all = (SIZE * SIZE) as usize * samples.count();
        for settings in settings(seed) {
            let mut color = vec![[0.0; 4]; all];
            let mut depths = Depths::zeros(format, all);
            let mut target = Target {
                samples,
                color: ColorBuffer::Rgba32F(&mut color),
                depth: depths.buffer(),
                ..Target::new(SIZE, SIZE)
            };
            Renderer::new(settings.clone()).expect("available").render(&pass, &mut target).expect("valid");
            for (at, color) in color.iter().enumerate() {
                let (sample, pixel) = (at / (SIZE * SIZE) as usize, at % (SIZE * SIZE) as usize);
                let corner = [pixel % SIZE as usize, pixel / SIZE as usize];
                let offset = if sampling == Sampling::Sample { samples.positions()[sample] } else { [8, 8] };
                let place = [0, 1].map(|k| corner[k] as f32 + f32::from(offset[k]) / 16.0);
                let depth = depths.get(at);
                let wanted = nearest(&balls, place, is_reversed, format);
                let say = || {
                    format!(
                        "seed {seed}, {settings:?}, {samples:?}, {sampling:?}, {format:?}, sample {sample} at {place:?}"
                    )
                };
                assert_eq!((*color, depth), wanted, "{}", say());
            }
        }
    }
}
