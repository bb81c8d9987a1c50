//! A vertex stage is told the number of its vertex: what the index says, or its place.

use pineda::*;

/// Where a vertex lies says its number alone: twelve corners of a grid. Shows it, and the instance's, of the provoking vertex.
struct Numbers;

/// Pixels from one corner of the grid to the next.
const STEP: f32 = 8.0;

#[shader]
impl Shader for Numbers {
    type Vertex = Instanced<(), u32>;
    type Varyings<L: Lanes> = RgbaU<L>;
    fn vertex(&self, v: &Self::Vertex) -> (Vec4, RgbaU) {
        let (column, row) = (v.vertex_id / 2, v.vertex_id % 2 + 2 * v.instance_id);
        let number = |x: u32| Uint::from(x);
        let position = Vec4::from([STEP * column as f32, STEP * row as f32, 0.5, 1.0]);
        (
            position,
            RgbaU { r: number(v.vertex_id + 1), g: number(v.instance_id + 1), b: number(v.instance), a: number(1) },
        )
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> RgbaU<L> {
        f.varyings()
    }
}

/// Of each triangle its first vertex, by the tables of `PrimitiveTopology`; `None` restarts.
fn provoking(row: &[Option<u32>], topology: PrimitiveTopology) -> Vec<u32> {
    let mut first = Vec::new();
    for stretch in row.split(Option::is_none) {
        let stretch: Vec<u32> = stretch.iter().flatten().copied().collect();
        let count = stretch.len().saturating_sub(2);
        match topology {
            PrimitiveTopology::TriangleList => first.extend(stretch.chunks(3).map(|corners| corners[0])),
            PrimitiveTopology::TriangleStrip => first.extend(&stretch[..count]),
            _ => first.extend(stretch.iter().skip(1).take(count)),
        }
    }
    first
}

#[test]
fn vertices_are_told_their_numbers() {
    let strip: Vec<u32> = vec![0, 1, 2, 3, 4, 5, u32::MAX, 11, 10, 9, 8, 7];
    let fan: Vec<u32> = vec![0, 1, 3, 5, 4, u32::MAX, 6, 7, 9, 11, 10, 8];
    let list: Vec<u32> = vec![2, 0, 1, 2, 1, 3, 9, 8, 10, 9, 10, 11];
    let nothing: [(); 12] = [(); 12];
    let instances: Vec<u32> = (0..5).map(|k| 100 + k).collect();
    let (width, height) = (48, 80);
    for (row, topology) in [
        (list, PrimitiveTopology::TriangleList),
        (strip, PrimitiveTopology::TriangleStrip),
        (fan, PrimitiveTopology::TriangleFan),
        ((0..12).collect(), PrimitiveTopology::TriangleStrip),
    ] {
        let primitive_restart = row.contains(&u32::MAX);
        let first = provoking(&row.iter().map(|&v| Some(v).filter(|&v| v != u32::MAX)).collect::<Vec<_>>(), topology);
        let [bytes, halves] = [0, 1].map(|_| row.clone());
        let bytes: Vec<u8> = bytes.iter().map(|&v| v as u8).collect();
        let halves: Vec<u16> = halves.iter().map(|&v| v as u16).collect();
        let in_order = row.iter().copied().eq(0..12);
        let kinds = [Indices::U8(&bytes), Indices::U16(&halves), Indices::U32(&row), Indices::Sequential];
        for indices in kinds.into_iter().take(if in_order { 4 } else { 3 }) {
            let mut seen = Vec::new();
            for (memory, threads) in [(1 << 29, 1), (0, 2)] {
                let state = DrawState { topology, primitive_restart, space: Space::Raster, ..DrawState::default() };
                let mut pass = Pass::new();
                pass.draw_instanced(&Numbers, Mesh { vertices: &nothing, indices }, &instances, state);
                let (mut colors, mut ids) = (vec![[0; 4]; width * height], vec![0; width * height]);
                let mut target = Target {
                    color: ColorBuffer::Rgba32U(&mut colors),
                    triangle_ids: Some(&mut ids),
                    ..Target::new(width as u32, height as u32)
                };
                let settings = Settings { memory, threads, ..Settings::default() };
                Renderer::new(settings).and_then(|mut r| r.render(&pass, &mut target)).expect("valid");
                let mut shown = std::collections::BTreeSet::new();
                for (&[vertex, instance, own, a], &id) in colors.iter().zip(&ids).filter(|(_, id)| **id != NO_ID) {
                    assert_eq!(vertex, first[id as usize] + 1, "triangle {id}, {topology:?}, {indices:?}");
                    assert_eq!((own, a), (99 + instance, 1), "the instance's own data");
                    shown.insert((instance, id));
                }
                assert!(shown.len() >= 5 * 4, "{topology:?}: {shown:?}");
                seen.push(colors);
            }
            assert!(seen[0] == seen[1], "{topology:?}: threads change numbers");
        }
    }
}

/// The short way, and positions asked for again, by clipping: it runs the stage with the same number.
#[test]
fn a_clipped_vertex_keeps_its_number() {
    let mut pass = Pass::new();
    pass.draw_instanced_with(
        Mesh { vertices: &[(); 6], indices: Indices::U8(&[3, 4, 5]) },
        &[()],
        DrawState::default(),
        // A triangle through the near plane, of the second three numbers; the first three lie elsewhere.
        |v| match v.vertex_id {
            3 => (Vec4::from([-1.0, -1.0, -0.5, 1.0]), ()),
            4 => (Vec4::from([1.0, -1.0, 0.5, 1.0]), ()),
            5 => (Vec4::from([1.0, 1.0, 0.5, 1.0]), ()),
            _ => (Vec4::from([5.0, 5.0, 0.5, 1.0]), ()),
        },
        |f| Rgba::gray(f.splat(1.0)),
    );
    let mut hits = vec![0; 16 * 16];
    let mut target = Target { hits: Some(&mut hits), ..Target::new(16, 16) };
    Renderer::new(Settings::default()).and_then(|mut r| r.render(&pass, &mut target)).expect("valid");
    // The lower right half, and of that what lies to the right of the middle.
    for (at, &hits) in hits.iter().enumerate() {
        let (x, y) = (at % 16, at / 16);
        assert_eq!(hits, u32::from(x >= 8 && x + y >= 15), "pixel ({x}, {y})");
    }
}
