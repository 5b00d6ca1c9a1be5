//! The scale bar of a picture.

use serde::Serialize;

/// The longest bar, as a fraction of the picture's width.
const MAX_WIDTH_FRACTION: f64 = 0.25;

/// A scale bar of round length.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct ScaleBar {
    /// Length (mm).
    pub length: f64,
    /// The label above the bar.
    pub words: String,
    /// Length in pixels; may be fractional.
    pub pixels: f64,
}

impl ScaleBar {
    /// The longest bar of 1, 2 or 5 times a power of ten mm within a quarter of `width` (pixels); None if the width is 0.
    pub fn new(width: f64, pixel_spacing: f64) -> Option<Self> {
        let room = MAX_WIDTH_FRACTION * (width * pixel_spacing);
        if !(room > 0.0 && room.is_finite()) {
            return None;
        }
        let exponent = room.log10().floor() as i32;
        // Lengths are parsed as decimals, since 2 · 0.1³ is not 0.002. At powers of ten the logarithm may be off by one.
        let lengths = [-1, 0, 1].into_iter().flat_map(|more| [1, 2, 5].map(|digit| (digit, exponent + more)));
        let read = |(digit, power): (i32, i32)| format!("{digit}e{power}").parse::<f64>().ok();
        let length = lengths.filter_map(read).filter(|length| *length <= room).fold(0.0, f64::max);
        Some(Self { length, words: format!("{length} mm"), pixels: length / pixel_spacing })
    }
}

#[cfg(test)]
#[path = "tests/scale_bar.rs"]
mod tests;
