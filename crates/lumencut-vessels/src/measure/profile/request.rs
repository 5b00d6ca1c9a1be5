//! The request for measuring a vessel, and its progress: each section asks once per pass whether to stop, and these
//! calls are counted.

use crate::measure::wall::WallRequest;
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::limits::Limits;
use lumencut_core::progress::Progress;
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

/// Approximate number of times that each section is visited.
const PASSES: f64 = 3.0;

/// Measures vessels in sections `step` mm apart. Progress is the number of calls of the stop function that
/// `measure` receives, relative to the expected number. Errors: those of `measure`.
pub fn with_progress<T>(
    progress: Option<&Progress>,
    (vessels, step): (&[Vessel], f64),
    stop: Stop,
    measure: impl FnOnce(Stop) -> Result<T>,
) -> Result<T> {
    let Some(progress) = progress else { return measure(stop) };
    let length =
        |vessel: &Vessel| -> f64 { vessel.points().windows(2).map(|ends| ends[0].distance(ends[1])).sum() };
    let sections: f64 = vessels.iter().map(|vessel| 1.0 + length(vessel) / step).sum();
    progress.begin_view(std::iter::once(1), (PASSES * sections) as usize);
    progress.begin_stage(1);
    let asked = || {
        progress.begin_pixels(1);
        stop()
    };
    let measured = measure(&asked);
    progress.end_view();
    measured
}

#[cfg(test)]
#[path = "tests/with_progress.rs"]
mod tests;
