use super::*;

const AXIS: Axis = Axis { low: 0.0, high: 60.0, start: 50.0, end: 650.0 };

#[test]
fn an_axis_goes_from_lengths_to_pixels() {
    assert_eq!([AXIS.pixel(0.0), AXIS.pixel(30.0), AXIS.pixel_within(90.0)], [50.0, 350.0, 650.0]);
    let up = Axis { low: 0.0, high: 10.0, start: 200.0, end: 20.0 };
    assert_eq!(up.pixel(5.0), 110.0);
}

#[test]
fn ticks_are_round_and_have_room() {
    let ticks = |high: f64, pixels: f64| Axis { high, ..AXIS }.ticks(pixels);
    assert_eq!(ticks(60.0, 100.0), [0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0]);
    assert_eq!(ticks(60.0, 120.0), [0.0, 20.0, 40.0, 60.0]);
    assert_eq!(ticks(9.4, 120.0), [0.0, 2.0, 4.0, 6.0, 8.0]);
    assert!(ticks(0.0, 100.0).is_empty() && ticks(f64::NAN, 100.0).is_empty());
}
