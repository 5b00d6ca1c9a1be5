//! A short description of a series.

use std::fmt;

use serde::Serialize;
use serde::ser::{SerializeStruct, Serializer};

use crate::wording::{counted, rounded};

/// A series, described so that users can choose; texts are empty if not stated.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// Number of the series.
    pub number: String,
    /// UID of the series.
    pub uid: String,
    /// Description of the series.
    pub description: String,
    /// Modality of the series.
    pub modality: String,
    /// Number of images, or of frames.
    pub images: i64,
    /// Number of voxels along i, j, k; None if the images do not form a stack.
    pub size: Option<[i64; 3]>,
    /// Distance between voxels along i, j, k (mm).
    pub spacing: Option<[f64; 3]>,
    /// Whether the series may be an angiography volume.
    pub can_be_volume: bool,
    /// Why the series is not a volume, or not an angiography; otherwise empty.
    pub trouble: String,
}

impl fmt::Display for Report {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let or = |text: &str, otherwise: &str| if text.is_empty() { otherwise } else { text }.to_owned();
        let mut parts = vec![or(&self.description, "no description"), or(&self.modality, "no modality")];
        if let (Some(size), Some(spacing)) = (self.size, self.spacing) {
            parts.push(size.map(|count| count.to_string()).join(" × "));
            parts.push(spacing.map(|step| rounded(step, 4)).join(" × ") + " mm");
        } else {
            parts.push(counted(self.images, "image"));
        }
        parts.push(format!("UID {}", or(&self.uid, "not stated")));
        let trouble = if self.trouble.is_empty() { String::new() } else { format!(": {}", self.trouble) };
        write!(formatter, "number {} ({}{trouble})", or(&self.number, "not stated"), parts.join(", "))
    }
}

impl Serialize for Report {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut fields = serializer.serialize_struct("Report", 10)?;
        fields.serialize_field("number", &self.number)?;
        fields.serialize_field("uid", &self.uid)?;
        fields.serialize_field("description", &self.description)?;
        fields.serialize_field("modality", &self.modality)?;
        fields.serialize_field("images", &self.images)?;
        fields.serialize_field("size", &self.size)?;
        fields.serialize_field("spacing", &self.spacing)?;
        fields.serialize_field("can_be_volume", &self.can_be_volume)?;
        fields.serialize_field("trouble", &self.trouble)?;
        fields.serialize_field("shown", &self.to_string())?;
        fields.end()
    }
}
