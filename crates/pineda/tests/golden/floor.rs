//! A chequered floor to the horizon, against what each pixel sees of it on average: the closed answer that filters come near to.
//!
//! The floor is that of the scene `texture_checks`. The reference knows neither texels nor levels. Up and down a pixel its integral is exact: a ray that swings down over a pixel's height walks along a straight line on
//! the floor, and where it crosses from one check to the next is the root of a linear equation. Across, it is the mean of sixteen such lines, which is right to a few thousandths.

use crate::scenes::Look;
use crate::textures::checks;
use pineda::*;

const WIDTH: usize = 317;
const HEIGHT: usize = 203;

/// Of one of the two floors: pixels from the picture's left border, and across and down, from row `TOP` on.
const FIRST: [usize; 2] = [3, 160];
const SIZE: [usize; 2] = [154, 195];
const TOP: usize = 4;

/// Lines across a pixel.
const LINES: usize = 16;

/// From the picture to the floor, as the rows of a matrix: a place is (row 0, row 1) / row 2 times (x, y, 1), in clip space's x and y.
fn to_floor(camera: &Mat4) -> [[f64; 3]; 3] {
    // The camera's columns for x, z and what moves; of their rows those that make x, y and w.
    let column = |unit: [f32; 4]| {
        let Vec4 { x, y, w, .. } = *camera * Vec4::from(unit);
        [x, y, w].map(|c| f64::from(f32::from(c)))
    };
    let [a, b, c] = [column([1.0, 0.0, 0.0, 0.0]), column([0.0, 0.0, 1.0, 0.0]), column([0.0, 0.0, 0.0, 1.0])];
    let cross =
        |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|k| a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3]);
    // The inverse, but for a factor.
    [cross(b, c), cross(c, a), cross(a, b)]
}

/// The part of a pixel's square that shows white; `None` where the floor has ended.
fn seen(to_floor: &[[f64; 3]; 3], pixel: [usize; 2]) -> Option<f64> {
    let mut white = 0.0;
    for line in 0..LINES {
        let x = (pixel[0] as f64 + (line as f64 + 0.5) / LINES as f64) / SIZE[0] as f64 * 2.0 - 1.0;
        let ends = [pixel[1], pixel[1] + 1].map(|row| {
            let y = 1.0 - row as f64 / SIZE[1] as f64 * 2.0;
            to_floor.map(|row| row[0] * x + row[1] * y + row[2])
        });
        let place = |s: f64| {
            let [i, j, k] = [0, 1, 2].map(|row| ends[0][row] + (ends[1][row] - ends[0][row]) * s);
            [i / k, j / k]
        };
        let is_on_floor = |[i, j]: [f64; 2]| i.abs() < 299.0 && j > -399.0 && j < 0.0;
        // Beyond the horizon lies what is behind the eye.
        if ends[0][2].signum() != ends[1][2].signum() || !is_on_floor(place(0.0)) || !is_on_floor(place(1.0)) {
            return None;
        }
        // Checks are a unit wide: half a repetition of the texture, which is two.
        let mut crossings = vec![0.0, 1.0];
        for axis in 0..2 {
            let [from, to] = [place(0.0)[axis], place(1.0)[axis]];
            let mut border = from.min(to).ceil();
            while border <= from.max(to) {
                let off = ends.map(|end| end[axis] - border * end[2]);
                crossings.push((off[0] / (off[0] - off[1])).clamp(0.0, 1.0));
                border += 1.0;
            }
        }
        crossings.sort_by(f64::total_cmp);
        for part in crossings.windows(2) {
            let [i, j] = place((part[0] + part[1]) / 2.0);
            if (i.floor() + j.floor()).rem_euclid(2.0) == 0.0 {
                white += (part[1] - part[0]) / LINES as f64;
            }
        }
    }
    Some(white)
}

/// How far a picture is from what is seen.
#[derive(Clone, Copy, Debug, Default)]
struct Off {
    sum: f64,
    most: f64,
    count: usize,
}

impl Off {
    fn mean(&self) -> f64 {
        self.sum / self.count as f64
    }
}

/// The rows where the floor is small both ways, and anisotropic filtering has enough lookups for all that a pixel sees. Above, sixteen are too few; below, texels are larger than
/// pixels, and borders of checks a texel wide.
const MIDDLE: std::ops::Range<usize> = 80..110;

/// The bounds are what filters of this kind (levels made of boxes, between them and in them linear) come to: an eye sees a tenth.
#[test]
fn a_chequered_floor_is_what_its_pixels_see_on_average() {
    let floors = checks();
    let mut pass = Pass::new();
    floors.iter().for_each(|layer| layer.draw(&mut pass));
    let mut pixels = vec![[0.0; 4]; WIDTH * HEIGHT];
    let mut target = Target { color: ColorBuffer::Rgba32F(&mut pixels), ..Target::new(WIDTH as u32, HEIGHT as u32) };
    Renderer::new(Settings::default()).and_then(|mut r| r.render(&pass, &mut target)).expect("a valid scene");
    // Trilinear and anisotropic: above the middle rows, in them, below.
    let mut off = [[Off::default(); 3]; 2];
    for (floor, layer) in floors.iter().enumerate() {
        let Look::Textured(look) = &layer.look else { panic!("a floor has a texture") };
        let to_floor = to_floor(&look.camera);
        for at in 0..SIZE[0] * SIZE[1] {
            let [x, y] = [at % SIZE[0], at / SIZE[0]];
            let Some(wanted) = seen(&to_floor, [x, y]) else { continue };
            let difference = (f64::from(pixels[(TOP + y) * WIDTH + FIRST[floor] + x][0]) - wanted).abs();
            let part = usize::from(TOP + y >= MIDDLE.start) + usize::from(TOP + y >= MIDDLE.end);
            let off = &mut off[floor][part];
            *off = Off { sum: off.sum + difference, most: off.most.max(difference), count: off.count + 1 };
        }
    }
    println!("{off:#?}");
    let [trilinear, anisotropic] = off;
    assert!(anisotropic.iter().all(|part| part.count > 2_000), "there is a floor");
    assert!(anisotropic[0].mean() < 0.02 && anisotropic[0].most < 0.15, "towards the horizon");
    assert!(anisotropic[1].mean() < 0.004 && anisotropic[1].most < 0.1, "in the middle");
    assert!(anisotropic[2].mean() < 0.008 && anisotropic[2].most < 0.5, "near the eye");
    assert!(trilinear[1].mean() > 10.0 * anisotropic[1].mean(), "what anisotropy is for");
    assert!(trilinear[2].mean() < 0.012, "without it, all is as good near the eye only");
}
