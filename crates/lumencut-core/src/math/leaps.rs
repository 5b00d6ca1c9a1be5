//! How leaps between neighbours are written.

/// The bit of a leap between a pixel and its right neighbour.
pub const TO_THE_RIGHT: u32 = 1;
/// The bit of a leap between a pixel and the one below it.
pub const DOWNWARDS: u32 = 2;
