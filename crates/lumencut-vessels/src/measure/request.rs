//! How a vessel is asked to be measured.

use super::wall_level::WallRequest;
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::limits::Limits;
use lumencut_core::stop::Stop;
use lumencut_core::vessel_tree::Vessel;

const FWHM: Limits = Limits::new(0.0, 20.0, "mm");

/// How a vessel is measured.
#[derive(Clone, Copy)]
pub struct MeasureRequest<'a> {
    /// The distance of sections (mm), at most.
    pub step: f64,
    /// The full width at half maximum of the scanner's point spread (mm), where known.
    pub fwhm: Option<f64>,
    /// The level of walls.
    pub wall: WallRequest,
    /// The vessels of the tree that the vessel is of; it may be one of them.
    pub tree: &'a [Vessel],
    /// Asked whether to stop.
    pub stop: Stop<'a>,
}

impl MeasureRequest<'_> {
    /// Checks the wall and the point spread that are asked for.
    ///
    /// # Errors
    /// [`ErrorKind::Settings`] for one that is invalid.
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
