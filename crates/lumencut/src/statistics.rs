//! Medians, percentiles and deviations of values.

/// The median; the mean of the two in the middle where their number is even. None of no values.
pub fn median(values: &mut [f64]) -> Option<f64> {
    let middle = values.len() / 2;
    if values.len() % 2 == 1 {
        return Some(nth(values, middle));
    }
    let above = (!values.is_empty()).then(|| nth(values, middle))?;
    Some((nth(values, middle - 1) + above) / 2.0)
}

/// The value below which `part` of all values lie, interpolated linearly between neighbours; None of no values.
pub fn quantile(values: &mut [f64], part: f64) -> Option<f64> {
    let last = values.len().checked_sub(1)?;
    let place = last as f64 * part;
    let below = (place.floor() as usize).min(last);
    let (low, high) = (nth(values, below), nth(values, (below + 1).min(last)));
    let (weight, difference) = (place - below as f64, high - low);
    // From the nearer end: so both ends are met exactly.
    Some(if weight < 0.5 { low + difference * weight } else { high - difference * (1.0 - weight) })
}

/// The standard deviation of all values, 0 of no values.
pub fn deviation(values: &[f64]) -> f64 {
    let count = values.len().max(1) as f64;
    let mean = sum(values) / count;
    let squares: Vec<f64> = values.iter().map(|value| (value - mean) * (value - mean)).collect();
    (sum(&squares) / count).sqrt()
}

fn nth(values: &mut [f64], n: usize) -> f64 {
    *values.select_nth_unstable_by(n, f64::total_cmp).1
}

/// The sum by halves, in eight columns each: its error grows with the logarithm of their number only.
fn sum(values: &[f64]) -> f64 {
    const COLUMNS: usize = 8;
    const LONGEST: usize = 128;
    if values.len() < COLUMNS {
        return values.iter().sum();
    }
    if values.len() > LONGEST {
        let half = values.len() / 2;
        let (front, back) = values.split_at(half - half % COLUMNS);
        return sum(front) + sum(back);
    }
    let mut rows = values.chunks_exact(COLUMNS);
    let mut columns = [0.0; COLUMNS];
    for row in &mut rows {
        for (column, value) in columns.iter_mut().zip(row) {
            *column += value;
        }
    }
    let [a, b, c, d, e, f, g, h] = columns;
    let total = ((a + b) + (c + d)) + ((e + f) + (g + h));
    rows.remainder().iter().fold(total, |total, value| total + value)
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
    fn the_deviation_of_two_heights_is_half_their_distance() {
        for pairs in [1, 3, 4, 64, 65, 5000] {
            let values = [4.0, 10.0].repeat(pairs);
            assert_eq!(deviation(&values), 3.0);
        }
        assert_eq!(deviation(&[5.0]), 0.0);
        assert_eq!(deviation(&[]), 0.0);
    }

    #[test]
    fn whole_numbers_are_summed_exactly_at_every_length() {
        for count in 0..1000u32 {
            let values: Vec<f64> = (1..=count).map(f64::from).collect();
            assert_eq!(sum(&values), f64::from(count * (count + 1) / 2));
        }
    }
}
