// How leaps between neighbours are written.

// The bit of a leap between a pixel and its right neighbour.
const TO_THE_RIGHT = 1u;
// The bit of a leap between a pixel and the one below it.
const DOWNWARDS = 2u;
