//! The part of a viewer's document that edits of vessels change. Documents are immutable; the viewer keeps earlier ones for undo.

use serde::{Deserialize, Serialize};

use crate::study::outlines::Contour;
use crate::study::palette::next_color;
use crate::study::tracing::StopperMessage;

/// A point in the world (LPS, mm).
pub(crate) type WorldPoint = [f64; 3];

#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct DocumentVessel {
    /// Identifies the vessel: it is constant through edits and unique in a study.
    pub(crate) id: u32,
    pub line: usize,
    /// Name; may be empty.
    pub name: String,
    /// `#rrggbb`.
    pub(crate) color: String,
    pub(crate) is_hidden: bool,
    /// The clicks of the vessel in order; none if it came from a file, mask or seed, or was cut or joined.
    pub(crate) clicks: Option<Vec<WorldPoint>>,
    /// Why a found branch is doubtful, until it is accepted.
    pub(crate) doubt: Option<String>,
    /// The contours that were drawn by hand on the vessel's line.
    #[serde(default)]
    pub(crate) contours: Vec<Contour>,
}

impl DocumentVessel {
    /// Whether the vessel is not doubtful: other vessels may join it, and clicks in it add nothing.
    pub(crate) fn is_sure(&self) -> bool {
        self.doubt.is_none()
    }

    /// Gives the vessel another line. Contours by hand belong to the sections of their line, so they are lost.
    pub(crate) fn take_line(&mut self, line: usize) {
        if self.line != line {
            self.line = line;
            self.contours.clear();
        }
    }

    pub(crate) fn called(&self) -> String {
        if self.name.is_empty() { format!("vessel {}", self.id) } else { self.name.clone() }
    }
}

#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "VesselDocument"))]
pub(crate) struct Document {
    /// The vessels in list order.
    pub vessels: Vec<DocumentVessel>,
    pub(crate) stoppers: Vec<StopperMessage>,
    /// Whether tracing bridges stretches without visible lumen.
    pub(crate) bridge: bool,
    /// Whether the context hides bone.
    #[serde(default)]
    pub(crate) bone_hidden: bool,
    /// Whether tracing looks for lumens that are darker than the tissue around them.
    #[serde(default)]
    pub(crate) dark: bool,
}

impl Document {
    pub(crate) fn position(&self, id: u32) -> Option<usize> {
        self.vessels.iter().position(|vessel| vessel.id == id)
    }

    pub(crate) fn vessel(&self, id: u32) -> Option<&DocumentVessel> {
        self.vessels.iter().find(|vessel| vessel.id == id)
    }

    pub(crate) fn names(&self) -> Vec<String> {
        self.vessels.iter().map(|vessel| vessel.name.clone()).collect()
    }

    pub(crate) fn next_color(&self) -> &'static str {
        let taken: Vec<&str> = self.vessels.iter().map(|vessel| vessel.color.as_str()).collect();
        next_color(&taken)
    }
}
