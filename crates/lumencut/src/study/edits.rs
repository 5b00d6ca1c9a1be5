//! The edits of vessels that a viewer offers, and what comes of them.
//!
//! Name, colour and whether a vessel is hidden are no edits here: a host sets these fields itself and at once, since nothing
//! follows from them. Undo is the host's too: it keeps the documents before each step beside what else it undoes, such as marks and
//! rulers, which must not wait for a vessel that is being traced.

use serde::{Deserialize, Serialize};

use crate::study::document::{Document, Place};
use crate::study::lines::NamedLine;
use crate::study::telling::Told;

/// An edit of vessels. Clicks and stoppers are numbered from 0, arc lengths are in mm.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(tag = "kind", rename_all = "snake_case")]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) enum Edit {
    /// A vessel between two clicks or more.
    BeginVessel {
        /// In order along it.
        clicks: Vec<Place>,
    },
    /// A click at the end of a vessel.
    AddClick {
        /// The vessel.
        id: u32,
        /// Where it is.
        point: Place,
    },
    /// A click between others, where a vessel was taken hold of. One that was not clicked gets clicks along its line, so that it can
    /// be edited and still runs where it ran.
    AddClickOnLine {
        /// The vessel.
        id: u32,
        /// A point of its line.
        point: Place,
    },
    /// A click elsewhere.
    MoveClick {
        /// The vessel.
        id: u32,
        /// Which of its clicks.
        number: usize,
        /// Where it is now.
        point: Place,
    },
    /// A vessel without one of its clicks; one that would have only one left goes with it.
    RemoveClick {
        /// The vessel.
        id: u32,
        /// Which of its clicks.
        number: usize,
    },
    /// One more ball that no vessel may pass.
    AddStopper {
        /// Its center.
        center: Place,
    },
    /// A stopper elsewhere.
    MoveStopper {
        /// Which of them.
        number: usize,
        /// Its center now.
        center: Place,
    },
    /// A stopper less.
    RemoveStopper {
        /// Which of them.
        number: usize,
    },
    /// Whether vessels go on where no lumen is seen.
    SetBridge {
        /// Whether they do from now on.
        bridge: bool,
    },
    /// A vessel in two parts; the second one gets a name and a colour of its own.
    Cut {
        /// The vessel.
        id: u32,
        /// The arc length of the cut.
        at: f64,
    },
    /// A second vessel joined to a first one, which keeps its name and colour.
    Join {
        /// The first vessel.
        id: u32,
        /// The second one.
        other: u32,
    },
    /// Vessels less.
    Remove {
        /// Which of them.
        ids: Vec<u32>,
    },
    /// All branches that a seed reaches; doubtful ones wait until they are accepted.
    AddBranches {
        /// A place in a vessel.
        seed: Place,
    },
    /// The whole vessel that a click lies in, from the nearest vessel that there is already to its end.
    AddWholeVessel {
        /// A place in the vessel.
        click: Place,
    },
    /// All vessels of the scan; doubtful ones wait until they are accepted.
    FindVessels {
        /// Whether doubtful ones are wanted also where none is sure; else that is refused.
        doubtful: bool,
    },
    /// Doubtful branches are vessels as others from now on.
    Accept {
        /// Which of them.
        ids: Vec<u32>,
    },
    /// Doubtful branches less.
    LeaveOut {
        /// Which of them.
        ids: Vec<u32>,
    },
    /// The vessels of the mask that was read.
    AddMask,
    /// The vessels of lines that are held, as from files.
    AddLines {
        /// In their order.
        lines: Vec<NamedLine>,
    },
}

impl Edit {
    /// Whether it is of clicks, stoppers or bridges, after which vessels between clicks run elsewhere.
    pub(crate) fn is_of_clicks(&self) -> bool {
        matches!(
            self,
            Self::BeginVessel { .. }
                | Self::AddClick { .. }
                | Self::AddClickOnLine { .. }
                | Self::MoveClick { .. }
                | Self::RemoveClick { .. }
                | Self::AddStopper { .. }
                | Self::MoveStopper { .. }
                | Self::RemoveStopper { .. }
                | Self::SetBridge { .. }
        )
    }

    /// The vessel that it traces, where it is a single one; `added` are those that came of it.
    pub(crate) fn traces(&self, added: &[u32]) -> Option<u32> {
        match self {
            Self::BeginVessel { .. } | Self::AddWholeVessel { .. } => added.first().copied(),
            Self::AddClick { id, .. }
            | Self::AddClickOnLine { id, .. }
            | Self::MoveClick { id, .. }
            | Self::RemoveClick { id, .. } => Some(*id),
            _ => None,
        }
    }

    /// What it does, as the name of a step that can be undone.
    pub(crate) fn words(&self) -> &'static str {
        let count = |ids: &[u32], one, several| if ids.len() == 1 { one } else { several };
        match self {
            Self::BeginVessel { .. } => "begin a vessel",
            Self::AddClick { .. } | Self::AddClickOnLine { .. } => "add a point",
            Self::MoveClick { .. } => "move a point",
            Self::RemoveClick { .. } => "remove a point",
            Self::AddStopper { .. } => "add a stopper",
            Self::MoveStopper { .. } => "move a stopper",
            Self::RemoveStopper { .. } => "remove a stopper",
            Self::SetBridge { bridge: true } => "bridge gaps",
            Self::SetBridge { bridge: false } => "leave gaps",
            Self::Cut { .. } => "cut a vessel",
            Self::Join { .. } => "join two vessels",
            Self::Remove { ids } => count(ids, "delete a vessel", "delete vessels"),
            Self::AddBranches { .. } => "add all branches from here",
            Self::AddWholeVessel { .. } => "add a whole vessel",
            Self::FindVessels { .. } => "find all vessels",
            Self::Accept { ids } => count(ids, "accept a branch", "accept branches"),
            Self::LeaveOut { ids } => count(ids, "leave a branch out", "leave branches out"),
            Self::AddMask => "add the vessels of a mask",
            Self::AddLines { .. } => "open centerlines",
        }
    }
}

/// What a host asks for: an edit of a document.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "EditRequest"))]
pub(crate) struct EditMessage {
    /// The document as it is.
    pub(crate) document: Document,
    /// What is done to it.
    pub(crate) edit: Edit,
    /// Whether gaps are bridged from now on, as part of the same step: what mends an edit that was refused by `bridge`.
    pub(crate) bridging: bool,
}

impl EditMessage {
    /// The name of the step that can be undone.
    pub(crate) fn words(&self) -> String {
        let bridging = if self.bridging { " and bridge gaps" } else { "" };
        format!("{}{bridging}", self.edit.words())
    }
}

/// What came of an edit.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct Edited {
    /// The document after it; the same one where there was nothing to do.
    pub(crate) document: Document,
    /// The name of the step that can be undone.
    pub words: String,
    /// The vessels that came to it, by their ids.
    pub(crate) added: Vec<u32>,
    /// The vessels whose marks are lost, by their ids: they are gone, or their places lie elsewhere.
    pub(crate) without_marks: Vec<u32>,
    /// What was odd, one sentence each.
    pub(crate) notes: Vec<String>,
    /// What is told of the vessel that was traced; none after an edit that traces no single one.
    pub told: Option<Told>,
}
