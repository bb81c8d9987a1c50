#![no_main]

//! The XML of a 3MF file's model.

use pineda_fuzz::{read, zipped};
use pineda_scene::Format;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| read(Format::ThreeMf, &zipped(bytes)));
