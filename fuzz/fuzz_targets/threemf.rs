#![no_main]

//! A zip file of XML. Most of what the fuzzer makes of zip files has wrong sums: `threemf_model` gets further.

use pineda_fuzz::read;
use pineda_scene::Format;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| read(Format::ThreeMf, bytes));
