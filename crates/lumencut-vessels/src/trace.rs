//! Centerlines from a volume or a mask, and how alike two centerlines are.
//!
//! The rooms, of which each needs only those above it: [`lines`] is arithmetic of points along a line, [`lumen`] says what lumen
//! looks like across a line, [`ways`] finds ways through voxels of lumen, and [`clicks`], [`mask`] and [`seed`] are what a
//! caller asks for.

pub mod clicks;
pub mod lines;
pub mod lumen;
pub mod mask;
pub mod seed;
pub mod ways;
