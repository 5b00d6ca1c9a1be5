//! What can go wrong, and the words for it: every error names its subject, what was found, what was
//! expected, and what would mend it.

use std::fmt;

use glam::DVec3;

pub use crate::mend::Mend;

/// The cause of an [`Error`]; each has its own exception class in Python.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ErrorKind {
    /// A volume whose voxels or geometry cannot be used.
    Volume,
    /// A vessel or vessel tree whose points or radii cannot be used.
    VesselTree,
    /// A camera that defines no view.
    Camera,
    /// A setting outside its range.
    Settings,
    /// A GPU that is not there, too small for the work, or failed.
    Device,
    /// Points between which no centerline can be traced.
    Tracing,
    /// A vessel whose lumen cannot be measured, or a place on it for which a number would be meaningless.
    Measuring,
    /// The caller asked to stop.
    Interrupted,
}

impl ErrorKind {
    /// Every kind, for tests that each of them can be met.
    pub const ALL: [ErrorKind; 8] = [
        ErrorKind::Volume,
        ErrorKind::VesselTree,
        ErrorKind::Camera,
        ErrorKind::Settings,
        ErrorKind::Device,
        ErrorKind::Tracing,
        ErrorKind::Measuring,
        ErrorKind::Interrupted,
    ];
}

/// Where an error shows in the volume.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The place (mm, LPS).
    pub point: DVec3,
    /// The value of the volume there; NaN outside of it.
    pub value: f64,
}

/// Which of the clicked points an error is about; the subject tells the same in words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clicked {
    /// All points of the vessel with this number, from 0.
    Vessel(usize),
    /// One point of a vessel, both counted from 0.
    Point {
        /// The number of the vessel.
        vessel: usize,
        /// The number of the point along it.
        point: usize,
    },
    /// A point of no vessel yet.
    Single,
}

/// An error in one line: `subject: found …; expected …; advice, or mend`.
#[derive(Clone, Debug, PartialEq)]
pub struct Error {
    /// The cause.
    pub kind: ErrorKind,
    /// The argument, file or item that is wrong.
    pub subject: String,
    /// What was found.
    pub found: String,
    /// What was expected instead.
    pub expected: String,
    /// Advice that no host acts on; empty where `expected` already says so.
    pub mend: String,
    /// What mends it beside the advice, for hosts to offer in their own words.
    pub mended_by: Option<Mend>,
    /// Where it shows in the volume: of a path without lumen the weakest place, of a point outside of the lumen that point.
    pub place: Option<Box<Place>>,
    /// Which of the clicked points it is about.
    pub clicked: Option<Box<Clicked>>,
}

impl Error {
    /// An error without a mend of its own.
    pub fn new(
        kind: ErrorKind,
        subject: impl Into<String>,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        Self {
            kind,
            subject: subject.into(),
            found: found.into(),
            expected: expected.into(),
            mend: String::new(),
            mended_by: None,
            place: None,
            clicked: None,
        }
    }

    /// The same error with advice that no host acts on.
    #[must_use]
    pub fn mend(mut self, mend: impl Into<String>) -> Self {
        self.mend = mend.into();
        self
    }

    /// The same error with a mend that hosts offer in their own words.
    #[must_use]
    pub fn mended_by(mut self, mend: Mend) -> Self {
        self.mended_by = Some(mend);
        self
    }

    /// The same error with the clicked points that it is about.
    #[must_use]
    pub fn about(mut self, clicked: Clicked) -> Self {
        self.clicked = Some(Box::new(clicked));
        self
    }

    /// The same error with the place (mm, LPS) where it shows in the volume, and the value there.
    #[must_use]
    pub fn at(mut self, point: DVec3, value: f64) -> Self {
        self.place = Some(Box::new(Place { point, value }));
        self
    }

    /// The caller asked to stop.
    pub fn interrupted() -> Self {
        Self::new(ErrorKind::Interrupted, "rendering", "a request to stop", "to run to its end")
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: found {}; expected {}", self.subject, self.found, self.expected)?;
        match (self.mend.as_str(), self.mended_by) {
            ("", None) => Ok(()),
            ("", Some(mend)) => write!(f, "; {mend}"),
            (advice, None) => write!(f, "; {advice}"),
            (advice, Some(mend)) => write!(f, "; {advice}, or {mend}"),
        }
    }
}

impl std::error::Error for Error {}

/// A result of this crate.
pub type Result<T> = std::result::Result<T, Error>;
