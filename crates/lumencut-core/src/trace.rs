//! Centerlines from a volume alone.

pub mod cross_section;
pub mod front;
pub mod gaps;
pub mod junctions;
pub mod lumen_model;
pub mod path;
pub mod refine;
pub mod region;
pub mod traced;
pub mod tracer;
pub mod voxels;
