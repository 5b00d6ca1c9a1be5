//! Reformations: other methods than the cut surface that find where each pixel looks. What is shown there is `look`'s.

mod connections;
pub mod cr;
mod found;
pub mod mpcpr;

pub use connections::Connections;
pub use found::NO_VESSEL;
