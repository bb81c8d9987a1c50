//! Turning vectors of one field for sixteen triangles into rows of one triangle's fields.

use crate::wide::{Simd, u32x4, u32x8, u32x16};

/// Sixteen vectors of sixteen lanes, transposed: four perfect shuffles of the vectors' halves.
#[inline(always)]
pub(crate) fn transpose16<S: Simd>(mut v: [u32x16<S>; 16]) -> [[u32; 16]; 16] {
    let mut round = 0;
    while round < 4 {
        let old = v;
        let mut i = 0;
        while i < 8 {
            (v[2 * i], v[2 * i + 1]) = old[i].interleave(old[i + 8]);
            i += 1;
        }
        round += 1;
    }
    let mut rows = [[0; 16]; 16];
    let mut i = 0;
    while i < 16 {
        v[i].store_slice(&mut rows[i]);
        i += 1;
    }
    rows
}

/// Eight vectors of sixteen lanes as sixteen rows of eight.
#[inline(always)]
pub(crate) fn transpose8<S: Simd>(mut v: [u32x16<S>; 8]) -> [[u32; 8]; 16] {
    let mut round = 0;
    while round < 3 {
        let old = v;
        let mut i = 0;
        while i < 4 {
            (v[2 * i], v[2 * i + 1]) = old[i].interleave(old[i + 4]);
            i += 1;
        }
        round += 1;
    }
    let mut rows = [[0u32; 16]; 8];
    let mut i = 0;
    while i < 8 {
        v[i].store_slice(&mut rows[i]);
        i += 1;
    }
    bytemuck::must_cast(rows)
}

/// Sixteen rows of four words as four vectors of sixteen.
#[inline(always)]
pub(crate) fn columns4<S: Simd>(rows: [u32x4<S>; 16]) -> [u32x16<S>; 4] {
    let [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p] = rows;
    if S::HAS_HALVES {
        let low = u32x8::transpose([a.combine(e), b.combine(f), c.combine(g), d.combine(h)]);
        let high = u32x8::transpose([i.combine(m), j.combine(n), k.combine(o), l.combine(p)]);
        return [low[0].combine(high[0]), low[1].combine(high[1]), low[2].combine(high[2]), low[3].combine(high[3])];
    }
    let (first, second) = (a.combine(b).combine(c.combine(d)), e.combine(f).combine(g.combine(h)));
    let (third, fourth) = (i.combine(j).combine(k.combine(l)), m.combine(n).combine(o.combine(p)));
    let (xz_low, xz_high) = (first.unzip_low(second), third.unzip_low(fourth));
    let (yw_low, yw_high) = (first.unzip_high(second), third.unzip_high(fourth));
    [xz_low.unzip_low(xz_high), yw_low.unzip_low(yw_high), xz_low.unzip_high(xz_high), yw_low.unzip_high(yw_high)]
}

/// An array of what an expression is for each number from 0 to 15. As a loop or a closure, vectors would go through memory.
macro_rules! each_of_sixteen {
    (|$k:ident| $value:expr) => {
        each_of_sixteen!(@ $k $value, 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15)
    };
    (@ $k:ident $value:expr, $($number:literal)+) => {
        [$({ let $k: usize = $number; $value }),+]
    };
}
pub(crate) use each_of_sixteen;
