//! Flags of a section, as bits. The crate `lumencut` has their words and colours.

/// The diameter is below 1.5 times the FWHM of the point spread, or twice the spacing of thick slices, or unsure by 7 %.
pub const AT_LIMIT: u32 = 1;
/// Another vessel starts at this section, or the lumen continues sideways.
pub const BRANCH: u32 = 1 << 1;
/// Something at the wall is brighter than lumen.
pub const CALCIUM: u32 = 1 << 2;
/// Metal: material at the wall that surrounds the lumen, forms a lattice, repeats, or is brighter than calcium.
pub const METAL: u32 = 1 << 3;
/// Another lumen, or bone, touches the wall.
pub const NEIGHBOR: u32 = 1 << 4;
/// Part of the section lies outside the volume.
pub const OUTSIDE: u32 = 1 << 5;
/// No wall was found, or the contour does not enclose lumen.
pub const NO_EDGE: u32 = 1 << 6;
/// The centerline lies outside the measured lumen.
pub const RECENTERED: u32 = 1 << 7;
/// The contour of the lumen differs strongly from an ellipse.
pub const IRREGULAR: u32 = 1 << 8;
/// The centerline turns more sharply than a vessel can.
pub const RESTLESS_LINE: u32 = 1 << 9;
/// Plaque nearly as bright as the lumen lies beside it, or makes it dimmer and narrower.
pub const PLAQUE: u32 = 1 << 10;

/// A reader drew the contour.
pub const BY_HAND: u32 = 1 << 11;
/// A reader moved the centerline.
pub const LINE_BY_HAND: u32 = 1 << 12;

/// Sections with any of these flags are ignored when the narrowest, widest or suggested sections are chosen.
pub const LEFT_OUT: u32 = BRANCH | OUTSIDE | NO_EDGE | RECENTERED | RESTLESS_LINE;
