//! How leaps between neighbours are written, and on which side of each its line lies.

/// The bit of a leap between a pixel and its right neighbour.
pub const TO_THE_RIGHT: u32 = 1;
/// The bit of a leap between a pixel and the one below it.
pub const DOWNWARDS: u32 = 2;
/// With [`TO_THE_RIGHT`]: the line lies in the right neighbour, not in the pixel itself.
pub const LINE_TO_THE_RIGHT: u32 = 4;
/// With [`DOWNWARDS`]: the line lies in the pixel below, not in the pixel itself.
pub const LINE_DOWNWARDS: u32 = 8;
/// The bit of a pixel that shows the lumen of a vessel.
pub const LUMEN: u32 = 16;
/// The bits of a pixel's leaps to both neighbours.
pub const LEAPS: u32 = TO_THE_RIGHT | DOWNWARDS;
