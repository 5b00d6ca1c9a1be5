//! The edits of vessels that a viewer offers, and their results. Name, colour, visibility and contours by hand
//! are not edits: the viewer sets these fields immediately, since nothing follows from them. The viewer also undoes edits: it keeps
//! earlier documents with their marks and rulers, which must not wait for tracing.

use serde::{Deserialize, Serialize};

use crate::study::document::{Document, WorldPoint};
use crate::study::lines::NamedLine;
use crate::study::trace_report::{Told, VesselDoubt};

/// An edit of vessels. Clicks and stoppers are numbered from 0; arc lengths in mm.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(tag = "kind", rename_all = "snake_case")]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) enum Edit {
    BeginVessel {
        clicks: Vec<WorldPoint>,
    },
    AddClick {
        id: u32,
        point: WorldPoint,
    },
    /// Adds a click between others, at the point to which a vessel was dragged. A vessel without clicks first gets clicks along its
    /// line, to stay in place.
    AddClickOnLine {
        id: u32,
        point: WorldPoint,
    },
    MoveClick {
        id: u32,
        number: usize,
        point: WorldPoint,
    },
    /// Removes a click. If only one click would be left, the vessel is removed.
    RemoveClick {
        id: u32,
        number: usize,
    },
    AddStopper {
        center: WorldPoint,
    },
    MoveStopper {
        number: usize,
        center: WorldPoint,
    },
    RemoveStopper {
        number: usize,
    },
    /// Sets whether tracing bridges stretches without visible lumen.
    SetBridge {
        bridge: bool,
    },
    /// Sets whether tracing looks for dark lumens. Vessels keep their lines, but lose their clicks.
    SetDark {
        dark: bool,
    },
    /// Sets whether the context hides bone.
    HideBone {
        hidden: bool,
    },
    /// Cuts a vessel in two; the second part gets its own name and colour.
    Cut {
        id: u32,
        at: f64,
    },
    /// Moves the line of a vessel by hand, from an arc length to a place. It then has no clicks; the ends of vessels that meet
    /// it follow.
    Bend {
        id: u32,
        at: f64,
        to: WorldPoint,
    },
    /// Smooths the line of a vessel by a Gaussian (standard deviation in mm), in the same way.
    Smooth {
        id: u32,
        sigma: f64,
    },
    /// Joins a second vessel to the first, which keeps name and colour.
    Join {
        id: u32,
        other: u32,
    },
    Remove {
        ids: Vec<u32>,
    },
    /// Adds all branches connected to a seed; doubtful ones wait until they are accepted.
    AddBranches {
        seed: WorldPoint,
    },
    /// Adds the whole vessel at a click, from the nearest existing vessel to its end.
    AddWholeVessel {
        click: WorldPoint,
    },
    /// Adds all vessels of the scan; doubtful ones wait until they are accepted.
    FindVessels {
        /// Whether to return only doubtful vessels if none is confident; otherwise that is an error.
        doubtful: bool,
    },
    Accept {
        ids: Vec<u32>,
    },
    LeaveOut {
        ids: Vec<u32>,
    },
    AddMask,
    /// Adds vessels with existing lines, such as lines of files.
    AddLines {
        lines: Vec<NamedLine>,
    },
}

impl Edit {
    /// Whether the edit changes clicks, stoppers or bridging, so that vessels with clicks are traced again.
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

    /// The vessel that the edit traces, if it is a single one; `added` are the new ids.
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
            Self::SetDark { dark: true } => "trace dark lumens",
            Self::SetDark { dark: false } => "trace bright lumens",
            Self::HideBone { hidden: true } => "hide bone",
            Self::HideBone { hidden: false } => "show bone",
            Self::Cut { .. } => "cut a vessel",
            Self::Join { .. } => "join two vessels",
            Self::Bend { .. } => "move a line",
            Self::Smooth { .. } => "smooth a line",
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

#[derive(Clone, Debug, Deserialize, PartialEq)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "EditRequest"))]
pub(crate) struct EditMessage {
    pub(crate) document: Document,
    pub(crate) edit: Edit,
    /// Whether to bridge gaps from now on, in the same step. This is the remedy for an edit that was rejected with `bridge`.
    pub(crate) bridging: bool,
}

impl EditMessage {
    pub(crate) fn words(&self) -> String {
        let bridging = if self.bridging { " and bridge gaps" } else { "" };
        format!("{}{bridging}", self.edit.words())
    }
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct Edited {
    /// The document after the edit; unchanged if there was nothing to do.
    pub(crate) document: Document,
    /// The name of the undo step.
    pub words: String,
    pub(crate) added: Vec<u32>,
    pub(crate) without_marks: Vec<u32>,
    pub(crate) notes: Vec<String>,
    /// Places from which found vessels are doubtful.
    pub(crate) doubts: Vec<VesselDoubt>,
    /// The report on the traced vessel, if it is a single one.
    pub told: Option<Told>,
}
