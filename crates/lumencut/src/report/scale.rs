//! Converts lengths to plot pixels, and places the ticks of an axis.

use serde::Serialize;

/// A linear axis: `low` (mm) lies at pixel `start`, `high` at `end`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Axis {
    /// Length at the start (mm).
    pub low: f64,
    /// Length at the end (mm).
    pub high: f64,
    /// First plot pixel.
    pub start: f64,
    /// Last plot pixel.
    pub end: f64,
}

impl Axis {
    pub(crate) fn pixel(&self, value: f64) -> f64 {
        self.start + (value - self.low) / (self.high - self.low) * (self.end - self.start)
    }

    /// The pixel of a length; lengths beyond the axis get the pixel of its end.
    pub(crate) fn pixel_within(&self, value: f64) -> f64 {
        self.pixel(value.clamp(self.low, self.high))
    }

    /// The positions of ticks: multiples of 1, 2 or 5 times a power of ten, at least `pixels` apart; none on an empty axis.
    pub fn ticks(&self, pixels: f64) -> Vec<f64> {
        let span = self.high - self.low;
        let most = (self.end - self.start).abs() / pixels;
        if !(span > 0.0 && most >= 1.0) {
            return Vec::new();
        }
        let power = 10f64.powf((span / most).log10().floor());
        let is_wide = |step: &f64| span / step <= most;
        let step = [1.0, 2.0, 5.0].map(|factor| factor * power).into_iter().find(is_wide);
        let step = step.unwrap_or(10.0 * power);
        let first = (self.low / step - 1e-9).ceil() as i64;
        let last = (self.high / step + 1e-9).floor() as i64;
        (first..=last).map(|n| n as f64 * step).collect()
    }
}

#[cfg(test)]
#[path = "../tests/report_scale.rs"]
mod tests;
