// Numbers that mean something of their own: finite, so that no shader ever meets inf or NaN. They are those of the Rust
// rooms of the same names.

// The children of a node of the hierarchy and the slots of a bundle.
const FAN = 16u;
// A key no piece reaches: the pixel has no winner yet.
const UNSET: f32 = 1e30;
// The depth of a piece that is not there; beyond UNSET whatever is added.
const ABSENT: f32 = 3e30;
// Where slots without a point lie (mm).
const FAR: f32 = 1e9;
// A key that no piece beats: the pixel does not take part.
const SETTLED: f32 = -1e30;
// An entry of the order that holds no slot.
const NO_SLOT = 0xffffffffu;
// Beyond every value of a volume; where there is no value, this stands for it.
const HUGE: f32 = 3e38;
