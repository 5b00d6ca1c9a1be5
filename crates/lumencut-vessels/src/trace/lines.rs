//! Computations along lines: steps, directions, frames, smoothing and correspondence.

pub mod centerline;
pub mod correspondence;
pub mod directions;
pub mod even_steps;
pub mod frames;
pub mod nearest_point;
pub mod smoothing;
pub mod wander;
