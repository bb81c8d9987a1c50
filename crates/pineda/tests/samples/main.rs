//! What happens to a sample after it is covered, against scalar references written from the specifications' formulas.

mod blending;
mod common;
mod depth;
mod depths;
mod formats;
mod layers;
mod queries;
mod stencil;
mod targets;
mod windows;
mod written_depth;
