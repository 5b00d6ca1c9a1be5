//! Remedies that hosts can apply or word themselves.

/// A remedy of an [`Error`](crate::Error). Hosts word it as Python arguments, command-line options or
/// buttons.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Mend {
    /// Name the series to read; the error describes them.
    Series,
    /// Name the phase by one of these values; empty if there are too many.
    Phase(Vec<String>),
    /// Interpolate missing slices.
    FillGaps,
    /// Put uneven slices on a regular grid.
    ResampleSlices,
    /// Put uneven slices on a regular grid, across gaps too.
    ResampleAndFill,
}

impl Mend {
    /// All names.
    pub const NAMES: [&str; 5] = ["series", "phase", "fill_gaps", "resample_slices", "resample_and_fill"];

    /// The name used by every host.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Series => "series",
            Self::Phase(_) => "phase",
            Self::FillGaps => "fill_gaps",
            Self::ResampleSlices => "resample_slices",
            Self::ResampleAndFill => "resample_and_fill",
        }
    }

    /// The choices.
    pub fn values(&self) -> &[String] {
        match self {
            Self::Phase(values) => values,
            Self::Series | Self::FillGaps | Self::ResampleSlices | Self::ResampleAndFill => &[],
        }
    }
}
