//! The focus: how far around the vessels the cut surface is shown, and how it fades into the context.

use crate::error::Result;
use crate::limits::Limits;

/// Limits of the margin (mm); a margin far below 0 shows only the context.
const MARGIN_LIMITS: Limits = Limits::new(-1e6, 1e6, "mm");
const FADE_LIMITS: Limits = Limits::new(0.0, 1e6, "mm");

/// Shows the cut surface around the vessels, and the context elsewhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Focus {
    /// Distance beyond the nearest wall (mm, in the view plane) up to which all of the cut surface is shown;
    /// if below 0, lumens fade.
    pub margin: f64,
    /// Distance over which the cut surface then fades into the context (mm); 0 makes a hard edge.
    pub fade: f64,
}

impl Focus {
    /// Checks margin and fade. Fails with [`crate::error::ErrorKind::Settings`] for one outside its range.
    pub fn check(&self) -> Result<()> {
        MARGIN_LIMITS.check("focus margin", self.margin)?;
        FADE_LIMITS.check("focus fade", self.fade)
    }
}

impl Default for Focus {
    fn default() -> Self {
        Self { margin: 2.0, fade: 6.0 }
    }
}
