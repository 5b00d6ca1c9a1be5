//! The arithmetic that the stages share.

pub mod candidates;
pub mod cost;
pub mod hierarchy;
pub mod lanes;
pub mod nearest;
pub mod pieces;
pub mod projection;
pub mod sampling;
pub mod tile;
pub mod walk;
pub mod window;
