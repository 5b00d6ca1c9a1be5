//! Finds the arrays in a VTK XML file, without decoding them.

use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

use crate::error::{Error, Result};
use crate::xml::{self, Attributes};

#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Declared {
    /// Name of the enclosing element, such as `Points` or `FieldData`.
    pub section: String,
    pub attributes: Attributes,
    /// Data inside the element, as text.
    pub text: String,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Piece {
    pub attributes: Attributes,
    pub arrays: Vec<Declared>,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Document {
    pub file: Attributes,
    pub field_arrays: Vec<Declared>,
    pub pieces: Vec<Piece>,
    pub complete: bool,
}

const EXPECTED: &str = "a VTK XML file";

/// Reads the elements; `text` may end where appended data begins.
pub(crate) fn document(text: &str) -> Result<Document> {
    let mut reader = Reader::from_str(text);
    let mut walk = Walk::default();
    loop {
        match reader.read_event().map_err(|error| xml::damaged(&reader, &error, EXPECTED))? {
            Event::Start(element) => walk.open(&element)?,
            Event::Empty(element) => {
                walk.open(&element)?;
                walk.close();
            }
            Event::End(_) => walk.close(),
            Event::Text(content) => walk.text(&content),
            Event::CData(_) | Event::GeneralRef(_) if walk.inside_array() => {
                return Err(Error::new("DataArray", "an entity or CDATA", "plain text"));
            }
            Event::DocType(_) => return Err(xml::document_type(EXPECTED)),
            Event::Eof => break,
            _ => {}
        }
    }
    if walk.document.file.get("type").is_none() {
        return Err(Error::new("", "XML without a VTKFile element and its type", "a VTK XML poly data file"));
    }
    Ok(walk.document)
}

#[derive(Default)]
struct Walk {
    document: Document,
    open: Vec<String>,
}

impl Walk {
    fn open(&mut self, element: &BytesStart) -> Result<()> {
        let name = xml::name_at_depth(element, self.open.len(), EXPECTED)?;
        let attributes = xml::attributes(element, EXPECTED)?;
        let parent = self.open.last().map_or("", String::as_str);
        match name.as_str() {
            "VTKFile" if self.open.is_empty() => self.document.file = attributes,
            "Piece" => self.document.pieces.push(Piece { attributes, arrays: Vec::new() }),
            "DataArray" | "Array" => {
                let array = Declared { section: parent.to_owned(), attributes, text: String::new() };
                match self.document.pieces.last_mut() {
                    Some(piece) if parent != "FieldData" => piece.arrays.push(array),
                    _ => self.document.field_arrays.push(array),
                }
            }
            _ => {}
        }
        self.open.push(name);
        Ok(())
    }

    fn close(&mut self) {
        self.open.pop();
        self.document.complete = self.open.is_empty();
    }

    fn inside_array(&self) -> bool {
        self.open.last().is_some_and(|name| name == "DataArray" || name == "Array")
    }

    /// Keeps text directly inside an array element, but not the text of information keys inside it.
    fn text(&mut self, content: &str) {
        if !self.inside_array() {
            return;
        }
        let in_field = self.open.iter().rev().nth(1).is_some_and(|parent| parent == "FieldData");
        let piece = self.document.pieces.last_mut().filter(|_| !in_field);
        let arrays = piece.map_or(&mut self.document.field_arrays, |piece| &mut piece.arrays);
        if let Some(array) = arrays.last_mut() {
            array.text.push_str(content);
        }
    }
}
