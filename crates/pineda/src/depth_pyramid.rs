//! "Is this visible?", asked of a finished depth buffer: hierarchical depth (Greene, Kass and Miller 1993, "Hierarchical Z-Buffer Visibility").

use crate::{Error, MAX_SIZE, Mat4};

/// A finished depth buffer, and above it ever smaller ones that hold the farthest depth of four pixels each: a game or a viewer asks it what need
/// not be drawn.
///
/// Nearer is smaller, as with [`Compare::Less`](crate::Compare::Less). A buffer drawn with reversed z (cleared to 0, tested with
/// [`Compare::Greater`](crate::Compare::Greater)) is given to [`Self::reversed`].
///
/// An answer "hidden" is certain: no point of the box is nearer than what is seen at any of the pixels that it reaches. "Visible" may be
/// wrong: a box covers fewer pixels than the rectangle around it, and is mostly farther away than its nearest corner. (For an exact answer draw
/// the box or the mesh itself, without colour, and count its samples.)
///
/// ```
/// use pineda::*;
/// // A wall at depth 0.5 over the left half of the picture; nothing on the right.
/// let wall = [[0.0, 0.0, 0.5, 1.0], [32.0, 0.0, 0.5, 1.0], [0.0, 64.0, 0.5, 1.0], [32.0, 64.0, 0.5, 1.0]];
/// let mut pass = Pass::new();
/// pass.draw_with(
///     Mesh { vertices: &wall, indices: Indices::Sequential },
///     DrawState { topology: PrimitiveTopology::TriangleStrip, space: Space::Raster, ..DrawState::default() },
///     |&corner| (Vec4::from(corner), ()),
///     |f| Rgba::gray(f.splat(1.0)),
/// );
/// let mut depth = vec![0.0; 64 * 64];
/// let mut target = Target { depth: DepthBuffer::D32F(&mut depth), ..Target::new(64, 64) };
/// Renderer::new(Settings::default())?.render(&pass, &mut target)?;
///
/// let pyramid = DepthPyramid::new(&depth, 64, 64)?;
/// let on_screen = Mat4::IDENTITY;
/// assert!(!pyramid.is_box_visible(&on_screen, [-0.9, -0.5, 0.6], [-0.5, 0.5, 0.9]), "behind the wall");
/// assert!(pyramid.is_box_visible(&on_screen, [-0.9, -0.5, 0.4], [-0.5, 0.5, 0.9]), "through the wall");
/// assert!(pyramid.is_box_visible(&on_screen, [-0.5, -0.5, 0.6], [0.5, 0.5, 0.9]), "beside the wall");
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct DepthPyramid {
    levels: Vec<Level>,
    is_reversed: bool,
}

/// Each element is the farthest depth of four of the level below.
#[derive(Clone, Debug)]
struct Level {
    width: usize,
    height: usize,
    farthest: Vec<f32>,
}

/// By how much a box must be farther away than what hides it: depths along a triangle are computed in f32.
const MARGIN: f64 = 1.0 / (1 << 18) as f64;

/// By how many pixels a corner can move when it is snapped, and a little more.
const REACH: f64 = 1.0 / 128.0;

impl DepthPyramid {
    /// The pyramid over a depth buffer: `width * height` depths in 0 to 1, row by row from the top.
    ///
    /// # Errors
    /// [`Error::TargetSize`] and [`Error::BufferLength`], as for a [`Target`](crate::Target).
    pub fn new(depth: &[f32], width: u32, height: u32) -> Result<Self, Error> {
        Self::build(depth, width, height, false)
    }

    /// The pyramid over a depth buffer where nearer is larger.
    /// ```
    /// use pineda::{DepthPyramid, Mat4};
    /// // Cleared to 0, and a wall at 0.5 over all of it.
    /// let pyramid = DepthPyramid::reversed(&[0.5; 64], 8, 8)?;
    /// assert!(!pyramid.is_box_visible(&Mat4::IDENTITY, [-0.5, -0.5, 0.1], [0.5, 0.5, 0.4]));
    /// assert!(pyramid.is_box_visible(&Mat4::IDENTITY, [-0.5, -0.5, 0.1], [0.5, 0.5, 0.6]));
    /// # Ok::<(), pineda::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn reversed(depth: &[f32], width: u32, height: u32) -> Result<Self, Error> {
        Self::build(depth, width, height, true)
    }

    fn build(depth: &[f32], width: u32, height: u32, is_reversed: bool) -> Result<Self, Error> {
        let sides = 1..=MAX_SIZE;
        if !sides.contains(&width) || !sides.contains(&height) {
            return Err(Error::TargetSize { width, height });
        }
        let expected = width as usize * height as usize;
        if depth.len() != expected {
            return Err(Error::BufferLength {
                buffer: "depth",
                length: depth.len(),
                expected,
                width,
                height,
                samples: 1,
            });
        }
        // Reversed, depths are negative: nearer is smaller again.
        let sign = if is_reversed { -1.0 } else { 1.0 };
        let farthest = depth.iter().map(|z| z * sign).collect();
        let mut levels = vec![Level { width: width as usize, height: height as usize, farthest }];
        while let Some(last) = levels.last().filter(|last| last.width.max(last.height) > 1) {
            levels.push(last.halved());
        }
        Ok(Self { levels, is_reversed })
    }

    /// Whether a box may be visible: `transform` takes its corners to clip space, the whole buffer is the viewport.
    ///
    /// `min` and `max` are the box's smallest and largest coordinates. A box that reaches behind the near plane is visible, and so
    /// is one with a NaN; one that lies beside the picture is not.
    #[must_use]
    pub fn is_box_visible(&self, transform: &Mat4, min: [f32; 3], max: [f32; 3]) -> bool {
        let corners: [[f64; 4]; 8] = std::array::from_fn(|k| {
            let corner = [0, 1, 2].map(|axis| f64::from(if k >> axis & 1 == 0 { min[axis] } else { max[axis] }));
            [0, 1, 2, 3].map(|row| {
                let m = |column: usize| f64::from(transform.0[column][row]);
                m(0) * corner[0] + m(1) * corner[1] + m(2) * corner[2] + m(3)
            })
        });
        if corners.as_flattened().iter().any(|c| !c.is_finite()) {
            return true;
        }
        let all = |outside: fn(&[f64; 4]) -> bool| corners.iter().all(outside);
        if all(|c| c[0] < -c[3]) || all(|c| c[0] > c[3]) || all(|c| c[1] < -c[3]) || all(|c| c[1] > c[3]) {
            return false;
        }
        if all(|c| c[2] < 0.0) || all(|c| c[2] > c[3]) {
            return false;
        }
        if corners.iter().any(|c| c[2] < 0.0 || c[2] > c[3] || c[3] <= 0.0) {
            // Cut by the near plane, it comes as near as anything can; by the far plane, it is rare, and not worth a rule of its own.
            return true;
        }
        let base = &self.levels[0];
        let (width, height) = (base.width as f64, base.height as f64);
        let bounds = |value: &dyn Fn(&[f64; 4]) -> f64| {
            corners
                .iter()
                .map(value)
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
        };
        let (left, right) = bounds(&|c| (c[0] / c[3] + 1.0) * 0.5 * width);
        let (top, bottom) = bounds(&|c| (1.0 - c[1] / c[3]) * 0.5 * height);
        let sign = if self.is_reversed { -1.0 } else { 1.0 };
        let (nearest, _) = bounds(&|c| sign * c[2] / c[3]);
        self.is_rectangle_visible(left, top, right, bottom, nearest)
    }

    /// Whether any pixel of a rectangle shows something farther away than `nearest`, or as far.
    fn is_rectangle_visible(&self, left: f64, top: f64, right: f64, bottom: f64, nearest: f64) -> bool {
        let base = &self.levels[0];
        let first = |v: f64| (v - REACH).floor().max(0.0) as usize;
        let last = |v: f64, size: usize| (v + REACH).floor().min(size as f64 - 1.0);
        let (x1, y1) = (last(right, base.width), last(bottom, base.height));
        if x1 < 0.0 || y1 < 0.0 {
            return false;
        }
        let area = [first(left), first(top), x1 as usize, y1 as usize];
        self.is_beyond(self.levels.len() - 1, 0, 0, area, nearest - MARGIN)
    }

    /// Whether something in `area` (first and last column and row of pixels) and below element (x, y) of a level is at `nearest` or beyond.
    fn is_beyond(&self, level: usize, x: usize, y: usize, area: [usize; 4], nearest: f64) -> bool {
        let here = &self.levels[level];
        let [x0, y0, x1, y1] = area;
        let (left, top, right, bottom) = (x << level, y << level, (x + 1) << level, (y + 1) << level);
        let is_apart = x >= here.width || y >= here.height || right <= x0 || left > x1 || bottom <= y0 || top > y1;
        if is_apart || f64::from(here.farthest[y * here.width + x]) < nearest {
            return false;
        }
        let is_inside = left >= x0 && top >= y0 && right <= x1 + 1 && bottom <= y1 + 1;
        is_inside
            || level == 0
            || [(0, 0), (1, 0), (0, 1), (1, 1)]
                .iter()
                .any(|(dx, dy)| self.is_beyond(level - 1, 2 * x + dx, 2 * y + dy, area, nearest))
    }
}

impl Level {
    /// The level above.
    fn halved(&self) -> Self {
        let (width, height) = (self.width.div_ceil(2), self.height.div_ceil(2));
        let mut farthest = Vec::with_capacity(width * height);
        for rows in self.farthest.chunks(2 * self.width) {
            let (upper, lower) = rows.split_at(self.width);
            // At the border there may be no second row, or no second column.
            let lower = if lower.is_empty() { upper } else { lower };
            for (a, b) in upper.chunks(2).zip(lower.chunks(2)) {
                farthest.push(
                    a.iter().chain(b).fold(f32::NEG_INFINITY, |far, &z| if z > far || z.is_nan() { z } else { far }),
                );
            }
        }
        Self { width, height, farthest }
    }
}
