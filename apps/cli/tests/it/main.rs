//! The built command, as a person runs it: exit codes, messages, files present or absent, pixels.

#![allow(missing_docs, reason = "tests")]

mod batch;
mod cameras;
mod formats;
mod global;
mod info;
mod looks;
mod malformed;
mod models;
mod outputs;
mod raster;
mod render;
mod shell;
mod streams;
mod workspace;
