//! How a fragment's colour meets the one that is there: WebGPU's and Vulkan's blend equations, in the lanes.
//!
//! What is exact about it says [`Blend`].

use crate::pass::{Blend, BlendComponent, BlendFactor, BlendOperation};
use crate::target::format::{Channels, clamp_unorm};
use crate::wide::{Simd, f32x16};

/// The colour to be stored, before clamping: `source`, the `second` source and `target` decoded, in linear light. `is_unorm` says that the target holds
/// numbers from 0 to 1.
#[inline(always)]
pub(crate) fn blend<S: Simd>(
    s: S,
    blend: &Blend,
    is_unorm: bool,
    source: Channels<S>,
    second: Channels<S>,
    target: Channels<S>,
) -> Channels<S> {
    let mut operands = Operands { source, second, target, constant: [f32x16::splat(s, 0.0); 4] };
    let mut k = 0;
    while k < 4 {
        operands.constant[k] = f32x16::splat(s, blend.constant[k]);
        if is_unorm {
            operands.source[k] = clamp_unorm(s, operands.source[k]);
            operands.second[k] = clamp_unorm(s, operands.second[k]);
            operands.constant[k] = clamp_unorm(s, operands.constant[k]);
        }
        k += 1;
    }
    let mut out = operands.source;
    let mut k = 0;
    while k < 4 {
        let component = if k < 3 { &blend.color } else { &blend.alpha };
        out[k] = operands.channel(s, component, k);
        k += 1;
    }
    out
}

/// What factors are taken from.
#[derive(Clone, Copy)]
struct Operands<S: Simd> {
    source: Channels<S>,
    second: Channels<S>,
    target: Channels<S>,
    constant: Channels<S>,
}

impl<S: Simd> Operands<S> {
    /// Channel `k`, blended.
    #[inline(always)]
    fn channel(&self, s: S, component: &BlendComponent, k: usize) -> f32x16<S> {
        let (source, target) = (self.source[k], self.target[k]);
        if component.replaces() {
            return source;
        }
        match component.operation {
            // In the target's favour where both are equal: it matters for the sign of 0.
            BlendOperation::Min => (source.simd_lt(target) | !target.simd_eq(target)).select(source, target),
            BlendOperation::Max => (source.simd_gt(target) | !target.simd_eq(target)).select(source, target),
            operation => {
                let source = self.times(s, source, component.source, k);
                let target = self.times(s, target, component.target, k);
                match operation {
                    BlendOperation::Subtract => source - target,
                    BlendOperation::ReverseSubtract => target - source,
                    _ => source + target,
                }
            }
        }
    }

    /// A value times a factor.
    #[inline(always)]
    fn times(&self, s: S, value: f32x16<S>, factor: BlendFactor, k: usize) -> f32x16<S> {
        let Self { source, second, target, constant } = self;
        let one = f32x16::splat(s, 1.0);
        value
            * match factor {
                // Not a product: that of 0 and infinity is NaN.
                BlendFactor::Zero => return f32x16::splat(s, 0.0),
                BlendFactor::One => return value,
                BlendFactor::Source => source[k],
                BlendFactor::OneMinusSource => one - source[k],
                BlendFactor::SourceAlpha => source[3],
                BlendFactor::OneMinusSourceAlpha => one - source[3],
                BlendFactor::Target => target[k],
                BlendFactor::OneMinusTarget => one - target[k],
                BlendFactor::TargetAlpha => target[3],
                BlendFactor::OneMinusTargetAlpha => one - target[3],
                BlendFactor::SourceAlphaSaturated => {
                    if k == 3 {
                        return value;
                    }
                    source[3].min(one - target[3])
                }
                BlendFactor::Constant => constant[k],
                BlendFactor::OneMinusConstant => one - constant[k],
                BlendFactor::ConstantAlpha => constant[3],
                BlendFactor::OneMinusConstantAlpha => one - constant[3],
                BlendFactor::Source1 => second[k],
                BlendFactor::OneMinusSource1 => one - second[k],
                BlendFactor::Source1Alpha => second[3],
                BlendFactor::OneMinusSource1Alpha => one - second[3],
            }
    }
}
