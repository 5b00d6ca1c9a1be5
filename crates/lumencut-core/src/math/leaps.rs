//! Bits that mark depth jumps (leaps) between neighbouring pixels, and the side on which a jump's line is drawn.

pub const TO_THE_RIGHT: u32 = 1;
pub const DOWNWARDS: u32 = 2;
/// With [`TO_THE_RIGHT`]: the line is drawn in the right neighbour, not in the pixel itself.
pub const LINE_TO_THE_RIGHT: u32 = 4;
/// With [`DOWNWARDS`]: the line is drawn in the pixel below, not in the pixel itself.
pub const LINE_DOWNWARDS: u32 = 8;
pub const LUMEN: u32 = 16;
/// The pixel shows the wall of a vessel.
pub const WALL: u32 = 32;
pub const LEAPS: u32 = TO_THE_RIGHT | DOWNWARDS;
