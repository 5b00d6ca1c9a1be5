//! Why images are no volume.

use serde::{Serialize, Serializer};

use crate::mend::Mend;
use crate::report::Report;

/// What a judgement gives, or why there is none.
pub type Result<T> = std::result::Result<T, Error>;

/// Why images are no volume, in the parts of a message `SUBJECT: found FOUND; expected EXPECTED; ADVICE, or MEND`.
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
    /// Advice that no host acts on; empty where there is none.
    pub advice: String,
    /// What mends it beside the advice, for hosts to offer in their own words: as JSON a list `mends` of names and values.
    #[serde(rename = "mends", serialize_with = "as_list")]
    pub mended_by: Option<Box<Mend>>,
    /// All series, where the trouble is that none of them is the one to read.
    pub series: Box<[Report]>,
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

    /// The same, of one file.
    #[must_use]
    pub fn of(self, file: usize) -> Self {
        Self { file: Some(file), ..self }
    }

    /// The same, with advice that no host acts on.
    #[must_use]
    pub fn mend(self, advice: impl Into<String>) -> Self {
        Self { advice: advice.into(), ..self }
    }

    /// The same, with a mend that hosts offer in their own words.
    #[must_use]
    pub fn mended_by(self, mend: Mend) -> Self {
        Self { mended_by: Some(Box::new(mend)), ..self }
    }
}

/// A mend as its name and values.
#[derive(Serialize)]
struct Told<'a> {
    name: &'static str,
    values: &'a [String],
}

fn as_list<S: Serializer>(mend: &Option<Box<Mend>>, to: S) -> std::result::Result<S::Ok, S::Error> {
    to.collect_seq(mend.iter().map(|mend| Told { name: mend.name(), values: mend.values() }))
}
