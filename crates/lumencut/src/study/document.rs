//! The part of a viewer's document that edits of vessels change. It is small and never changed in place: a host keeps the
//! documents before an edit, so that undo shows them again.

use serde::{Deserialize, Serialize};

use crate::study::palette::next_color;
use crate::study::tracing::StopperMessage;

/// A place in the world (LPS, mm).
pub(crate) type Place = [f64; 3];

/// A vessel that the reader sees in the list.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct DocumentVessel {
    /// Stays the same through edits; never given twice in a study.
    pub(crate) id: u32,
    /// The number of its line.
    pub line: usize,
    /// Its name; empty where it has none.
    pub name: String,
    /// `#rrggbb`.
    pub(crate) color: String,
    /// Whether the views leave it out.
    pub(crate) is_hidden: bool,
    /// Where it was clicked, in order along it; none where it came from a file, a mask or a seed, or was cut or joined.
    pub(crate) clicks: Option<Vec<Place>>,
    /// Why a branch from a seed is doubtful: it is shown apart until it is accepted. None where it is not.
    pub(crate) doubt: Option<String>,
}

impl DocumentVessel {
    /// Whether it is a vessel that is there already, and no branch that is offered: others hang on it, and a click in it adds nothing.
    pub(crate) fn is_sure(&self) -> bool {
        self.doubt.is_none()
    }

    /// What lists, files and errors call it.
    pub(crate) fn called(&self) -> String {
        if self.name.is_empty() { format!("vessel {}", self.id) } else { self.name.clone() }
    }
}

/// The vessels of a document, and what they are traced by.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "VesselDocument"))]
pub(crate) struct Document {
    /// In the order of the list.
    pub vessels: Vec<DocumentVessel>,
    /// Balls that no vessel may pass.
    pub(crate) stoppers: Vec<StopperMessage>,
    /// Whether vessels go on where no lumen is seen.
    pub(crate) bridge: bool,
}

impl Document {
    /// Where a vessel stands in the list.
    pub(crate) fn position(&self, id: u32) -> Option<usize> {
        self.vessels.iter().position(|vessel| vessel.id == id)
    }

    /// The vessel of an id.
    pub(crate) fn vessel(&self, id: u32) -> Option<&DocumentVessel> {
        self.vessels.iter().find(|vessel| vessel.id == id)
    }

    /// The names of all vessels.
    pub(crate) fn names(&self) -> Vec<String> {
        self.vessels.iter().map(|vessel| vessel.name.clone()).collect()
    }

    /// The colour that the next vessel gets.
    pub(crate) fn next_color(&self) -> &'static str {
        let taken: Vec<&str> = self.vessels.iter().map(|vessel| vessel.color.as_str()).collect();
        next_color(&taken)
    }
}
