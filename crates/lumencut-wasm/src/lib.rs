//! Lumencut in a browser: what the page in `web/` calls. It converts and decides nothing: texts of JSON become values of the
//! facade's study ([`lumencut::study`]), and its pictures become bytes.

#[cfg(target_arch = "wasm32")]
mod engine;
pub mod phantoms;
#[cfg(target_arch = "wasm32")]
mod stopping;
#[cfg(target_arch = "wasm32")]
mod threads;
