//! The reformation that a study keeps from one picture to the next, and its picture.

use serde::Serialize;

use crate::study::reformations::{Laid, ReformationMessage};

/// The picture of a reformation.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct ReformedPicture {
    /// Columns and rows.
    pub size: [usize; 2],
    /// A byte for each channel.
    #[cfg_attr(test, ts(type = "Bytes"))]
    pub bytes: Vec<u8>,
    /// What rows, columns and colours are.
    pub words: String,
    /// The side of a pixel (mm).
    pub pixel_spacing: f64,
    /// Names of vessels where they end, or open into the one that is shown.
    pub(crate) marks: Vec<Mark>,
}

/// A name at a place of a picture.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct Mark {
    /// The name.
    pub words: String,
    /// Column and row.
    pub pixel: [f64; 2],
}

/// The reformation that was shown last.
pub(crate) struct Reformed {
    /// What was asked for.
    pub(super) message: ReformationMessage,
    /// The size of its pane.
    pub(super) size: [usize; 2],
    /// Where its pixels look.
    pub(super) laid: Laid,
    /// What each pixel shows: a value of the volume, or a length (mm); NaN where it shows nothing.
    pub(super) value: Vec<f32>,
}
