// Bits that mark depth jumps (leaps) between neighbouring pixels; see leaps.rs.

const TO_THE_RIGHT = 1u;
const DOWNWARDS = 2u;
const LINE_TO_THE_RIGHT = 4u;
const LINE_DOWNWARDS = 8u;
const LUMEN = 16u;
const WALL = 32u;
