//! Filters: what is done to elements after they have been decompressed (appendix B), in f32 as it is written there.

/// Applies the filter of that name in place.
pub(super) fn apply(filter: &str, elements: &mut [u8], stride: usize) -> Result<(), String> {
    match (filter, stride) {
        ("NONE", _) => {}
        ("OCTAHEDRAL", 4) => each(elements, |i: [i8; 4]| octahedral(i.map(i32::from), 127.0).map(|c| c as i8)),
        ("OCTAHEDRAL", 8) => each(elements, |i: [i16; 4]| octahedral(i.map(i32::from), 32767.0).map(|c| c as i16)),
        ("QUATERNION", 8) => each(elements, quaternion),
        ("EXPONENTIAL", _) => each(elements, |[i]: [i32; 1]| [exponential(i)]),
        ("COLOR", 4) => each(elements, |i: [u8; 4]| {
            let [y, o, g, a] = i;
            color([y.into(), (o as i8).into(), (g as i8).into(), a.into()], 255.0).map(|c| c as u8)
        }),
        ("COLOR", 8) => each(elements, |i: [u16; 4]| {
            let [y, o, g, a] = i;
            color([y.into(), (o as i16).into(), (g as i16).into(), a.into()], 65535.0).map(|c| c as u16)
        }),
        _ => {
            let filter = crate::text::shown(filter.as_bytes());
            return Err(format!("there is no filter {filter} for elements of {stride} bytes"));
        }
    }
    Ok(())
}

/// Numbers that elements consist of, little-endian.
trait Number: Sized {
    const SIZE: usize;
    fn read(bytes: &[u8]) -> Self;
    fn write(self, bytes: &mut [u8]);
}

macro_rules! numbers {
    ($($number:ty),*) => {$(
        impl Number for $number {
            const SIZE: usize = size_of::<$number>();

            fn read(bytes: &[u8]) -> Self {
                Self::from_le_bytes(std::array::from_fn(|i| bytes[i]))
            }

            fn write(self, bytes: &mut [u8]) {
                bytes.copy_from_slice(&self.to_le_bytes());
            }
        }
    )*};
}
numbers!(i8, u8, i16, u16, i32, f32);

fn each<I: Number, O: Number, const N: usize>(elements: &mut [u8], filter: impl Fn([I; N]) -> [O; N]) {
    for element in elements.chunks_exact_mut(N * I::SIZE) {
        let input = std::array::from_fn(|i| I::read(&element[i * I::SIZE..]));
        for (output, bytes) in filter(input).into_iter().zip(element.chunks_exact_mut(O::SIZE)) {
            output.write(bytes);
        }
    }
}

/// A unit vector from its octahedral form; the fourth number stays.
fn octahedral([x, y, one, w]: [i32; 4], largest: f32) -> [i32; 4] {
    let one = one as f32;
    let (x, y) = (x as f32 / one, y as f32 / one);
    let z = 1.0 - x.abs() - y.abs();
    let t = if z < 0.0 { z } else { 0.0 };
    let (x, y) = (x - t.copysign(x), y - t.copysign(y));
    let length = (x * x + y * y + z * z).sqrt();
    let [x, y, z] = [x, y, z].map(|c| libm::roundf(c / length * largest) as i32);
    [x, y, z, w]
}

/// A unit quaternion from three components; the largest is what is missing.
fn quaternion(input: [i16; 4]) -> [i16; 4] {
    let one = f32::from(input[3] | 3);
    let range = 1.0 / 2.0f32.sqrt();
    let [x, y, z] = [input[0], input[1], input[2]].map(|c| f32::from(c) / one * range);
    let squared = 1.0 - x * x - y * y - z * z;
    let w = if squared > 0.0 { squared.sqrt() } else { 0.0 };
    let largest = (input[3] & 3) as usize;
    let mut output = [0; 4];
    for (i, c) in [w, x, y, z].into_iter().enumerate() {
        output[(largest + i) % 4] = libm::roundf(c * 32767.0) as i16;
    }
    output
}

/// Eight bits of exponent, 24 of mantissa, both signed.
fn exponential(input: i32) -> f32 {
    libm::ldexpf(((input << 8) >> 8) as f32, input >> 24)
}

/// YCoCg to red, green, blue; the highest bit that is set in alpha says how many bits all of them have.
fn color([y, co, cg, alpha]: [i32; 4], largest: f32) -> [i32; 4] {
    // At most 16 bits, as alpha has.
    let all = (1 << (32 - (alpha as u32).leading_zeros())) - 1;
    let a = alpha & (all >> 1);
    let scale = largest / all as f32;
    [y + co - cg, y + cg, y - co - cg, a << 1 | a & 1].map(|c| libm::roundf(c as f32 * scale) as i32)
}
