//! The lumen of a vessel measured: cross-sections, diameters with the blur of the scanner taken into account, stenoses,
//! lengths and angles.

pub mod all_sections;
pub mod along;
pub mod believed;
pub mod blooming;
pub mod blur;
pub mod branches;
pub mod contour;
pub mod cross_section;
pub mod ellipse;
pub mod fit;
pub mod fitting;
pub mod flags;
pub mod golden;
pub mod groups;
pub mod hindrances;
pub mod least_squares;
pub mod levels;
pub mod looked;
pub mod measured_part;
pub mod measuring;
pub mod model;
pub mod obstacles;
pub mod parameters;
pub mod parts;
pub mod place;
pub mod point_spread;
pub mod pooled;
pub mod profile;
pub mod radii;
pub mod rays;
pub mod request;
pub mod restless;
pub mod rough;
pub mod scale;
pub mod sections;
pub mod settled;
pub mod slab;
pub mod stenosis;
pub mod stretch;
pub mod suggestions;
pub mod sums;
pub mod terms;
pub mod texture;
pub mod told_by_tree;
pub mod tree_walls;
pub mod wall;
pub mod wall_level;
pub mod wall_pool;
pub mod watched;

#[cfg(test)]
#[path = "measure/tests/made_profile.rs"]
mod made_profile;
