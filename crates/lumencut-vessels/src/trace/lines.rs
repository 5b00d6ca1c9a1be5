//! Points along a line: arc length, directions, frames, smoothing, and which points of two lines belong together.

pub mod correspondence;
pub mod path;
pub mod polyline;
