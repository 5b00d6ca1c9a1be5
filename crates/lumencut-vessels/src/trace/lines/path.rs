//! Lines of points: even steps, directions, frames that do not twist, and smoothing that keeps bends.

use glam::DVec3;

use lumencut_core::math::arc_length::arc_lengths;
use lumencut_core::math::frames::{MovingFrame, double_reflection};

/// The same line in even steps of at most `step` (mm), at least two points.
pub fn resampled(points: &[DVec3], step: f64) -> Vec<DVec3> {
    let lengths = arc_lengths(points);
    let total = lengths[lengths.len() - 1];
    let parts = (total / step).ceil().max(1.0) as usize;
    (0..=parts).map(|n| along(points, &lengths, total * n as f64 / parts as f64)).collect()
}

/// The values at the same places as the points of [`resampled`].
pub fn resampled_values(points: &[DVec3], values: &[f64], step: f64) -> Vec<f64> {
    let lengths = arc_lengths(points);
    let total = lengths[lengths.len() - 1];
    let parts = (total / step).ceil().max(1.0) as usize;
    (0..=parts)
        .map(|n| {
            let (i, share) = place(&lengths, total * n as f64 / parts as f64);
            values[i] + (values[i + 1] - values[i]) * share
        })
        .collect()
}

fn along(points: &[DVec3], lengths: &[f64], at: f64) -> DVec3 {
    let (i, share) = place(lengths, at);
    points[i].lerp(points[i + 1], share)
}

/// The segment that a length lies on, and where on it.
fn place(lengths: &[f64], at: f64) -> (usize, f64) {
    let i = lengths.partition_point(|length| *length <= at).clamp(1, lengths.len() - 1) - 1;
    let step = lengths[i + 1] - lengths[i];
    (i, if step > 0.0 { ((at - lengths[i]) / step).clamp(0.0, 1.0) } else { 0.0 })
}

/// The direction of the line at each point, from the points up to `reach` (mm) before and after it.
pub fn directions(points: &[DVec3], reach: f64) -> Vec<DVec3> {
    let lengths = arc_lengths(points);
    let last = points.len() - 1;
    let mut found = Vec::with_capacity(points.len());
    for (i, length) in lengths.iter().enumerate() {
        let before = lengths.partition_point(|l| *l < length - reach).min(i.saturating_sub(1));
        let after = (lengths.partition_point(|l| *l <= length + reach) - 1).max((i + 1).min(last));
        let across = points[after] - points[before];
        let fallback = found.last().copied().unwrap_or(DVec3::Z);
        found.push(across.try_normalize().unwrap_or(fallback));
    }
    found
}

/// Two directions across the line at each point that do not turn around it.
pub fn frames(points: &[DVec3], directions: &[DVec3]) -> Vec<[DVec3; 2]> {
    let mut frame = MovingFrame::looking(directions[0], directions[0].any_orthonormal_vector());
    let mut found = vec![[frame.ahead, frame.across]];
    for i in 1..points.len() {
        frame = double_reflection(frame, points[i] - points[i - 1], directions[i]);
        found.push([frame.ahead, frame.across]);
    }
    found
}

/// Values along a line, smoothed: at each place the parabola that fits best to those around it, which count by their
/// weights and by a Gaussian of `width` (mm). Unlike an average it does not cut bends. Where next to nothing counts the
/// values stay.
pub fn smoothed<const N: usize>(
    lengths: &[f64],
    values: &[[f64; N]],
    weights: &[f64],
    width: impl Fn(usize) -> f64,
) -> Vec<[f64; N]> {
    (0..values.len())
        .map(|i| {
            let width = width(i);
            let first = lengths.partition_point(|l| *l < lengths[i] - 3.0 * width);
            let end = lengths.partition_point(|l| *l <= lengths[i] + 3.0 * width);
            let mut fit = Parabola::<N>::default();
            for j in first..end {
                let s = (lengths[j] - lengths[i]) / width;
                fit.add(s, weights[j] * (-0.5 * s * s).exp(), &values[j]);
            }
            fit.middle().unwrap_or(values[i])
        })
        .collect()
}

/// Sums of a weighted fit of a parabola to N values.
struct Parabola<const N: usize> {
    powers: [f64; 5],
    values: [[f64; N]; 3],
}

impl<const N: usize> Default for Parabola<N> {
    fn default() -> Self {
        Self { powers: [0.0; 5], values: [[0.0; N]; 3] }
    }
}

impl<const N: usize> Parabola<N> {
    fn add(&mut self, s: f64, weight: f64, values: &[f64; N]) {
        let mut power = weight;
        for p in 0..5 {
            self.powers[p] += power;
            if p < 3 {
                for n in 0..N {
                    self.values[p][n] += power * values[n];
                }
            }
            power *= s;
        }
    }

    /// The parabola at 0; none where too few values count.
    fn middle(&self) -> Option<[f64; N]> {
        let [m0, m1, m2, m3, m4] = self.powers;
        if m0 < 0.3 {
            return None;
        }
        let matrix =
            glam::DMat3::from_cols(DVec3::new(m0, m1, m2), DVec3::new(m1, m2, m3), DVec3::new(m2, m3, m4));
        // Values on one side alone tell too little of a bend.
        if matrix.determinant() < 1e-2 * m0 * m0 * m0 {
            return None;
        }
        let first = matrix.inverse().x_axis;
        Some(std::array::from_fn(|n| (0..3).map(|p| first[p] * self.values[p][n]).sum()))
    }
}
