//! Errors of the functions that plan a volume.

use serde::{Serialize, Serializer};

use crate::mend::Mend;
use crate::report::Report;

/// Result of the functions of this crate.
pub type Result<T> = std::result::Result<T, Error>;

/// Why images do not form a volume, as parts of `SUBJECT: found FOUND; expected EXPECTED; ADVICE, or MEND`.
/// The caller adds the subject: a file name, or a name for everything that was examined.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Error {
    /// The kind of the error.
    pub kind: ErrorKind,
    /// Number of the file with the error, from 0; None if it concerns all files together.
    pub file: Option<usize>,
    /// What was found.
    pub found: String,
    /// What was expected.
    pub expected: String,
    /// Advice in words; may be empty.
    pub advice: String,
    /// Remedy, which each user interface words itself. In JSON: a list `mends` of names and values.
    #[serde(rename = "mends", serialize_with = "as_list")]
    pub mended_by: Option<Box<Mend>>,
    /// Descriptions of all series, if it is not clear which one to read.
    pub series: Box<[Report]>,
}

/// The kind of an error.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ErrorKind {
    /// The images do not form a volume.
    Format,
    /// There are several series, and it is not clear which one to read.
    Series,
}

impl Error {
    /// An error that concerns all images together.
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

    /// Assigns the error to the file with this number.
    #[must_use]
    pub fn of(self, file: usize) -> Self {
        Self { file: Some(file), ..self }
    }

    /// Adds advice in words to the error.
    #[must_use]
    pub fn mend(self, advice: impl Into<String>) -> Self {
        Self { advice: advice.into(), ..self }
    }

    /// Adds a remedy to the error.
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
