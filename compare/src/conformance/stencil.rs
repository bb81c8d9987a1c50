//! Stencil: every operation and comparison, each face its own, masks, references; values, pictures and depths exactly.

use super::Bench;
use super::depth::{cells, position};
use super::ours;
use super::sheet::{DepthFormat, Draw, Interpolation, Sheet, Vertex, clip_position};
use super::tally::{Row, Tally};
use anyhow::Result;
use pineda::{Compare, DepthState, DrawState, StencilFace, StencilOperation, StencilState};
use pineda_oracle::cases::Random;

const SIDE: u32 = 256;
const CELL: u32 = 16;
/// In front of what is drawn, and behind it.
const DEPTHS: [f32; 3] = [0.25, 0.5, 0.75];

/// In each cell two triangles, the front of one and the back of the other, with a state of its own; each fails the depth test in its left half. Twice, one after the other.
pub(crate) fn stencil(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    for seed in bench.seed..bench.seed + bench.times {
        let mut random = Random::new(seed);
        let mut sheet = Sheet::new(SIDE);
        sheet.depth = DepthFormat::Unorm24Stencil8;
        let states: Vec<[StencilState; 2]> = cells(SIDE, CELL).map(|_| [0; 2].map(|_| state(&mut random))).collect();
        sheet.stencil = (0..sheet.pixels())
            .map(|at| {
                let [x, y] = position(&sheet, at).map(|x| x / CELL);
                let own = states[(y * (SIDE / CELL) + x) as usize][0].front;
                let any = random.bits() as u8;
                random.pick(&[any, any, 0, 1, 127, 128, 254, 255, own.reference, own.reference & own.read_mask])
            })
            .collect();
        let mut halves = Vec::new();
        for [x, y] in cells(SIDE, CELL) {
            let middle = x + CELL / 2;
            halves.extend(rectangle(&sheet, [x, y], [middle, y + CELL], DEPTHS[0]));
            halves.extend(rectangle(&sheet, [middle, y], [x + CELL, y + CELL], DEPTHS[2]));
        }
        let depth = DepthState { compare: Compare::Always, write: true };
        add(&mut sheet, halves, DrawState { depth, ..DrawState::DEFAULT });
        for turn in 0..2 {
            for (states, [x, y]) in states.iter().zip(cells(SIDE, CELL)) {
                let [front, mut back] = halves_of(rectangle(&sheet, [x, y], [x + CELL, y + CELL], DEPTHS[1]));
                back.swap(1, 2);
                let color = [1.0, 0.25 + 0.5 * turn as f32, 0.0, 1.0];
                let vertices = [front, back].concat().into_iter().map(|vertex| Vertex { color, ..vertex }).collect();
                add(&mut sheet, vertices, DrawState { stencil: Some(states[turn]), ..DrawState::DEFAULT });
            }
        }
        tally.cases += 2 * states.len() as u64;
        let [ours, theirs] = bench.draw(&sheet)?;
        // wgpu 30 leaves the test out where both masks are 0 (`StencilState::is_enabled`). What would be seen then?
        for draw in &mut sheet.draws {
            draw.state.stencil = draw.state.stencil.filter(|state| state.front.read_mask | state.front.write_mask != 0);
        }
        let without = ours::draw(&mut bench.ours, &sheet)?;
        for at in 0..sheet.pixels() {
            tally.pixels += 1;
            let [our, their, without] =
                [&ours, &theirs, &without].map(|picture| (picture.stencil[at], picture.colors.codes()[at]));
            tally.drawn += u64::from(our.0 != sheet.stencil[at] || our.1[0] > 0);
            // The two depths that are seen lie between two codes each; either is right.
            if our != their || ours.depth[at].abs_diff(theirs.depth[at]) > 1 {
                tally.differs((their == without).then_some(Row::MasksOfZero), || {
                    let [x, y] = position(&sheet, at);
                    let own = &states[(y / CELL * (SIDE / CELL) + x / CELL) as usize];
                    let there = sheet.stencil[at];
                    format!(
                        "seed {seed}, pixel {:?} with stencil {there}: pineda {our:?}, lavapipe {their:?}; {own:?}",
                        [x, y]
                    )
                });
            }
        }
    }
    Ok(())
}

/// WebGPU has one reference and one pair of masks for both faces.
fn state(random: &mut Random) -> StencilState {
    let mut mask = || random.pick(&[0xff, 0xff, 0x0f, 0xaa, 0]);
    let (read_mask, write_mask) = (mask(), mask());
    let reference = if random.one_in(2) { random.bits() as u8 } else { random.pick(&[0, 1, 128, 254, 255]) };
    let mut face = || StencilFace {
        compare: random.pick(&Compare::ALL),
        fail: random.pick(&StencilOperation::ALL),
        depth_fail: random.pick(&StencilOperation::ALL),
        pass: random.pick(&StencilOperation::ALL),
        read_mask,
        write_mask,
        reference,
    };
    StencilState { front: face(), back: face() }
}

/// Two triangles that turn their fronts to the viewer.
fn rectangle(sheet: &Sheet, [left, top]: [u32; 2], [right, bottom]: [u32; 2], z: f32) -> [Vertex; 6] {
    let corners = [[left, top], [left, bottom], [right, bottom], [left, top], [right, bottom], [right, top]];
    corners.map(|corner| {
        let corner = corner.map(|x| 256 * i64::from(x));
        Vertex { position: clip_position(&sheet.viewport(), corner, z, 1.0), color: [0.0; 4] }
    })
}

fn halves_of([a, b, c, d, e, f]: [Vertex; 6]) -> [[Vertex; 3]; 2] {
    [[a, b, c], [d, e, f]]
}

fn add(sheet: &mut Sheet, vertices: Vec<Vertex>, state: DrawState) {
    sheet.draws.push(Draw { vertices, indices: None, interpolation: Interpolation::Flat, state });
}
