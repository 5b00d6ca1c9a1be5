//! The study that a viewer has open: a volume, the lines of its vessels and their edits, tracing, picking, what was measured
//! and marked, and saved sessions. Its functions take and give plain values and JSON, so that every viewer works alike.
//!
//! Points are in world space (LPS, mm) unless their documentation says otherwise.

pub mod after_edit;
pub mod asking;
pub mod brightest;
pub mod centerline_files;
pub mod content;
pub mod document;
pub mod doubts;
mod draft;
mod editing;
pub mod edits;
pub mod failure;
pub mod held_volume;
pub mod histogram;
pub mod labels;
pub mod line_edits;
pub mod line_facts;
pub mod line_path;
pub mod lines;
pub mod lumens;
pub mod masks;
pub mod measure_messages;
pub mod measuring;
pub mod names;
pub mod open_study;
mod opening;
pub mod palette;
pub mod picking;
pub mod place_turn;
pub mod planes;
mod points_along;
pub mod profiles;
pub mod questions;
pub mod reformations;
pub mod reformed;
pub mod reforming;
pub mod regions;
pub mod report_messages;
pub mod session_files;
pub mod settings;
pub mod straightened;
pub mod straightening;
pub mod telling;
pub mod tracing;
pub mod view;
pub mod voxels;
pub mod whole_vessel;

#[cfg(test)]
pub(crate) mod tests;
