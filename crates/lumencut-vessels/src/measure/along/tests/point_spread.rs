use super::*;

const SEARCH_RANGE: [f64; 2] = [0.3, 3.0];

#[test]
fn the_median_of_estimates_that_agree_is_taken() {
    let [fwhm, deviation] = agreed(&mut [1.1, 0.9, 1.0, 3.0, 1.0], SEARCH_RANGE).unwrap();
    assert_eq!(fwhm, 1.0);
    // The median deviation is 0.1; multiplied by 1.4826 it becomes a standard deviation.
    assert!((deviation - 0.14826).abs() < 1e-9);
}

#[test]
fn estimates_that_do_not_agree_tell_nothing() {
    assert!(
        agreed(&mut [0.5, 1.0, 2.0, 1.5, 0.6], SEARCH_RANGE).unwrap_err().contains("give different widths")
    );
    assert!(agreed(&mut [3.0, 3.0, 2.99, 1.0], SEARCH_RANGE).unwrap_err().contains("give different widths"));
}

#[test]
fn a_point_spread_below_the_range_is_none() {
    assert!(agreed(&mut [0.3, 0.31, 0.9], SEARCH_RANGE).unwrap_err().contains("sharper"));
    assert_eq!(agreed(&mut [1.0, 1.0], SEARCH_RANGE), Err(TOO_NARROW));
}
