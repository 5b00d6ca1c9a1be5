#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| lumencut_io_fuzz::check(data, "a.tre"));
