//! Stencil states.

use super::Compare;

/// The stencil test of a draw, and what it leaves in the stencil buffer; front and back faces each have their own.
///
/// A draw with a stencil test is drawn in submission order, its hidden fragments shaded too unless the depth test stops them. A target without a stencil buffer has one
/// nevertheless, which the pass clears to [`Pass::clear_stencil`](crate::Pass::clear_stencil) or 0, and forgets.
///
/// ```
/// use pineda::{Compare, DrawState, StencilFace, StencilOperation, StencilState};
/// // Marks what is drawn with 1.
/// let mark = StencilFace { pass: StencilOperation::Replace, reference: 1, ..StencilFace::IGNORE };
/// // Draws only where there is no mark.
/// let outside = StencilFace { compare: Compare::NotEqual, reference: 1, ..StencilFace::IGNORE };
/// let [first, second] = [mark, outside]
///     .map(|face| DrawState { stencil: Some(StencilState::both(face)), ..DrawState::default() });
/// # assert_ne!(first, second);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub struct StencilState {
    /// For triangles that show their front.
    pub front: StencilFace,
    /// For triangles that show their back.
    pub back: StencilFace,
}

impl StencilState {
    /// The same for both faces.
    #[must_use]
    pub const fn both(face: StencilFace) -> Self {
        Self { front: face, back: face }
    }
}

/// The stencil test of one face: a fragment passes if `compare(reference & read_mask, stored & read_mask)`. Then one of three operations is applied to
/// what is stored, to those of its bits that `write_mask` names. A fragment that its shader discards changes nothing.
///
/// How many triangles lie over each pixel:
///
/// ```
/// use pineda::*;
/// let corners = [[0.0, 0.0], [0.0, 64.0], [64.0, 64.0], [0.0, 0.0], [0.0, 32.0], [64.0, 32.0]];
/// let count = StencilFace { pass: StencilOperation::IncrementClamp, ..StencilFace::IGNORE };
/// let mut pass = Pass::new();
/// pass.draw_with(
///     Mesh { vertices: &corners, indices: Indices::Sequential },
///     DrawState {
///         stencil: Some(StencilState::both(count)),
///         depth: DepthState::OFF,
///         color_mask: ColorMask::NONE,
///         space: Space::Raster,
///         ..DrawState::default()
///     },
///     |&[x, y]| (Vec4::from([x, y, 0.5, 1.0]), ()),
///     |f| Rgba::gray(f.z()),
/// );
/// let mut stencil = vec![0; 64 * 64];
/// let mut target = Target { stencil: Some(&mut stencil), ..Target::new(64, 64) };
/// Renderer::new(Settings::default())?.render(&pass, &mut target)?;
/// assert_eq!([0, 31, 63].map(|row| stencil[64 * row]), [1, 2, 1]);
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct StencilFace {
    /// The comparison of the reference with what is stored.
    pub compare: Compare,
    /// What becomes of what is stored if the stencil test fails.
    pub fail: StencilOperation,
    /// If the stencil test passes and the depth test fails.
    pub depth_fail: StencilOperation,
    /// If both pass.
    pub pass: StencilOperation,
    /// The bits that are compared.
    pub read_mask: u8,
    /// The bits that are written.
    pub write_mask: u8,
    /// What is compared with, and what [`StencilOperation::Replace`] stores.
    pub reference: u8,
}

impl StencilFace {
    /// Everything passes, nothing is changed; all bits are read and written.
    pub const IGNORE: Self = Self {
        compare: Compare::Always,
        fail: StencilOperation::Keep,
        depth_fail: StencilOperation::Keep,
        pass: StencilOperation::Keep,
        read_mask: 0xff,
        write_mask: 0xff,
        reference: 0,
    };
}

impl Default for StencilFace {
    fn default() -> Self {
        Self::IGNORE
    }
}

/// What becomes of a stencil value; with an example at [`StencilFace`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum StencilOperation {
    /// It stays.
    #[default]
    Keep,
    /// 0.
    Zero,
    /// The reference.
    Replace,
    /// One more, 255 at the most.
    IncrementClamp,
    /// One less, 0 at the least.
    DecrementClamp,
    /// Each bit turned over.
    Invert,
    /// One more; 0 after 255.
    IncrementWrap,
    /// One less; 255 after 0.
    DecrementWrap,
}

impl StencilOperation {
    /// Every operation.
    pub const ALL: [Self; 8] = [
        Self::Keep,
        Self::Zero,
        Self::Replace,
        Self::IncrementClamp,
        Self::DecrementClamp,
        Self::Invert,
        Self::IncrementWrap,
        Self::DecrementWrap,
    ];
}
