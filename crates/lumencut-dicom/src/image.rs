//! One image, with access to its attributes and its frames.

use crate::error::{Error, Result};
use crate::headers::{File, Header};
use crate::keyword::Keyword;
use crate::uids;
use crate::value::Value;
use crate::wording::{line, printable};

static EMPTY: Value = Value::Empty;

#[derive(Debug)]
pub(crate) struct Image<'a> {
    pub file: usize,
    pub name: String,
    pub kind: &'a str,
    /// Whether the caller can decode the pixels.
    pub is_decodable: bool,
    /// Number of frames that the header states, which may be wrong.
    pub frame_count: i64,
    pub samples: i64,
    pub header: &'a Header,
}

impl<'a> Image<'a> {
    pub(crate) fn new(number: usize, file: &'a File, header: &'a Header, is_decodable: bool) -> Result<Self> {
        let mut image = Self {
            file: number,
            name: printable(&file.name),
            kind: kind(file),
            is_decodable,
            frame_count: 1,
            samples: 1,
            header,
        };
        image.frame_count = image.count(Keyword::NumberOfFrames)?.unwrap_or(1);
        image.samples = image.count(Keyword::SamplesPerPixel)?.unwrap_or(1);
        Ok(image)
    }

    pub(crate) fn get(&self, keyword: Keyword) -> &'a Value {
        self.header.attributes.get(keyword).unwrap_or(&EMPTY)
    }

    /// Value of an attribute for a frame: from its own or the shared groups, else from the top level.
    pub(crate) fn of_frame(&self, frame: usize, keyword: Keyword) -> &'a Value {
        if keyword.groups().is_empty() {
            return self.get(keyword);
        }
        let own = self.header.frames.get(frame).and_then(|groups| groups.get(keyword));
        own.or_else(|| self.header.shared.get(keyword)).unwrap_or_else(|| self.get(keyword))
    }

    /// Value as one printable line; empty if not stated.
    pub(crate) fn text(&self, keyword: Keyword) -> String {
        match self.get(keyword) {
            Value::Empty => String::new(),
            stated => line(&stated.to_string()),
        }
    }

    /// Integer at the top level; None if not stated or zero.
    pub(crate) fn count(&self, keyword: Keyword) -> Result<Option<i64>> {
        let stated = self.get(keyword);
        if stated.is_nothing() {
            return Ok(None);
        }
        let count = stated.integer().ok_or_else(|| damaged(keyword, "a whole number").of(self.file))?;
        Ok(Some(count).filter(|&count| count != 0))
    }

    pub(crate) fn number(&self, frame: usize, keyword: Keyword) -> Result<Option<f64>> {
        let stated = self.of_frame(frame, keyword);
        if stated.is_empty() {
            return Ok(None);
        }
        stated.number().map(Some).ok_or_else(|| damaged(keyword, "a number").of(self.file))
    }

    pub(crate) fn frame_name(&self, frame: usize) -> String {
        if self.frame_count > 1 { format!("{} frame {}", self.name, frame + 1) } else { self.name.clone() }
    }

    pub(crate) fn is_localizer(&self, frame: usize) -> bool {
        let is = |value: &Value| matches!(value, Value::Text(text) if text == "LOCALIZER");
        let stated = [self.get(Keyword::ImageType), self.of_frame(frame, Keyword::FrameType)];
        stated.iter().any(|value| value.all().iter().any(is))
    }

    pub(crate) fn has_position(&self, frame: usize) -> bool {
        !self.of_frame(frame, Keyword::ImagePositionPatient).is_empty()
    }

    /// Whether all described frames have positions. The stated number of frames is not used: it may be wrong.
    pub(crate) fn has_positions(&self) -> bool {
        let described = self.header.frames.len().max(1);
        let frames = usize::try_from(self.frame_count.max(1)).map_or(described, |count| count.min(described));
        (0..frames).any(|frame| self.has_position(frame))
    }
}

pub(crate) fn kind(file: &File) -> &str {
    match &file.header {
        Some(header) => uids::name(&header.sop_class).unwrap_or("DICOM of no known kind"),
        None => &file.kind,
    }
}

/// The error for an invalid value. It does not quote the value, which may be the name of a patient.
fn damaged(keyword: Keyword, expected: &str) -> Error {
    Error::new(format!("damaged values in {}", keyword.name()), expected)
}
