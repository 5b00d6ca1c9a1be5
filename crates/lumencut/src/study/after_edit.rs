//! Answers an edit at once with all that a viewer needs afterwards: vessels, lines, facts, and what lies at the edited place.

use serde::Serialize;

use crate::study::content::Report;
use crate::study::document::{Document, DocumentVessel, WorldPoint};
use crate::study::edits::{Edit, EditMessage, Edited};
use crate::study::failure::Result;
use crate::study::line_facts::LineFacts;
use crate::study::lines::{LineContent, ListedLine};
use crate::study::open_study::Study;
use crate::study::picking::Pick;
use crate::study::tracing::Watch;
use crate::study::whole_vessel::WholeVessel;

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct AfterEdit {
    pub(crate) edited: Edited,
    /// The state after the edit, in which all vessels that are not doubtful are shown.
    pub(crate) report: Report,
    /// The lines that the document before the edit did not have.
    pub lines: Vec<NumberedLine>,
    /// Facts about the lines that are not doubtful.
    pub(crate) facts: Vec<LineFacts>,
    /// What lies at the place of the edit, if the edit has a place.
    pub(crate) pick: Option<Pick>,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct NumberedLine {
    pub line: usize,
    pub content: LineContent,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct FirstClick {
    pub(crate) pick: Pick,
    /// The whole vessel that the click would add.
    pub whole: Option<WholeVessel>,
}

impl Study {
    /// Makes an edit and shows the document after it. After an error the view stays unchanged.
    pub(crate) fn edit_and_show(&mut self, message: &EditMessage, watch: Watch) -> Result<AfterEdit> {
        let edited = self.edit(message, watch)?;
        let listed = listed(&edited.document);
        self.trace_dark(edited.document.dark);
        self.hide_bone(edited.document.bone_hidden, &listed, watch)?;
        self.show(&listed)?;
        let known: Vec<usize> = message.document.vessels.iter().map(|vessel| vessel.line).collect();
        let mut new: Vec<usize> = edited.document.vessels.iter().map(|vessel| vessel.line).collect();
        new.retain(|line| !known.contains(line));
        let numbered = |line| Ok(NumberedLine { line, content: self.line(line)? });
        let lines = new.into_iter().map(numbered).collect::<Result<_>>()?;
        let facts = self.line_facts(&listed.iter().map(|one| one.line).collect::<Vec<_>>())?;
        let pick = place(&message.edit).map(|place| self.at(place));
        Ok(AfterEdit { report: self.report()?, lines, facts, pick, edited })
    }

    pub(crate) fn first_click(&self, click: WorldPoint, vessels: &[DocumentVessel]) -> Result<FirstClick> {
        self.check_click(click)?;
        Ok(FirstClick { pick: self.at(click), whole: self.whole_vessel(click, vessels)? })
    }
}

/// The vessels to show: all that are not doubtful.
fn listed(document: &Document) -> Vec<ListedLine> {
    let of = |vessel: &DocumentVessel| ListedLine {
        line: vessel.line,
        name: vessel.called(),
        hidden: vessel.is_hidden,
        contours: vessel.contours.clone(),
    };
    document.vessels.iter().filter(|vessel| vessel.is_sure()).map(of).collect()
}

/// The place of an edit: where its click, seed or stopper lies.
fn place(edit: &Edit) -> Option<WorldPoint> {
    match edit {
        Edit::BeginVessel { clicks } => clicks.last().copied(),
        Edit::AddClick { point: place, .. }
        | Edit::AddClickOnLine { point: place, .. }
        | Edit::MoveClick { point: place, .. }
        | Edit::AddStopper { center: place }
        | Edit::MoveStopper { center: place, .. }
        | Edit::AddBranches { seed: place }
        | Edit::AddWholeVessel { click: place } => Some(*place),
        _ => None,
    }
}
