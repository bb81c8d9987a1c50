//! What a fragment stage is told: derivatives, flat varyings, facing, its own place.

use pineda::*;
use pineda_oracle::cases::{Case, Family, Random, orders};
use pineda_oracle::{Rational, Triangle, barycentrics, error, interpolate};
use pineda_proof::{ProbeVertex, Renderers};

varyings! {
    struct Told {
        smooth: Real,
        #[noperspective]
        linear: Real,
        #[flat]
        flat: Real,
    }
}

/// Shows one group of what it is told.
struct Tell {
    show: Show,
}

#[derive(Clone, Copy, PartialEq)]
enum Show {
    /// The smooth varying's and the linear one's derivatives, right and down each.
    Derivatives,
    /// The flat varying, whether the front is seen, the flat varying's derivatives (their sum).
    Flat,
    /// The pixel's centre, and depth.
    Place,
}

#[shader]
impl Shader for Tell {
    type Vertex = ProbeVertex;
    type Varyings<L: Lanes> = Told<L>;
    const DERIVATIVES: bool = true;
    fn vertex(&self, v: &ProbeVertex) -> (Vec4, Told) {
        let number = |x: f32| Real::new(Scalar, x);
        let told = Told { smooth: number(v.smooth[0]), linear: number(v.linear[0]), flat: number(v.smooth[1]) };
        (v.position.into(), told)
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let zero = f.splat(0.0);
        match self.show {
            Show::Derivatives => {
                let (dx, dy) = (*f.dx(), *f.dy());
                Rgba { r: dx.smooth, g: dy.smooth, b: dx.linear, a: dy.linear }
            }
            Show::Flat => {
                let front = f.front_facing().select(f.splat(1.0), zero);
                Rgba { r: f.flat, g: front, b: f.dx().flat + f.dy().flat, a: zero }
            }
            Show::Place => Rgba { r: f.x(), g: f.y(), b: f.z(), a: zero },
        }
    }
}

struct Shown {
    color: Vec<[f32; 4]>,
    depth: Vec<f32>,
    ids: Vec<u32>,
}

fn drawn(renderer: &mut Renderer, show: Show, vertices: &[ProbeVertex], indices: &[u32], size: [u32; 2]) -> Shown {
    let shader = Tell { show };
    let mut pass = Pass::new();
    let state = DrawState { space: Space::Raster, ..DrawState::default() };
    pass.draw(&shader, Mesh { vertices, indices: Indices::U32(indices) }, state);
    let pixels = (size[0] * size[1]) as usize;
    let mut shown = Shown { color: vec![[0.0; 4]; pixels], depth: vec![0.0; pixels], ids: vec![0; pixels] };
    let mut target = Target {
        color: ColorBuffer::Rgba32F(&mut shown.color),
        depth: DepthBuffer::D32F(&mut shown.depth),
        triangle_ids: Some(&mut shown.ids),
        ..Target::new(size[0], size[1])
    };
    renderer.render(&pass, &mut target).expect("valid");
    shown
}

/// Soups of the oracle's, with attributes.
fn soups(count: u64) -> impl Iterator<Item = (Case, Vec<ProbeVertex>, Random)> {
    (0..count).map(|n| {
        let case = Case::of_family(if n % 2 == 0 { Family::Soup } else { Family::Tiny }, n);
        let mut random = Random::new(n);
        let vertices = case.vertices.iter().map(|&position| ProbeVertex {
            position,
            smooth: [random.real(-1.0, 1.0), random.real(-1.0, 1.0)],
            linear: [random.real(-1.0, 1.0); 2],
        });
        (case.clone(), vertices.collect(), random)
    })
}

/// 2^-24.
const U: f64 = 1.0 / 16_777_216.0;

/// With D = sum(E_i / w_i) and N = sum(f_i E_i / w_i), f = N / D and f' = (N' - f D') / D. Each term of these sums has at most a dozen roundings behind
/// it; their sizes, without signs, are what an error is measured by.
const ROUNDINGS: f64 = 40.0;

#[test]
fn derivatives_are_those_of_the_plane() {
    let mut renderers = Renderers::default();
    let (mut worst, mut checked) = (0.0f64, 0);
    for (case, vertices, mut random) in soups(3_000) {
        let indices: Vec<u32> = case.triangles.iter().flatten().copied().collect();
        let size = [case.width, case.height];
        let shown = drawn(renderers.nth(random.bits()), Show::Derivatives, &vertices, &indices, size);
        let snapped = case.snapped();
        for at in (0..shown.ids.len()).filter(|&at| shown.ids[at] != NO_ID).step_by(17) {
            let id = shown.ids[at] as usize;
            let corners = case.triangles[id].map(|k| vertices[k as usize]);
            let pixel = [at as i64 % i64::from(case.width), at as i64 / i64::from(case.width)];
            for (axis, step) in [[1, 0], [0, 1]].into_iter().enumerate() {
                let next = [pixel[0] + step[0], pixel[1] + step[1]];
                let (smooth, smooth_size) = slope(snapped[id], &corners, pixel, next);
                let difference = f64::from(shown.color[at][axis]) - smooth;
                worst = worst.max(difference.abs() / (U * smooth_size));
                assert!(difference.abs() <= ROUNDINGS * U * smooth_size, "{case}pixel {pixel:?}, axis {axis}");
                // On the screen the difference from one pixel to the next is the derivative, exactly.
                let values = corners.map(|corner| corner.linear[0]);
                let value = |pixel| barycentrics(snapped[id], pixel).and_then(|b| interpolate(&b, values));
                let (Some(here), Some(there)) = (value(pixel), value(next)) else { panic!("finite") };
                let exact: Rational = there - here;
                let flat = corners.map(|corner| ProbeVertex {
                    position: [corner.position[0], corner.position[1], 0.0, 1.0],
                    smooth: corner.linear,
                    ..corner
                });
                let (_, size) = slope(snapped[id], &flat, pixel, next);
                let wrong = error(shown.color[at][2 + axis], &exact);
                worst = worst.max(wrong / (U * size));
                assert!(wrong <= ROUNDINGS * U * size, "{case}pixel {pixel:?}, axis {axis}: {wrong}");
                checked += 2;
            }
        }
    }
    println!("{checked} derivatives, {worst} roundings at most");
    assert!(checked > 10_000);
}

/// The derivative of `smooth[0]` from its definition in f64, and the size of the terms that it is made of.
fn slope(t: Triangle, corners: &[ProbeVertex; 3], pixel: [i64; 2], next: [i64; 2]) -> (f64, f64) {
    let weights = |pixel: [i64; 2]| {
        let b = barycentrics(t, pixel).expect("it covers something");
        [0, 1, 2].map(|k| b[k].to_f64().value() / f64::from(corners[k].position[3]))
    };
    let (here, there) = (weights(pixel), weights(next));
    let change = [0, 1, 2].map(|k| there[k] - here[k]);
    let f = corners.map(|corner| f64::from(corner.smooth[0]));
    let sum = |w: [f64; 3]| w[0] + w[1] + w[2];
    let value = (0..3).map(|k| here[k] * f[k]).sum::<f64>() / sum(here);
    let n_change = (0..3).map(|k| change[k] * f[k]).sum::<f64>();
    let size = change.iter().map(|c| c.abs()).sum::<f64>() / sum(here).abs() * 2.0;
    ((n_change - value * sum(change)) / sum(here), size.max(f64::MIN_POSITIVE))
}

#[test]
fn flat_is_the_first_vertex_bit_by_bit_and_facing_follows_the_winding() {
    let mut renderers = Renderers::default();
    for (case, mut vertices, mut random) in soups(400) {
        // Any bits will do but NaN's, of which there is one; a subnormal number for each vertex.
        vertices.iter_mut().enumerate().for_each(|(k, v)| v.smooth[1] = f32::from_bits(1 + k as u32));
        for order in 0..6 {
            let indices: Vec<u32> = case.triangles.iter().flat_map(|&t| orders(t)[order]).collect();
            let size = [case.width, case.height];
            let shown = drawn(renderers.nth(random.bits()), Show::Flat, &vertices, &indices, size);
            for at in (0..shown.ids.len()).filter(|&at| shown.ids[at] != NO_ID) {
                let first = 3 * shown.ids[at] as usize;
                let [flat, front, change, _] = shown.color[at];
                assert_eq!(flat.to_bits(), vertices[indices[first] as usize].smooth[1].to_bits(), "{case}");
                assert_eq!(change, 0.0, "{case}a flat varying does not change");
                let corners = [0, 1, 2].map(|k| indices[first + k]);
                let snapped = Case { triangles: vec![corners], ..case.clone() }.snapped()[0];
                let is_front = pineda_oracle::winding(snapped) == pineda_oracle::Winding::CounterClockwise;
                assert_eq!(front, f32::from(u8::from(is_front)), "{case}order {order}");
            }
        }
    }
}

#[test]
fn a_fragment_knows_its_place() {
    let mut renderers = Renderers::default();
    for (case, vertices, mut random) in soups(400) {
        let indices: Vec<u32> = case.triangles.iter().flatten().copied().collect();
        let size = [case.width, case.height];
        let shown = drawn(renderers.nth(random.bits()), Show::Place, &vertices, &indices, size);
        for at in (0..shown.ids.len()).filter(|&at| shown.ids[at] != NO_ID) {
            let (i, j) = (at % case.width as usize, at / case.width as usize);
            assert_eq!(shown.color[at], [i as f32 + 0.5, j as f32 + 0.5, shown.depth[at], 0.0], "{case}");
        }
    }
}
