//! Finds the whole vessel at a click among all vessels of the scan, which are searched for only once.

use glam::DVec3;
use lumencut_core::error::ErrorKind;
use lumencut_vessels::trace::clicks::checks::Clicks;
use lumencut_vessels::trace::clicks::tracer::Tracer;
use lumencut_vessels::trace::find::found::Trees;
use lumencut_vessels::trace::find::{FindRequest, find_vessels};
use lumencut_vessels::trace::lines::centerline::Centerline;
use lumencut_vessels::trace::lumen::own_axis::OwnLumen;
use lumencut_vessels::voxels::Voxels;
use serde::Serialize;

use crate::found_vessels::one_vessel;
use crate::study::document::{DocumentVessel, WorldPoint};
use crate::study::draft::Draft;
use crate::study::failure::Result;
use crate::study::lines::Line;
use crate::study::open_study::Study;
use crate::study::tracing::Watch;

/// A vessel that is hardly longer than wide is accepted if it is round: its points have at least this mean confidence. Its radius
/// (mm) must be at most that of the widest aorta.
const MIN_ROUND_CONFIDENCE: f64 = 0.6;
const MAX_STUMP_RADIUS_MM: f64 = 25.0;

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct WholeVessel {
    /// The points of the vessel's line (mm, LPS).
    pub points: Vec<WorldPoint>,
    /// Length and joined vessels, such as `84.2 mm, joins Vessel 2 at 12 mm`.
    pub words: String,
}

impl Study {
    pub(crate) fn trees(&mut self, watch: Watch) -> Result<&Trees> {
        let volume = self.content.traced()?;
        let Watch { stop, progress } = watch;
        let request = FindRequest { smallest_radius: None, stop, progress: Some(progress) };
        Ok(match self.trees.take() {
            Some(known) => self.trees.insert(known),
            None => {
                let found = find_vessels(&volume, &request)?;
                self.trees.insert(found)
            }
        })
    }

    pub(crate) fn add_whole_vessel(
        &mut self,
        draft: &mut Draft,
        notes: &mut Vec<String>,
        (click, watch): (WorldPoint, Watch),
    ) -> Result<()> {
        // Rejects a place in air or fat immediately, and not after a search of the whole scan.
        self.check_click(click)?;
        self.trees(watch)?;
        let known = self.known_vessel(click, &draft.document.vessels);
        // An error that advises a second click means that the scan shows too little of the vessel.
        let is_short = known.as_ref().is_err_and(|refused| !refused.mend.is_empty());
        let short = if is_short { self.short_vessel(click, &draft.document.vessels, watch)? } else { None };
        if let Some(line) = short {
            let line = self.lines.add(line)?;
            let name = draft.add_named(line, "", draft.kind.words().name).called();
            notes.push(format!(
                "{name} was traced from the click alone, because no {} was found there: check it.",
                draft.kind.words().one
            ));
        } else if let Some(line) = known? {
            let line = self.lines.add(line.into())?;
            draft.add_named(line, "", draft.kind.words().name);
        }
        Ok(())
    }

    /// The vessel at a click, if the scan cuts it off on both sides, and it is round and hardly longer than wide.
    fn short_vessel(
        &self,
        click: WorldPoint,
        vessels: &[DocumentVessel],
        watch: Watch,
    ) -> Result<Option<Line>> {
        let volume = self.content.traced()?;
        let Some(ends) = OwnLumen::around(&Voxels::new(&volume), DVec3::from_array(click)).cut_ends() else {
            return Ok(None);
        };
        let sure = vessels.iter().filter(|vessel| vessel.is_sure());
        let beside = sure.map(|vessel| Ok(self.lines.get(vessel.line)?.met())).collect::<Result<_>>()?;
        let clicks = Clicks { vessels: vec![ends.to_vec()], beside, ..Clicks::default() };
        let traced = match Tracer::default().trace(&volume, &clicks, watch.stop, None) {
            Err(error) if error.kind == ErrorKind::Tracing => return Ok(None),
            traced => traced?,
        };
        let is_round = |line: &Centerline| {
            let sum: f64 = line.confidence.iter().sum();
            let is_narrow = line.radius.iter().all(|radius| *radius <= MAX_STUMP_RADIUS_MM);
            is_narrow && sum >= MIN_ROUND_CONFIDENCE * line.confidence.len() as f64
        };
        Ok(traced.into_iter().find(|traced| is_round(&traced.line)).map(Line::from))
    }

    /// The vessel that a click would add; None if the scan's vessels were not searched for yet.
    pub(crate) fn known_vessel(
        &self,
        click: WorldPoint,
        vessels: &[DocumentVessel],
    ) -> Result<Option<Centerline>> {
        let volume = self.content.traced()?;
        let Some(trees) = &self.trees else { return Ok(None) };
        let sure = vessels.iter().filter(|vessel| vessel.is_sure());
        let beside = sure.map(|vessel| Ok(self.lines.get(vessel.line)?.met()));
        let beside: Vec<Centerline> = beside.collect::<Result<_>>()?;
        Ok(Some(one_vessel(&volume, trees, DVec3::from_array(click), &beside)?))
    }

    /// As [`Study::known_vessel`], but None if the click is rejected.
    pub(crate) fn whole_vessel(
        &self,
        click: WorldPoint,
        vessels: &[DocumentVessel],
    ) -> Result<Option<WholeVessel>> {
        let line = match self.known_vessel(click, vessels) {
            Err(refused) if refused.kind == "tracing" => return Ok(None),
            known => known?,
        };
        let Some(line) = line else { return Ok(None) };
        let sure: Vec<&DocumentVessel> = vessels.iter().filter(|vessel| vessel.is_sure()).collect();
        let words = self.joining(&line, &sure)?;
        Ok(Some(WholeVessel { points: line.points.iter().map(|point| point.to_array()).collect(), words }))
    }
}
