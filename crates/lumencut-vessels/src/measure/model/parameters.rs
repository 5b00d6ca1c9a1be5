//! Indices of the fit parameters, with and without a wall.

use super::ellipse::SHAPE;

pub(crate) const LUMEN: usize = SHAPE;
pub(crate) const BACKGROUND: usize = SHAPE + 1;

/// Number of parameters of the model without a wall.
pub(crate) const PLAIN: usize = SHAPE + 2;

/// Index of the logarithm of the wall thickness (mm).
pub(crate) const THICKNESS: usize = PLAIN;
pub(crate) const WALL: usize = PLAIN + 1;
/// Index of the first harmonic of the surroundings.
pub(crate) const SECTORS: usize = PLAIN + 2;

/// Number of harmonics of the surroundings: cosine and sine of one, two and three times the direction.
pub(crate) const HARMONICS: usize = 6;

/// Number of parameters of the model with a wall.
pub(crate) const WALLED: usize = SECTORS + HARMONICS;
