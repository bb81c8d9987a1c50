//! The built command, as a person runs it: exit codes, messages, files present or absent, pixels.

#![allow(missing_docs, reason = "tests")]

mod global;
mod outputs;
mod raster;
mod render;
mod workspace;
