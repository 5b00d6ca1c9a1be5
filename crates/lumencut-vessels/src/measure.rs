//! Measures the lumen of a vessel, as described in `docs/method/measuring.md`. Each module uses only those listed
//! before it: `section` (planes and their voxels), `beside` (calcium, metal and other vessels), `estimation`,
//! `model` (the blurred lumen), `uncertainty`, `fit` (one section), `wall`, `along` (what sections share), `outer` (thick
//! walls), `flap` (two lumens), `profile` (the result), `stenosis`, `comparison` (of two scans).

pub(crate) mod along;
pub(crate) mod beside;
pub mod comparison;
pub(crate) mod estimation;
pub(crate) mod fit;
pub mod flap;
pub mod model;
pub mod outer;
pub mod profile;
pub mod section;
pub mod stenosis;
pub mod uncertainty;
pub mod wall;
