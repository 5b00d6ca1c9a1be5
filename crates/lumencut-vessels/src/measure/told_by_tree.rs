//! What a tree tells of all that is measured along it.

use super::profile::PointSpread;
use super::tree_walls::ToldWall;

/// What a tree tells of all that is measured along it.
#[derive(Clone, Debug, PartialEq)]
pub struct ToldByTree {
    /// The point spread of its scan.
    pub spread: PointSpread,
    /// What its vessels tell of the level of their walls, those that tell something.
    pub walls: Vec<ToldWall>,
}
