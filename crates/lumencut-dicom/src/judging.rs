//! Carries out the steps from headers to a plan.

use serde::Deserialize;

use crate::choice::chosen;
use crate::describing::described;
use crate::error::Result;
use crate::gathering::{gathered, note_parts};
use crate::geometry::{Mending, stacked};
use crate::headers::Headers;
use crate::images::images;
use crate::oddities::note_oddities;
use crate::phases::of_phase;
use crate::plan::Plan;
use crate::report::Report;
use crate::series::{Placed, grouped};

/// What to read, and which remedies are allowed.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default)]
pub struct Wanted {
    /// Number or UID of the series to read.
    pub series: Option<String>,
    /// The phase to read, as a value of the attribute that distinguishes the phases.
    pub phase: Option<String>,
    /// Whether missing slices are interpolated instead of rejected.
    pub fill_gaps: bool,
    /// Whether uneven slices are put on a regular grid instead of rejected.
    pub resample_slices: bool,
}

/// Decides how images become one volume, or states why they do not.
pub fn judge(headers: &Headers, wanted: &Wanted) -> Result<Plan> {
    let mut notes = Vec::new();
    let every = gathered(grouped(images(headers, &mut notes)?));
    let series = chosen(&every, wanted.series.as_deref(), &mut notes)?;
    note_parts(series, &mut notes);
    let Placed { mut slices, copies } = series.slices(&headers.unlike, &mut notes)?;
    if let Some(phase) = &wanted.phase {
        slices = of_phase(&slices, phase, &mut notes)?;
    }
    let mending = Mending { fill_gaps: wanted.fill_gaps, resample_slices: wanted.resample_slices };
    let stack = stacked(slices, mending, &headers.unlike, &mut notes)?;
    note_oddities(&stack, &mut notes);
    Ok(Plan::new(series, &stack, &copies, notes))
}

/// Describes each series.
pub fn describe(headers: &Headers) -> Result<Vec<Report>> {
    let every = gathered(grouped(images(headers, &mut Vec::new())?));
    Ok(every.iter().map(described).collect())
}
