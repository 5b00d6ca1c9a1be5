//! The arithmetic that the stages share.

pub mod accumulate;
pub mod blocks;
pub mod candidates;
pub mod centerline_smoothing;
pub mod context_parameters;
pub mod cost;
pub mod decision;
pub mod hierarchy;
pub mod lanes;
pub mod leaps;
pub mod levels;
pub mod light;
pub mod nearest;
pub mod own_pieces;
pub mod pieces;
pub mod projection;
pub mod ray;
pub mod sampler;
pub mod sampling;
pub mod thickness;
pub mod tile;
pub mod trace;
pub mod transfer;
pub mod walk;
pub mod window;
