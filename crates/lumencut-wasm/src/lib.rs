//! Lumencut in a browser: what the page in `web/` calls. Everything here is thin over the facade: texts of JSON become its
//! values, and its pictures become bytes. [`session`] is the same on every target, so that its tests run natively.
//!
//! Points are in world space (LPS, mm) unless their documentation says otherwise.

pub mod brightest;
pub mod choices;
#[cfg(target_arch = "wasm32")]
mod engine;
pub mod failure;
pub mod files;
pub mod histogram;
pub mod line_edits;
pub mod lines;
pub mod masks;
pub mod measured;
pub mod measuring;
#[cfg(target_arch = "wasm32")]
mod measuring_engine;
mod opening;
pub mod phantoms;
pub mod planes;
pub mod profiles;
pub mod saved_sessions;
#[cfg(target_arch = "wasm32")]
mod saved_sessions_engine;
pub mod session;
pub mod sides;
#[cfg(target_arch = "wasm32")]
mod stopping;
pub mod study;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_lines;
#[cfg(test)]
mod tests_masks;
#[cfg(test)]
mod tests_tracing;
#[cfg(target_arch = "wasm32")]
mod threads;
pub mod tracing;
#[cfg(target_arch = "wasm32")]
mod tracing_engine;
pub mod view;
pub mod voxels;
