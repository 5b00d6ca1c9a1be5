//! Measures the lumen of a vessel, as described in `docs/method/measuring.md`.

pub(crate) mod all_sections;
pub(crate) mod along;
pub(crate) mod blooming;
pub mod blur;
pub(crate) mod branches;
pub(crate) mod contour;
pub(crate) mod contour_check;
pub mod cross_section;
pub mod ellipse;
pub(crate) mod fit;
pub(crate) mod fitting;
pub mod flags;
pub(crate) mod golden;
pub mod groups;
pub mod hindrances;
pub(crate) mod least_squares;
pub(crate) mod levels;
pub(crate) mod lumen_estimate;
pub(crate) mod measured_part;
pub mod measuring;
pub(crate) mod model;
pub(crate) mod obstacles;
pub(crate) mod parameters;
pub mod parts;
pub(crate) mod point_spread;
pub(crate) mod pooled;
pub(crate) mod prepared;
pub mod profile;
pub mod radii;
pub(crate) mod rays;
pub mod request;
pub(crate) mod scale;
pub mod section_plane;
pub(crate) mod sections;
pub(crate) mod sharp_turns;
pub(crate) mod slab;
pub(crate) mod stable_fit;
pub mod stenosis;
pub mod stretch;
pub mod suggestions;
pub(crate) mod sums;
pub(crate) mod terms;
pub(crate) mod texture;
pub mod tree_findings;
pub mod tree_walls;
pub(crate) mod wall;
pub mod wall_level;
pub(crate) mod wall_pool;
pub mod with_progress;

#[cfg(test)]
#[path = "measure/tests/made_profile.rs"]
mod made_profile;
