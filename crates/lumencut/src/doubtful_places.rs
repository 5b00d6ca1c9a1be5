//! Places of a line, found or traced, from which it is doubtful: the lumen changes brightness, or the line turns sharply.

use lumencut_core::math::arc_length::arc_lengths;
use lumencut_vessels::trace::lines::centerline::Centerline;
use lumencut_vessels::trace::lumen::level_change::level_change;
use lumencut_vessels::trace::lumen::wander::wandering;
use lumencut_vessels::voxels::Voxels;
use serde::Serialize;

use crate::text::fixed;

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct DoubtfulPlace {
    /// A sentence that states the reason of the doubt.
    pub words: String,
    /// The arc length (mm) from which, or up to which, the vessel is doubtful, to show and cut there; none for the whole line.
    pub at: Option<f64>,
}

impl DoubtfulPlace {
    /// A sentence that also names the vessel.
    pub(crate) fn of(&self, name: &str) -> String {
        format!("{name}: {}", self.words)
    }
}

pub(crate) fn doubtful_places(voxels: &Voxels, line: &Centerline) -> Vec<DoubtfulPlace> {
    let lengths = arc_lengths(&line.points);
    let change = level_change(voxels, line).map(|n| {
        let at = lengths[n];
        let words =
            format!("Doubtful from {} mm on: the brightness of the lumen changes there.", fixed(at, 0));
        DoubtfulPlace { words, at: Some(at) }
    });
    let wander = wandering_from(line).map(|(from, to)| wanders(lengths[from], lengths[to]));
    change.into_iter().chain(wander).collect()
}

/// The first stretch on which a line turns sharply; interruptions shorter than a radius are part of it.
fn wandering_from(line: &Centerline) -> Option<(usize, usize)> {
    let is_wandering = wandering(line);
    let lengths = arc_lengths(&line.points);
    let from = is_wandering.iter().position(|wanders| *wanders)?;
    let later = (from..is_wandering.len()).filter(|n| is_wandering[*n]);
    let goes_on = |to: usize, n: usize| lengths[n] - lengths[to] <= line.radius[n];
    Some((from, later.fold(from, |to, n| if goes_on(to, n) { n } else { to })))
}

/// The doubt about a stretch with sharp turns, between two arc lengths (mm).
fn wanders(from: f64, to: f64) -> DoubtfulPlace {
    let why = "the line turns in less than the width of the vessel there";
    let (words, at) = if from > 0.0 {
        (format!("Doubtful from {} mm on: {why}.", fixed(from, 0)), from)
    } else {
        (format!("Doubtful up to {} mm: {why}.", fixed(to, 0)), to)
    };
    DoubtfulPlace { words, at: Some(at) }
}
