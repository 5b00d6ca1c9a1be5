//! Traces centerlines between clicks.

pub mod checks;
pub(crate) mod closure;
pub(crate) mod dim;
pub mod doubts;
pub(crate) mod flaps;
pub(crate) mod gaps;
pub(crate) mod junctions;
pub(crate) mod paths;
pub mod preview;
pub mod tracer;
pub(crate) mod way;

use glam::DVec3;

use crate::trace::lines::centerline::Centerline;

/// A centerline between clicks.
#[derive(Clone, Debug, PartialEq)]
pub struct Traced {
    /// The line with radii and confidence.
    pub line: Centerline,
    /// Whether each point lies on a straight bridge across a part without lumen.
    pub bridged: Vec<bool>,
    /// The first and the last click.
    pub ends: [DVec3; 2],
}
