//! Reformations: other methods to find the position of each pixel; [`crate::pipeline`] shows the volume there.

mod connections;
pub mod cpr;
pub mod cr;
mod cut_locus;
pub mod endoscopy;
pub mod flatten;
mod found;
mod layout;
pub mod lumen_map;
pub mod mpcpr;
mod segments;
pub mod spiral;
pub mod tangential;
pub mod uncurl;
pub mod untangled;
mod wall;

pub use connections::Connections;
pub use found::NO_VESSEL;
pub use layout::Layout;
pub use wall::Wall;
