//! What lumen looks like: its values, its cross-sections along a line, and lines moved to its middle.

pub mod cross_section;
pub mod lumen_model;
pub mod ray;
pub mod refine;
pub mod surroundings;
pub mod within;
