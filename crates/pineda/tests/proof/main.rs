//! `pineda` against the oracle, against a naive renderer, and against its own promises.

mod coverage;
mod encodings;
mod errors;
mod fragments;
mod garbage;
mod passes;
mod primitives;
mod scene;
mod strokes;
mod traps;
mod viewports;
mod visibility;
