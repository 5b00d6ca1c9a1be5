use super::*;
use crate::tube::tube;

#[test]
fn the_band_is_two_standard_deviations_wide_and_ends_at_zero() {
    let mut profile = tube();
    profile.uncertainty[10] = 9.0;
    let chart = Chart::of(&profile);
    assert_eq!([chart.spread[0][20], chart.spread[1][20]], [7.8, 8.2]);
    assert_eq!([chart.spread[0][10], chart.spread[1][10]], [0.0, 26.0]);
    assert!(chart.spread[0][118].is_nan() && chart.width[118].is_nan() && chart.range[1][118].is_nan());
}

#[test]
fn the_largest_diameter_has_room() {
    let mut profile = tube();
    assert_eq!(Chart::of(&profile).top, 1.12 * 1.1 * 8.0);
    profile.diameter_max[115] = 50.0;
    assert_eq!(Chart::of(&profile).top, 1.12 * 1.1 * 8.0, "a section that is left out");
    let flags = profile.flags[115];
    profile.flags.fill(flags);
    assert_eq!(Chart::of(&profile).top, 1.12 * 50.0, "all are left out");
    profile.diameter_max.fill(f64::NAN);
    assert_eq!(Chart::of(&profile).top, 1.0);
}

#[test]
fn flags_reach_half_a_step_beyond_their_sections_in_the_order_of_the_table() {
    let rows = Chart::of(&tube()).flags;
    let rows: Vec<_> = rows.iter().map(|row| (row.look.word, &row.runs[..])).collect();
    assert_eq!(rows, [("branch", &[[50.25, 60.25]][..]), ("calcium", &[[19.75, 20.25]])]);
}

#[test]
fn the_limit_of_resolution_is_told_below_the_top() {
    let mut profile = tube();
    assert_eq!(Chart::of(&profile).limit_words().as_deref(), Some("1.5 × FWHM: 1.80"));
    profile.fwhm = 20.0;
    assert_eq!(Chart::of(&profile).limit, None);
}
