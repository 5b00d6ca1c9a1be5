//! Why images are no volume.

use serde::Serialize;

use crate::report::Report;

/// What a judgement gives, or why there is none.
pub type Result<T> = std::result::Result<T, Error>;

/// Why images are no volume, in the parts of a message `SUBJECT: found FOUND; expected EXPECTED; MEND`.
///
/// The subject is for the host to name: a file, or all that it looked into.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Error {
    /// What kind of trouble it is.
    pub kind: ErrorKind,
    /// The number of the file that is wrong, from 0; none where all of them together are.
    pub file: Option<usize>,
    /// What was found.
    pub found: String,
    /// What was expected instead.
    pub expected: String,
    /// What would mend it; empty where nothing is known to.
    pub mend: String,
    /// All series, where the trouble is that none of them is the one to read.
    pub series: Vec<Report>,
}

/// A kind of trouble.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ErrorKind {
    /// Images that form no volume.
    Format,
    /// Several series of which none is known to be the one to read.
    Series,
}

impl Error {
    /// Trouble with all images together.
    pub fn new(found: impl Into<String>, expected: impl Into<String>) -> Self {
        let (found, expected) = (found.into(), expected.into());
        Self { kind: ErrorKind::Format, file: None, found, expected, mend: String::new(), series: Vec::new() }
    }

    /// The same, of one file.
    #[must_use]
    pub fn of(self, file: usize) -> Self {
        Self { file: Some(file), ..self }
    }

    /// The same, with what would mend it.
    #[must_use]
    pub fn mended_by(self, mend: impl Into<String>) -> Self {
        Self { mend: mend.into(), ..self }
    }
}
