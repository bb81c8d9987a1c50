//! Triangles that are drawn one after the other: what they cover, until there is enough of it to be shaded.

use super::sink::{AnyTest, DepthTest, Sink};
use crate::raster::triangle_id::ORDER_BITS;
use crate::shading::shade::OrderedPacket;
use crate::wide::{Simd, f32x16, mask32x16};

/// Ordered packets are shaded when there are this many: few enough that the nearest cache holds them beside a tile's colours and depths.
const ORDERED_PACKETS: usize = 64;

/// Collects covered blocks in order, and has them shaded when there are enough.
pub(super) struct InOrder<'a, F: FnMut(&mut [OrderedPacket])> {
    pub(super) test: AnyTest,
    /// Whether a triangle's packets may be shaded in parts.
    pub(super) is_plain: bool,
    pub(super) packets: &'a mut Vec<OrderedPacket>,
    pub(super) flush: &'a mut F,
}

impl<F: FnMut(&mut [OrderedPacket])> InOrder<'_, F> {
    /// Whether what is there can be shaded before the next triangle comes.
    #[inline(always)]
    fn can_shade_before(&self, id: u32) -> bool {
        self.is_plain || self.packets.last().is_none_or(|last| last.id >> ORDER_BITS != id >> ORDER_BITS)
    }

    #[inline(never)]
    pub(super) fn finish(&mut self) {
        (self.flush)(self.packets);
        self.packets.clear();
    }
}

impl<S: Simd, F: FnMut(&mut [OrderedPacket])> Sink<S> for InOrder<'_, F> {
    #[inline(always)]
    fn samples(&mut self, s: S, block: usize, inside: mask32x16<S>, z: f32x16<S>, id: u32) {
        let mask = inside.to_bitmask() as u32;
        if mask != 0 {
            if self.packets.len() >= ORDERED_PACKETS && self.can_shade_before(id) {
                self.finish();
            }
            let depth = self.test.depths(s, z).into();
            self.packets.push(OrderedPacket { depth, id, block: block as u32, mask });
        }
    }
}
