//! `pineda` against the oracle, against a naive renderer, and against its own promises.

mod barycentrics;
mod clip_distances;
mod color_errors;
mod conservative;
mod coverage;
mod derivatives;
mod encodings;
mod errors;
mod fragments;
mod garbage;
mod ids;
mod large_triangles;
mod multisample;
mod occlusion;
mod passes;
mod primitives;
mod sample_masks;
mod scene;
mod strokes;
mod traps;
mod vertex_ids;
mod viewports;
mod visibility;
mod written_depth;
