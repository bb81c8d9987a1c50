//! Several colour buffers: what each of them starts with, how each is blended, and what can be wrong with that.

use super::{Blend, BlendComponent, BlendFactor, BlendOperation, ColorMask, DrawState, Pass};
use crate::shading::OutputKind;
use crate::target::format::ColorFormat;
use crate::target::{ColorBuffer, MAX_COLORS};
use crate::{Error, Target};

/// How a draw meets one of several colour buffers, in place of [`DrawState::blend`] and [`DrawState::color_mask`]; see [`DrawState::colors`].
///
/// ```
/// use pineda::{Blend, ColorMask, ColorState};
/// let red_light = ColorState { blend: Blend::ADD, mask: ColorMask { r: true, ..ColorMask::NONE } };
/// # assert_ne!(red_light, ColorState::default());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct ColorState {
    /// How the fragment's colour meets the buffer's.
    pub blend: Blend,
    /// Which channels of the buffer are written.
    pub mask: ColorMask,
}

/// What a pass does with one colour buffer before the first draw, and after the last; see [`Pass::color_ops`].
///
/// ```
/// use pineda::{ColorOps, Load, Pass, Store};
/// let mut pass = Pass::new();
/// // Goes on from what is there, and throws away what becomes of it.
/// pass.color_ops[1] = ColorOps { load: Load::Keep, store: Store::Discard };
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct ColorOps {
    /// What the buffer starts with.
    pub load: Load,
    /// What becomes of it.
    pub store: Store,
}

/// What a colour buffer starts with.
///
/// ```
/// use pineda::*;
/// let mut pixels = vec![[0.0; 4]; 8 * 8];
/// let mut draw_nothing = |load, store| {
///     let mut pass = Pass::new();
///     pass.color_ops[0] = ColorOps { load, store };
///     let mut target = Target { color: ColorBuffer::Rgba32F(&mut pixels), ..Target::new(8, 8) };
///     Renderer::new(Settings::default())?.render(&pass, &mut target)?;
///     Ok::<_, Error>(pixels[0])
/// };
/// assert_eq!(draw_nothing(Load::Clear([0.25; 4].into()), Store::Keep)?, [0.25; 4]);
/// assert_eq!(draw_nothing(Load::Keep, Store::Keep)?, [0.25; 4]);
/// assert_eq!(draw_nothing(Load::Clear([1.0; 4].into()), Store::Discard)?, [0.25; 4]);
/// // Transparent black, which is what a pass starts with.
/// assert_eq!(draw_nothing(Load::ByPass, Store::Keep)?, [0.0; 4]);
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub enum Load {
    /// What [`Pass::clear_color`] says. If that is a colour, a buffer of integers starts with zeros.
    #[default]
    ByPass,
    /// What it holds.
    Keep,
    /// A value of its own.
    Clear(ClearColor),
}

/// What becomes of a colour buffer; with an example at [`Load`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Store {
    /// It holds what was drawn.
    #[default]
    Keep,
    /// It holds what it held before the pass. Nothing is computed for it either.
    Discard,
}

/// A colour to start with, of the kind of numbers that the buffer holds. Any array of four turns into one; numbers
/// without a suffix are signed there.
///
/// ```
/// use pineda::{ClearColor, Load};
/// let (sky, nothing) = (Load::Clear([0.2, 0.4, 0.8, 1.0].into()), Load::Clear([u32::MAX; 4].into()));
/// assert_eq!(nothing, Load::Clear(ClearColor::Uint([u32::MAX; 4])));
/// # assert_ne!(sky, nothing);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ClearColor {
    /// Red, green, blue in linear light, and alpha.
    Float([f32; 4]),
    /// Unsigned integers.
    Uint([u32; 4]),
    /// Signed integers.
    Int([i32; 4]),
}

impl From<[f32; 4]> for ClearColor {
    fn from(color: [f32; 4]) -> Self {
        Self::Float(color)
    }
}

impl From<[u32; 4]> for ClearColor {
    fn from(color: [u32; 4]) -> Self {
        Self::Uint(color)
    }
}

impl From<[i32; 4]> for ClearColor {
    fn from(color: [i32; 4]) -> Self {
        Self::Int(color)
    }
}

impl ClearColor {
    fn kind(self) -> OutputKind {
        match self {
            Self::Float(_) => OutputKind::Float,
            Self::Uint(_) => OutputKind::Uint,
            Self::Int(_) => OutputKind::Int,
        }
    }

    /// As a tile stores it.
    fn words(self, format: ColorFormat) -> [u32; 4] {
        match self {
            Self::Float(color) => format.encoded(color),
            Self::Uint(color) => color,
            Self::Int(color) => color.map(i32::cast_unsigned),
        }
    }
}

impl Pass<'_> {
    /// What colour buffer `k` starts with, as a tile stores it; `None` is what it holds.
    pub(crate) fn start_of(&self, k: usize, format: ColorFormat) -> Option<[u32; 4]> {
        match self.color_ops[k].load {
            Load::Keep => None,
            Load::ByPass => self.clear_color.map(|color| format.encoded(color)),
            Load::Clear(color) => Some(color.words(format)),
        }
    }
}

impl DrawState {
    /// How the draw meets colour buffer `k`.
    #[inline(always)]
    pub(crate) fn color(&self, k: usize) -> ColorState {
        match self.colors[k & (MAX_COLORS - 1)] {
            Some(state) => state,
            None => ColorState { blend: self.blend, mask: self.color_mask },
        }
    }

    /// Whether none of the first `outputs` colour buffers is written.
    pub(crate) fn writes_no_color(&self, outputs: usize) -> bool {
        (0..outputs.min(MAX_COLORS)).all(|k| self.color(k).mask == ColorMask::NONE)
    }

    /// Whether all channels of the first `outputs` colour buffers are replaced.
    pub(crate) fn replaces_colors(&self, outputs: usize) -> bool {
        (0..outputs.min(MAX_COLORS)).all(|k| {
            let ColorState { blend, mask } = self.color(k);
            mask == ColorMask::ALL && blend.replaces()
        })
    }
}

impl Blend {
    /// Whether a factor takes the shader's second colour.
    fn takes_second_source(&self) -> bool {
        let is_second = |factor| {
            use BlendFactor::{OneMinusSource1, OneMinusSource1Alpha, Source1, Source1Alpha};
            matches!(factor, Source1 | OneMinusSource1 | Source1Alpha | OneMinusSource1Alpha)
        };
        let takes = |component: &BlendComponent| {
            let has_factors = !matches!(component.operation, BlendOperation::Min | BlendOperation::Max);
            has_factors && (is_second(component.source) || is_second(component.target))
        };
        takes(&self.color) || takes(&self.alpha)
    }
}

// As the arrays of states and operations have it; and `DrawState::color` wants a power of two.
const _: () = assert!(MAX_COLORS == 8);

/// Whether a valid target's colour buffers and a pass's draws go together.
pub(crate) fn check(pass: &Pass<'_>, target: &Target<'_>) -> Result<(), Error> {
    let count = target.color_count();
    let formats = || (0..count).map(|k| (k, target.color_buffer(k).map_or(ColorFormat::None, ColorBuffer::format)));
    for (color, format) in formats().filter(|&(_, format)| format != ColorFormat::None) {
        let (Load::Clear(clear), holds) = (pass.color_ops[color].load, format.kind()) else { continue };
        if clear.kind() != holds {
            return Err(Error::ClearKind { color, clear: clear.kind(), holds });
        }
    }
    for (draw, call) in pass.draws.iter().enumerate() {
        let (state, outputs) = (call.state(), call.outputs());
        if count == 0 || (0..count).all(|k| state.color(k).mask == ColorMask::NONE) {
            continue;
        }
        if outputs.kinds.len() > count {
            return Err(Error::OutputCount { draw, outputs: outputs.kinds.len(), colors: count });
        }
        for (color, format) in formats() {
            let ColorState { blend, mask } = state.color(color);
            if mask == ColorMask::NONE {
                continue;
            }
            let Some(&returned) = outputs.kinds.get(color) else {
                return Err(Error::OutputCount { draw, outputs: outputs.kinds.len(), colors: count });
            };
            if format == ColorFormat::None {
                continue;
            }
            let holds = format.kind();
            if returned != holds {
                return Err(Error::OutputKind { draw, color, returned, holds });
            }
            if holds != OutputKind::Float && !blend.replaces() {
                return Err(Error::BlendedIntegers { draw, color });
            }
            if blend.takes_second_source() {
                if count > 1 {
                    return Err(Error::SecondSourceColors { draw, colors: count });
                }
                if !outputs.has_second_source {
                    return Err(Error::NoSecondSource { draw });
                }
            }
        }
    }
    Ok(())
}
