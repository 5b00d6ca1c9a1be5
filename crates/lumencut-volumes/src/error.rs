//! Errors that state the file, what was found, what was expected, and advice.

use std::fmt;

use crate::known::Need;
use crate::text::shown;

/// A volume file that cannot be read. No text of a patient stands in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    /// The kind of the error.
    pub kind: ErrorKind,
    /// Name of the file, as `open` was given it or as a header names it.
    pub subject: String,
    /// What was found.
    pub found: String,
    /// What was expected.
    pub expected: String,
    /// Advice in words; may be empty.
    pub mend: String,
}

/// What kind of error it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorKind {
    /// The content is damaged or no volume.
    Format,
    /// A file is missing.
    File,
    /// Segments that share voxels; their header is sound.
    Overlap,
}

impl Error {
    pub(crate) fn new(subject: &str, found: impl Into<String>, expected: impl Into<String>) -> Self {
        Self {
            kind: ErrorKind::Format,
            subject: subject.into(),
            found: found.into(),
            expected: expected.into(),
            mend: String::new(),
        }
    }

    pub(crate) fn mend(mut self, mend: impl Into<String>) -> Self {
        self.mend = mend.into();
        self
    }

    /// A damaged file; another copy may be whole.
    pub(crate) fn damaged(subject: &str, found: impl Into<String>, expected: impl Into<String>) -> Self {
        Self::new(subject, found, expected).mend("copy the file again")
    }

    /// One file of a pair, of which the other is not there.
    pub(crate) fn half_a_pair(one: &str, other: &str) -> Self {
        let expected = format!("both files of the pair, {one} and {other}");
        Self { kind: ErrorKind::File, ..Self::new(one, "one file of a pair", expected) }
            .mend("bring both files together")
    }

    /// A header without the file of its voxels.
    pub(crate) fn header_alone(header: &str, voxels: &str) -> Self {
        let expected = format!("the header and its voxels, {}", shown(voxels));
        Self { kind: ErrorKind::File, ..Self::new(header, "a header alone", expected) }
            .mend("bring both files together")
    }

    /// A file with fewer bytes of voxels than its header says; `limit` is empty or "at most ".
    pub(crate) fn too_short(subject: &str, limit: &str, found: u128, needed: u128) -> Self {
        let found = format!("{limit}{found} bytes of voxels");
        Self::damaged(subject, found, format!("{needed} bytes as the header says"))
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: found {}; expected {}", self.subject, self.found, self.expected)?;
        if self.mend.is_empty() { Ok(()) } else { write!(f, "; {}", self.mend) }
    }
}

impl std::error::Error for Error {}

/// Why `open` gives no plan yet.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Stop {
    /// The host fetches this, and asks again.
    Need(Need),
    /// The file is no NIfTI, NRRD or MetaImage file: another reader may know it.
    Unknown,
    /// The file cannot be read.
    Refused(Error),
}

impl From<Error> for Stop {
    fn from(error: Error) -> Self {
        Self::Refused(error)
    }
}

impl From<Need> for Stop {
    fn from(need: Need) -> Self {
        Self::Need(need)
    }
}

/// Result of a step of `open`.
pub(crate) type Opening<T> = Result<T, Stop>;
