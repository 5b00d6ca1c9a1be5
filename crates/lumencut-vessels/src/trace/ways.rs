//! Ways through the voxels of a volume: what a step costs, the cheapest ways from a voxel.

pub(crate) mod blocks;
pub(crate) mod buckets;
pub mod front;
pub mod region;
pub(crate) mod shape;
