//! Vectors of three f64: enough for normals and boxes, and the same bits everywhere.

pub(crate) type Vec3 = [f64; 3];

/// Each component by itself: `array::map`, which is a call where the compiler does not optimize across codegen units.
#[inline]
pub(crate) fn each<A: Copy, B>(v: [A; 3], f: impl Fn(A) -> B) -> [B; 3] {
    [f(v[0]), f(v[1]), f(v[2])]
}

pub(crate) fn widen(v: [f32; 3]) -> Vec3 {
    each(v, f64::from)
}

pub(crate) fn add(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(crate) fn sub(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(crate) fn scale(a: Vec3, s: f64) -> Vec3 {
    [a[0] * s, a[1] * s, a[2] * s]
}

pub(crate) fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn length(a: Vec3) -> f64 {
    dot(a, a).sqrt()
}

/// `a` at length 1; `None` for a vector without a direction: zero, NaN or infinite.
///
/// Dividing by the largest component first keeps the squares of very long and very short vectors in range.
pub(crate) fn normalize(a: Vec3) -> Option<Vec3> {
    let largest = a.iter().fold(0.0, |m, c| if c.abs() > m { c.abs() } else { m });
    if largest == 0.0 || !a.iter().all(|c| c.is_finite()) {
        return None;
    }
    let a = each(a, |c| c / largest);
    let length = length(a);
    Some(each(a, |c| c / length))
}

/// `a` at length 1 and rounded once; `[0.0; 3]` for a vector without a direction.
pub(crate) fn unit_or_zero(a: Vec3) -> [f32; 3] {
    normalize(a).map_or([0.0; 3], |n| each(n, |c| c as f32))
}

/// Twice the area times the unit normal of the triangle a, b, c; counter-clockwise is towards the viewer.
pub(crate) fn area_vector_x2(a: Vec3, b: Vec3, c: Vec3) -> Vec3 {
    cross(sub(b, a), sub(c, a))
}
