//! Where in the target a draw goes: viewports and scissor rectangles.

/// The rectangle of the target that clip space's square maps to, and the range that depth maps to.
///
/// Nothing is drawn outside the rectangle. Its corners are rounded to the nearest whole pixel for that purpose only. It may lie anywhere, partly or
/// wholly outside the target.
///
/// With a negative height the rectangle reaches from `y` upwards, and the picture is upside down, as in Vulkan since 1.1 (where that is how y
/// comes to point up; here it does already). Winding is decided on the picture: what was a front shows its back. In [`Space::Raster`](crate::Space::Raster)
/// the sign makes no difference.
///
/// ```
/// use pineda::Viewport;
/// let upright = Viewport::whole(640, 480);
/// let upside_down = Viewport { y: 480.0, height: -480.0, ..upright };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewport {
    /// Its left border in pixels from the target's.
    pub x: f32,
    /// Its upper border (the lower one if the height is negative) in pixels from the target's upper border.
    pub y: f32,
    /// Pixels across.
    pub width: f32,
    /// Pixels down; negative to turn the picture upside down.
    pub height: f32,
    /// What z = 0 maps to, in 0 to 1.
    pub min_depth: f32,
    /// What z = w maps to, in 0 to 1.
    pub max_depth: f32,
}

impl Viewport {
    /// The whole of a target, with depth 0 to 1.
    #[must_use]
    pub fn whole(width: u32, height: u32) -> Self {
        Self { x: 0.0, y: 0.0, width: width as f32, height: height as f32, min_depth: 0.0, max_depth: 1.0 }
    }

    pub(crate) fn validate(&self) -> Result<(), &'static str> {
        let Self { x, y, width, height, min_depth, max_depth } = *self;
        let limit = 2.0 * crate::MAX_SIZE as f32;
        if ![x, y, width, height, min_depth, max_depth].iter().all(|v| v.is_finite()) {
            return Err("all of its numbers must be finite");
        }
        if width <= 0.0 || height == 0.0 {
            return Err("its width must be positive and its height must not be 0");
        }
        let (top, bottom) = (y.min(y + height), y.max(y + height));
        if x < -limit || top < -limit || x + width > limit || bottom > limit {
            return Err("it must lie within 32,768 pixels of the target's corner");
        }
        if ![min_depth, max_depth].iter().all(|d| (0.0..=1.0).contains(d)) {
            return Err("its depths must lie in 0 to 1");
        }
        Ok(())
    }
}

/// A rectangle of whole pixels that bounds what a draw covers. It may reach beyond the target, and may be empty.
///
/// ```
/// use pineda::{DrawState, Scissor};
/// let state = DrawState { scissor: Some(Scissor { x: 10, y: 20, width: 300, height: 200 }), ..DrawState::default() };
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scissor {
    /// Its first column, from the target's left border.
    pub x: i32,
    /// Its first row, from the target's upper border.
    pub y: i32,
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
}
