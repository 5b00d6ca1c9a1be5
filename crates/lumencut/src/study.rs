//! The study that is open in a viewer: volume, vessel lines and their edits, tracing, picking, measurements, marks
//! and sessions. Viewers exchange plain values and JSON with it, so that all of them work alike. Points are in world
//! space (LPS, mm) unless stated otherwise.

mod after_edit;
mod along;
pub mod asking;
mod bone;
pub mod brightest;
mod centerline_files;
mod content;
mod contours;
mod document;
mod doubts;
mod draft;
mod editing;
mod edits;
pub mod failure;
mod from_inside;
pub mod held_volume;
mod histogram;
mod hung;
mod known_names;
mod labels;
pub mod line_edits;
mod line_facts;
pub mod line_path;
pub mod lines;
mod lumens;
mod masks;
mod measure_layout;
mod measure_messages;
mod measuring;
pub mod names;
pub mod open_study;
mod opening;
mod palette;
mod picking;
mod place_turn;
mod planes;
mod points_along;
mod profiles;
pub mod questions;
mod reformations;
mod reforming;
mod regions;
mod report_messages;
mod reshaping;
mod session_files;
mod settings;
mod straightened;
mod straightening;
mod trace_report;
pub mod tracing;
mod two_scans;
pub mod view;
pub mod voxels;
mod whole_vessel;

mod outlines;
#[cfg(test)]
pub(crate) mod tests;
mod without_bone;
