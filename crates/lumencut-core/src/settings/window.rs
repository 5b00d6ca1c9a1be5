//! The window (level, width) that maps intensities to grey, and the ramp that maps them to opacity.

use crate::error::Result;
use crate::limits::Limits;

const WIDTH: Limits = Limits::new(1e-12, Limits::LARGEST_INTENSITY, Limits::INTENSITY.unit);

/// Intensities shown from black to white: `level` ± `width` / 2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// The intensity shown as middle grey.
    pub level: f64,
    /// The range of intensities from black to white, above 0.
    pub width: f64,
}

/// A window that shows vessels of a CT angiography.
impl Default for Window {
    fn default() -> Self {
        Self { level: 300.0, width: 900.0 }
    }
}

impl Window {
    /// Checks the window called `name`. Fails with [`crate::error::ErrorKind::Settings`].
    pub fn check(&self, name: &str) -> Result<()> {
        Limits::INTENSITY.check(&format!("{name} level"), self.level)?;
        WIDTH.check(&format!("{name} width"), self.width)
    }
}

/// A linear ramp from transparent to opaque; `transparent` may lie above `opaque`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Opacity {
    /// The intensity at which opacity begins to rise from 0.
    pub transparent: f64,
    /// The intensity at which opacity reaches 1.
    pub opaque: f64,
}

impl Opacity {
    /// Fails with [`crate::error::ErrorKind::Settings`] for an intensity outside its range.
    pub fn check(&self) -> Result<()> {
        Limits::INTENSITY.check("opacity start", self.transparent)?;
        Limits::INTENSITY.check("opacity end", self.opaque)
    }
}
