//! Errors in one form: subject, what was found, what was expected, and how to fix it.

use std::fmt;

use glam::DVec3;

pub use crate::mend::Mend;

/// The cause of an [`Error`]; each has its own exception class in Python.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ErrorKind {
    /// Voxels or geometry of a volume are unusable.
    Volume,
    /// Points or radii of a vessel or vessel tree are unusable.
    VesselTree,
    /// The camera defines no view.
    Camera,
    /// A setting is outside its range.
    Settings,
    /// The GPU is missing, too small or failed.
    Device,
    /// No centerline can be traced between the points.
    Tracing,
    /// The lumen cannot be measured, or a number at this position would mean nothing.
    Measuring,
    /// The caller asked to stop.
    Interrupted,
}

impl ErrorKind {
    /// Every kind, for tests.
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

/// The position in the volume that an error is about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorPosition {
    /// Position (mm, LPS).
    pub point: DVec3,
    /// The value of the volume there; NaN outside the volume.
    pub value: f64,
    /// The nearest suitable position (mm, LPS), if known.
    pub nearest: Option<DVec3>,
}

/// The clicked points that an error is about; the error's subject names them in words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clicked {
    /// All points of the vessel with this number, from 0.
    Vessel(usize),
    /// One point of a vessel, both counted from 0.
    Point {
        /// Index of the vessel.
        vessel: usize,
        /// Index of the point along the vessel.
        point: usize,
    },
    /// A point that belongs to no vessel yet.
    Single,
}

/// An error in one line: `subject: found …; expected …; how to fix it`.
#[derive(Clone, Debug, PartialEq)]
pub struct Error {
    /// The cause.
    pub kind: ErrorKind,
    /// The argument, file or item that is wrong.
    pub subject: String,
    /// The wrong value or state that was found.
    pub found: String,
    /// What would have been right.
    pub expected: String,
    /// Advice that no host (Python, page) can act on; empty if `expected` already says how to fix the error.
    pub mend: String,
    /// A further remedy. Each host puts it into its own words and may offer it as an action.
    pub mended_by: Option<Mend>,
    /// Position in the volume: the least lumen-like point of a path, or the point outside the lumen.
    pub place: Option<Box<ErrorPosition>>,
    /// The clicked points that the error is about.
    pub clicked: Option<Box<Clicked>>,
}

impl Error {
    /// An error without advice or remedy.
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

    /// Adds advice that neither Python nor the page can act on.
    #[must_use]
    pub fn mend(mut self, mend: impl Into<String>) -> Self {
        self.mend = mend.into();
        self
    }

    /// Adds a remedy that Python and the page word themselves and may offer as an action.
    #[must_use]
    pub fn mended_by(mut self, mend: Mend) -> Self {
        self.mended_by = Some(mend);
        self
    }

    /// Adds the clicked points that the error is about.
    #[must_use]
    pub fn about(mut self, clicked: Clicked) -> Self {
        self.clicked = Some(Box::new(clicked));
        self
    }

    /// Adds the position (mm, LPS) that the error is about, and the value of the volume there.
    #[must_use]
    pub fn at(mut self, point: DVec3, value: f64) -> Self {
        self.place = Some(Box::new(ErrorPosition { point, value, nearest: None }));
        self
    }

    /// Adds the nearest suitable position (mm, LPS) to an error with a position.
    #[must_use]
    pub fn nearest(mut self, point: DVec3) -> Self {
        if let Some(place) = &mut self.place {
            place.nearest = Some(point);
        }
        self
    }

    /// The error for work that the caller stopped.
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
