//! Distances below which two positions count as the same, with the reason. Distances are in mm. Each is far above the
//! rounding of a coordinate of a few hundred mm (1e-13 mm), and far below the smallest voxel (about 0.05 mm).

/// A point this near repeats the previous one: rounding would decide the direction between them.
pub const REPEATED_POINT: f64 = 1e-9;

/// A point this near to the end of a vessel is that end. Files keep coordinates as `f32`, which moves them by
/// up to 3e-5 mm at 500 mm, and writers round to 0.001 mm.
pub const VESSEL_END: f64 = 1e-3;

/// Positions in a reformation this near count as equal: rounding differs, and no pixel is as small.
pub(crate) const ON_PICTURE: f64 = 1e-6;

/// Arc lengths that differ by less than this count as equal: sums over thousands of segments are rounded.
pub const ALONG_LINE: f64 = 1e-6;
