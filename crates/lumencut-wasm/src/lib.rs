//! Lumencut in a browser: what the page in `web/` calls. Everything here is thin over the facade: texts of JSON become its
//! values, and its pictures become bytes. [`session`] is the same on every target, so that its tests run natively.
//!
//! Points are in world space (LPS, mm) unless their documentation says otherwise.

pub mod choices;
#[cfg(target_arch = "wasm32")]
mod engine;
pub mod failure;
pub mod files;
pub mod histogram;
pub mod planes;
pub mod session;
pub mod sides;
pub mod study;
#[cfg(test)]
mod tests;
#[cfg(target_arch = "wasm32")]
mod threads;
pub mod view;
pub mod voxels;
