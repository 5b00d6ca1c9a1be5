//! What is told of a vessel once it is traced: its length, which vessels it joins, and from where on it is doubtful.

use glam::DVec3;
use lumencut_core::math::arc_length::arc_lengths;
use lumencut_vessels::trace::lines::centerline::Centerline;
use lumencut_vessels::trace::lines::wander::wandering;
use lumencut_vessels::trace::lumen::across::runs_across;
use lumencut_vessels::trace::lumen::level_change::level_change;
use lumencut_vessels::voxels::Voxels;
use serde::Serialize;

use crate::study::document::{Document, DocumentVessel, Place};
use crate::study::failure::Result;
use crate::study::open_study::Study;
use crate::text::fixed;

/// Nearer than this an end of a line is a point of another one (mm); they are equal but for rounding.
const SAME: f64 = 1e-6;

/// What is told of a vessel that was traced.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct Told {
    /// The vessel.
    pub vessel: u32,
    /// Its name, its length, and which vessels it joins, in a sentence.
    pub words: String,
    /// Where it is doubtful; none where it is not.
    pub doubts: Vec<DoubtfulPlace>,
}

/// Where a line is doubtful.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct DoubtfulPlace {
    /// Why, in a sentence.
    pub words: String,
    /// From which arc length on, or up to which (mm): where it can be looked at and cut. None where all of the line is meant.
    pub at: Option<f64>,
}

impl Study {
    /// What is told of a vessel that was traced; none where there is no such vessel.
    ///
    /// # Errors
    /// `vessel tree` for a line that there is not, `volume` where none is open.
    pub(crate) fn told_of(&self, document: &Document, id: Option<u32>) -> Result<Option<Told>> {
        let Some(vessel) = id.and_then(|id| document.vessel(id)) else { return Ok(None) };
        let line = self.lines.get(vessel.line)?.met();
        let others: Vec<&DocumentVessel> =
            document.vessels.iter().filter(|other| other.id != vessel.id && other.is_sure()).collect();
        let words = format!("{}, {}.", vessel.called(), self.joining(&line, &others)?);
        Ok(Some(Told { vessel: vessel.id, words, doubts: self.doubtful(&line, vessel.clicks.as_deref())? }))
    }

    /// How long a line is and which vessels it joins at its ends, in words.
    ///
    /// # Errors
    /// `vessel tree` for a line that there is not.
    pub(crate) fn joining(&self, line: &Centerline, others: &[&DocumentVessel]) -> Result<String> {
        let last = line.points.len() - 1;
        let mut words = format!("{} mm", fixed(arc_lengths(&line.points)[last], 1));
        let mut joined = Vec::new();
        for other in others {
            let points = self.lines.get(other.line)?.points.clone();
            let lengths = arc_lengths(&points);
            for end in [0, last] {
                let met = points.iter().position(|point| point.distance(line.points[end]) <= SAME);
                joined.extend(met.map(|n| format!("{} at {} mm", other.called(), fixed(lengths[n], 0))));
            }
        }
        if !joined.is_empty() {
            words += &format!(", joins {}", joined.join(" and "));
        }
        Ok(words)
    }

    /// Where a line is doubtful, the place where it has left its lumen first.
    fn doubtful(&self, line: &Centerline, clicks: Option<&[Place]>) -> Result<Vec<DoubtfulPlace>> {
        let Some(held) = &self.content.held else { return Ok(Vec::new()) };
        let volume = held.volume()?;
        let voxels = &Voxels::new(&volume);
        let ends = clicks.and_then(|clicks| Some([*clicks.first()?, *clicks.last()?].map(DVec3::from_array)));
        if ends.is_some_and(|ends| runs_across(voxels, ends)) {
            let words = "The path runs across the lumen, not along it: click in another slice.".to_owned();
            return Ok(vec![DoubtfulPlace { words, at: None }]);
        }
        let lengths = arc_lengths(&line.points);
        let change = level_change(voxels, line).map(|n| {
            let at = lengths[n];
            let words =
                format!("Doubtful from {} mm on: the brightness of the lumen changes there.", fixed(at, 0));
            DoubtfulPlace { words, at: Some(at) }
        });
        let wander = wandering_from(line).map(|(from, to)| wanders(lengths[from], lengths[to]));
        Ok(change.into_iter().chain(wander).collect())
    }
}

/// The first stretch of points on which a line wanders; pauses of less than a radius belong to it.
fn wandering_from(line: &Centerline) -> Option<(usize, usize)> {
    let is_wandering = wandering(line);
    let lengths = arc_lengths(&line.points);
    let from = is_wandering.iter().position(|wanders| *wanders)?;
    let later = (from..is_wandering.len()).filter(|n| is_wandering[*n]);
    let goes_on = |to: usize, n: usize| lengths[n] - lengths[to] <= line.radius[n];
    Some((from, later.fold(from, |to, n| if goes_on(to, n) { n } else { to })))
}

/// What is told of a stretch on which a line wanders, from one arc length to another (mm).
fn wanders(from: f64, to: f64) -> DoubtfulPlace {
    let why = "the line turns in less than the width of the vessel there";
    let (words, at) = if from > 0.0 {
        (format!("Doubtful from {} mm on: {why}.", fixed(from, 0)), from)
    } else {
        (format!("Doubtful up to {} mm: {why}.", fixed(to, 0)), to)
    };
    DoubtfulPlace { words, at: Some(at) }
}
