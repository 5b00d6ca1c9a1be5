//! Traces centerlines between clicks.

pub mod checks;
pub(crate) mod gaps;
pub(crate) mod junctions;
pub mod preview;
pub mod traced;
pub mod tracer;
pub(crate) mod way;
