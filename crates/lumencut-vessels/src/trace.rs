//! Traces centerlines in a volume or a mask.
//!
//! Modules, each of which needs only those before it: [`lines`] is arithmetic along a line; [`lumen`]
//! recognizes lumen across a line; [`ways`] finds cheapest paths through voxels; [`skeleton`] thins lumen
//! voxels to lines. [`clicks`], [`find`] and [`mask`] are the entry points. Described in
//! `docs/method/tracing.md`.

pub mod clicks;
pub mod find;
pub mod lines;
pub mod lumen;
pub mod mask;
pub mod skeleton;
pub mod ways;
