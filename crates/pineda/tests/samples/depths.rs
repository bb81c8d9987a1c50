//! Depth buffers of any format.

use pineda::DepthBuffer;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Format {
    Float,
    Unorm24,
    Unorm16,
}

impl Format {
    pub(crate) const ALL: [Self; 3] = [Self::Float, Self::Unorm24, Self::Unorm16];

    /// What is compared and stored: a code, or an f32's bits. A number that orders as depths do.
    pub(crate) fn stored(self, z: f32) -> u32 {
        let code = |steps: f64| (f64::from(z) * steps).round_ties_even() as u32;
        match self {
            Self::Float => z.to_bits(),
            Self::Unorm24 => code(16_777_215.0),
            Self::Unorm16 => code(65_535.0),
        }
    }
}

/// Codes of either unorm format, or f32s.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Depths {
    Float(Vec<f32>),
    Unorm24(Vec<u32>),
    Unorm16(Vec<u16>),
}

impl Depths {
    pub(crate) fn zeros(format: Format, count: usize) -> Self {
        match format {
            Format::Float => Self::Float(vec![0.0; count]),
            Format::Unorm24 => Self::Unorm24(vec![0; count]),
            Format::Unorm16 => Self::Unorm16(vec![0; count]),
        }
    }

    pub(crate) fn format(&self) -> Format {
        match self {
            Self::Float(_) => Format::Float,
            Self::Unorm24(_) => Format::Unorm24,
            Self::Unorm16(_) => Format::Unorm16,
        }
    }

    pub(crate) fn buffer(&mut self) -> DepthBuffer<'_> {
        match self {
            Self::Float(depths) => DepthBuffer::D32F(depths),
            Self::Unorm24(depths) => DepthBuffer::D24(depths),
            Self::Unorm16(depths) => DepthBuffer::D16(depths),
        }
    }

    pub(crate) fn get(&self, at: usize) -> u32 {
        match self {
            Self::Float(depths) => depths[at].to_bits(),
            Self::Unorm24(depths) => depths[at],
            Self::Unorm16(depths) => depths[at].into(),
        }
    }

    pub(crate) fn set(&mut self, at: usize, stored: u32) {
        match self {
            Self::Float(depths) => depths[at] = f32::from_bits(stored),
            Self::Unorm24(depths) => depths[at] = stored,
            Self::Unorm16(depths) => depths[at] = stored as u16,
        }
    }
}
