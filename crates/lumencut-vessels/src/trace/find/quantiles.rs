//! Medians and quantiles that are always one of the values. The interpolating versions in lumencut-core would split
//! the dissection of one test patient differently.

/// Quantile by nearest rank; None if there are no values.
pub(crate) fn quantile(values: &mut [f64], share: f64) -> Option<f64> {
    let last = values.len().checked_sub(1)?;
    let rank = (last as f64 * share).round() as usize;
    Some(*values.select_nth_unstable_by(rank, f64::total_cmp).1)
}

/// The upper one of two middle values; None if there are no values.
pub(crate) fn median(values: &mut [f64]) -> Option<f64> {
    quantile(values, 0.5)
}

/// The lower one of two middle values; None if there are no values.
pub(crate) fn lower_median(values: &mut [f64]) -> Option<f64> {
    let last = values.len().checked_sub(1)?;
    Some(*values.select_nth_unstable_by(last / 2, f64::total_cmp).1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_an_even_number_each_median_is_its_own_one_of_the_middle() {
        let mut values = [4.0, 1.0, 3.0, 2.0];
        assert_eq!((lower_median(&mut values), median(&mut values)), (Some(2.0), Some(3.0)));
        assert_eq!((lower_median(&mut [7.0]), median(&mut [7.0])), (Some(7.0), Some(7.0)));
        assert_eq!((lower_median(&mut []), median(&mut [])), (None, None));
    }

    #[test]
    fn quantiles_are_the_nearest_in_rank() {
        let at = |share| quantile(&mut [50.0, 10.0, 30.0, 20.0, 40.0], share);
        assert_eq!([0.0, 0.3, 0.4, 1.0].map(at), [10.0, 20.0, 30.0, 50.0].map(Some));
    }
}
