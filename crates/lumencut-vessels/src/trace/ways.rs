//! Finds the cheapest paths through the voxels of a volume.

pub(crate) mod barrier;
pub(crate) mod blocks;
pub(crate) mod buckets;
pub mod front;
pub mod region;
pub(crate) mod shape;
