//! Remedies that programs apply, or state in their own words.

/// A remedy for an [`Error`](crate::Error). Users see it as a Python argument, a command-line option or a button.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Mend {
    /// Name the series to read. The error describes all series.
    Series,
    /// Choose a phase by one of these values; the list is empty if there are too many.
    Phase(Vec<String>),
    /// Interpolate missing slices.
    FillGaps,
    /// Put uneven slices on a regular grid.
    ResampleSlices,
    /// Put uneven slices on a regular grid, also across gaps.
    ResampleAndFill,
}

impl Mend {
    /// Names of all remedies.
    pub const NAMES: [&str; 5] = ["series", "phase", "fill_gaps", "resample_slices", "resample_and_fill"];

    /// The name by which programs recognise the remedy.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Series => "series",
            Self::Phase(_) => "phase",
            Self::FillGaps => "fill_gaps",
            Self::ResampleSlices => "resample_slices",
            Self::ResampleAndFill => "resample_and_fill",
        }
    }

    /// The values to choose from.
    pub fn values(&self) -> &[String] {
        match self {
            Self::Phase(values) => values,
            Self::Series | Self::FillGaps | Self::ResampleSlices | Self::ResampleAndFill => &[],
        }
    }
}
