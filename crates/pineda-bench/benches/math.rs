//! The functions of shaders: each eight times for each packet of a picture of 512 x 512 pixels, with one thread.
//!
//! An element of the throughput is one function of one packet, sixteen numbers: criterion's `thrpt` in Melem/s is 1000 / ns. What drawing takes without any function
//! is `nothing`, which the others contain.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use pineda::{
    ColorBuffer, DrawState, Fragment, Indices, Lanes, Mesh, Pass, Real, Renderer, Rgba, Settings, Shader, Space,
    Target, Vec2, Vec3, Vec4, noise, shader,
};

const SIZE: u32 = 512;
const TIMES: u32 = 8;

/// The number of a function in [`NAMES`].
struct Function(usize);

macro_rules! functions {
    ($x:ident: $($name:literal = $value:expr;)+) => {
        const NAMES: &[&str] = &[$($name),+];

        #[shader]
        fn value<L: Lanes>(function: usize, $x: Real<L>) -> Real<L> {
            let mut number = 0;
            $(
                if function == number {
                    return $value;
                }
                number += 1;
            )+
            let _ = number;
            $x
        }
    };
}

functions! {
    x:
    "nothing" = x;
    "sqrt" = x.sqrt();
    "inverse_sqrt" = x.inverse_sqrt();
    "cbrt" = x.cbrt();
    "exp" = x.exp();
    "exp2" = x.exp2();
    "log" = x.log();
    "log2" = x.log2();
    "powf" = x.powf(2.2);
    "sin" = x.sin();
    "sin_of_huge" = (x * 1e9).sin();
    "tan" = x.tan();
    "asin" = x.asin();
    "atan" = x.atan();
    "atan2" = x.atan2(0.7 - x);
    "linear_to_srgb" = x.linear_to_srgb();
    "srgb_to_linear" = x.srgb_to_linear();
    "normalize" = Vec3::new(x, x + 1.0, 2.0 - x).normalize().dot([1.0, 2.0, 3.0]);
    "hash3" = noise::hash3([x.to_bits(), x.to_bits() + 1, x.to_bits() + 2])[0].to_unit();
    "gradient2" = noise::gradient2(Vec2::new(x * 9.0, x * 7.0), 0);
    "gradient3" = noise::gradient3(Vec3::new(x * 9.0, x * 7.0, x * 5.0), 0);
    "gradient3_with_slope" = noise::gradient3_with_slope(Vec3::new(x * 9.0, x * 7.0, x * 5.0), 0).1.dot([1.0, 2.0, 3.0]);
    "fbm3_of_5_octaves" = noise::fbm3(Vec3::new(x * 9.0, x * 7.0, x * 5.0), 5, 0);
}

#[shader]
impl Shader for Function {
    type Vertex = [f32; 2];
    type Varyings<L: Lanes> = ();

    fn vertex(&self, &[x, y]: &[f32; 2]) -> (Vec4, ()) {
        ([x, y, 0.5, 1.0].into(), ())
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let mut x = f.x() * (1.0 / SIZE as f32);
        let mut sum = f.y() * 0.0;
        let mut time = 0;
        while time < TIMES {
            sum += value(self.0, x);
            x = x * 0.99 + 0.003;
            time += 1;
        }
        Rgba::gray(sum)
    }
}

fn math(criterion: &mut Criterion) {
    let size = SIZE as f32;
    let corners = [[0.0, 0.0], [2.0 * size, 0.0], [0.0, 2.0 * size]];
    let state = DrawState { space: Space::Raster, ..DrawState::default() };
    let mut pixels = vec![[0.0; 4]; (SIZE * SIZE) as usize];
    let mut renderer =
        Renderer::new(Settings { threads: 1, ..Settings::default() }).expect("the default level is there");
    let mut group = criterion.benchmark_group("math");
    group.sample_size(20).throughput(Throughput::Elements(u64::from(SIZE * SIZE / 16 * TIMES)));
    for (number, name) in NAMES.iter().enumerate() {
        let shader = Function(number);
        let mut pass = Pass::new();
        pass.draw(&shader, Mesh { vertices: &corners, indices: Indices::Sequential }, state);
        group.bench_function(*name, |bencher| {
            bencher.iter(|| {
                let mut target = Target { color: ColorBuffer::Rgba32F(&mut pixels), ..Target::new(SIZE, SIZE) };
                renderer.render(&pass, &mut target).expect("the scene is valid")
            });
        });
    }
    group.finish();
}

criterion_group!(benches, math);
criterion_main!(benches);
