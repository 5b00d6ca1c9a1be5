//! Links the engine with memory shared by the page's workers.

/// Symbols that a worker needs to start a thread in shared memory.
const EXPORTED: [&str; 5] = ["__wasm_init_tls", "__tls_size", "__tls_align", "__tls_base", "__heap_base"];

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var("CARGO_CFG_TARGET_ARCH").as_deref() != Ok("wasm32") {
        return;
    }
    for argument in ["--shared-memory", "--import-memory", "--max-memory=4294967296"] {
        println!("cargo::rustc-link-arg-cdylib={argument}");
    }
    for name in EXPORTED {
        println!("cargo::rustc-link-arg-cdylib=--export={name}");
    }
}
