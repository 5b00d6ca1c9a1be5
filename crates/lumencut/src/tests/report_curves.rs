use super::*;

const NONE: f64 = f64::NAN;
const AXES: Axes = Axes {
    x: Axis { low: 0.0, high: 4.0, start: 0.0, end: 4.0 },
    y: Axis { low: 0.0, high: 10.0, start: 10.0, end: 0.0 },
};
const PLACES: [f64; 5] = [0.0, 1.0, 2.0, 3.0, 4.0];

#[test]
fn a_line_is_interrupted_where_nothing_counts() {
    let path = line(&AXES, &PLACES, &[1.0, 2.0, NONE, 3.0, 4.0]);
    assert_eq!(path, "M0.00 9.00L1.00 8.00M3.00 7.00L4.00 6.00");
}

#[test]
fn a_section_that_stands_alone_is_no_line() {
    let values = [1.0, NONE, 2.0, NONE, NONE];
    assert_eq!(line(&AXES, &PLACES, &values), "");
    assert_eq!(isolated(&values), [0, 2]);
}

#[test]
fn a_band_goes_forth_above_and_back_below() {
    let path = band(&AXES, &PLACES, &[1.0, 1.0, NONE, NONE, NONE], &[2.0, 3.0, 4.0, NONE, NONE]);
    assert_eq!(path, "M0.00 8.00L1.00 7.00L1.00 9.00L0.00 9.00Z");
}
