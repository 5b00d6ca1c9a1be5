//! Lumencut in a browser, for the page in `web/`. It passes JSON and bytes to [`lumencut::study`].

#[cfg(target_arch = "wasm32")]
mod engine;
pub mod phantoms;
#[cfg(target_arch = "wasm32")]
mod stopping;
#[cfg(target_arch = "wasm32")]
mod threads;
