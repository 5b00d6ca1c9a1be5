//! What a series is, in a few words and numbers.

use std::fmt;

use serde::Serialize;
use serde::ser::{SerializeStruct, Serializer};

use crate::wording::{counted, rounded};

/// One series, described for whoever chooses.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// Its number, empty where it is not stated.
    pub number: String,
    /// Its unique identifier, empty where it is not stated.
    pub uid: String,
    /// Its description, empty where it is not stated.
    pub description: String,
    /// Its modality, empty where it is not stated.
    pub modality: String,
    /// How many images (frames) it has.
    pub images: i64,
    /// Number of voxels along i, j, k; none where its images form no stack.
    pub size: Option<[i64; 3]>,
    /// Distance between neighbouring voxels along i, j, k (mm).
    pub spacing: Option<[f64; 3]>,
    /// Whether it may be an angiography volume.
    pub can_be_volume: bool,
    /// Why its images form no volume, or no such volume; empty otherwise.
    pub trouble: String,
}

/// The series on one line.
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

/// The fields, and `shown`: the line.
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
