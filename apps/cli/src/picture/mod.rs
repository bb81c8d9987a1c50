//! Finished pictures, and the formats that they are written in.

mod encode;
mod format;

pub(crate) use format::PictureFormat;

use crate::values::Size;

/// Pixels row by row, the top row first.
#[derive(Debug)]
pub(crate) struct Picture {
    pub(crate) size: Size,
    pub(crate) pixels: Pixels,
}

#[derive(Debug)]
pub(crate) enum Pixels {
    Rgb8(Vec<[u8; 3]>),
    /// Straight alpha.
    Rgba8(Vec<[u8; 4]>),
    Gray16(Vec<u16>),
    /// Four numbers: not a picture to look at.
    Rgba16(Vec<[u16; 4]>),
    /// Linear light or plain numbers, multiplied by alpha.
    Rgba32F(Vec<[f32; 4]>),
}
