//! The last reformation that a study rendered, and its picture.

use serde::Serialize;

use crate::study::reformations::{Laid, ReformationMessage};

#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct ReformedPicture {
    /// Columns and rows.
    pub size: [usize; 2],
    /// One byte per channel.
    #[cfg_attr(test, ts(type = "Bytes"))]
    pub bytes: Vec<u8>,
    /// What rows, columns and colours mean.
    pub words: String,
    /// Pixel side (mm).
    pub pixel_spacing: f64,
    pub(crate) marks: Vec<Mark>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct Mark {
    pub words: String,
    pub pixel: [f64; 2],
}

pub(crate) struct Reformed {
    pub(super) message: ReformationMessage,
    pub(super) size: [usize; 2],
    pub(super) laid: Laid,
    /// The value of each pixel: a value of the volume, or a length (mm); NaN if the pixel is empty.
    pub(super) value: Vec<f32>,
}
