//! Centerlines between clicks.

pub mod checks;
pub mod gaps;
pub mod junctions;
pub mod preview;
pub mod traced;
pub mod tracer;
pub mod way;
