//! The depth test and depth bias.

/// The depth test: a fragment passes if `compare(its depth, the target's depth)`, and then replaces it if `write`.
///
/// Reversed z, for which 1 is near, so that floats are finest far away:
///
/// ```
/// use pineda::*;
/// let layers = [0.25, 0.75, 0.5].map(|z| [[0.0, 0.0, z, 1.0], [0.0, 64.0, z, 1.0], [64.0, 64.0, z, 1.0]]);
/// let nearer = DepthState { compare: Compare::Greater, write: true };
/// let mut pass = Pass::new();
/// pass.clear_depth = Some(0.0);
/// for corners in &layers {
///     pass.draw_with(
///         Mesh { vertices: &corners[..], indices: Indices::Sequential },
///         DrawState { depth: nearer, space: Space::Raster, ..DrawState::default() },
///         |&corner: &[f32; 4]| (corner.into(), ()),
///         |f| Rgba::gray(f.z()),
///     );
/// }
/// let mut depth = vec![0.0; 64 * 64];
/// let mut target = Target { depth: DepthBuffer::D32F(&mut depth), ..Target::new(64, 64) };
/// Renderer::new(Settings::default())?.render(&pass, &mut target)?;
/// assert_eq!((depth[63 * 64], depth[63]), (0.75, 0.0));
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DepthState {
    /// The comparison.
    pub compare: Compare,
    /// Whether passing fragments write their depth.
    pub write: bool,
}

impl DepthState {
    /// No test and no writing: the painter's order.
    pub const OFF: Self = Self { compare: Compare::Always, write: false };
}

impl Default for DepthState {
    fn default() -> Self {
        Self { compare: Compare::Less, write: true }
    }
}

/// Moves a triangle's depths, so that a decal does not fight with what it lies on, or a shadow map with what casts the shadow:
///
/// ```text
/// offset = constant * 2^(exponent(max |z|) - 23) + slope * max(|dz/dx|, |dz/dy|)
/// ```
///
/// limited to `clamp` if that is not 0: from above if it is positive, from below if it is negative. The exponent is the one of the largest depth in the
/// triangle; on unorm depth buffers the power of two is the step from one code to the next instead. Depths are in the target's range, slopes a pixel.
/// The sum is clamped to the viewport's range of depths.
///
/// ```
/// use pineda::{DepthBias, DrawState};
/// // Towards the eye, by two units and twice the slope.
/// let decal = DrawState { depth_bias: DepthBias { constant: -2.0, slope: -2.0, clamp: 0.0 }, ..DrawState::default() };
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct DepthBias {
    /// In units of the depth's last place. Finite.
    pub constant: f32,
    /// In slopes of the triangle. Finite.
    pub slope: f32,
    /// What the offset may not exceed; 0 for no such limit. Finite.
    pub clamp: f32,
}

impl DepthBias {
    /// Depths stay as they are.
    pub const NONE: Self = Self { constant: 0.0, slope: 0.0, clamp: 0.0 };

    pub(crate) fn validate(&self) -> Result<(), &'static str> {
        let all = [("constant", self.constant), ("slope", self.slope), ("clamp", self.clamp)];
        all.into_iter().find(|(_, value)| !value.is_finite()).map_or(Ok(()), |(field, _)| Err(field))
    }
}

/// A comparison of a fragment's depth with the one that is there, or of a [stencil](crate::StencilFace) reference; with an example at [`DepthState`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Compare {
    /// Nothing passes.
    Never,
    /// Nearer passes.
    #[default]
    Less,
    /// The same passes.
    Equal,
    /// Nearer or the same passes.
    LessEqual,
    /// Farther passes.
    Greater,
    /// Anything but the same passes.
    NotEqual,
    /// Farther or the same passes.
    GreaterEqual,
    /// Everything passes.
    Always,
}

impl Compare {
    /// Every comparison.
    pub const ALL: [Self; 8] = [
        Self::Never,
        Self::Less,
        Self::Equal,
        Self::LessEqual,
        Self::Greater,
        Self::NotEqual,
        Self::GreaterEqual,
        Self::Always,
    ];

    /// Whether it passes for (less, equal, greater).
    pub(crate) fn outcomes(self) -> [bool; 3] {
        match self {
            Self::Never => [false, false, false],
            Self::Less => [true, false, false],
            Self::Equal => [false, true, false],
            Self::LessEqual => [true, true, false],
            Self::Greater => [false, false, true],
            Self::NotEqual => [true, false, true],
            Self::GreaterEqual => [false, true, true],
            Self::Always => [true, true, true],
        }
    }
}
