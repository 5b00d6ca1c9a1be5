//! Errors as the page gets them: the same four texts as everywhere, and the kind.

use lumencut_core::error::{Error, ErrorKind};
use lumencut_io as centerlines;
use serde::Serialize;

/// An error for the page.
#[derive(Debug, Serialize)]
pub struct Failure {
    /// The cause in a word, such as `volume`.
    pub kind: &'static str,
    /// What is wrong.
    pub subject: String,
    /// What was found.
    pub found: String,
    /// What was expected instead.
    pub expected: String,
    /// What would mend it; empty where `expected` already says so.
    pub mend: String,
    /// Where it shows in the volume.
    #[serde(flatten)]
    pub seen: Option<Box<Seen>>,
}

/// Where an error shows in the volume.
#[derive(Debug, Serialize)]
pub struct Seen {
    /// The place (mm, LPS).
    pub place: [f64; 3],
    /// What the volume has there; `null` where that is no number.
    pub value: f64,
}

/// What the functions of this crate give.
pub type Result<T> = std::result::Result<T, Failure>;

impl Failure {
    /// A message of the page that is not what it should be: a mistake of the page, never of its user.
    pub fn of_message(subject: &str, found: &impl ToString, expected: &str) -> Self {
        Error::new(ErrorKind::Settings, subject, found.to_string(), expected).into()
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let Error { kind, subject, found, expected, mend, place } = error;
        let kind = match kind {
            ErrorKind::Volume => "volume",
            ErrorKind::VesselTree => "vessel tree",
            ErrorKind::Camera => "camera",
            ErrorKind::Settings => "settings",
            ErrorKind::Device => "device",
            ErrorKind::Tracing => "tracing",
            ErrorKind::Measuring => "measuring",
            ErrorKind::Interrupted => "interrupted",
        };
        let seen = place.map(|place| Box::new(Seen { place: place.point.to_array(), value: place.value }));
        Self { kind, subject, found, expected, mend, seen }
    }
}

impl From<centerlines::Error> for Failure {
    fn from(error: centerlines::Error) -> Self {
        let centerlines::Error { subject, found, expected, mend, .. } = error;
        Self { kind: "format", subject, found, expected, mend, seen: None }
    }
}
