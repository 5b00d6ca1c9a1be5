use super::*;
use glam::DVec3;

fn tube(length: f64, radius: f64, level: f64, closure: f64) -> Vec<TrackPoint> {
    let point = |n: usize| TrackPoint {
        place: DVec3::X * (length * n as f64 / 20.0),
        direction: DVec3::X,
        radius,
        level,
        contrast: level - 40.0,
        closure,
        is_good: true,
    };
    (0..=20).map(point).collect()
}

#[test]
fn the_level_is_that_of_the_longest_and_widest_tubes_that_are_alike() {
    let tracks = [
        tube(90.0, 5.0, 340.0, 1.0),
        tube(60.0, 3.0, 350.0, 1.0),
        tube(20.0, 2.0, 900.0, 1.0),
        tube(300.0, 8.0, 500.0, 0.7),
    ];
    let UsualLevel { level: [level, contrast], is_wide } = vessel_level(&tracks, 10.0).expect("a level");
    // The mean is weighted by length, width and contrast, so the weights are 450 × 300 and 180 × 310.
    let expected = (450.0 * 300.0 * 340.0 + 180.0 * 310.0 * 350.0) / (450.0 * 300.0 + 180.0 * 310.0);
    assert!((level - expected).abs() < 1e-9 && (contrast - (expected - 40.0)).abs() < 1e-9);
    assert!(is_wide);
}

#[test]
fn narrow_tubes_tell_the_level_where_there_are_no_others_and_open_ones_never() {
    let narrow = UsualLevel { level: [300.0, 260.0], is_wide: false };
    assert_eq!(vessel_level(&[tube(20.0, 1.0, 300.0, 0.9)], 10.0), Some(narrow));
    assert_eq!(vessel_level(&[tube(90.0, 5.0, 300.0, 0.8)], 10.0), None);
    assert_eq!(vessel_level(&[], 10.0), None);
}
