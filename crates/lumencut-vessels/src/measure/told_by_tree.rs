//! What a tree says about everything measured along it.

use super::profile::PointSpread;
use super::tree_walls::ToldWall;

/// Findings of a tree that apply to all its vessels.
#[derive(Clone, Debug, PartialEq)]
pub struct ToldByTree {
    /// Point spread of the scan.
    pub spread: PointSpread,
    /// Wall levels of the vessels that show them.
    pub(crate) walls: Vec<ToldWall>,
}
