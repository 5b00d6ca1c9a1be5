//! Traces centerlines in a volume or a mask, as described in `docs/method/tracing.md`. Each module uses only the
//! modules listed before it: [`lines`], [`lumen`], [`ways`], [`skeleton`]. The entry points [`clicks`], [`find`] and
//! [`mask`] use all of them.

pub mod clicks;
pub mod find;
pub mod lines;
pub mod lumen;
pub mod mask;
pub mod skeleton;
pub mod ways;
