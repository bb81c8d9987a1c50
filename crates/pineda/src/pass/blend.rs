//! Blend states: how a fragment's colour meets the one that is there, and which channels it is written to.

/// How a fragment's colour (the *source*) meets the target's: colour and alpha apart, each `operation(source * factor, target * factor)`.
///
/// The usual cases are constants. Anything else that WebGPU and Vulkan have is put together from factors and operations; those factors that take a second
/// colour from the shader want it to return a [`DualSource`](crate::DualSource).
///
/// ```
/// use pineda::{Blend, BlendComponent, BlendFactor, DrawState};
/// let glass = DrawState { blend: Blend::ALPHA, ..DrawState::default() };
/// // Fades the target towards black by a constant, and leaves its alpha alone.
/// let fade = Blend {
///     color: BlendComponent { source: BlendFactor::Zero, target: BlendFactor::Constant, ..BlendComponent::REPLACE },
///     alpha: BlendComponent::KEEP,
///     constant: [0.9; 4],
/// };
/// # assert_ne!(glass.blend, fade);
/// ```
///
/// What is computed, to the bit:
///
/// - In f32, in linear light: an sRGB target is decoded before and encoded after. Each product and the sum (or difference) is rounded once.
/// - On 8-bit and 16-bit fixed-point targets the sources and the constant are clamped to 0 to 1 first, NaN to 0, as Vulkan asks ("Blending"); the result is clamped when it is
///   stored. On float targets nothing is clamped.
/// - [`BlendFactor::Zero`] leaves its side out: it makes 0 of infinities and NaN, too. A component that takes the source times one and the target
///   times zero, added, is the source as it is, with the sign of a zero.
/// - [`BlendOperation::Min`] and [`BlendOperation::Max`] take the number if the other one is NaN, and the target of two equals. Apart from that
///   NaN goes on as IEEE 754 has it, and is stored with one set of bits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blend {
    /// For red, green and blue.
    pub color: BlendComponent,
    /// For alpha.
    pub alpha: BlendComponent,
    /// What [`BlendFactor::Constant`] and its like stand for: red, green, blue, alpha, in linear light.
    pub constant: [f32; 4],
}

impl Blend {
    /// The source replaces the target.
    pub const OPAQUE: Self = Self::both(BlendComponent::REPLACE);

    /// Porter and Duff's "over" with straight alpha: `c = s.c s.a + d.c (1 - s.a)`, `a = s.a + d.a (1 - s.a)`.
    pub const ALPHA: Self = Self {
        color: BlendComponent { source: BlendFactor::SourceAlpha, ..BlendComponent::OVER },
        ..Self::both(BlendComponent::OVER)
    };

    /// "Over" with colours that are already multiplied by their alpha: `c = s.c + d.c (1 - s.a)`, alpha likewise.
    pub const PREMULTIPLIED: Self = Self::both(BlendComponent::OVER);

    /// Light upon light: `c = s.c + d.c`, alpha likewise.
    pub const ADD: Self = Self::both(BlendComponent { target: BlendFactor::One, ..BlendComponent::REPLACE });

    /// A filter before it: `c = s.c d.c`, alpha likewise.
    pub const MULTIPLY: Self = Self::both(BlendComponent { source: BlendFactor::Target, ..BlendComponent::REPLACE });

    /// The smaller of the two, channel by channel.
    pub const MIN: Self = Self::both(BlendComponent { operation: BlendOperation::Min, ..BlendComponent::REPLACE });

    /// The larger of the two, channel by channel.
    pub const MAX: Self = Self::both(BlendComponent { operation: BlendOperation::Max, ..BlendComponent::REPLACE });

    /// The same for colour and alpha; the constant is 0.
    #[must_use]
    pub const fn both(component: BlendComponent) -> Self {
        Self { color: component, alpha: component, constant: [0.0; 4] }
    }

    /// Whether the source replaces the target, so that what is there need not be known.
    pub(crate) fn replaces(&self) -> bool {
        self.color.replaces() && self.alpha.replaces()
    }
}

impl Default for Blend {
    fn default() -> Self {
        Self::OPAQUE
    }
}

/// How colour or alpha is blended: `operation(source * factor, target * factor)`.
///
/// ```
/// use pineda::*;
/// // The target less the source.
/// let darker =
///     BlendComponent { source: BlendFactor::One, operation: BlendOperation::ReverseSubtract, target: BlendFactor::One };
/// let blend = Blend { color: darker, alpha: BlendComponent::KEEP, constant: [0.0; 4] };
/// let mut pass = Pass::new();
/// pass.clear_color = Some([0.75; 4]);
/// pass.draw_with(
///     Mesh { vertices: &[[0.0, 0.0], [0.0, 2.0], [2.0, 0.0]], indices: Indices::Sequential },
///     DrawState { blend, space: Space::Raster, ..DrawState::default() },
///     |&[x, y]| (Vec4::from([x, y, 0.5, 1.0]), ()),
///     |f| Rgba::gray(f.splat(0.25)),
/// );
/// let mut pixel = [[0.0; 4]];
/// let mut target = Target { color: ColorBuffer::Rgba32F(&mut pixel), ..Target::new(1, 1) };
/// Renderer::new(Settings::default())?.render(&pass, &mut target)?;
/// assert_eq!(pixel, [[0.5, 0.5, 0.5, 0.75]]);
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct BlendComponent {
    /// What the fragment's value is multiplied by.
    pub source: BlendFactor,
    /// What becomes of the two products.
    pub operation: BlendOperation,
    /// What the target's value is multiplied by.
    pub target: BlendFactor,
}

impl BlendComponent {
    /// The source replaces the target.
    pub const REPLACE: Self =
        Self { source: BlendFactor::One, operation: BlendOperation::Add, target: BlendFactor::Zero };

    /// The target stays.
    pub const KEEP: Self = Self { source: BlendFactor::Zero, operation: BlendOperation::Add, target: BlendFactor::One };

    /// `s + d (1 - s.a)`.
    pub const OVER: Self =
        Self { source: BlendFactor::One, operation: BlendOperation::Add, target: BlendFactor::OneMinusSourceAlpha };

    #[inline(always)]
    pub(crate) fn replaces(&self) -> bool {
        matches!((self.source, self.operation, self.target), (BlendFactor::One, BlendOperation::Add, BlendFactor::Zero))
    }
}

/// What a colour is multiplied by before it is blended: for each channel its own number. Of alpha, the alpha of all that is named here.
/// There is an example at [`BlendComponent`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BlendFactor {
    /// 0.
    Zero,
    /// 1.
    One,
    /// The fragment's colour.
    Source,
    /// 1 less the fragment's colour.
    OneMinusSource,
    /// The fragment's alpha.
    SourceAlpha,
    /// 1 less the fragment's alpha.
    OneMinusSourceAlpha,
    /// The target's colour.
    Target,
    /// 1 less the target's colour.
    OneMinusTarget,
    /// The target's alpha.
    TargetAlpha,
    /// 1 less the target's alpha.
    OneMinusTargetAlpha,
    /// The smaller of the fragment's alpha and 1 less the target's (the latter if they are equal or one is NaN); 1 for alpha.
    SourceAlphaSaturated,
    /// [`Blend::constant`].
    Constant,
    /// 1 less [`Blend::constant`].
    OneMinusConstant,
    /// The alpha of [`Blend::constant`].
    ConstantAlpha,
    /// 1 less the alpha of [`Blend::constant`].
    OneMinusConstantAlpha,
    /// The fragment's [second source](crate::DualSource).
    Source1,
    /// 1 less the fragment's second source.
    OneMinusSource1,
    /// The alpha of the fragment's second source.
    Source1Alpha,
    /// 1 less the alpha of the fragment's second source.
    OneMinusSource1Alpha,
}

impl BlendFactor {
    /// Every factor.
    pub const ALL: [Self; 19] = [
        Self::Zero,
        Self::One,
        Self::Source,
        Self::OneMinusSource,
        Self::SourceAlpha,
        Self::OneMinusSourceAlpha,
        Self::Target,
        Self::OneMinusTarget,
        Self::TargetAlpha,
        Self::OneMinusTargetAlpha,
        Self::SourceAlphaSaturated,
        Self::Constant,
        Self::OneMinusConstant,
        Self::ConstantAlpha,
        Self::OneMinusConstantAlpha,
        Self::Source1,
        Self::OneMinusSource1,
        Self::Source1Alpha,
        Self::OneMinusSource1Alpha,
    ];
}

/// What becomes of source and target, each times its factor; with an example at [`BlendComponent`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BlendOperation {
    /// Their sum.
    Add,
    /// Source less target.
    Subtract,
    /// Target less source.
    ReverseSubtract,
    /// The smaller of the two, without factors.
    Min,
    /// The larger of the two, without factors.
    Max,
}

impl BlendOperation {
    /// Every operation.
    pub const ALL: [Self; 5] = [Self::Add, Self::Subtract, Self::ReverseSubtract, Self::Min, Self::Max];
}

/// The channels of the target that a draw writes; the others stay as they are, to the bit.
///
/// ```
/// use pineda::{ColorMask, DrawState};
/// // Fills the depth buffer and no colour: the fragment stage does not even run.
/// let prepass = DrawState { color_mask: ColorMask::NONE, ..DrawState::default() };
/// # assert_ne!(prepass, DrawState::default());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ColorMask {
    /// Red.
    pub r: bool,
    /// Green.
    pub g: bool,
    /// Blue.
    pub b: bool,
    /// Alpha.
    pub a: bool,
}

impl ColorMask {
    /// All four.
    pub const ALL: Self = Self { r: true, g: true, b: true, a: true };
    /// Red, green and blue.
    pub const COLOR: Self = Self { a: false, ..Self::ALL };
    /// Alpha.
    pub const ALPHA: Self = Self { a: true, ..Self::NONE };
    /// None: depth and ids only.
    pub const NONE: Self = Self { r: false, g: false, b: false, a: false };

    #[inline(always)]
    pub(crate) fn channels(self) -> [bool; 4] {
        [self.r, self.g, self.b, self.a]
    }
}

impl Default for ColorMask {
    fn default() -> Self {
        Self::ALL
    }
}
