//! The parameters of a section, with and without a wall, by where they stand.

use super::ellipse::SHAPE;

/// Where the levels of the lumen and of its surroundings stand among the parameters, after those of the ellipse.
pub const LUMEN: usize = SHAPE;
/// See [`LUMEN`].
pub const BACKGROUND: usize = SHAPE + 1;

/// The number of parameters without a wall.
pub const PLAIN: usize = SHAPE + 2;

/// Where the logarithm of the wall's thickness (mm), its level, and the shares of the surroundings by direction stand.
pub const THICKNESS: usize = PLAIN;
/// See [`THICKNESS`].
pub const WALL: usize = PLAIN + 1;
/// See [`THICKNESS`].
pub const SECTORS: usize = PLAIN + 2;

/// The cosine and the sine of the direction, of twice and of three times it: surroundings differ from side to side.
pub const HARMONICS: usize = 6;

/// The number of parameters with a wall.
pub const WALLED: usize = SECTORS + HARMONICS;
