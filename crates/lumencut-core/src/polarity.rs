//! Whether a lumen is brighter or darker than the tissue around it.

use crate::named::Named;

/// The side of its surroundings on which the values of a lumen lie.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Polarity {
    /// Brighter, such as blood with contrast medium.
    #[default]
    Bright,
    /// Darker, such as airways.
    Dark,
}

impl Named for Polarity {
    const NAMES: &'static [(&'static str, Self)] = &[("bright", Self::Bright), ("dark", Self::Dark)];
}

impl Polarity {
    /// A value as it is traced, or the value of the volume from such a value: dark lumens are traced in negated values.
    pub fn turned(self, value: f64) -> f64 {
        match self {
            Self::Bright => value,
            // Unlike `-value`, this has no negative zero.
            Self::Dark => 0.0 - value,
        }
    }

    /// How lumen compares with its surroundings.
    pub fn brighter(self) -> &'static str {
        match self {
            Self::Bright => "brighter",
            Self::Dark => "darker",
        }
    }
}
