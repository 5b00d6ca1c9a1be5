//! Smoothing along a line by parabolas, which does not cut bends, or by a Gaussian, which keeps the ends.

use glam::DVec3;

use lumencut_core::math::arc_length::arc_lengths;

/// The Gaussian is cut off at this many standard deviations.
const CUTOFF_SIGMAS: f64 = 3.0;

/// Smooths values by local parabolas, weighted by `weights` and a Gaussian of `width` mm. Unlike averages,
/// parabolas do not cut bends. Values with almost no weight around them stay unchanged.
pub fn smoothed_by_parabolas<const N: usize>(
    lengths: &[f64],
    values: &[[f64; N]],
    weights: &[f64],
    width: impl Fn(usize) -> f64,
) -> Vec<[f64; N]> {
    (0..values.len())
        .map(|i| {
            let width = width(i);
            let first = lengths.partition_point(|l| *l < lengths[i] - CUTOFF_SIGMAS * width);
            let end = lengths.partition_point(|l| *l <= lengths[i] + CUTOFF_SIGMAS * width);
            let mut fit = Parabola::<N>::default();
            for j in first..end {
                let s = (lengths[j] - lengths[i]) / width;
                fit.add(s, weights[j] * (-0.5 * s * s).exp(), &values[j]);
            }
            fit.middle().unwrap_or(values[i])
        })
        .collect()
}

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

    /// Value of the parabola at 0; None if the weight is too small.
    fn middle(&self) -> Option<[f64; N]> {
        let [m0, m1, m2, m3, m4] = self.powers;
        if m0 < 0.3 {
            return None;
        }
        let matrix =
            glam::DMat3::from_cols(DVec3::new(m0, m1, m2), DVec3::new(m1, m2, m3), DVec3::new(m2, m3, m4));
        // Values on only one side do not determine the bend of a parabola.
        if matrix.determinant() < 1e-2 * m0 * m0 * m0 {
            return None;
        }
        let first = matrix.inverse().x_axis;
        Some(std::array::from_fn(|n| (0..3).map(|p| first[p] * self.values[p][n]).sum()))
    }
}

/// Smooths points by a Gaussian of standard deviation `sigma` mm, or a third of the distance to the nearer
/// end if that is less, so that the ends stay. A closed line (whose last point equals the first) has no ends.
pub fn smoothed_by_gaussian(points: &[DVec3], sigma: &[f64], is_closed: bool) -> Vec<DVec3> {
    let ways = arc_lengths(points);
    let whole = ways[ways.len() - 1];
    let count = points.len();
    let mut made: Vec<DVec3> = (0..count)
        .map(|n| {
            let to_end = ways[n].min(whole - ways[n]);
            let most = if is_closed { whole / 6.0 } else { to_end / CUTOFF_SIGMAS };
            let sigma = sigma[n].min(most);
            if sigma <= 0.0 {
                return points[n];
            }
            let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
            for turn in if is_closed { -1..=1 } else { 0..=0 } {
                let center = ways[n] - f64::from(turn) * whole;
                let first = ways.partition_point(|way| *way < center - CUTOFF_SIGMAS * sigma);
                for m in first..count {
                    let away = (ways[m] - center) / sigma;
                    if away > CUTOFF_SIGMAS {
                        break;
                    }
                    // The weight of a point is half of the distance between its neighbours.
                    let share = (ways[(m + 1).min(count - 1)] - ways[m.saturating_sub(1)]) / 2.0;
                    let weight = share * (-away * away / 2.0).exp();
                    sum += weight * points[m];
                    weights += weight;
                }
            }
            if weights > 0.0 { sum / weights } else { points[n] }
        })
        .collect();
    if is_closed {
        made[count - 1] = made[0];
    }
    made
}
