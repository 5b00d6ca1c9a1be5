//! Ways through the voxels of a volume: what a step costs, the cheapest ways from a voxel.

pub mod blocks;
pub mod buckets;
pub mod front;
pub mod region;
pub mod shape;
