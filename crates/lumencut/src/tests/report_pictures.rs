use super::*;
use crate::tube::tube;

#[test]
fn nine_of_ten_sections_fit() {
    let mut profile = tube();
    assert_eq!(section_side(&profile), 22.0);
    assert_eq!(section_spacing(&profile, 201), 0.11);
    // Between two values the quantile is interpolated: 3 + 0.9 (8 - 3) = 7.5 mm.
    profile.diameter_max.fill(f64::NAN);
    profile.diameter_max[..2].copy_from_slice(&[3.0, 8.0]);
    assert_eq!(section_side(&profile), 19.0);
}

#[test]
fn sides_have_bounds_and_a_default() {
    let mut profile = tube();
    for (diameter, side) in [(0.5, 12.0), (90.0, 120.0), (f64::NAN, DEFAULT_SIDE_MM)] {
        profile.diameter_max.fill(diameter);
        assert_eq!(section_side(&profile), side);
    }
}
