//! What mends a refusal, where a host can do it or says it in words of its own.

/// A step that mends an [`Error`](crate::Error). Each host words it in its own way: as arguments of Python, as options of the
/// command line, as buttons of a page.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Mend {
    /// Name the series to read; the error describes them.
    Series,
    /// Name the phase to read by one of these values; none where there are too many to choose among.
    Phase(Vec<String>),
    /// Interpolate missing slices.
    FillGaps,
    /// Put slices of uneven distances on a regular grid.
    ResampleSlices,
    /// Put slices of uneven distances on a regular grid, also over the holes between them.
    ResampleAndFill,
}

impl Mend {
    /// The name of every mend of this crate.
    pub const NAMES: [&str; 5] = ["series", "phase", "fill_gaps", "resample_slices", "resample_and_fill"];

    /// The name by which every host knows it.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Series => "series",
            Self::Phase(_) => "phase",
            Self::FillGaps => "fill_gaps",
            Self::ResampleSlices => "resample_slices",
            Self::ResampleAndFill => "resample_and_fill",
        }
    }

    /// What can be chosen among.
    pub fn values(&self) -> &[String] {
        match self {
            Self::Phase(values) => values,
            Self::Series | Self::FillGaps | Self::ResampleSlices | Self::ResampleAndFill => &[],
        }
    }
}
