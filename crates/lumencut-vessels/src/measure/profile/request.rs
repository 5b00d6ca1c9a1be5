//! The request for measuring a vessel.

use crate::measure::wall::WallRequest;
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::limits::Limits;
use lumencut_core::stop::Stop;
use lumencut_core::vessel_tree::Vessel;

const FWHM: Limits = Limits::new(0.0, 20.0, "mm");

/// How to measure a vessel.
#[derive(Clone, Copy)]
pub struct MeasureRequest<'a> {
    /// Maximum distance between sections (mm).
    pub step: f64,
    /// FWHM of the scanner's point spread (mm), if known.
    pub fwhm: Option<f64>,
    /// How the level of the wall is chosen.
    pub wall: WallRequest,
    /// The tree to which the vessel belongs; it may include the vessel itself.
    pub tree: &'a [Vessel],
    /// Called often; returns whether to stop.
    pub stop: Stop<'a>,
}

impl MeasureRequest<'_> {
    /// Checks the request. Errors: [`ErrorKind::Settings`] for an invalid wall or point spread.
    pub fn check(&self) -> Result<()> {
        self.wall.check()?;
        let Some(fwhm) = self.fwhm else { return Ok(()) };
        FWHM.check("fwhm", fwhm)?;
        if fwhm > 0.0 {
            return Ok(());
        }
        Err(Error::new(ErrorKind::Settings, "fwhm", format!("{fwhm} mm"), "a width above 0 mm, or none"))
    }
}
