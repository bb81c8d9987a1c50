//! What a triangle covers, worked out slowly and exactly, to judge `pineda` by.
//!
//! The rules are those of `../shared/raster-rules.md`, written down as literally as they can be: integers and rationals
//! only, no rounding but the one that the rules ask for (snapping), and not a line in common with the rasterizer. Each
//! file answers one question:
//!
//! | file | question |
//! | --- | --- |
//! | `snap.rs` | where on the grid of 1/256 pixel does a position land? |
//! | `project.rs` | where in the picture does a clip-space vertex land, exactly? |
//! | `coverage.rs` | does this snapped triangle own this pixel? |
//! | `conservative.rs` | which pixels does it touch, which does it cover whole? |
//! | `lines.rs` | which pixels does a line one pixel wide own, which a point? |
//! | `area.rs` | how much of a pixel does a convex polygon cover? |
//! | `interpolate.rs` | what are depth and attributes there, and how far off is an answer in floats? |
//! | `visible.rs` | what does a clip-space triangle cover, whatever the signs of w, without clipping? |
//! | `picture.rs` | how does that look in a test? |
//! | `cases/` | which triangles are worth trying? |
//!
//! ```
//! use pineda_oracle::{coverage, picture};
//!
//! // A square of 2 x 2 pixels, corners on pixel centres, cut along its diagonal. Snapped positions: 256 is one pixel.
//! let [a, b, c, d] = [[128, 128], [640, 128], [640, 640], [128, 640]];
//! // The top and the left edge keep their pixels; the diagonal's belong to the half that lies to the right of it.
//! assert_eq!(picture(&coverage([a, b, c], 3, 3), 3), "##.\n.#.\n...\n");
//! assert_eq!(picture(&coverage([a, c, d], 3, 3), 3), "...\n#..\n...\n");
//! ```
//!
//! Raster space has x to the right and y down; pixel (i, j) is sampled at its centre, (i + 1/2, j + 1/2).

mod area;
pub mod cases;
mod conservative;
mod coverage;
mod interpolate;
mod lines;
mod picture;
mod project;
mod snap;
mod visible;

pub use area::covered_area;
pub use conservative::{contains, covers_whole, touches};
pub use coverage::{
    Point, SUBPIXELS, Triangle, Winding, coverage, covered_exactly_once, covers, hits, polygon_coverage, winding,
};
pub use interpolate::{barycentrics, error, error_in_ulps, interpolate, perspective};
pub use lines::{Line, line_coverage, line_covers, point_covers};
pub use picture::picture;
pub use project::{project_exact, project_snapped};
pub use snap::{Rational, rational, snap, snap_exact, snap_unambiguous, snapped_within};
pub use visible::{Visible, clip_space_barycentrics};
