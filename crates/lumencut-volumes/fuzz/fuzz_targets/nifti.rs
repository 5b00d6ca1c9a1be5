#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| lumencut_volumes_fuzz::check(data, "a.nii"));
