#![no_main]

use pineda_fuzz::read;
use pineda_scene::Format;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| read(Format::Obj, bytes));
