//! Triangles, lines and points: from points of the raster to records in the bins of tiles.

pub(crate) mod bins;
mod canonical_order;
pub(crate) mod conservative;
pub(crate) mod corners;
pub(crate) mod depth_bias;
pub(crate) mod diamond_exit;
mod edge;
pub(crate) mod groups;
mod make_records;
pub(crate) mod reach;
pub(crate) mod record;
pub(crate) mod rows;
pub(crate) mod samples;
pub(crate) mod setup;
pub(crate) mod smooth;
pub(crate) mod strips;
pub(crate) mod stroke;
mod tile_boxes;
pub(crate) mod top_left;
pub(crate) mod triangle_id;
