//! Primitive modes: from a row of corners to triangles, lines or points (specification, 3.7.2.1).

use super::schema::Whole;

/// A primitive's mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mode {
    Points,
    Lines,
    LineLoop,
    LineStrip,
    Triangles,
    TriangleStrip,
    TriangleFan,
}

/// What a primitive consists of.
pub(super) enum Elements {
    Triangles(Vec<[u32; 3]>),
    Lines(Vec<[u32; 2]>),
    Points(Vec<u32>),
}

impl Mode {
    /// `None` if the code does not exist.
    pub(super) fn of(code: Option<Whole>) -> Option<Self> {
        Some(match code.map_or(4, |code| code.0) {
            0 => Self::Points,
            1 => Self::Lines,
            2 => Self::LineLoop,
            3 => Self::LineStrip,
            4 => Self::Triangles,
            5 => Self::TriangleStrip,
            6 => Self::TriangleFan,
            _ => return None,
        })
    }

    /// How many elements so many corners make. Incomplete ones are left out.
    pub(super) fn count(self, corners: usize) -> usize {
        match self {
            Self::Points => corners,
            Self::Lines => corners / 2,
            Self::LineLoop if corners < 2 => 0,
            Self::LineLoop => corners,
            Self::LineStrip => corners.saturating_sub(1),
            Self::Triangles => corners / 3,
            Self::TriangleStrip | Self::TriangleFan => corners.saturating_sub(2),
        }
    }

    /// The elements of a row of corners, in the specification's order.
    pub(super) fn elements(self, corners: usize, index: impl Fn(usize) -> u32) -> Elements {
        let numbers = 0..self.count(corners);
        let triangles = |corners_of: &dyn Fn(usize) -> [usize; 3]| {
            Elements::Triangles(numbers.clone().map(|i| corners_of(i).map(&index)).collect())
        };
        let lines = |corners_of: &dyn Fn(usize) -> [usize; 2]| {
            Elements::Lines(numbers.clone().map(|i| corners_of(i).map(&index)).collect())
        };
        match self {
            Self::Points => Elements::Points(numbers.map(index).collect()),
            Self::Lines => lines(&|i| [2 * i, 2 * i + 1]),
            Self::LineLoop => lines(&|i| [i, if i + 1 == corners { 0 } else { i + 1 }]),
            Self::LineStrip => lines(&|i| [i, i + 1]),
            Self::Triangles => triangles(&|i| [3 * i, 3 * i + 1, 3 * i + 2]),
            Self::TriangleStrip => triangles(&|i| [i, i + 1 + i % 2, i + 2 - i % 2]),
            Self::TriangleFan => triangles(&|i| [i + 1, i + 2, 0]),
        }
    }
}

impl Elements {
    /// Every corner's index, one after the other.
    pub(super) fn indices(&self) -> &[u32] {
        match self {
            Self::Triangles(triangles) => triangles.as_flattened(),
            Self::Lines(lines) => lines.as_flattened(),
            Self::Points(points) => points,
        }
    }

    pub(super) fn indices_mut(&mut self) -> &mut [u32] {
        match self {
            Self::Triangles(triangles) => triangles.as_flattened_mut(),
            Self::Lines(lines) => lines.as_flattened_mut(),
            Self::Points(points) => points,
        }
    }
}
