//! Lumencut in a browser, for the page in `web/`. It converts JSON and bytes for the facade's [`lumencut::study`].

#[cfg(target_arch = "wasm32")]
mod engine;
pub mod phantoms;
#[cfg(target_arch = "wasm32")]
mod stopping;
#[cfg(target_arch = "wasm32")]
mod threads;
