//! Counts the progress of measuring: each section asks once per pass whether to stop, and these calls are counted.

use lumencut_core::error::Result;
use lumencut_core::progress::Progress;
use lumencut_core::stop::Stop;
use lumencut_core::vessel_tree::Vessel;

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
