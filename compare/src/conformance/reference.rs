//! What Vulkan says of textures, in f64 and in its own words (1.4, "Image Operations", 16.5 and 16.6), for judging where two renderers differ. Nothing of it is `pineda`'s.

use super::blending::decode;
use super::lookups::{Format, Kind, Lookups, Place, Texture};
use super::sheet::Vertex;
use pineda::{Filter, MipFilter, Wrap, f16_to_f32};

/// A colour, and how far a step of 1/256 in each of the weights can move it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Color {
    pub(crate) color: [f64; 4],
    pub(crate) moves: [f64; 4],
}

/// The colour at a place, at a level of detail; of a cube only the nearest texel.
pub(crate) fn color(Lookups { texture, sampler, .. }: &Lookups, place: &Place) -> Color {
    let last = f64::from(texture.levels - 1);
    let lod = f64::from(place.extra).clamp(0.0, last);
    let filter = if place.extra > 0.0 { sampler.min_filter } else { sampler.mag_filter };
    let at_level = |level: f64| at_level(texture, sampler.wrap, filter, place, level as u32);
    if sampler.mip_filter != MipFilter::Linear {
        return at_level((lod + 0.5).floor().min(last));
    }
    let (first, part) = (lod.floor(), lod - lod.floor());
    let (a, b) = (at_level(first), at_level((first + 1.0).min(last)));
    let between = |a: f64, b: f64| a + (b - a) * part;
    Color {
        color: [0, 1, 2, 3].map(|k| between(a.color[k], b.color[k])),
        moves: [0, 1, 2, 3].map(|k| between(a.moves[k], b.moves[k]) + (a.color[k] - b.color[k]).abs() / 256.0),
    }
}

fn at_level(texture: &Texture, wrap: [Wrap; 3], filter: Filter, place: &Place, level: u32) -> Color {
    let extent = texture.extent(level);
    let (mut at, mut slice, mut wrap) = (place.at.map(f64::from), None, wrap);
    match texture.kind {
        Kind::Flat => slice = Some(0),
        Kind::Array => slice = Some((place.layer as i64).clamp(0, i64::from(extent[2]) - 1)),
        Kind::Cube => {
            let (number, axes) = face(at);
            let [sc, tc, ma] = axes.map(|(axis, sign)| sign * at[axis]);
            (at, slice, wrap) = ([0.5 * (sc / ma + 1.0), 0.5 * (tc / ma + 1.0), 0.0], Some(number), [Wrap::Clamp; 3]);
        }
        Kind::Volume => {}
    }
    let axes = if slice.is_some() { 2 } else { 3 };
    // The texels on either side of each axis, and the second one's weight.
    let sides = [0, 1, 2].map(|k| {
        let u = at[k] * f64::from(extent[k]);
        match filter {
            Filter::Nearest => ([u.floor() as i64; 2], 0.0),
            Filter::Linear => ([(u - 0.5).floor() as i64, (u - 0.5).floor() as i64 + 1], (u - 0.5) - (u - 0.5).floor()),
        }
    });
    let corner = |corner: usize| -> [f64; 4] {
        let mut texel = [0, 0, slice.unwrap_or(0)];
        for k in 0..axes {
            match wrapped(wrap[k], sides[k].0[corner >> k & 1], extent[k].into()) {
                Some(i) => texel[k] = i,
                None => return border(texture.format),
            }
        }
        number(texture, level, texel)
    };
    let corners: Vec<[f64; 4]> = (0..1 << axes).map(corner).collect();
    let weight = |corner: usize| -> f64 {
        (0..axes).map(|k| if corner >> k & 1 == 1 { sides[k].1 } else { 1.0 - sides[k].1 }).product()
    };
    let mut result = Color { color: [0.0; 4], moves: [0.0; 4] };
    for channel in 0..4 {
        result.color[channel] = (0..corners.len()).map(|c| weight(c) * corners[c][channel]).sum();
        for axis in 0..axes {
            let step = |c: usize| (corners[c][channel] - corners[c ^ 1 << axis][channel]).abs();
            result.moves[channel] += (0..corners.len()).map(step).fold(0.0, f64::max) / 256.0;
        }
    }
    result
}

/// Vulkan's wrapping of a texel's number; `None` is the border.
fn wrapped(wrap: Wrap, i: i64, size: i64) -> Option<i64> {
    match wrap {
        Wrap::Repeat => Some(i.rem_euclid(size)),
        Wrap::Mirror => {
            let i = i.rem_euclid(2 * size);
            Some(if i < size { i } else { 2 * size - 1 - i })
        }
        Wrap::Clamp => Some(i.clamp(0, size - 1)),
        Wrap::Border => (0..size).contains(&i).then_some(i),
    }
}

/// White, in the channels that there are.
fn border(format: Format) -> [f64; 4] {
    [0, 1, 2, 3].map(|k| f64::from(u8::from(k < format.channels() || k == 3)))
}

fn number(texture: &Texture, level: u32, [x, y, z]: [i64; 3]) -> [f64; 4] {
    let [width, height, _] = texture.extent(level).map(i64::from);
    let texel = texture.texels_before(level) + ((z * height + y) * width + x) as usize;
    let (channels, size) = (texture.format.channels(), texture.format.channel_size());
    [0, 1, 2, 3].map(|k| {
        if k >= channels {
            return if k == 3 { 1.0 } else { 0.0 };
        }
        let bytes = &texture.bytes[(texel * channels + k) * size..][..size];
        match (texture.format, bytes) {
            (Format::Rgba8Srgb, &[code]) if k < 3 => decode(code.into()),
            (Format::Depth16, &[low, high]) => f64::from(u16::from_le_bytes([low, high])) / 65535.0,
            (_, &[code]) => f64::from(code) / 255.0,
            (_, &[low, high]) => f16_to_f32(u16::from_le_bytes([low, high])).into(),
            (_, bytes) => f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]).into(),
        }
    })
}

/// The number of the face of a cube that a direction meets, and the axes, with their signs, that its s and t run along and that it looks along (16.5.4).
fn face([x, y, z]: [f64; 3]) -> (i64, [(usize, f64); 3]) {
    if z.abs() >= x.abs() && z.abs() >= y.abs() {
        if z >= 0.0 { (4, [(0, 1.0), (1, -1.0), (2, 1.0)]) } else { (5, [(0, -1.0), (1, -1.0), (2, -1.0)]) }
    } else if y.abs() >= x.abs() {
        if y >= 0.0 { (2, [(0, 1.0), (2, 1.0), (1, 1.0)]) } else { (3, [(0, 1.0), (2, -1.0), (1, -1.0)]) }
    } else if x >= 0.0 {
        (0, [(2, -1.0), (1, -1.0), (0, 1.0)])
    } else {
        (1, [(2, 1.0), (1, -1.0), (0, -1.0)])
    }
}

/// The square of the longer of two gradients, in texels of level 0 (16.6.9).
pub(crate) fn longest_squared(texture: &Texture, place: &Place) -> f64 {
    let size = texture.size.map(f64::from);
    let squared = |gradient: [f32; 3]| -> f64 {
        let gradient = gradient.map(f64::from);
        match texture.kind {
            Kind::Flat | Kind::Array => (0..2).map(|k| (gradient[k] * size[k]).powi(2)).sum(),
            Kind::Volume => (0..3).map(|k| (gradient[k] * size[k]).powi(2)).sum(),
            Kind::Cube => {
                // 16.5.6: the derivative of the quotient.
                let direction = place.at.map(f64::from);
                let (_, axes) = face(direction);
                let [sc, tc, ma] = axes.map(|(axis, sign)| sign * direction[axis]);
                let [dsc, dtc, dma] = axes.map(|(axis, sign)| sign * gradient[axis]);
                let step = |c: f64, dc: f64| 0.5 * (ma * dc - c * dma) / (ma * ma) * size[0];
                step(sc, dsc).powi(2) + step(tc, dtc).powi(2)
            }
        }
    };
    squared(place.right).max(squared(place.down))
}

/// The level of detail that a square says, as a texture shows it.
pub(crate) fn level_of_detail(texture: &Texture, squared: f64) -> f64 {
    (0.5 * squared.log2()).clamp(0.0, f64::from(texture.levels - 1))
}

/// The same as llvmpipe has it: it takes the mantissa for the logarithm's fraction (`lp_build_fast_log2`), up to 0.086 off, half of which is left for a root.
pub(crate) fn lavapipe_level_of_detail(texture: &Texture, squared: f64) -> f64 {
    let exponent = squared.log2().floor();
    let fraction = squared / exponent.exp2() - 1.0;
    (0.5 * (exponent + fraction)).clamp(0.0, f64::from(texture.levels - 1))
}

/// Coordinates on a triangle in a square picture, with perspective.
pub(crate) struct Surface {
    /// x, y and 1/w of each corner.
    corners: [[f64; 3]; 3],
    uv: [[f64; 2]; 3],
}

impl Surface {
    pub(crate) fn new(vertices: [Vertex; 3], side: u32) -> Self {
        let half = f64::from(side) / 2.0;
        let corners = vertices.map(|Vertex { position, .. }| {
            let [x, y, _, w] = position.map(f64::from);
            [(x / w + 1.0) * half, (1.0 - y / w) * half, 1.0 / w]
        });
        Self { corners, uv: vertices.map(|Vertex { color: [u, v, ..], .. }| [u, v].map(f64::from)) }
    }

    /// u/w, v/w and 1/w, times a number that is the same everywhere.
    fn over_w(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        let mut sums = [0.0; 3];
        for k in 0..3 {
            let ([ax, ay, _], [bx, by, _]) = (self.corners[(k + 1) % 3], self.corners[(k + 2) % 3]);
            let weight = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) * self.corners[k][2];
            let [u, v] = self.uv[k];
            sums = [sums[0] + weight * u, sums[1] + weight * v, sums[2] + weight];
        }
        sums
    }

    fn at(&self, point: [f64; 2]) -> [f64; 2] {
        let [u, v, w] = self.over_w(point);
        [u / w, v / w]
    }

    /// The square of the longer gradient at a pixel's centre, in texels of level 0.
    pub(crate) fn longest_squared(&self, texture: &Texture, pixel: [u32; 2]) -> f64 {
        let [x, y] = pixel.map(|x| f64::from(x) + 0.5);
        let [u, v, w] = self.over_w([x, y]);
        let (du, dv, dw) = {
            // All three are linear.
            let (right, down) = (self.over_w([x + 1.0, y]), self.over_w([x, y + 1.0]));
            ([right[0] - u, down[0] - u], [right[1] - v, down[1] - v], [right[2] - w, down[2] - w])
        };
        let [width, height, _] = texture.size.map(f64::from);
        let squared = |k: usize| {
            let step = |c: f64, dc: f64| (w * dc - c * dw[k]) / (w * w);
            (step(u, du[k]) * width).powi(2) + (step(v, dv[k]) * height).powi(2)
        };
        squared(0).max(squared(1))
    }

    /// The same from differences in the pixel's block of 2 x 2.
    pub(crate) fn longest_squared_of_quad(&self, texture: &Texture, pixel: [u32; 2]) -> f64 {
        let [x, y] = pixel.map(|x| f64::from(x & !1) + 0.5);
        let [u, v] = self.at([x, y]);
        let [width, height, _] = texture.size.map(f64::from);
        let squared = |[a, b]: [f64; 2]| ((a - u) * width).powi(2) + ((b - v) * height).powi(2);
        squared(self.at([x + 1.0, y])).max(squared(self.at([x, y + 1.0])))
    }
}
