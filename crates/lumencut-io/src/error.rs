//! Errors that state the file and the position in it, what was found, what was expected, and a remedy.

use std::fmt;

use crate::mend::Mend;

/// An error. Its text is one line: `subject: found …; expected …; advice or remedy`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    /// The file, and the position in it.
    pub subject: String,
    /// What was found.
    pub found: String,
    /// What was expected.
    pub expected: String,
    /// Advice in words; may be empty.
    pub mend: String,
    /// Remedy that programs can apply; each user interface states it in its own words.
    pub mended_by: Option<Box<Mend>>,
}

impl Error {
    /// An error at the position `subject` of a file.
    pub fn new(subject: impl Into<String>, found: impl Into<String>, expected: impl Into<String>) -> Self {
        let (subject, found, expected) = (subject.into(), found.into(), expected.into());
        Self { subject, found, expected, mend: String::new(), mended_by: None }
    }

    /// Adds advice in words to the error.
    #[must_use]
    pub fn mend(mut self, mend: impl Into<String>) -> Self {
        self.mend = mend.into();
        self
    }

    /// Adds a remedy to the error.
    #[must_use]
    pub fn mended_by(mut self, mend: Mend) -> Self {
        self.mended_by = Some(Box::new(mend));
        self
    }

    /// Puts the file name in front of the position.
    #[must_use]
    pub fn in_file(mut self, file_name: &str) -> Self {
        self.subject =
            if self.subject.is_empty() { file_name.into() } else { format!("{file_name}: {}", self.subject) };
        self
    }

    pub(crate) fn truncated(
        subject: impl Into<String>,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        Self::new(subject, found, expected).mend("the file seems truncated: copy or export it again")
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: found {}; expected {}", self.subject, self.found, self.expected)?;
        match (self.mend.as_str(), &self.mended_by) {
            ("", None) => Ok(()),
            ("", Some(mend)) => write!(f, "; {mend}"),
            (advice, None) => write!(f, "; {advice}"),
            (advice, Some(mend)) => write!(f, "; {advice}, or {mend}"),
        }
    }
}

impl std::error::Error for Error {}

/// Result of the functions of this crate.
pub type Result<T> = std::result::Result<T, Error>;

/// At most 40 characters of text from a file, escaped.
pub(crate) fn excerpt(text: &str) -> String {
    let short: String = text.chars().take(40).flat_map(char::escape_debug).collect();
    if text.chars().nth(40).is_some() { format!("'{short}…'") } else { format!("'{short}'") }
}
