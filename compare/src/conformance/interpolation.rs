//! Colours between vertices: with perspective, without, and flat, within one code of 8 bits (flat ones exactly).

use super::Bench;
use super::depth::{cells, is_fat, point, position};
use super::sheet::{Draw, Interpolation, Sheet, Vertex, clip_position};
use super::tally::Tally;
use anyhow::Result;
use pineda::{DepthState, DrawState};
use pineda_oracle::Point;
use pineda_oracle::cases::Random;

const SIDE: u32 = 1024;
const CELL: u32 = 64;

/// A triangle a cell, a pixel wide at least, for Vulkan asks nothing of a slope that is steeper than colours are wide.
pub(crate) fn interpolation(bench: &mut Bench, tally: &mut Tally) -> Result<()> {
    for (interpolation, allowed) in
        [(Interpolation::Perspective, 1), (Interpolation::Linear, 1), (Interpolation::Flat, 0)]
    {
        for seed in bench.seed..bench.seed + 8 * bench.times {
            let mut random = Random::new(seed);
            let mut sheet = Sheet::new(SIDE);
            let triangles: Vec<([Point; 3], [Vertex; 3])> =
                cells(SIDE, CELL).map(|origin| triangle(&mut random, &sheet, origin)).collect();
            let vertices = triangles.iter().flat_map(|(_, vertices)| *vertices).collect();
            let state = DrawState { depth: DepthState::OFF, ..DrawState::DEFAULT };
            sheet.draws.push(Draw { vertices, indices: None, interpolation, state });
            tally.cases += triangles.len() as u64;
            let [ours, theirs] = bench.draw(&sheet)?;
            for at in 0..sheet.pixels() {
                tally.pixels += 1;
                let (our, their) = (ours.colors.codes()[at], theirs.colors.codes()[at]);
                // Alpha is never 0 where something was drawn.
                tally.drawn += u64::from(our[3] > 0);
                let difference = our.iter().zip(their).map(|(our, their)| our.abs_diff(their)).max().unwrap_or(0);
                if difference > allowed || (our[3] > 0) != (their[3] > 0) {
                    tally.differs(None, || {
                        let [x, y] = position(&sheet, at);
                        let triangle = &triangles[(y / CELL * (SIDE / CELL) + x / CELL) as usize];
                        format!("seed {seed}, {interpolation:?}, pixel {:?}: pineda {our:?}, lavapipe {their:?}; {triangle:?}", [x, y])
                    });
                } else {
                    tally.allow(difference.into());
                }
            }
        }
    }
    Ok(())
}

fn triangle(random: &mut Random, sheet: &Sheet, origin: [u32; 2]) -> ([Point; 3], [Vertex; 3]) {
    let corners = loop {
        let corners = [0; 3].map(|_| point(random, origin, CELL));
        if is_fat(corners) {
            break corners;
        }
    };
    let vertices = corners.map(|corner| {
        // Powers of two, so that the division leaves the corner where it is.
        let w = random.pick(&[0.125, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0]);
        let mut color = [0; 4].map(|_| random.unit());
        color[3] = 0.25 + 0.75 * color[3];
        Vertex { position: clip_position(&sheet.viewport(), corner, 0.5, w), color }
    });
    (corners, vertices)
}
