//! Estimates: means with standard deviations, their use as priors on the parameters of a fit, and a search for minima.

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

const GOLDEN: f64 = 0.618_033_988_749_895;

/// Position of the minimum of a unimodal function in a range, by golden-section search (Kiefer 1953,
/// doi:10.2307/2032161). Each round shrinks the range to 62 %. Errors of the function are returned.
pub(crate) fn least<E>(
    [mut low, mut high]: [f64; 2],
    rounds: usize,
    mut function: impl FnMut(f64) -> Result<f64, E>,
) -> Result<f64, E> {
    let [mut a, mut b] = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
    let [mut at_a, mut at_b] = [function(a)?, function(b)?];
    for _ in 0..rounds {
        if at_a <= at_b {
            (high, b, at_b) = (b, a, at_a);
            a = high - GOLDEN * (high - low);
            at_a = function(a)?;
        } else {
            (low, a, at_a) = (a, b, at_b);
            b = low + GOLDEN * (high - low);
            at_b = function(b)?;
        }
    }
    Ok(f64::midpoint(low, high))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bottom_of_a_valley_is_found() {
        let found = least([0.0, 10.0], 40, |x: f64| Ok::<_, ()>((x - 3.7).powi(2)));
        assert!((found.unwrap() - 3.7).abs() < 1e-6);
        assert_eq!(least([0.0, 1.0], 5, |_| Err("stopped")), Err("stopped"));
    }
}
