//! Draws the curves of a profile as SVG paths. A NaN interrupts a curve.

use std::fmt::Write;

use super::scale::Axis;

#[derive(Clone, Copy, Debug)]
pub(super) struct Axes {
    /// Arc length along the vessel (mm).
    pub x: Axis,
    /// Diameter (mm).
    pub y: Axis,
}

impl Axes {
    fn point(&self, at: f64, value: f64) -> [f64; 2] {
        [self.x.pixel(at), self.y.pixel(value)]
    }
}

/// A polyline that is interrupted at NaN. A value between two NaN is not drawn.
pub(super) fn line(axes: &Axes, at: &[f64], values: &[f64]) -> String {
    let mut path = String::new();
    for run in stretches(values).iter().filter(|run| run.len() > 1) {
        push(&mut path, run.clone().map(|n| axes.point(at[n], values[n])));
    }
    path
}

pub(super) fn band(axes: &Axes, at: &[f64], low: &[f64], high: &[f64]) -> String {
    let both: Vec<f64> = low.iter().zip(high).map(|(low, high)| low + high).collect();
    let mut path = String::new();
    for run in stretches(&both).iter().filter(|run| run.len() > 1) {
        let upper = run.clone().map(|n| axes.point(at[n], high[n]));
        push(&mut path, upper.chain(run.clone().rev().map(|n| axes.point(at[n], low[n]))));
        path.push('Z');
    }
    path
}

pub(super) fn isolated(values: &[f64]) -> Vec<usize> {
    stretches(values).iter().filter(|run| run.len() == 1).map(|run| run.start).collect()
}

fn stretches(values: &[f64]) -> Vec<std::ops::Range<usize>> {
    runs(values.len(), |n| values[n].is_finite())
}

/// Ranges of consecutive indices below `count` for which `holds` is true.
pub(super) fn runs(count: usize, holds: impl Fn(usize) -> bool) -> Vec<std::ops::Range<usize>> {
    let mut found: Vec<std::ops::Range<usize>> = Vec::new();
    for n in (0..count).filter(|n| holds(*n)) {
        match found.last_mut() {
            Some(last) if last.end == n => last.end = n + 1,
            _ => found.push(n..n + 1),
        }
    }
    found
}

fn push(path: &mut String, points: impl Iterator<Item = [f64; 2]>) {
    for (n, [x, y]) in points.enumerate() {
        let letter = if n == 0 { 'M' } else { 'L' };
        // Writing to memory does not fail.
        let _ = write!(path, "{letter}{x:.2} {y:.2}");
    }
}

#[cfg(test)]
#[path = "../tests/report_curves.rs"]
mod tests;
