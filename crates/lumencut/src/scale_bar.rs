//! The scale bar of a picture: how long it is and what stands above it is decided here for every host.

use serde::Serialize;

/// A bar takes at most this part of the width of its picture.
const PART: f64 = 0.25;

/// A bar of a length that is easily read.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct ScaleBar {
    /// mm
    pub length: f64,
    /// The length with its unit, as it stands above the bar.
    pub words: String,
    /// How many pixels it is long; those who draw whole pixels round it.
    pub pixels: f64,
}

impl ScaleBar {
    /// The bar of a picture of this width (pixels) and side of a pixel (mm): the longest of 1, 2 and 5 times a power of ten mm
    /// within a quarter of the width; none for a picture without a width.
    pub fn new(width: f64, pixel_spacing: f64) -> Option<Self> {
        let room = PART * (width * pixel_spacing);
        if !(room > 0.0 && room.is_finite()) {
            return None;
        }
        let exponent = room.log10().floor() as i32;
        // Read as decimals: 2 times 0.1 to the third is not 0.002. The logarithm may be off by one at a power of ten.
        let lengths = [-1, 0, 1].into_iter().flat_map(|more| [1, 2, 5].map(|digit| (digit, exponent + more)));
        let read = |(digit, power): (i32, i32)| format!("{digit}e{power}").parse::<f64>().ok();
        let length = lengths.filter_map(read).filter(|length| *length <= room).fold(0.0, f64::max);
        Some(Self { length, words: format!("{length} mm"), pixels: length / pixel_spacing })
    }
}

#[cfg(test)]
#[path = "tests/scale_bar.rs"]
mod tests;
