//! Headers of all examined files as plain values, the input of every judgement.

use std::fmt;

use serde::Deserialize;
use serde::de::{Deserializer, MapAccess, Visitor};

use crate::keyword::Keyword;
use crate::value::Value;

/// Everything known of a folder, archive or list of files.
#[derive(Debug, Deserialize)]
pub struct Headers {
    /// Transfer syntaxes (UIDs) that the host can decode.
    pub transfer_syntaxes: Vec<String>,
    /// Files in the host's order; errors and plans refer to their numbers.
    pub files: Vec<File>,
    /// Pairs of [`Plan::compared`](crate::Plan::compared) whose values the host found to differ.
    #[serde(default)]
    pub unlike: Vec<Unlike>,
}

/// Two frames that a plan equates but whose values differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
pub struct Unlike {
    /// The frame read.
    pub kept: FrameOf,
    /// The frame skipped.
    pub other: FrameOf,
}

/// A frame of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
pub struct FrameOf {
    /// Number of the file.
    pub file: usize,
    /// Number of the frame, from 0.
    pub frame: usize,
}

/// One file.
#[derive(Debug, Deserialize)]
pub struct File {
    /// Name without folders.
    pub name: String,
    /// Description of a file that is not DICOM, such as `gzipped; unpack it first`.
    #[serde(default)]
    pub kind: String,
    /// Header; None (null or omitted) if not DICOM.
    #[serde(default)]
    pub header: Option<Header>,
}

/// The header of a DICOM file.
#[derive(Debug, Deserialize)]
pub struct Header {
    /// SOP class UID from the dataset or the meta information; may be empty.
    pub sop_class: String,
    /// Transfer syntax UID.
    pub transfer_syntax: String,
    /// Keyword of the pixel element, such as `PixelData`; may be empty.
    pub pixels: String,
    /// Top-level attributes.
    pub attributes: Attributes,
    /// Shared functional groups.
    #[serde(default)]
    pub shared: Attributes,
    /// Functional groups per frame; may be empty.
    #[serde(default)]
    pub frames: Vec<Attributes>,
}

/// Attributes of one header level, as an object of [`Keyword`]s and [`Value`]s; others are ignored.
/// Functional groups are flattened ([`Keyword::groups`]).
#[derive(Debug, Default)]
pub struct Attributes(Vec<(Keyword, Value)>);

impl Attributes {
    /// None if absent.
    pub fn get(&self, keyword: Keyword) -> Option<&Value> {
        self.0.iter().find(|(own, _)| *own == keyword).map(|(_, value)| value)
    }
}

impl FromIterator<(Keyword, Value)> for Attributes {
    fn from_iter<I: IntoIterator<Item = (Keyword, Value)>>(attributes: I) -> Self {
        Self(attributes.into_iter().collect())
    }
}

impl<'de> Deserialize<'de> for Attributes {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(AnyAttributes)
    }
}

struct AnyAttributes;

impl<'de> Visitor<'de> for AnyAttributes {
    type Value = Attributes;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("attributes by their keywords")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Attributes, A::Error> {
        let mut attributes = Vec::with_capacity(map.size_hint().unwrap_or_default());
        while let Some((name, value)) = map.next_entry::<String, Value>()? {
            if let Some(keyword) = Keyword::named(&name) {
                attributes.push((keyword, typed(keyword, value)));
            }
        }
        Ok(Attributes(attributes))
    }
}

/// Some hosts write 40.0 as 40 in JSON.
fn typed(keyword: Keyword, value: Value) -> Value {
    match value {
        Value::Integer(whole) if keyword.is_float() => Value::Number(whole as f64),
        other => other,
    }
}
