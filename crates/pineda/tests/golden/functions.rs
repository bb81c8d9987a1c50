//! Noise, hashes and refraction as pictures: a cell for each. (The bits of functions of one or two numbers: `crates/pineda-proof/tests/accuracy.rs`.)

use crate::looks::Vertex;
use crate::scenes::{Layer, Look, RASTER};
use crate::shapes::Shape;
use pineda::*;

/// Pixels along a cell's side; three cells across, two down.
pub(crate) const CELL: u32 = 40;
pub(crate) const SIZE: [u32; 2] = [3 * CELL, 2 * CELL];

pub(crate) struct Functions;

#[shader]
impl Shader for Functions {
    type Vertex = Vertex;
    type Varyings<L: Lanes> = ();

    fn vertex(&self, v: &Vertex) -> (Vec4, ()) {
        (v.position.into(), ())
    }

    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
        let pixel = Vec2::new(f.x(), f.y());
        let cell = (pixel / CELL as f32).floor();
        let p = (pixel - cell * CELL as f32) / CELL as f32;
        let number = cell.x + cell.y * 3.0;
        let gray = |value: Real<L>| Vec3::new(value, value, value);
        let hashed = noise::hash3([pixel.x.to_int().to_uint(), pixel.y.to_int().to_uint(), Uint::new(f.lanes(), 7)]);
        let slope = noise::gradient3_with_slope((p * 5.0).extend(0.3), 2).1;
        let bent = (p - [0.5, 0.5]).extend(-0.6).normalize().refract([0.0, 0.0, 1.0], 1.0 / 1.5);
        let cells = [
            gray(noise::gradient2(p * 6.0, 1) * 0.5 + 0.5),
            gray(noise::fbm2(p * 3.0, 5, 1) * 0.5 + 0.5),
            gray(noise::turbulence3((p * 3.0).extend(0.7), 4, 1)),
            slope * 0.25 + 0.5,
            Vec3::new(hashed[0].to_unit(), hashed[1].to_unit(), hashed[2].to_unit()),
            bent * 0.5 + 0.5,
        ];
        let mut color = f.splat([0.0, 0.0, 0.0]);
        let mut k = 0;
        while k < cells.len() {
            color = number.eq(k as f32).select(cells[k], color);
            k += 1;
        }
        Rgba::opaque(color)
    }
}

pub(crate) fn functions() -> Vec<Layer> {
    let [width, height] = SIZE.map(|x| x as f32);
    let corner = |x: f32, y: f32| Vertex { position: [x, y, 0.5, 1.0], ..Vertex::default() };
    let vertices = vec![corner(0.0, 0.0), corner(width, 0.0), corner(0.0, height), corner(width, height)];
    vec![Layer { shape: Shape { vertices, indices: vec![0, 2, 1, 1, 2, 3] }, look: Look::Functions, state: RASTER }]
}
