//! Carries out edits of vessels, and traces the affected vessels again.

use glam::DVec3;

use crate::study::document::{Document, DocumentVessel, WorldPoint};
use crate::study::draft::Draft;
use crate::study::edits::{Edit, EditMessage, Edited};
use crate::study::failure::Result;
use crate::study::open_study::Study;
use crate::study::points_along::{click_after, nearest_point, points_along};
use crate::study::reshaping::Reshaping;
use crate::study::trace_report::{DoubtfulPlace, VesselDoubt};
use crate::study::tracing::{HeldLine, TraceRequest, Watch};

impl Study {
    /// The initial document: the opened vessels, with ids from 1.
    pub(crate) fn begin_document(&mut self) -> Document {
        let mut draft = Draft::default();
        if let Some(named) = &self.content.named {
            for (line, name) in named.lines.iter().zip(&named.names) {
                draft.add(*line, name.clone());
            }
        }
        self.last_id = draft.last_id;
        draft.document
    }

    /// The document after an edit. If clicks, stoppers or bridging change, all vessels with clicks are traced again. They can join
    /// the other vessels that are not doubtful.
    pub(crate) fn edit(&mut self, message: &EditMessage, watch: Watch) -> Result<Edited> {
        self.trace_dark(message.document.dark);
        let mut draft = Draft::of(message.document.clone(), self.last_id);
        draft.kind = self.content.kind();
        let (mut notes, mut doubts) = (Vec::new(), Vec::new());
        let is_traced = match &message.edit {
            Edit::AddBranches { seed } => {
                self.add_branches(&mut draft, *seed, watch).map(|found| doubts = found).map(|()| false)
            }
            Edit::AddWholeVessel { click } => {
                self.add_whole_vessel(&mut draft, &mut notes, (*click, watch)).map(|()| false)
            }
            Edit::FindVessels { doubtful } => self
                .add_found(&mut draft, *doubtful, watch)
                .map(|found| (notes, doubts) = found)
                .map(|()| false),
            Edit::AddMask => self.add_mask(&mut draft, &mut notes, watch).map(|()| false),
            Edit::Cut { id, at } => self.cut_vessel(&mut draft, *id, *at).map(|()| false),
            Edit::Join { id, other } => self.join_vessels(&mut draft, *id, *other).map(|()| false),
            Edit::Bend { id, at, to } => {
                let how = Reshaping::Bend { at: *at, to: *to };
                self.reshape_vessel(&mut draft, *id, &how).map(|()| false)
            }
            Edit::Smooth { id, sigma } => {
                self.reshape_vessel(&mut draft, *id, &Reshaping::Smooth { sigma: *sigma }).map(|()| false)
            }
            Edit::AddClickOnLine { id, point } => {
                self.add_click_on_line(&mut draft, *id, *point).map(|()| true)
            }
            other => Ok(changed(&mut draft, other)),
        }?;
        draft.document.bridge |= message.bridging;
        if (is_traced || message.bridging) && draft.document != message.document {
            self.trace_clicked(&mut draft, watch)?;
        }
        self.last_id = draft.last_id;
        let Draft { document, added, without_marks, .. } = draft;
        let mut told = self.trace_report(&document, message.edit.traces(&added))?;
        if let Some(told) = &mut told {
            told.doubts.extend(notes.iter().map(|note| DoubtfulPlace { words: note.clone(), at: None }));
        }
        Ok(Edited { document, words: message.words(), added, without_marks, notes, doubts, told })
    }

    fn trace_clicked(&mut self, draft: &mut Draft, watch: Watch) -> Result<()> {
        let Document { vessels, stoppers, bridge, .. } = &draft.document;
        let request = TraceRequest {
            vessels: draft.clicked().map(|(_, clicks)| clicks.clone()).collect(),
            stoppers: stoppers.clone(),
            bridge: *bridge,
            beside: vessels.iter().filter(|vessel| is_beside(vessel)).map(|vessel| vessel.line).collect(),
        };
        if request.vessels.is_empty() {
            return Ok(());
        }
        let lines = self.trace(&request, watch).map_err(|failure| draft.in_names(failure))?;
        let clicked = draft.document.vessels.iter_mut().filter(|vessel| vessel.clicks.is_some());
        for (vessel, line) in clicked.zip(lines) {
            vessel.take_line(line);
        }
        Ok(())
    }

    fn add_branches(
        &mut self,
        draft: &mut Draft,
        seed: WorldPoint,
        watch: Watch,
    ) -> Result<Vec<VesselDoubt>> {
        // Rejects a seed in bone or fat immediately, and not after a search of the whole scan.
        self.check_click(seed)?;
        Ok(add_held(draft, self.trace_from(seed, watch)?, "Branch"))
    }

    fn add_found(
        &mut self,
        draft: &mut Draft,
        doubtful: bool,
        watch: Watch,
    ) -> Result<(Vec<String>, Vec<VesselDoubt>)> {
        let (found, notes) = self.find_vessels(doubtful, watch)?;
        let name = draft.kind.words().name;
        Ok((notes, add_held(draft, found, name)))
    }

    fn add_mask(&mut self, draft: &mut Draft, notes: &mut Vec<String>, watch: Watch) -> Result<()> {
        let mask = self.trace_mask(watch)?;
        *notes = mask.notes;
        for named in mask.lines {
            draft.add_named(named.line, &named.name, "Mask");
        }
        Ok(())
    }

    fn cut_vessel(&mut self, draft: &mut Draft, id: u32, at: f64) -> Result<()> {
        if let Some(vessel) = draft.document.vessel(id) {
            let parts = self.cut(vessel.line, at)?;
            draft.part(id, parts);
        }
        Ok(())
    }

    fn join_vessels(&mut self, draft: &mut Draft, id: u32, other: u32) -> Result<()> {
        let both = draft.document.vessel(id).zip(draft.document.vessel(other));
        if let Some((first, second)) = both.filter(|_| id != other) {
            let line = self.join(first.line, second.line)?;
            draft.replace(id, line);
            draft.remove(&[other]);
        }
        Ok(())
    }

    fn add_click_on_line(&mut self, draft: &mut Draft, id: u32, point: WorldPoint) -> Result<()> {
        let Some(vessel) = draft.document.vessel(id).filter(|vessel| vessel.is_sure()) else {
            return Ok(());
        };
        let line = self.lines.get(vessel.line)?;
        let number = nearest_point(&line.points, DVec3::from_array(point));
        if let Some(clicks) = &vessel.clicks {
            let clicks: Vec<DVec3> = clicks.iter().copied().map(DVec3::from_array).collect();
            draft.insert_click(id, Some(click_after(&clicks, &line.points, number)), point);
        } else {
            let chosen = points_along(&line.points, number).into_iter();
            draft.give_clicks(id, chosen.map(|n| line.points[n].to_array()).collect());
        }
        Ok(())
    }
}

fn is_beside(vessel: &DocumentVessel) -> bool {
    vessel.clicks.is_none() && vessel.is_sure()
}

/// Applies an edit that changes only the document; returns whether vessels with clicks must be traced again.
fn changed(draft: &mut Draft, edit: &Edit) -> bool {
    match edit {
        Edit::BeginVessel { clicks } => draft.begin(clicks),
        Edit::AddClick { id, point } => draft.insert_click(*id, None, *point),
        Edit::MoveClick { id, number, point } => draft.move_click(*id, *number, *point),
        Edit::RemoveClick { id, number } => return draft.remove_click(*id, *number),
        Edit::SetBridge { bridge } => draft.document.bridge = *bridge,
        Edit::SetDark { dark } => draft.set_dark(*dark),
        Edit::HideBone { hidden } => draft.document.bone_hidden = *hidden,
        Edit::AddStopper { .. } | Edit::MoveStopper { .. } | Edit::RemoveStopper { .. } => {
            draft.change_stoppers(edit);
        }
        Edit::Remove { ids } => draft.remove(ids),
        Edit::Accept { ids } => draft.accept(ids),
        Edit::LeaveOut { ids } => draft.leave_out(ids),
        Edit::AddLines { lines } => {
            for named in lines {
                draft.add(named.line, named.name.clone());
            }
        }
        // `Study::edit` carries these out.
        Edit::AddBranches { .. }
        | Edit::AddWholeVessel { .. }
        | Edit::FindVessels { .. }
        | Edit::AddMask
        | Edit::Cut { .. }
        | Edit::Join { .. }
        | Edit::Bend { .. }
        | Edit::Smooth { .. }
        | Edit::AddClickOnLine { .. } => {}
    }
    edit.is_of_clicks()
}

/// Adds found vessels; returns the places from which confident ones are doubtful.
fn add_held(draft: &mut Draft, found: Vec<HeldLine>, kind: &str) -> Vec<VesselDoubt> {
    let mut doubts = Vec::new();
    for HeldLine { line, places, doubt } in found {
        let vessel = draft.add_named(line, "", kind);
        vessel.doubt = doubt.map(str::to_owned);
        doubts.extend(places.into_iter().map(|doubt| VesselDoubt::of(line, doubt)));
    }
    doubts
}
