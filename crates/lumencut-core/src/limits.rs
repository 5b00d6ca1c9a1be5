//! Ranges of numbers, and the error for a number outside its range.

use crate::error::{Error, ErrorKind, Result};

/// The range that a number must lie in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// The smallest number.
    pub low: f64,
    /// The largest number.
    pub high: f64,
    /// The unit, as the error names it.
    pub unit: &'static str,
}

impl Limits {
    pub(crate) const LARGEST_INTENSITY: f64 = 1e12;
    pub(crate) const INTENSITY: Self =
        Self::new(-Self::LARGEST_INTENSITY, Self::LARGEST_INTENSITY, "units of intensity");

    /// From `low` to `high`, both included.
    pub const fn new(low: f64, high: f64, unit: &'static str) -> Self {
        Self { low, high, unit }
    }

    /// Checks the parameter `name`. Fails with [`ErrorKind::Settings`] for NaN or a number outside the range.
    pub fn check(&self, name: &str, value: f64) -> Result<()> {
        let &Self { low, high, unit } = self;
        if value >= low && value <= high {
            return Ok(());
        }
        let expected = format!("between {low} and {high} {unit}");
        Err(Error::new(ErrorKind::Settings, name, format!("{value}"), expected))
    }
}
