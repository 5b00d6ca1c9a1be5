//! Estimates: means with standard deviations, and their use as priors on the parameters of a fit.

pub(crate) mod golden;
pub(crate) mod least_squares;

/// Mean and standard deviation.
pub(crate) type Level = [f64; 2];

pub(crate) fn unit<const N: usize>(n: usize) -> [f64; N] {
    std::array::from_fn(|m| f64::from(u8::from(m == n)))
}

/// Prior of a parameter, or of a linear combination: mean and standard deviation.
#[derive(Clone, Debug)]
pub(crate) struct Term<const N: usize> {
    pub parameter: usize,
    /// Coefficient of each parameter.
    pub by: [f64; N],
    pub level: Level,
    /// Initial value of the parameter.
    pub start: f64,
}

impl<const N: usize> Term<N> {
    pub(crate) fn one(parameter: usize, level: Level) -> Self {
        Self { parameter, by: unit(parameter), level, start: level[0] }
    }

    /// Applies the prior to the parameter minus `share` times the difference of the parameter `other` from `mean`.
    #[must_use]
    pub(crate) fn less(mut self, other: usize, share: f64, mean: f64) -> Self {
        self.by[other] = -share;
        self.level[0] -= share * mean;
        self
    }

    pub(crate) fn missing(&self, at: &[f64; N]) -> f64 {
        self.level[0] - (0..N).map(|n| self.by[n] * at[n]).sum::<f64>()
    }
}
