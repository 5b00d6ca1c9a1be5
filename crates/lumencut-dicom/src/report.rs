//! A short description of a series.

use std::fmt;

use serde::Serialize;
use serde::ser::{SerializeStruct, Serializer};

use crate::wording::{counted, rounded};

/// One series, described for choosing; texts are empty where not stated.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// Number.
    pub number: String,
    /// UID.
    pub uid: String,
    /// Description.
    pub description: String,
    /// Modality.
    pub modality: String,
    /// Number of images (frames).
    pub images: i64,
    /// Voxels along i, j, k; None if the images form no stack.
    pub size: Option<[i64; 3]>,
    /// Voxel distances along i, j, k (mm).
    pub spacing: Option<[f64; 3]>,
    /// Whether it may be an angiography volume.
    pub can_be_volume: bool,
    /// Why it is no (angiography) volume; otherwise empty.
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
