// Finite sentinels, so that no shader meets inf or NaN; lanes.rs, hierarchy.rs and blocks.rs explain them.

const FAN = 16u;
const UNSET: f32 = 1e30;
const ABSENT: f32 = 3e30;
const FAR: f32 = 1e9;
const EXCLUDED: f32 = -1e30;
const NO_SLOT = 0xffffffffu;
// Larger than every value of a volume; marks a missing value.
const HUGE: f32 = 3e38;
