//! The whole vessel of one click, in the study that is open: it is one of all vessels of the scan, which are looked for once.

use glam::DVec3;
use lumencut_vessels::trace::find::found::Trees;
use lumencut_vessels::trace::find::{FindRequest, SMALLEST_RADIUS, find_vessels};
use lumencut_vessels::trace::lines::centerline::Centerline;

use crate::found_vessels::one_vessel;
use crate::study::document::{DocumentVessel, Place};
use crate::study::draft::Draft;
use crate::study::failure::Result;
use crate::study::held_volume::no_volume;
use crate::study::open_study::Study;
use crate::study::tracing::Watch;

impl Study {
    /// The vessels of the scan down to the radius of Python, sure and doubtful ones.
    ///
    /// # Errors
    /// `volume` where none is open, `interrupted`.
    pub(crate) fn trees(&mut self, watch: Watch) -> Result<&Trees> {
        let volume = self.content.held.as_ref().ok_or_else(no_volume)?.volume()?;
        let Watch { stop, progress } = watch;
        let request = FindRequest { smallest_radius: SMALLEST_RADIUS, stop, progress: Some(progress) };
        Ok(match self.trees.take() {
            Some(known) => self.trees.insert(known),
            None => {
                let found = find_vessels(&volume, &request)?;
                self.trees.insert(found)
            }
        })
    }

    /// Adds the vessel that a click lies in, from the nearest vessel that there is already to its end.
    ///
    /// # Errors
    /// `tracing` as [`one_vessel`] and for a place that no vessel can begin at, `volume` where none is open, `interrupted`.
    pub(crate) fn add_whole_vessel(&mut self, draft: &mut Draft, click: Place, watch: Watch) -> Result<()> {
        // A place in air or fat is refused at once: the search would look through all of the scan before it says so.
        self.check_click(click)?;
        self.trees(watch)?;
        let beside: Vec<usize> = draft.document.vessels.iter().filter(is_sure).map(|one| one.line).collect();
        if let Some(line) = self.known_vessel(click, &beside)? {
            let line = self.lines.add(line.into())?;
            draft.add_named(line, "", "Vessel");
        }
        Ok(())
    }

    /// The vessel that a click would add beside lines that there are already; none as long as the vessels of the scan were not
    /// looked for.
    ///
    /// # Errors
    /// Those of [`one_vessel`], `vessel tree` for a line that there is not, `volume` where none is open.
    pub(crate) fn known_vessel(&self, click: Place, beside: &[usize]) -> Result<Option<Centerline>> {
        let volume = self.content.held.as_ref().ok_or_else(no_volume)?.volume()?;
        let Some(trees) = &self.trees else { return Ok(None) };
        let beside = beside.iter().map(|line| Ok(self.lines.get(*line)?.met()));
        let beside: Vec<Centerline> = beside.collect::<Result<_>>()?;
        Ok(Some(one_vessel(&volume, trees, DVec3::from_array(click), &beside)?))
    }

    /// The points of the vessel that a click would add; none where it would add none, and as long as that is not known at once.
    ///
    /// # Errors
    /// `vessel tree` for a line that there is not, `volume` where none is open.
    pub fn whole_vessel(&self, click: Place, beside: &[usize]) -> Result<Option<Vec<Place>>> {
        let points = |line: Centerline| line.points.iter().map(|point| point.to_array()).collect();
        match self.known_vessel(click, beside) {
            Err(refused) if refused.kind == "tracing" => Ok(None),
            known => Ok(known?.map(points)),
        }
    }
}

/// Whether a vessel is more than an offer.
fn is_sure(vessel: &&DocumentVessel) -> bool {
    vessel.doubt.is_none()
}
