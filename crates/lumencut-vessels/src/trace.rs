//! Centerlines from a volume or a mask, and how alike two centerlines are.
//!
//! The rooms, of which each needs only those before it: [`lines`] is arithmetic of points along a line; [`lumen`] says what
//! lumen looks like across a line; [`ways`] finds ways through voxels of lumen; [`skeleton`] thins voxels of lumen to lines.
//! [`clicks`], [`find`] and [`mask`] are what a caller asks for; they do not need each other.

pub mod clicks;
pub mod find;
pub mod lines;
pub mod lumen;
pub mod mask;
pub mod skeleton;
pub mod ways;
