//! The thresholds of CR.

use crate::error::{Error, ErrorKind, Result};

const MAX_THRESHOLD_PIXELS: f64 = 1e6;

/// The two thresholds of CR.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrParameters {
    /// A vessel hides what lies behind it up to this distance beyond its radius (pixels).
    pub radius_offset: f64,
    /// Points nearer than this along the tree (pixels) form a stretch; its point nearest to a pixel is shown.
    pub arc_threshold: f64,
}

impl Default for CrParameters {
    /// The thresholds of the paper's picture of the neck.
    fn default() -> Self {
        Self { radius_offset: 50.0, arc_threshold: 150.0 }
    }
}

impl CrParameters {
    /// Fails with [`ErrorKind::Settings`] for a threshold that is not from 0 to a million pixels.
    pub fn check(&self) -> Result<()> {
        for (name, value) in [("radius_offset", self.radius_offset), ("arc_threshold", self.arc_threshold)] {
            if !(0.0..=MAX_THRESHOLD_PIXELS).contains(&value) {
                let expected = "a finite number of pixels between 0 and 1e6";
                return Err(Error::new(ErrorKind::Settings, name, format!("{value}"), expected));
            }
        }
        Ok(())
    }
}
