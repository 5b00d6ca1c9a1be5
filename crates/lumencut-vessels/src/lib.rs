//! Traces vessels in a volume or a mask, and measures them.
//!
//! All points are in world space (LPS, mm).

pub mod kind;
pub mod measure;
pub mod trace;
pub mod voxels;
