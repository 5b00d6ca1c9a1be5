// How leaps between neighbours are written, and on which side of each its line lies.

// The bit of a leap between a pixel and its right neighbour.
const TO_THE_RIGHT = 1u;
// The bit of a leap between a pixel and the one below it.
const DOWNWARDS = 2u;
// Beside TO_THE_RIGHT: the line lies in the right neighbour, not in the pixel itself.
const LINE_TO_THE_RIGHT = 4u;
// Beside DOWNWARDS: the line lies in the pixel below, not in the pixel itself.
const LINE_DOWNWARDS = 8u;
// The bit of a pixel that shows the lumen of a vessel.
const LUMEN = 16u;
