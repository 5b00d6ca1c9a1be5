//! Functions that the XML readers share.

use quick_xml::Reader;
use quick_xml::events::BytesStart;

use crate::error::{Error, Result, excerpt};

#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Attributes(Vec<(String, String)>);

impl Attributes {
    pub(crate) fn get(&self, name: &str) -> Option<&str> {
        self.0.iter().find(|(key, _)| key == name).map(|(_, value)| value.trim())
    }

    /// Value of the attribute `name` as a count; 0 if missing.
    pub(crate) fn count(&self, name: &str) -> Result<usize> {
        let text = self.get(name).unwrap_or("0");
        text.parse().map_err(|_| Error::new(name, excerpt(text), "a whole number from 0"))
    }
}

/// Maximum nesting depth; valid files have up to 6.
const DEEPEST: usize = 32;

/// The attributes of an element. Only the five predefined XML entities are accepted.
pub(crate) fn attributes(element: &BytesStart, expected: &str) -> Result<Attributes> {
    let wrong = |cause: String| Error::new("", format!("damaged XML attributes ({cause})"), expected);
    element
        .attributes()
        .map(|attribute| {
            let attribute = attribute.map_err(|error| wrong(error.to_string()))?;
            let value = attribute
                .normalized_value(quick_xml::XmlVersion::Implicit1_0)
                .map_err(|error| wrong(error.to_string()))?;
            Ok((attribute.key.as_ref().to_owned(), value.into_owned()))
        })
        .collect::<Result<_>>()
        .map(Attributes)
}

pub(crate) fn name_at_depth(element: &BytesStart, depth: usize, expected: &str) -> Result<String> {
    if depth == DEEPEST {
        return Err(Error::new("", format!("elements nested deeper than {DEEPEST}"), expected));
    }
    Ok(element.name().as_ref().to_owned())
}

pub(crate) fn damaged(reader: &Reader<&[u8]>, cause: &quick_xml::Error, expected: &str) -> Error {
    let found = format!("damaged XML near byte {} ({cause})", reader.error_position());
    Error::truncated("", found, expected)
}

/// The error for a document type, which could define entities of unlimited size.
pub(crate) fn document_type(expected: &str) -> Error {
    Error::new("", "a document type (<!DOCTYPE)", format!("{expected}, which has no document type"))
}

/// Name of the first element, after declarations and comments.
pub(crate) fn first_element(mut text: &[u8]) -> Option<&[u8]> {
    loop {
        text = text.trim_ascii_start().strip_prefix(b"<")?;
        let end: &[u8] = match text {
            [b'!', b'-', b'-', ..] => b"-->",
            [b'?', ..] => b"?>",
            _ => break,
        };
        let at = text.windows(end.len()).position(|window| window == end)?;
        text = &text[at + end.len()..];
    }
    let end = text.iter().position(|b| b.is_ascii_whitespace() || b"/>".contains(b))?;
    Some(&text[..end])
}
