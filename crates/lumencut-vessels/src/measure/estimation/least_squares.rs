//! Nonlinear least squares for few parameters (Levenberg-Marquardt; Marquardt 1963, doi:10.1137/0111030).

#[derive(Clone, Copy, Debug)]
pub(crate) struct Normal<const N: usize> {
    pub cost: f64,
    /// Sum of the products of the derivatives with respect to each pair of parameters.
    pub matrix: [[f64; N]; N],
    /// Sum of the products of the derivatives and the residuals.
    pub slope: [f64; N],
}

impl<const N: usize> Normal<N> {
    #[cfg(test)]
    pub(crate) fn zero() -> Self {
        Self { cost: 0.0, matrix: [[0.0; N]; N], slope: [0.0; N] }
    }

    /// Adds a prior on a linear combination of parameters: its coefficients, residual and standard deviation.
    pub(crate) fn expect(&mut self, by: &[f64; N], missing: f64, deviation: f64) {
        let weight = 1.0 / (deviation * deviation);
        self.cost += weight * missing * missing;
        for a in (0..N).filter(|a| by[*a] != 0.0) {
            for b in 0..N {
                self.matrix[a][b] += weight * by[a] * by[b];
            }
            self.slope[a] += weight * by[a] * missing;
        }
    }
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Minimum<const N: usize> {
    pub at: [f64; N],
    pub normal: Normal<N>,
}

/// Finds a minimum from `start` in at most `steps` steps; `evaluate` returns None for invalid parameters.
pub(crate) fn minimum<const N: usize>(
    start: [f64; N],
    steps: usize,
    mut evaluate: impl FnMut(&[f64; N]) -> Option<Normal<N>>,
) -> Option<Minimum<N>> {
    /// The iteration stops if the relative decrease of the cost is below this.
    const ENOUGH: f64 = 1e-4;
    let mut best = Minimum { at: start, normal: evaluate(&start)? };
    let mut damping = 1e-3;
    for _ in 0..steps {
        let mut matrix = best.normal.matrix;
        for n in 0..N {
            matrix[n][n] *= 1.0 + damping;
        }
        let tried = solved(&matrix, &best.normal.slope).and_then(|change| {
            let at = std::array::from_fn(|n| best.at[n] + change[n]);
            evaluate(&at).map(|normal| Minimum { at, normal })
        });
        match tried {
            Some(tried) if tried.normal.cost <= best.normal.cost => {
                let fallen = best.normal.cost - tried.normal.cost;
                best = tried;
                damping = (damping * 0.1_f64).max(1e-9);
                if fallen <= ENOUGH * best.normal.cost {
                    break;
                }
            }
            _ if damping > 1e6 => break,
            _ => damping *= 10.0,
        }
    }
    Some(best)
}

fn cholesky<const N: usize>(matrix: &[[f64; N]; N]) -> Option<[[f64; N]; N]> {
    let mut lower = [[0.0; N]; N];
    for i in 0..N {
        for j in 0..=i {
            let known: f64 = (0..j).map(|k| lower[i][k] * lower[j][k]).sum();
            let rest = matrix[i][j] - known;
            lower[i][j] = if i == j {
                let is_positive = rest > 1e-14 * matrix[i][i].abs();
                if !is_positive {
                    return None;
                }
                rest.sqrt()
            } else {
                rest / lower[j][j]
            };
        }
    }
    Some(lower)
}

/// Solves a symmetric positive definite system; None if the matrix is not positive definite.
pub(crate) fn solved<const N: usize>(matrix: &[[f64; N]; N], right: &[f64; N]) -> Option<[f64; N]> {
    let lower = cholesky(matrix)?;
    let mut solution = *right;
    for i in 0..N {
        let known: f64 = (0..i).map(|k| lower[i][k] * solution[k]).sum();
        solution[i] = (solution[i] - known) / lower[i][i];
    }
    for i in (0..N).rev() {
        let known: f64 = (i + 1..N).map(|k| lower[k][i] * solution[k]).sum();
        solution[i] = (solution[i] - known) / lower[i][i];
    }
    Some(solution)
}

/// Variance of a linear combination of parameters, from the normal matrix.
pub(crate) fn variance<const N: usize>(matrix: &[[f64; N]; N], combination: &[f64; N]) -> Option<f64> {
    let solution = solved(matrix, combination)?;
    Some((0..N).map(|n| solution[n] * combination[n]).sum())
}

#[cfg(test)]
#[path = "tests/least_squares.rs"]
mod tests;
