//! Values estimated on a tree that apply to all its vessels.

use super::PointSpread;
use crate::measure::wall::tree::VesselWall;

/// Values estimated on a tree that apply to all its vessels.
#[derive(Clone, Debug, PartialEq)]
pub struct TreeFindings {
    /// Point spread of the scan.
    pub spread: PointSpread,
    /// Wall levels of the vessels whose walls are visible.
    pub(crate) walls: Vec<VesselWall>,
}
