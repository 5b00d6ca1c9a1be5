//! Centerlines from what is known of the lumen, and how alike two centerlines are.

pub mod centering;
pub mod correspondence;
pub mod distance_transform;
pub mod foreground;
pub mod graph;
pub mod labels;
pub mod lumen;
pub mod mask;
pub mod mask_gaps;
mod nearest_background;
pub mod polyline;
pub mod pruning;
pub mod runs;
pub mod simple_point;
pub mod thinning;
pub mod through_lines;
pub mod traced;
