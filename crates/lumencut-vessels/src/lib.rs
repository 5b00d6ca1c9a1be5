//! From a volume to centerlines and numbers: vessels are traced in a volume or a mask, and measured along their centerlines.
//!
//! Points are in world space (LPS, mm). Of the method's crate this one uses what every scene is made of (volume, vessel tree)
//! and the arithmetic, and nothing that makes pictures.

pub mod measure;
pub mod trace;
pub mod voxels;
