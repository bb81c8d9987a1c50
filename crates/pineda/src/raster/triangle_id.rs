//! What a tile's visibility buffer holds for each sample: which triangle, and in which order to take its vertices.

/// A triangle of the batch that is being drawn, and its canonical vertex order, in 32 bits; 0 is none.
///
/// The canonical order starts at the vertex with the smallest (y, x) on the raster and goes round clockwise on the picture.
/// Whatever is computed from the vertices is computed in this order, so that neither the rotation nor the winding in which a
/// triangle was submitted changes a bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct TriangleId(pub(crate) u32);

/// More triangles than this do not go into one batch.
pub(crate) const MAX_BATCH_TRIANGLES: usize = (1 << 29) - 2;

/// Bits that hold the vertex order.
pub(crate) const ORDER_BITS: u32 = 3;

/// A clipped triangle's order is found from its positions. Its winding is kept here.
pub(crate) const CLIPPED_CLOCKWISE: u32 = 6;
pub(crate) const CLIPPED_COUNTER_CLOCKWISE: u32 = 7;

/// By order code, which of the submitted vertices come first, second and third. Codes 0 to 2 were submitted clockwise on the picture,
/// starting at the vertex of that number; 3 to 5 counter-clockwise.
pub(crate) const ORDERS: [[u8; 3]; 8] =
    [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [1, 0, 2], [2, 1, 0], [0, 1, 2], [0, 1, 2]];

impl TriangleId {
    /// The word for triangle `number` of the batch, with order code 0.
    pub(crate) fn first(number: usize) -> u32 {
        debug_assert!(number < MAX_BATCH_TRIANGLES);
        (number as u32 + 1) << ORDER_BITS
    }

    /// The triangle's number within the batch.
    #[inline(always)]
    pub(crate) fn number(self) -> usize {
        ((self.0 >> ORDER_BITS) as usize).wrapping_sub(1)
    }

    #[inline(always)]
    pub(crate) fn order_code(self) -> u32 {
        self.0 & 7
    }

    #[inline(always)]
    pub(crate) fn is_clipped(self) -> bool {
        self.order_code() >= CLIPPED_CLOCKWISE
    }
}
