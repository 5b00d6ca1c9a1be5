//! How near to each other two places are one place, and why.
//!
//! Distances are in mm. Each is far above what rounding moves a coordinate of a few hundred mm by (1e-13 mm), and far below the
//! smallest voxel (about 0.05 mm).

/// A point no farther from the one before it is the same point: a segment between them would have no direction that rounding
/// does not decide.
pub const REPEATED_POINT: f64 = 1e-9;

/// A point no farther from an end of a vessel is that end: files keep coordinates as `f32`, which moves them by up to 3e-5 mm
/// at 500 mm, and writers round to 0.001 mm.
pub const VESSEL_END: f64 = 1e-3;

/// Places of a reformation no farther apart are one place: they are found along different ways, each with its own rounding,
/// and no pixel is as small.
pub const ON_PICTURE: f64 = 1e-6;

/// Arc lengths, and lengths in steps of a line, that differ by less are the same: what is left of them after sums over
/// thousands of segments.
pub const ALONG_LINE: f64 = 1e-6;
