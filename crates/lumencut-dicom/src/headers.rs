//! The headers of all files that were looked into, as plain values: what every judgement is made of.

use std::fmt;

use serde::Deserialize;
use serde::de::{Deserializer, MapAccess, Visitor};

use crate::keyword::Keyword;
use crate::value::Value;

/// Everything that is known of a folder, an archive or a list of files.
#[derive(Debug, Deserialize)]
pub struct Headers {
    /// The transfer syntaxes (their UIDs) whose pixels the host can decode.
    pub transfer_syntaxes: Vec<String>,
    /// The files in the order in which the host found them; errors and plans name a file by its number here.
    pub files: Vec<File>,
    /// The pairs of [`Plan::compared`](crate::Plan::compared) whose values the host found to differ.
    #[serde(default)]
    pub unlike: Vec<Unlike>,
}

/// Two frames that a plan takes for one, and whose values differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
pub struct Unlike {
    /// The one that the plan reads.
    pub kept: FrameOf,
    /// The one that it leaves out.
    pub other: FrameOf,
}

/// A frame of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
pub struct FrameOf {
    /// The number of the file.
    pub file: usize,
    /// The number of the frame, from 0.
    pub frame: usize,
}

/// One file.
#[derive(Debug, Deserialize)]
pub struct File {
    /// Its name without folders.
    pub name: String,
    /// What the file is that is no DICOM, such as `no DICOM` or `gzipped; unpack it first`.
    #[serde(default)]
    pub kind: String,
    /// Its header, none (null or left out) where it is no DICOM.
    #[serde(default)]
    pub header: Option<Header>,
}

/// The header of a DICOM file.
#[derive(Debug, Deserialize)]
pub struct Header {
    /// The UID of its SOP class, in the dataset or else in the meta information; empty where neither states it.
    pub sop_class: String,
    /// The UID of its transfer syntax.
    pub transfer_syntax: String,
    /// The keyword of its element of pixels, such as `PixelData`; empty where there is none.
    pub pixels: String,
    /// What stands at its top level.
    pub attributes: Attributes,
    /// What the functional groups of all frames hold; none where it has no such groups.
    #[serde(default)]
    pub shared: Attributes,
    /// What the functional groups of each frame hold; empty where it has no such groups.
    #[serde(default)]
    pub frames: Vec<Attributes>,
}

/// Attributes of one level of a header: an object of [`Keyword`]s and [`Value`]s.
///
/// Other keywords are passed over. Those of functional groups stand side by side, whatever group they are in
/// ([`Keyword::groups`]).
#[derive(Debug, Default)]
pub struct Attributes(Vec<(Keyword, Value)>);

impl Attributes {
    /// The value of an attribute, none where it is not there at all.
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

/// The same value for hosts whose JSON writes 40.0 as 40.
fn typed(keyword: Keyword, value: Value) -> Value {
    match value {
        Value::Integer(whole) if keyword.is_float() => Value::Number(whole as f64),
        other => other,
    }
}
