//! Centerlines from a volume or a mask, and how alike two centerlines are.

pub mod centering;
pub mod correspondence;
pub mod cross_section;
pub mod distance_transform;
pub mod foreground;
pub mod front;
pub mod gaps;
pub mod graph;
pub mod junctions;
pub mod labels;
pub mod lumen;
pub mod lumen_model;
pub mod mask;
pub mod mask_gaps;
mod nearest_background;
pub mod path;
pub mod polyline;
pub mod pruning;
pub mod refine;
pub mod region;
pub mod runs;
pub mod simple_point;
pub mod thinning;
pub mod through_lines;
pub mod traced;
pub mod tracer;
pub mod voxels;
