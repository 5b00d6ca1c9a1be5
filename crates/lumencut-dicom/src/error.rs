//! Errors of judging series.

use serde::{Serialize, Serializer};

use crate::mend::Mend;
use crate::report::Report;

/// Result of this crate.
pub type Result<T> = std::result::Result<T, Error>;

/// Why images form no volume, as parts of `SUBJECT: found FOUND; expected EXPECTED; ADVICE, or MEND`. The
/// host adds the subject: a file, or everything it examined.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Error {
    /// Kind of error.
    pub kind: ErrorKind,
    /// Number of the file concerned, from 0; None for all together.
    pub file: Option<usize>,
    /// What was found.
    pub found: String,
    /// What was expected.
    pub expected: String,
    /// Advice in words; may be empty.
    pub advice: String,
    /// Remedy that hosts offer in their own words; in JSON a list `mends` of names and values.
    #[serde(rename = "mends", serialize_with = "as_list")]
    pub mended_by: Option<Box<Mend>>,
    /// All series, if none of them is clearly the one to read.
    pub series: Box<[Report]>,
}

/// A kind of error.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ErrorKind {
    /// Images that form no volume.
    Format,
    /// Several series, with no clear choice.
    Series,
}

impl Error {
    /// An error about all images together.
    pub fn new(found: impl Into<String>, expected: impl Into<String>) -> Self {
        let (found, expected) = (found.into(), expected.into());
        Self {
            kind: ErrorKind::Format,
            file: None,
            found,
            expected,
            advice: String::new(),
            mended_by: None,
            series: Box::default(),
        }
    }

    /// Assigns the error to a file.
    #[must_use]
    pub fn of(self, file: usize) -> Self {
        Self { file: Some(file), ..self }
    }

    /// Adds advice in words.
    #[must_use]
    pub fn mend(self, advice: impl Into<String>) -> Self {
        Self { advice: advice.into(), ..self }
    }

    /// Adds a remedy for hosts.
    #[must_use]
    pub fn mended_by(self, mend: Mend) -> Self {
        Self { mended_by: Some(Box::new(mend)), ..self }
    }
}

#[derive(Serialize)]
struct NamedMend<'a> {
    name: &'static str,
    values: &'a [String],
}

fn as_list<S: Serializer>(mend: &Option<Box<Mend>>, to: S) -> std::result::Result<S::Ok, S::Error> {
    to.collect_seq(mend.iter().map(|mend| NamedMend { name: mend.name(), values: mend.values() }))
}
