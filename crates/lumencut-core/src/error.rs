//! What can go wrong, and the words for it: every error names its subject, what was found, what was
//! expected, and what would mend it.

use std::fmt;

use glam::DVec3;

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
    /// A point between which and others no centerline can be traced.
    Tracing,
    /// A vessel whose lumen cannot be measured, or a place on it where a number makes no sense.
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
    /// What the volume has there; no number where it has none.
    pub value: f64,
}

/// An error in one line: `subject: found …; expected …; mend`.
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
    /// What would mend it; empty where `expected` already says so.
    pub mend: String,
    /// Where it shows in the volume: of a way without lumen the weakest place, of a point in no lumen that point.
    pub place: Option<Box<Place>>,
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
            place: None,
        }
    }

    /// The same error with the step that would mend it.
    #[must_use]
    pub fn mend(mut self, mend: impl Into<String>) -> Self {
        self.mend = mend.into();
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
        if self.mend.is_empty() { Ok(()) } else { write!(f, "; {}", self.mend) }
    }
}

impl std::error::Error for Error {}

/// A result of this crate.
pub type Result<T> = std::result::Result<T, Error>;
