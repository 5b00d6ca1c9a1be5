//! Traces centerlines in a volume or a mask. Described in `docs/method/tracing.md`.
//!
//! Each module needs only those before it: [`lines`], [`lumen`], [`ways`], [`skeleton`]; then the entry
//! points [`clicks`], [`find`] and [`mask`].

pub mod clicks;
pub mod find;
pub mod lines;
pub mod lumen;
pub mod mask;
pub mod skeleton;
pub mod ways;
