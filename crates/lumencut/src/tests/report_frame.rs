use super::*;
use crate::tube::tube;

#[test]
fn rows_of_flags_take_less_than_half_of_the_chart() {
    assert_eq!([row_height(0, 200.0), row_height(2, 200.0), row_height(10, 200.0)], [12.0, 12.0, 9.0]);
    let layout = Layout::of(&Chart::of(&tube()), [900.0, 270.0]);
    assert_eq!([layout.bottom, layout.axes.y.start, layout.axes.y.end], [236.0, 212.0, 38.0]);
    assert_eq!([layout.row, layout.word_row], [12.0, 12.0]);
}

#[test]
fn words_of_low_rows_spread_upwards() {
    let layout = Layout::of(&Chart::of(&tube()), [900.0, 60.0]);
    assert_eq!([layout.row, layout.word_row, layout.bottom], [4.5, 11.0, 58.0]);
}

#[test]
fn a_small_pane_keeps_an_axis() {
    assert_eq!(axis_along(60.0, 900.0), Axis { low: 0.0, high: 60.0, start: 56.0, end: 796.0 });
    assert_eq!(axis_along(60.0, 30.0).end, 76.0);
}

#[test]
fn a_long_vessel_is_true_to_scale_and_a_short_one_shows_its_lumen() {
    let long = StripLayout::along(&axis_along(400.0, 900.0), 150.0, 1.0, 22.0);
    assert!((long.stretch - 1.0).abs() < 1e-12 && long.width == 22.0);
    let short = StripLayout::along(&axis_along(40.0, 900.0), 150.0, 2.0, 60.0);
    assert_eq!([short.width, short.height, short.spacing], [36.0, 150.0, 0.05]);
    assert!(short.stretch < 0.5);
}
