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
    /// Whether each point is a guess: on a bridge across a part without lumen, in dim lumen, or in a flap.
    pub bridged: Vec<bool>,
    /// The first and the last click.
    pub ends: [DVec3; 2],
}

impl Traced {
    pub(crate) fn new(mut line: Centerline, bridged: Vec<bool>, clicks: &[DVec3]) -> Self {
        for (confidence, is_guess) in line.confidence.iter_mut().zip(&bridged) {
            *confidence = if *is_guess { 0.0 } else { *confidence };
        }
        Self { line, bridged, ends: [clicks[0], clicks[clicks.len() - 1]] }
    }
}
