//! Headers of all examined files as plain values, which are the input of this crate.

use std::fmt;

use serde::Deserialize;
use serde::de::{Deserializer, MapAccess, Visitor};

use crate::keyword::Keyword;
use crate::value::Value;

/// The headers of a folder, an archive or a list of files.
#[derive(Debug, Deserialize)]
pub struct Headers {
    /// Transfer syntaxes (UIDs) that the caller can decode.
    pub transfer_syntaxes: Vec<String>,
    /// Files in the order of the caller. Errors and plans refer to their numbers.
    pub files: Vec<File>,
    /// Pairs of [`Plan::compared`](crate::Plan::compared) for which the caller found different values.
    #[serde(default)]
    pub unlike: Vec<Unlike>,
}

/// Two frames that a plan treated as equal, although their values differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
pub struct Unlike {
    /// The frame that is read.
    pub kept: FrameOf,
    /// The frame that is skipped.
    pub other: FrameOf,
}

/// A frame, identified by its file and its number in that file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
pub struct FrameOf {
    /// Number of the file.
    pub file: usize,
    /// Number of the frame, from 0.
    pub frame: usize,
}

/// One examined file.
#[derive(Debug, Deserialize)]
pub struct File {
    /// The name of the file, without folders.
    pub name: String,
    /// Description of a file that is not DICOM, such as `gzipped; unpack it first`.
    #[serde(default)]
    pub kind: String,
    /// The header; None (null or left out) if the file is not DICOM.
    #[serde(default)]
    pub header: Option<Header>,
}

/// The header of a DICOM file.
#[derive(Debug, Deserialize)]
pub struct Header {
    /// UID of the SOP class, from the dataset or the meta information; may be empty.
    pub sop_class: String,
    /// UID of the transfer syntax.
    pub transfer_syntax: String,
    /// Keyword of the pixel element, such as `PixelData`; may be empty.
    pub pixels: String,
    /// Attributes at the top level.
    pub attributes: Attributes,
    /// Functional groups that all frames share.
    #[serde(default)]
    pub shared: Attributes,
    /// Functional groups of each frame; may be empty.
    #[serde(default)]
    pub frames: Vec<Attributes>,
}

/// Attributes of one level of a header. In JSON they are an object with [`Keyword`]s and [`Value`]s, and
/// others are ignored. Functional groups are flattened ([`Keyword::groups`]).
#[derive(Debug, Default)]
pub struct Attributes(Vec<(Keyword, Value)>);

impl Attributes {
    /// Value of an attribute; None if absent.
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

/// The value with the type of its attribute, because some programs write 40.0 as 40 in JSON.
fn typed(keyword: Keyword, value: Value) -> Value {
    match value {
        Value::Integer(whole) if keyword.is_float() => Value::Number(whole as f64),
        other => other,
    }
}
