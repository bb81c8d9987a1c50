//! Clip distances: what is cut off and what is kept meet without a gap, and eight planes leave what eight half-planes have in common.

use pineda::*;
use pineda_oracle::cases::Random;

/// A vertex with its position and its distances.
#[derive(Clone, Copy)]
struct Vertex {
    position: [f32; 4],
    distances: [f32; MAX_CLIP_DISTANCES],
}

/// Keeps what lies inside, or (with one distance) what lies outside.
struct Cut<const N: usize> {
    sign: f32,
}

#[shader]
impl<const N: usize> Shader for Cut<N> {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = Vec4<L>;
    const CLIP_DISTANCES: usize = N;

    fn vertex(&self, v: &Vertex) -> (Vec4, Vec4) {
        (Vec4::from(v.position), Vec4::from(v.position))
    }

    fn clip_distances(&self, v: &Vertex) -> [f32; MAX_CLIP_DISTANCES] {
        v.distances.map(|d| d * self.sign)
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let Vec4 { x, y, z, .. } = f.varyings();
        Rgba::opaque(Vec3::new(x, y, z))
    }
}

const SIZE: u32 = 96;
const PIXELS: usize = (SIZE * SIZE) as usize;

/// Hits, colours and statistics of draws, one after the other.
fn draw<const N: usize>(
    settings: Settings,
    cuts: &[Cut<N>],
    vertices: &[Vertex],
    indices: &[u32],
) -> (Vec<u32>, Vec<[f32; 4]>, Statistics) {
    let mut pass = Pass::new();
    for cut in cuts {
        pass.draw(cut, Mesh { vertices, indices: Indices::U32(indices) }, DrawState::default());
    }
    let (mut hits, mut color) = (vec![0; PIXELS], vec![[0.0; 4]; PIXELS]);
    let mut target =
        Target { hits: Some(&mut hits), color: ColorBuffer::Rgba32F(&mut color), ..Target::new(SIZE, SIZE) };
    let statistics = Renderer::new(settings).and_then(|mut r| r.render(&pass, &mut target)).expect("valid");
    (hits, color, statistics)
}

/// A mesh over more than the picture, with any w and any distances: both sides of the cut together hit each pixel once. At every setting, in either winding
/// and every order of the corners the bits are the same, and colours are those of the mesh that is not cut.
#[test]
fn both_sides_of_a_cut_make_the_whole() {
    let mut random = Random::new(11);
    for case in 0..40 {
        const SIDE: usize = 9;
        let mut vertices = Vec::new();
        for k in 0..SIDE * SIDE {
            let jitter = |random: &mut Random| random.real(-0.05, 0.05);
            let x = (k % SIDE) as f32 / 4.0 - 1.0 + jitter(&mut random);
            let y = (k / SIDE) as f32 / 4.0 - 1.0 + jitter(&mut random);
            let w = random.real(0.5, 3.0);
            let mut distances = [0.0; MAX_CLIP_DISTANCES];
            // Sometimes exactly on the plane, but never all corners of a triangle: it would belong to both sides.
            let may_be_on = (k % SIDE + k / SIDE).is_multiple_of(3);
            distances[0] = if may_be_on && random.one_in(2) { 0.0 } else { random.real(-2.0, 2.0) };
            let [x, y] = [x, y].map(|v| v * 1.5);
            vertices.push(Vertex { position: [x * w, y * w, 0.5 * w, w], distances });
        }
        let mut triangles = Vec::new();
        for k in 0..SIDE * (SIDE - 1) {
            if k % SIDE != SIDE - 1 {
                let (a, b, c, d) = (k as u32, k as u32 + 1, (k + SIDE) as u32, (k + SIDE) as u32 + 1);
                triangles.extend([[a, b, c], [c, b, d]]);
            }
        }
        let orders = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];
        let (whole, _, _) = draw::<0>(Settings::default(), &[Cut { sign: 1.0 }], &vertices, triangles.as_flattened());
        assert!(whole.iter().all(|&hits| hits == 1));
        let mut first = None;
        for (k, order) in orders.iter().enumerate() {
            let indices: Vec<u32> = triangles.iter().flat_map(|t| order.map(|k| t[k])).collect();
            let settings = Settings {
                simd: Simd::available()[(case + k) % Simd::available().len()],
                threads: [1, 2, 7][k % 3],
                tile: [TileSize::T16, TileSize::T64][k % 2],
                ..Settings::default()
            };
            let both = [Cut::<1> { sign: 1.0 }, Cut { sign: -1.0 }];
            let (hits, color, statistics) = draw(settings, &both, &vertices, &indices);
            assert!(hits.iter().all(|&hits| hits == 1), "case {case}");
            assert!(statistics.clipped > 0);
            let bits: Vec<_> = color.iter().map(|c| c.map(f32::to_bits)).collect();
            assert_eq!(*first.get_or_insert_with(|| bits.clone()), bits, "case {case}, order {order:?}");
        }
    }
}

/// On a triangle over the whole picture, w = 1: a pixel's centre is covered if all distances there are positive. (Cuts are snapped; centres nearer
/// to a plane than that are not judged.)
#[test]
fn eight_planes_leave_what_their_half_planes_share() {
    let mut random = Random::new(12);
    let mut judged = 0;
    for case in 0..200 {
        // Of a distance: a x + b y + c, in pixels from the picture's centre.
        let planes: [[f32; 3]; MAX_CLIP_DISTANCES] = std::array::from_fn(|_| {
            let (a, b) = (random.real(-1.0, 1.0), random.real(-1.0, 1.0));
            let length = a.hypot(b).max(0.1);
            [a / length, b / length, random.real(0.0, 40.0)]
        });
        let corner = |x: f32, y: f32| {
            let half = SIZE as f32 / 2.0;
            Vertex { position: [x, y, 0.5, 1.0], distances: planes.map(|[a, b, c]| a * x * half - b * y * half + c) }
        };
        let vertices = [corner(-1.5, -1.5), corner(4.0, -1.5), corner(-1.5, 4.0)];
        let (hits, _, _) = draw(Settings::default(), &[Cut::<8> { sign: 1.0 }], &vertices, &[0, 1, 2]);
        for (at, &hit) in hits.iter().enumerate() {
            let center = |v: usize| v as f32 + 0.5 - SIZE as f32 / 2.0;
            let (x, y) = (center(at % SIZE as usize), center(at / SIZE as usize));
            let nearest = planes.map(|[a, b, c]| a * x + b * y + c).into_iter().fold(f32::INFINITY, f32::min);
            if nearest.abs() > 1.0 / 64.0 {
                assert_eq!(hit == 1, nearest > 0.0, "case {case}, pixel ({x}, {y})");
                judged += 1;
            }
        }
    }
    assert!(judged > 1_700_000);
}

#[test]
fn distances_that_are_no_numbers_drop_the_triangle() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let vertex = |position: [f32; 2], distance: f32| {
            let [x, y] = position;
            Vertex { position: [x, y, 0.5, 1.0], distances: [distance; MAX_CLIP_DISTANCES] }
        };
        let vertices =
            [vertex([-1.0, -1.0], 1.0), vertex([1.0, -1.0], -1.0), vertex([0.0, 1.0], 1.0), vertex([1.0, 1.0], bad)];
        let (hits, _, statistics) =
            draw(Settings::default(), &[Cut::<2> { sign: 1.0 }], &vertices, &[0, 1, 2, 0, 1, 3]);
        assert_eq!((statistics.non_finite, statistics.clipped), (1, 1));
        assert!(hits.contains(&1) && !hits.contains(&2));
        // Distances beyond the first two are not looked at.
        let mut far = vertices;
        far.iter_mut().for_each(|v| v.distances = [1.0, 1.0, bad, bad, bad, bad, bad, bad]);
        let (_, _, statistics) = draw(Settings::default(), &[Cut::<2> { sign: 1.0 }], &far, &[0, 1, 2, 0, 1, 3]);
        assert_eq!((statistics.non_finite, statistics.clipped), (0, 0));
    }
}

/// A line ends where its distance becomes negative, a point is there or not.
#[test]
fn lines_and_points_are_cut_off_too() {
    let vertex = |x: f32, distance: f32| {
        let mut distances = [0.0; MAX_CLIP_DISTANCES];
        distances[0] = distance;
        Vertex { position: [x, 1.0 / SIZE as f32, 0.5, 1.0], distances }
    };
    let vertices = [vertex(-1.0, 1.0), vertex(1.0, -1.0), vertex(0.5, 1.0)];
    let half = SIZE / 2;
    let row = ((half - 1) * SIZE) as usize;
    // It is cut off in the picture's middle, where it has entered the last diamond and does not leave it any more.
    let of_line: Vec<u32> = (0..SIZE).map(|x| u32::from(x < half - 1)).collect();
    // The first point lies on the picture's left border, and covers the pixel beyond; the second is cut off.
    let of_points: Vec<u32> = (0..SIZE).map(|x| u32::from(x == 3 * half / 2 - 1)).collect();
    let expected = [
        (PrimitiveTopology::LineStrip, &[0, 1][..], of_line),
        (PrimitiveTopology::PointList, &[0, 1, 2][..], of_points),
    ];
    for (topology, indices, covered) in expected {
        let cut = Cut::<1> { sign: 1.0 };
        let mut pass = Pass::new();
        let state = DrawState { topology, ..DrawState::default() };
        pass.draw(&cut, Mesh { vertices: &vertices, indices: Indices::U32(indices) }, state);
        for simd in Simd::available() {
            let mut hits = vec![0; PIXELS];
            let mut target = Target { hits: Some(&mut hits), ..Target::new(SIZE, SIZE) };
            let mut renderer = Renderer::new(Settings { simd, ..Settings::default() }).expect("available");
            renderer.render(&pass, &mut target).expect("valid");
            assert_eq!(hits[row..row + SIZE as usize], covered, "{topology:?}, {simd:?}");
            assert_eq!(hits.iter().sum::<u32>(), covered.iter().sum(), "{topology:?}, {simd:?}");
        }
    }
}
