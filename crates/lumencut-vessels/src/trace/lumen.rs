//! Recognises lumen by its values, fits cross-sections along a line, and centres the line in the lumen.

pub mod cross_section;
pub(crate) mod directions;
pub(crate) mod distance_map;
pub mod level_change;
pub(crate) mod lumen_model;
pub mod on_ray;
pub mod own_axis;
pub mod refine;
pub(crate) mod ridge;
pub mod seen;
pub mod surroundings;
pub mod wall_crossing;
pub mod wander;
pub(crate) mod within;
