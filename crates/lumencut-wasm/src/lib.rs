//! Lumencut in a browser, for the page in `web/`: a thin conversion between JSON or bytes and the facade's [`lumencut::study`].

#[cfg(target_arch = "wasm32")]
mod engine;
pub mod phantoms;
#[cfg(target_arch = "wasm32")]
mod stopping;
#[cfg(target_arch = "wasm32")]
mod threads;
