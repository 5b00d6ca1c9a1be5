//! What the Python package, the viewer and Rust programs share: devices, fitted views, windows, centerline placement, picking, and
//! the words, tables and JSON of measurements.
//!
//! Points are in world space (LPS, mm) unless stated otherwise.

pub mod along_vessels;
pub mod axes_words;
pub mod backend;
mod choice;
pub mod clicked_vessel;
pub mod comparison;
pub mod cut_at;
pub mod cut_diameter;
pub mod cut_off_values;
pub mod defaults;
pub mod devices;
pub mod doubted_scan;
mod doubted_unit;
pub mod drags;
pub mod endoscopy;
pub mod extent;
pub mod feature_aggregation;
pub mod file_kinds;
pub mod flag_table;
pub mod flight;
pub mod found_vessels;
mod fused;
pub mod kept_profiles;
pub mod letters;
pub mod line_doubts;
pub mod lumen_map;
pub mod lumen_points;
pub mod lumen_wall;
pub mod mask_grid;
pub mod mask_notes;
pub mod measure_words;
pub mod mends;
pub mod method;
pub mod misplaced;
pub(crate) mod narrower;
mod narrowing;
pub mod network;
pub mod not_measured;
pub mod not_suggested;
pub mod parts;
pub mod placement;
pub mod places;
mod populations;
pub mod positions;
mod profile_columns;
pub mod profile_json;
pub mod profile_marks;
pub mod profile_record;
pub mod profile_table;
mod rays_across;
mod recorded_number;
pub mod reordering;
pub mod report;
mod samples;
pub mod scale_bar;
pub mod scan_details;
pub mod scan_identity;
pub mod spiral_lengths;
pub mod straightened_sides;
pub mod study;
pub mod suggested_names;
mod text;
#[cfg(test)]
#[path = "tests/tube.rs"]
mod tube;
pub mod turn;
pub mod value_colours;
mod value_unit;
pub mod vessel_names;
pub mod vessel_views;
pub mod views;
pub mod window_presets;
pub mod windows;
mod wireframe;

pub use lumencut_core::{
    camera, error, frame, geometry, limits, math, named, pipeline, polarity, progress, reformations, scene,
    settings, stages, stop, vessel_tree, volume, with_voxels,
};
#[cfg(target_arch = "wasm32")]
pub use lumencut_gpu::screen;
pub use lumencut_io as centerlines;
pub use lumencut_vessels::{kind, measure, trace, voxels};
