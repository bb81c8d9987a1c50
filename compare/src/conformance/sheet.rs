//! What both renderers are given, in `pineda`'s words: a *sheet*, one picture in which many cases lie beside each other; and what comes back.

use pineda::{DrawState, Viewport};
use pineda_oracle::Point;

/// A square picture, what is in it before, and the draws.
#[derive(Clone, Debug)]
pub(crate) struct Sheet {
    /// Pixels to each side: a power of two, so that clip-space positions on the subpixel grid are exact in f32. At least 256, for rows to be copied without padding.
    pub(crate) side: u32,
    /// The colours that are there, and their format.
    pub(crate) colors: Colors,
    /// Cleared to 1.
    pub(crate) depth: DepthFormat,
    /// The stencil values that are there, if the depth format has any.
    pub(crate) stencil: Vec<u8>,
    pub(crate) draws: Vec<Draw>,
}

/// Colours, row by row from the top.
#[derive(Clone, Debug)]
pub(crate) enum Colors {
    Unorm8(Vec<[u8; 4]>),
    Srgb8(Vec<[u8; 4]>),
    /// Bits.
    Float16(Vec<[u16; 4]>),
    Float32(Vec<[f32; 4]>),
}

/// WebGPU's formats.
#[derive(Clone, Copy, Debug, Eq, Hash, PartialEq)]
pub(crate) enum DepthFormat {
    None,
    Float32,
    Unorm24,
    Unorm16,
    Unorm24Stencil8,
}

/// Vertices and how to draw them.
#[derive(Clone, Debug)]
pub(crate) struct Draw {
    pub(crate) vertices: Vec<Vertex>,
    /// None: in order.
    pub(crate) indices: Option<Vec<u32>>,
    pub(crate) interpolation: Interpolation,
    pub(crate) state: DrawState,
}

#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(crate) struct Vertex {
    /// In clip space.
    pub(crate) position: [f32; 4],
    pub(crate) color: [f32; 4],
}

/// How colours get from vertices to pixels.
#[derive(Clone, Copy, Debug, Eq, Hash, PartialEq)]
pub(crate) enum Interpolation {
    Perspective,
    Linear,
    /// The first vertex provokes.
    Flat,
}

/// A sheet when it has been drawn.
#[derive(Clone, Debug)]
pub(crate) struct Picture {
    pub(crate) colors: Colors,
    /// Bits of an f32, or a code; empty without depth.
    pub(crate) depth: Vec<u32>,
    /// Empty without stencil.
    pub(crate) stencil: Vec<u8>,
}

impl Sheet {
    /// A sheet of black, without depth.
    pub(crate) fn new(side: u32) -> Self {
        assert!(side.is_power_of_two() && side >= 256, "{side}");
        let pixels = side as usize * side as usize;
        let (colors, draws) = (Colors::Unorm8(vec![[0; 4]; pixels]), Vec::new());
        Self { side, colors, depth: DepthFormat::None, stencil: Vec::new(), draws }
    }

    pub(crate) fn pixels(&self) -> usize {
        self.side as usize * self.side as usize
    }

    /// The viewport that is the whole of it.
    pub(crate) fn viewport(&self) -> Viewport {
        Viewport::whole(self.side, self.side)
    }

    /// A pixel's place, row by row from the top.
    pub(crate) fn at(&self, [x, y]: [u32; 2]) -> usize {
        (y * self.side + x) as usize
    }
}

impl Colors {
    /// The 8-bit codes of either format; none of floats.
    pub(crate) fn codes(&self) -> &[[u8; 4]] {
        match self {
            Self::Unorm8(codes) | Self::Srgb8(codes) => codes,
            Self::Float16(_) | Self::Float32(_) => &[],
        }
    }
}

impl DepthFormat {
    /// The largest code of a unorm format.
    pub(crate) fn steps(self) -> Option<u32> {
        match self {
            Self::None | Self::Float32 => None,
            Self::Unorm24 | Self::Unorm24Stencil8 => Some((1 << 24) - 1),
            Self::Unorm16 => Some((1 << 16) - 1),
        }
    }

    /// The depth of a value of [`Picture::depth`].
    pub(crate) fn decoded(self, stored: u32) -> f64 {
        match self.steps() {
            Some(steps) => f64::from(stored) / f64::from(steps),
            None => f64::from(f32::from_bits(stored)),
        }
    }
}

/// The position in clip space of a point on the picture, in 1/256 pixels. Exact for viewports and w that are powers of two.
pub(crate) fn clip_position(viewport: &Viewport, point: Point, z: f32, w: f32) -> [f32; 4] {
    clip_position_between(viewport, point.map(|x| 16 * x), z, w)
}

/// The same of a point in 1/4096 pixels.
pub(crate) fn clip_position_between(viewport: &Viewport, [x, y]: [i64; 2], z: f32, w: f32) -> [f32; 4] {
    let unit = |x: i64, start: f32, size: f32| 2.0 * (x as f64 / 4096.0 - f64::from(start)) / f64::from(size) - 1.0;
    let position = [unit(x, viewport.x, viewport.width), -unit(y, viewport.y, viewport.height), z.into(), 1.0];
    position.map(|x| (x * f64::from(w)) as f32)
}
