//! Medians, quantiles and groups of values, in time proportional to their number; at once if they are sorted.

/// The median, or the mean of the two in the middle; `None` without values. It reorders the values.
pub fn median(values: &mut [f64]) -> Option<f64> {
    let last = values.len().checked_sub(1)?;
    Some(middle(last, neighbours(values, last / 2)))
}

/// The [`median`] of rising values.
pub fn rising_median(values: &[f64]) -> Option<f64> {
    let last = values.len().checked_sub(1)?;
    Some(middle(last, rising_neighbours(values, last / 2)))
}

fn middle(last: usize, [below, above]: [f64; 2]) -> f64 {
    if last.is_multiple_of(2) { below } else { (below + above) / 2.0 }
}

/// The quantile at share `part`, interpolated linearly; `None` without values. It reorders the values.
pub fn quantile(values: &mut [f64], part: f64) -> Option<f64> {
    let (below, weight) = place(values.len(), part)?;
    Some(between(neighbours(values, below), weight))
}

/// The [`quantile`] of rising values.
pub fn rising_quantile(values: &[f64], part: f64) -> Option<f64> {
    let (below, weight) = place(values.len(), part)?;
    Some(between(rising_neighbours(values, below), weight))
}

/// The place below a quantile, and the weight of the next place.
fn place(count: usize, part: f64) -> Option<(usize, f64)> {
    let last = count.checked_sub(1)?;
    let place = last as f64 * part;
    let below = (place.floor() as usize).min(last);
    Some((below, place - below as f64))
}

/// The result is computed from the nearer end, so that it is exact at both ends.
fn between([low, high]: [f64; 2], weight: f64) -> f64 {
    let difference = high - low;
    if weight < 0.5 { low + difference * weight } else { high - difference * (1.0 - weight) }
}

/// Splits rising values into two groups by Otsu (1979): the start of the second; `None` if all are equal.
pub fn two_groups(rising: &[f64]) -> Option<usize> {
    let first = *rising.first()?;
    let all: f64 = rising.iter().map(|value| value - first).sum();
    let mut below = 0.0;
    let mut best = (0.0, None);
    for (n, pair) in (1..rising.len()).zip(rising.windows(2)) {
        below += pair[0] - first;
        let (count, others) = (n as f64, (rising.len() - n) as f64);
        let difference = (all - below) / others - below / count;
        let between = count * others * difference * difference;
        if pair[0] < pair[1] && between > best.0 {
            best = (between, Some(n));
        }
    }
    best.1
}

/// The n-th value in rising order and the next one; the last value twice at the end.
fn neighbours(values: &mut [f64], n: usize) -> [f64; 2] {
    let (_, found, above) = values.select_nth_unstable_by(n, f64::total_cmp);
    [*found, above.iter().copied().min_by(f64::total_cmp).unwrap_or(*found)]
}

fn rising_neighbours(values: &[f64], n: usize) -> [f64; 2] {
    [values[n], values[(n + 1).min(values.len() - 1)]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_the_middle_or_the_mean_of_two() {
        assert_eq!(median(&mut [3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(&mut [4.0, 1.0, 2.0, 30.0]), Some(3.0));
        assert_eq!(median(&mut [7.0]), Some(7.0));
        assert_eq!(median(&mut []), None);
    }

    #[test]
    fn quantiles_lie_between_neighbours() {
        let mut values: Vec<f64> = (0..101).rev().map(f64::from).collect();
        assert_eq!(quantile(&mut values, 0.0), Some(0.0));
        assert_eq!(quantile(&mut values, 0.25), Some(25.0));
        assert_eq!(quantile(&mut values, 1.0), Some(100.0));
        assert_eq!(quantile(&mut [10.0, 20.0], 0.75), Some(17.5));
        assert_eq!(quantile(&mut [10.0], 0.99), Some(10.0));
        assert_eq!(quantile(&mut [], 0.5), None);
    }

    #[test]
    fn sorted_values_have_the_same_median_and_quantiles() {
        for count in 0..6 {
            let rising: Vec<f64> = (0..count).map(|n| f64::from(n * n)).collect();
            assert_eq!(rising_median(&rising), median(&mut rising.clone()));
            for part in [0.0, 0.1, 0.5, 0.77, 1.0] {
                assert_eq!(rising_quantile(&rising, part), quantile(&mut rising.clone(), part));
            }
        }
    }

    #[test]
    fn two_groups_part_where_their_means_differ_most() {
        assert_eq!(two_groups(&[1.0, 2.0, 3.0, 90.0, 91.0]), Some(3));
        assert_eq!(two_groups(&[0.0, 0.0, 0.0, 5.0]), Some(3));
        assert_eq!(two_groups(&[7.0, 8.0]), Some(1));
        for same in [&[][..], &[4.0], &[4.0, 4.0, 4.0]] {
            assert_eq!(two_groups(same), None);
        }
    }
}
