#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| pineda_fuzz::mtl(bytes));
