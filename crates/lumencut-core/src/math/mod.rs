//! The arithmetic that the stages share. Hidden modules are public only for `lumencut-gpu` and the tests.

#[doc(hidden)]
pub mod accumulate;
pub mod arc_length;
#[doc(hidden)]
pub mod blocks;
pub mod body;
pub(crate) mod candidates;
#[doc(hidden)]
pub mod cell_walk;
pub mod centerline_path;
pub mod centerline_smoothing;
#[doc(hidden)]
pub mod chosen_slots;
#[doc(hidden)]
pub mod context_parameters;
pub(crate) mod cost;
#[doc(hidden)]
pub mod cubic;
pub(crate) mod decision;
pub mod frames;
#[doc(hidden)]
pub mod hierarchy;
#[doc(hidden)]
pub mod lanes;
#[doc(hidden)]
pub mod leaps;
#[doc(hidden)]
pub mod levels;
#[doc(hidden)]
pub mod light;
pub(crate) mod nearest;
pub(crate) mod own_pieces;
#[doc(hidden)]
pub mod pieces;
pub(crate) mod position_map;
#[doc(hidden)]
pub mod projection;
#[doc(hidden)]
pub mod ray;
#[doc(hidden)]
pub mod ray_lines;
#[doc(hidden)]
pub mod reduce;
pub mod same_place;
pub(crate) mod sampler;
#[doc(hidden)]
pub mod sampling;
pub mod statistics;
#[doc(hidden)]
pub mod thickness;
pub(crate) mod tile;
pub(crate) mod trace;
#[doc(hidden)]
pub mod transfer;
#[doc(hidden)]
pub mod tube;
pub(crate) mod walk;
#[doc(hidden)]
pub mod walls;
pub(crate) mod whole_curve;
#[doc(hidden)]
pub mod window;
