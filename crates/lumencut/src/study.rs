//! The study that a viewer has open: a volume, the lines of its vessels and their edits, tracing, picking, what was measured
//! and marked, and saved sessions. Its functions take and give plain values and JSON, so that every viewer works alike.
//!
//! Points are in world space (LPS, mm) unless their documentation says otherwise.

pub mod brightest;
pub mod choices;
pub mod failure;
pub mod files;
pub mod histogram;
pub mod line_edits;
pub mod lines;
pub mod masks;
pub mod measured;
pub mod measuring;
pub mod open;
mod opening;
pub mod planes;
pub mod profiles;
pub mod saved_sessions;
pub mod session;
pub mod sides;
pub mod tracing;
pub mod view;
pub mod voxels;

#[cfg(test)]
mod tests;
