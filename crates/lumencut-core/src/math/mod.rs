//! The arithmetic that the stages share. Hidden modules are public only for `lumencut-gpu` and the tests.

pub(crate) mod accumulate;
pub mod arc_length;
#[doc(hidden)]
pub mod blocks;
pub(crate) mod candidates;
pub(crate) mod cell_walk;
pub mod centerline_path;
pub mod centerline_smoothing;
#[doc(hidden)]
pub mod chosen_slots;
#[doc(hidden)]
pub mod context_parameters;
pub(crate) mod cost;
pub(crate) mod cubic;
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
pub(crate) mod light;
pub(crate) mod nearest;
pub(crate) mod own_pieces;
pub(crate) mod pieces;
pub(crate) mod place_map;
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
pub(crate) mod thickness;
pub(crate) mod tile;
pub(crate) mod trace;
#[doc(hidden)]
pub mod transfer;
pub(crate) mod walk;
pub(crate) mod walls;
pub(crate) mod window;
