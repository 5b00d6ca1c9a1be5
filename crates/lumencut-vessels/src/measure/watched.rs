//! How far measuring is, for whoever watches it from another thread: each section asks whether to stop once in every pass over
//! its vessel, so that these questions tell it.

use lumencut_core::error::Result;
use lumencut_core::progress::Progress;
use lumencut_core::stop::Stop;
use lumencut_core::vessel_tree::Vessel;

/// About how often a section is looked at while a vessel is measured.
const PASSES: f64 = 3.0;

/// Measures vessels, in sections `step` mm apart, as one of the views that `progress` expects, and tells how far that is. `measure`
/// is given what it has to ask whether to stop.
///
/// # Errors
/// Those of `measure`.
pub fn watched<T>(
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
#[path = "tests/watched.rs"]
mod tests;
