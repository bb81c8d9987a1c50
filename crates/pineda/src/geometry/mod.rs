//! Vertices: from the shader's positions to snapped points of the raster.

pub(crate) mod clip;
pub(crate) mod clip_line;
pub(crate) mod exact;
pub(crate) mod project;
pub(crate) mod raster_space;
