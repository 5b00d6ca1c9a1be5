//! Errors that state the file, what was found, what was expected, and advice.

use std::fmt;

/// Why a volume file cannot be read. It contains no text about the patient.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    /// The kind of the error.
    pub kind: ErrorKind,
    /// Name of the file, as given to `open` or as a header states it.
    pub subject: String,
    /// What was found.
    pub found: String,
    /// What was expected.
    pub expected: String,
    /// Advice in words; may be empty.
    pub mend: String,
}

/// The kinds of errors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorKind {
    /// The content is damaged, or is not a volume.
    Format,
    /// A file is missing.
    File,
    /// Segments share voxels; the header is valid.
    Overlap,
}

impl Error {
    pub(crate) fn new(subject: &str, found: impl Into<String>, expected: impl Into<String>) -> Box<Self> {
        Self::made(subject, found.into(), expected.into())
    }

    #[inline(never)]
    fn made(subject: &str, found: String, expected: String) -> Box<Self> {
        Box::new(Self {
            kind: ErrorKind::Format,
            subject: subject.into(),
            found,
            expected,
            mend: String::new(),
        })
    }

    #[inline(never)]
    pub(crate) fn mend(mut self: Box<Self>, mend: &str) -> Box<Self> {
        self.mend = mend.into();
        self
    }

    pub(crate) fn of(mut self: Box<Self>, kind: ErrorKind) -> Box<Self> {
        self.kind = kind;
        self
    }

    pub(crate) fn damaged(subject: &str, found: impl Into<String>, expected: impl Into<String>) -> Box<Self> {
        Self::new(subject, found, expected).mend("copy the file again")
    }

    pub(crate) fn missing(name: &str, expected: &str) -> Box<Self> {
        Self::new(name, "no such file", expected).mend("bring both files together").of(ErrorKind::File)
    }

    /// A file with fewer bytes of voxels than its header states; `limit` is empty or "at most ".
    pub(crate) fn too_short(subject: &str, limit: &str, found: u128, needed: u128) -> Box<Self> {
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

/// What `open` still needs. File names are relative to the folder of the opened file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Need {
    /// The sizes of these files, or that they are missing.
    Sizes(Vec<String>),
    /// The bytes of a file from `start` to `end`; fewer if the file is shorter.
    Bytes {
        /// The name of the file.
        name: String,
        /// The first byte.
        start: u64,
        /// The byte after the last one.
        end: u64,
    },
}

/// Why `open` returned no plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Stop {
    /// The host must fetch this and call `open` again.
    Need(Need),
    /// The file is not NIfTI, NRRD or MetaImage; another reader may read it.
    Unknown,
    /// The file cannot be read.
    Refused(Box<Error>),
}

impl From<Box<Error>> for Stop {
    fn from(error: Box<Error>) -> Self {
        Self::Refused(error)
    }
}

impl From<Need> for Stop {
    fn from(need: Need) -> Self {
        Self::Need(need)
    }
}

pub(crate) type Opening<T> = Result<T, Stop>;
