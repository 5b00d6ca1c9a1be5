//! What a viewer shows after an edit, in one answer: the vessels, their lines, what is known of them, and what lies where it was made.

use serde::Serialize;

use crate::study::content::Report;
use crate::study::document::{Document, DocumentVessel, Place};
use crate::study::edits::{Edit, EditMessage, Edited};
use crate::study::failure::Result;
use crate::study::line_facts::LineFacts;
use crate::study::lines::{LineContent, ListedLine};
use crate::study::open_study::Study;
use crate::study::picking::Pick;
use crate::study::tracing::Watch;
use crate::study::whole_vessel::WholeVessel;

/// An edit that was made, and what is shown after it.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct AfterEdit {
    /// What came of it.
    pub(crate) edited: Edited,
    /// What is open now: the vessels of the document that are not doubtful are shown, as `show` shows them.
    pub(crate) report: Report,
    /// The lines that came to the document.
    pub lines: Vec<NumberedLine>,
    /// What is known of the lines that are not doubtful, as `line_facts` tells it.
    pub(crate) facts: Vec<LineFacts>,
    /// What lies where the edit was made; none of an edit that has no place.
    pub(crate) pick: Option<Pick>,
}

/// A line with its number.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct NumberedLine {
    /// Its number.
    pub line: usize,
    /// Its content.
    pub content: LineContent,
}

/// What a first click of a vessel hit.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct FirstClick {
    /// What lies there.
    pub(crate) pick: Pick,
    /// The whole vessel that it would add, as `whole_vessel` tells it.
    pub whole: Option<WholeVessel>,
}

impl Study {
    /// Makes an edit and shows the document after it.
    ///
    /// # Errors
    /// Those of [`Study::edit`] and [`Study::show`]; what was shown stays then.
    pub(crate) fn edit_and_show(&mut self, message: &EditMessage, watch: Watch) -> Result<AfterEdit> {
        let edited = self.edit(message, watch)?;
        let listed = listed(&edited.document);
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

    /// What a first click hit, and the whole vessel that it would add beside the vessels of a list.
    ///
    /// # Errors
    /// Those of [`Study::check_click`] and [`Study::whole_vessel`].
    pub(crate) fn first_click(&self, click: Place, vessels: &[DocumentVessel]) -> Result<FirstClick> {
        self.check_click(click)?;
        Ok(FirstClick { pick: self.at(click), whole: self.whole_vessel(click, vessels)? })
    }
}

/// The vessels of a document as they are shown: without those that are doubtful.
fn listed(document: &Document) -> Vec<ListedLine> {
    let of = |vessel: &DocumentVessel| ListedLine {
        line: vessel.line,
        name: vessel.name.clone(),
        hidden: vessel.is_hidden,
    };
    document.vessels.iter().filter(|vessel| vessel.is_sure()).map(of).collect()
}

/// Where an edit is made: the click that it sets or moves, its seed or its stopper.
fn place(edit: &Edit) -> Option<Place> {
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
