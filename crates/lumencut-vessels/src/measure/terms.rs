//! What is expected of the parameters of a fit.

use super::pooled::Level;

/// The parameters of a combination that is one of them.
pub fn unit<const N: usize>(n: usize) -> [f64; N] {
    std::array::from_fn(|m| f64::from(u8::from(m == n)))
}

/// What is expected of a parameter, or of it less a share of another one: a mean and a standard deviation.
#[derive(Clone, Debug)]
pub struct Term<const N: usize> {
    /// The parameter.
    pub parameter: usize,
    /// What of each parameter it is of.
    pub by: [f64; N],
    /// The mean and the standard deviation.
    pub level: Level,
    /// Where the parameter begins.
    pub start: f64,
}

impl<const N: usize> Term<N> {
    /// What is expected of one parameter.
    pub fn one(parameter: usize, level: Level) -> Self {
        Self { parameter, by: unit(parameter), level, start: level[0] }
    }

    /// The same of the parameter less a share of by how much another one differs from its mean.
    #[must_use]
    pub fn less(mut self, other: usize, share: f64, mean: f64) -> Self {
        self.by[other] = -share;
        self.level[0] -= share * mean;
        self
    }

    /// By how much parameters miss it.
    pub fn missing(&self, at: &[f64; N]) -> f64 {
        self.level[0] - (0..N).map(|n| self.by[n] * at[n]).sum::<f64>()
    }
}
