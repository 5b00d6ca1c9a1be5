//! Reports on a traced vessel: its length, the vessels that it joins, and its doubtful stretches.

use glam::DVec3;
use lumencut_core::math::arc_length::arc_lengths;
use lumencut_vessels::trace::clicks::doubts::{Doubt, Doubted};
use lumencut_vessels::trace::lines::centerline::Centerline;
use lumencut_vessels::voxels::Voxels;
use serde::Serialize;

use crate::study::document::{Document, DocumentVessel};
use crate::study::failure::Result;
use crate::study::open_study::Study;
use crate::text::fixed;

/// An end within this distance (mm) of a point of another line is the same point; it differs only by rounding.
const SAME_POINT_MM: f64 = 1e-6;

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct Told {
    pub vessel: u32,
    /// A sentence with name, length and joined vessels.
    pub words: String,
    pub doubts: Vec<DoubtfulPlace>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct DoubtfulPlace {
    /// A sentence that states the reason of the doubt.
    pub words: String,
    /// The arc length (mm) from which, or up to which, the vessel is doubtful, to show and cut there; none for the whole line.
    pub at: Option<f64>,
}

/// A doubt about a vessel that was found, with its place.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct VesselDoubt {
    pub(crate) line: usize,
    pub(crate) kind: String,
    #[serde(flatten)]
    pub(crate) place: DoubtfulPlace,
}

impl VesselDoubt {
    pub(crate) fn of(line: usize, doubt: Doubt) -> Self {
        let Doubt { words, kind, at } = doubt;
        Self { line, kind: kind.to_owned(), place: DoubtfulPlace { words, at } }
    }
}

impl Study {
    pub(crate) fn trace_report(&self, document: &Document, id: Option<u32>) -> Result<Option<Told>> {
        let Some(vessel) = id.and_then(|id| document.vessel(id)) else { return Ok(None) };
        let line = self.lines.get(vessel.line)?.met();
        let others: Vec<&DocumentVessel> =
            document.vessels.iter().filter(|other| other.id != vessel.id && other.is_sure()).collect();
        let words = format!("{}, {}.", vessel.called(), self.joining(&line, &others)?);
        Ok(Some(Told { vessel: vessel.id, words, doubts: self.doubtful(vessel)? }))
    }

    pub(crate) fn joining(&self, line: &Centerline, others: &[&DocumentVessel]) -> Result<String> {
        let last = line.points.len() - 1;
        let mut words = format!("{} mm", fixed(arc_lengths(&line.points)[last], 1));
        let mut joined = Vec::new();
        for other in others {
            let points = self.lines.get(other.line)?.points.clone();
            let lengths = arc_lengths(&points);
            for end in [0, last] {
                let met = points.iter().position(|point| point.distance(line.points[end]) <= SAME_POINT_MM);
                joined.extend(met.map(|n| format!("{} at {} mm", other.called(), fixed(lengths[n], 0))));
            }
        }
        if !joined.is_empty() {
            words += &format!(", joins {}", joined.join(" and "));
        }
        Ok(words)
    }

    fn doubtful(&self, vessel: &DocumentVessel) -> Result<Vec<DoubtfulPlace>> {
        let Some(held) = &self.content.held else { return Ok(Vec::new()) };
        let volume = held.volume()?.with_polarity(self.content.polarity);
        let line = self.lines.get(vessel.line)?;
        let clicks: Vec<DVec3> = vessel.clicks.iter().flatten().copied().map(DVec3::from_array).collect();
        let bridged = line.bridged.as_deref().unwrap_or_default();
        let doubted = Doubted { line: &line.met(), bridged, clicks: &clicks };
        let doubts = doubted.doubts(&Voxels::new(&volume)).into_iter();
        Ok(doubts.map(|doubt| DoubtfulPlace { words: doubt.words, at: doubt.at }).collect())
    }
}
