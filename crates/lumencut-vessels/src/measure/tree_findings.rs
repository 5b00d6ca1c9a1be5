//! What a tree says about everything measured along it.

use super::profile::PointSpread;
use super::tree_walls::VesselWall;

/// Findings of a tree that apply to all its vessels.
#[derive(Clone, Debug, PartialEq)]
pub struct TreeFindings {
    /// Point spread of the scan.
    pub spread: PointSpread,
    /// Wall levels of the vessels that show them.
    pub(crate) walls: Vec<VesselWall>,
}
