//! Errors in the form that the page receives: texts, kind, and remedies.

use lumencut_core::error::{Clicked, Error, ErrorKind};
use lumencut_io as centerlines;
use serde::Serialize;

use crate::mends::Mend;

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
    /// Advice in words; may be empty.
    pub mend: String,
    /// Further details.
    #[serde(flatten)]
    pub more: Box<More>,
}

/// Details of some errors.
#[derive(Debug, Default, Serialize)]
pub struct More {
    pub(crate) mends: Vec<Mend>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) about: Option<About>,
    #[serde(flatten)]
    pub(crate) seen: Option<Seen>,
}

/// The point of a tracing request that an error concerns; numbers count from 0.
#[derive(Debug, PartialEq, Eq, Serialize)]
pub(crate) struct About {
    /// The vessel; None if the point belongs to no vessel yet.
    pub vessel: Option<usize>,
    /// The point; None if all points are meant.
    pub point: Option<usize>,
}

impl From<Clicked> for About {
    fn from(clicked: Clicked) -> Self {
        match clicked {
            Clicked::Vessel(vessel) => Self { vessel: Some(vessel), point: None },
            Clicked::Point { vessel, point } => Self { vessel: Some(vessel), point: Some(point) },
            Clicked::Single => Self { vessel: None, point: None },
        }
    }
}

#[derive(Debug, Serialize)]
pub(crate) struct Seen {
    /// The place (mm, LPS).
    pub place: [f64; 3],
    /// The value of the volume at the place; `null` outside the volume.
    pub value: f64,
    /// The nearest place (mm, LPS) that suits.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) nearest: Option<[f64; 3]>,
}

/// The result of the study's functions.
pub type Result<T> = std::result::Result<T, Failure>;

impl Failure {
    /// An error for an invalid message. Such a message is a bug of the page, and no mistake of its user.
    pub fn of_message(subject: &str, found: &impl ToString, expected: &str) -> Self {
        Error::new(ErrorKind::Settings, subject, found.to_string(), expected).into()
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let Error { kind, subject, found, expected, mend, mended_by, place, clicked } = error;
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
        let more = More {
            mends: mended_by.into_iter().map(Mend::from).collect(),
            about: clicked.map(|clicked| About::from(*clicked)),
            seen: place.map(|place| Seen {
                place: place.point.to_array(),
                value: place.value,
                nearest: place.nearest.map(|point| point.to_array()),
            }),
        };
        Self { kind, subject, found, expected, mend, more: Box::new(more) }
    }
}

impl From<centerlines::Error> for Failure {
    fn from(error: centerlines::Error) -> Self {
        let centerlines::Error { subject, found, expected, mend, mended_by } = error;
        let mends = mended_by.into_iter().map(|mend| Mend::from(*mend)).collect();
        let more = More { mends, ..More::default() };
        Self { kind: "format", subject, found, expected, mend, more: Box::new(more) }
    }
}
