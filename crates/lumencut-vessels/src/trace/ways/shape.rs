//! The shape of the values around a voxel: a wall between two lumens, a ridge, or the edge of bone.

use crate::trace::ways::blocks::SIDE;

/// Border around a block (voxels).
pub(crate) const HALO: usize = 3;
/// Side of the cube with border (voxels).
pub(crate) const PADDED_SIDE: usize = SIDE + 2 * HALO;

pub(crate) fn padded(n: usize) -> usize {
    let [i, j, k] = [n % SIDE, n / SIDE % SIDE, n / (SIDE * SIDE)].map(|c| c + HALO);
    (k * PADDED_SIDE + j) * PADDED_SIDE + i
}

/// A ridge adds up to this fraction of the missing membership.
const RIDGE: f64 = 0.6;

/// Minimum membership for a ridge to be visible.
const FAINT: f64 = 0.05;

/// Second derivative of the membership in a clear wall. In the throat of a stenosis, the next eigenvalue is
/// below -`THROAT` times the first.
const DIP: f64 = 0.1;
const THROAT: f64 = 0.3;

/// Degree (0 to 1) to which a voxel lies in a wall between two lumens. In one direction it is darker than both
/// neighbours. In the other directions it is not brighter than its neighbours, unlike the throat of a stenosis.
pub(crate) fn wall_between(share: f64, bends: &[f64; 3]) -> f64 {
    if !(0.1..0.95).contains(&share) {
        return 0.0;
    }
    let [most, middle, _] = *bends;
    let is_throat = middle < -THROAT * most;
    if most <= 0.0 || is_throat { 0.0 } else { (most / DIP).min(1.0) }
}

/// Raises the membership on ridges, because a vessel thinner than a voxel never looks as bright as its lumen.
/// Ridges below the noise (standard deviation `noise`) are ignored.
pub(crate) fn raised(share: f64, bends: &[f64; 3], noise: f64) -> f64 {
    let is_seen = (share / (2.0 * noise).max(FAINT) - 1.0).clamp(0.0, 1.0);
    let ridge = ((-bends[1] - 2.0 * noise) / share.max(1e-6)).clamp(0.0, 1.0);
    share + (1.0 - share) * RIDGE * ridge * is_seen
}

/// Eigenvalues of the second derivatives, in descending order; positive if both neighbours are brighter.
pub(crate) fn bends(shares: &[f32], at: usize) -> [f64; 3] {
    let share = f64::from(shares[at]);
    if !(0.02..0.98).contains(&share) {
        return [0.0; 3];
    }
    let strides = [1, PADDED_SIDE, PADDED_SIDE * PADDED_SIDE];
    let value = |n: usize| f64::from(shares[n]);
    let mut bends = [[0.0; 3]; 3];
    for a in 0..3 {
        bends[a][a] = value(at + strides[a]) + value(at - strides[a]) - 2.0 * share;
        for b in 0..a {
            let (plus, minus) = (strides[a] + strides[b], strides[a] - strides[b]);
            let across = value(at + plus) + value(at - plus) - value(at + minus) - value(at - minus);
            (bends[a][b], bends[b][a]) = (across / 4.0, across / 4.0);
        }
    }
    eigenvalues(bends)
}

/// Extends the marked voxels by one voxel, except at the border.
pub(crate) fn beside(values: &[f32], is_marked: impl Fn(f32) -> bool) -> Vec<bool> {
    let mut marked: Vec<bool> = values.iter().map(|value| is_marked(*value)).collect();
    if !marked.contains(&true) {
        return marked;
    }
    for stride in [1, PADDED_SIDE, PADDED_SIDE * PADDED_SIDE] {
        let before = marked.clone();
        for n in stride..marked.len() - stride {
            marked[n] = before[n - stride] || before[n] || before[n + stride];
        }
    }
    marked
}

/// Eigenvalues of a symmetric matrix, in descending order.
pub(crate) fn eigenvalues(m: [[f64; 3]; 3]) -> [f64; 3] {
    let mean = (m[0][0] + m[1][1] + m[2][2]) / 3.0;
    let mut square = 2.0 * (m[0][1].powi(2) + m[0][2].powi(2) + m[1][2].powi(2));
    square += (0..3).map(|a| (m[a][a] - mean).powi(2)).sum::<f64>();
    let size = (square / 6.0).sqrt();
    if size < 1e-9 {
        return [mean; 3];
    }
    let unit = |a: usize, b: usize| (m[a][b] - if a == b { mean } else { 0.0 }) / size;
    let matrix =
        glam::DMat3::from_cols_array_2d(&std::array::from_fn(|a| std::array::from_fn(|b| unit(a, b))));
    let angle = (matrix.determinant() / 2.0).clamp(-1.0, 1.0).acos() / 3.0;
    let first = mean + 2.0 * size * angle.cos();
    let last = mean + 2.0 * size * (angle + std::f64::consts::TAU / 3.0).cos();
    [first, 3.0 * mean - first - last, last]
}

/// Averages over the cube, axis by axis; results are valid where all weights lie inside.
pub(crate) fn blurred(shares: &[f32], weights: &[f32]) -> Vec<f32> {
    let reach = weights.len() / 2;
    let mut now = shares.to_vec();
    let mut next = vec![0.0; shares.len()];
    for stride in [1, PADDED_SIDE, PADDED_SIDE * PADDED_SIDE] {
        let from = reach * stride;
        let length = shares.len() - 2 * from;
        next.fill(0.0);
        for (w, weight) in weights.iter().enumerate() {
            let shifted = &now[w * stride..][..length];
            for (sum, share) in next[from..][..length].iter_mut().zip(shifted) {
                *sum += weight * share;
            }
        }
        std::mem::swap(&mut now, &mut next);
    }
    now
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cube whose membership depends on the offset from its middle, and the index of the middle voxel.
    fn cube(share: impl Fn([f64; 3]) -> f64) -> (Vec<f32>, usize) {
        let middle = PADDED_SIDE / 2;
        let steps = |n: usize| {
            [n % PADDED_SIDE, n / PADDED_SIDE % PADDED_SIDE, n / (PADDED_SIDE * PADDED_SIDE)]
                .map(|c| c as f64 - middle as f64)
        };
        let shares = (0..PADDED_SIDE * PADDED_SIDE * PADDED_SIDE).map(|n| share(steps(n)) as f32).collect();
        (shares, (middle * PADDED_SIDE + middle) * PADDED_SIDE + middle)
    }

    #[test]
    fn a_dark_sheet_is_a_wall_and_a_throat_is_none() {
        let (sheet, middle) = cube(|[i, _, _]| 0.5 + 0.1 * i * i);
        assert!((wall_between(0.5, &bends(&sheet, middle)) - 1.0).abs() < 1e-6);
        let (throat, middle) = cube(|[i, j, k]| 0.5 + 0.1 * i * i - 0.1 * (j * j + k * k));
        assert!(wall_between(0.5, &bends(&throat, middle)).abs() < f64::EPSILON);
    }

    #[test]
    fn a_thin_bright_line_counts_for_more_than_its_membership_unless_it_is_noise() {
        let (line, middle) = cube(|[_, j, k]| 0.4 - 0.1 * (j * j + k * k));
        let bends = bends(&line, middle);
        let expected = 0.4 + 0.6 * RIDGE * (0.2 / 0.4);
        assert!((raised(0.4, &bends, 0.0) - expected).abs() < 1e-6);
        assert!((raised(0.4, &bends, 0.2) - 0.4).abs() < 1e-6);
    }

    #[test]
    fn an_average_over_neighbours_keeps_a_slope_and_marks_spread_by_one_voxel() {
        let (slope, middle) = cube(|[i, _, _]| 0.5 + 0.05 * i);
        assert!((blurred(&slope, &[0.25, 0.5, 0.25])[middle + 2] - 0.6).abs() < 1e-6);
        let (spot, middle) = cube(|steps| f64::from(u8::from(steps == [0.0; 3])));
        let near = beside(&spot, |value| value > 0.5);
        assert_eq!(near.iter().filter(|is_near| **is_near).count(), 27);
        assert!(near[middle + 1 + PADDED_SIDE] && !near[middle + 2]);
    }
}
