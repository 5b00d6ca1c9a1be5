//! Curved Surface Reformation (CSR): the lumen of all vessels of an angiography in one freely rotatable view.
//!
//! The method of Auzinger et al., "Vessel Visualization using Curved Surface Reformation", IEEE TVCG 19(12),
//! 2013, doi:10.1109/TVCG.2013.215. This crate knows no file format and no GPU API.

pub mod brute_force;
pub mod camera;
pub mod edges;
pub mod error;
pub mod frame;
pub mod geometry;
pub mod limits;
pub mod math;
mod mend;
pub mod named;
pub mod pipeline;
pub mod polarity;
pub mod progress;
pub mod reformations;
pub mod scene;
pub mod settings;
pub mod shaders;
pub mod stages;
pub mod stop;
pub mod vessel_tree;
pub mod volume;
