#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    if let Some(file) = lumencut_io_fuzz::packed_vtp(data) {
        lumencut_io_fuzz::check(&file, "a.vtp");
    }
});
