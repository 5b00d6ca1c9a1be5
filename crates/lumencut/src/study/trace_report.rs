//! Reports on a traced vessel: its length, the vessels that it joins, and its doubtful stretches.

use glam::DVec3;
use lumencut_core::math::arc_length::arc_lengths;
use lumencut_vessels::trace::lines::centerline::Centerline;
use lumencut_vessels::trace::lumen::own_axis::runs_across;
use lumencut_vessels::voxels::Voxels;
use serde::Serialize;

use crate::doubtful_places::{DoubtfulPlace, doubtful_places};
use crate::study::document::{Document, DocumentVessel, WorldPoint};
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

impl Study {
    pub(crate) fn trace_report(&self, document: &Document, id: Option<u32>) -> Result<Option<Told>> {
        let Some(vessel) = id.and_then(|id| document.vessel(id)) else { return Ok(None) };
        let line = self.lines.get(vessel.line)?.met();
        let others: Vec<&DocumentVessel> =
            document.vessels.iter().filter(|other| other.id != vessel.id && other.is_sure()).collect();
        let words = format!("{}, {}.", vessel.called(), self.joining(&line, &others)?);
        Ok(Some(Told { vessel: vessel.id, words, doubts: self.doubtful(&line, vessel.clicks.as_deref())? }))
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

    fn doubtful(&self, line: &Centerline, clicks: Option<&[WorldPoint]>) -> Result<Vec<DoubtfulPlace>> {
        let Some(held) = &self.content.held else { return Ok(Vec::new()) };
        let volume = held.volume()?;
        let voxels = &Voxels::new(&volume);
        let ends = clicks.and_then(|clicks| Some([*clicks.first()?, *clicks.last()?].map(DVec3::from_array)));
        if ends.is_some_and(|ends| runs_across(voxels, ends)) {
            let words = "The path runs across the lumen, not along it: click in another slice.".to_owned();
            return Ok(vec![DoubtfulPlace { words, at: None }]);
        }
        Ok(doubtful_places(voxels, line))
    }
}
