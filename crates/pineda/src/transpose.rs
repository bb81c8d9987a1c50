//! Turning vectors of one field for sixteen triangles into rows of one triangle's fields.

use crate::wide::{Simd, u32x16};

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
pub(crate) fn columns4<S: Simd>(a: u32x16<S>, b: u32x16<S>, c: u32x16<S>, d: u32x16<S>) -> [u32x16<S>; 4] {
    let (xz_low, xz_high) = (a.unzip_low(b), c.unzip_low(d));
    let (yw_low, yw_high) = (a.unzip_high(b), c.unzip_high(d));
    [xz_low.unzip_low(xz_high), yw_low.unzip_low(yw_high), xz_low.unzip_high(xz_high), yw_low.unzip_high(yw_high)]
}
