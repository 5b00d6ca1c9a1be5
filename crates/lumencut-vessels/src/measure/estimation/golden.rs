//! Finds the minimum of a unimodal function by golden-section search (Kiefer 1953, doi:10.2307/2032161).

const GOLDEN: f64 = 0.618_033_988_749_895;

/// Position of the minimum in a range. Each round shrinks the range to 62 %. Errors of the function are returned.
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
