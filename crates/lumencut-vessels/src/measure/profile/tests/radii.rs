use super::*;

#[test]
fn radii_lie_between_sections_that_are_not_far_apart() {
    let known = [(0.0, 2.0), (1.0, 3.0), (30.0, 5.0)];
    assert_eq!(between(&known, 0.0), Some(2.0));
    assert_eq!(between(&known, 0.25), Some(2.25));
    assert_eq!(between(&known, 10.0), None);
    assert_eq!(between(&known, 30.0), Some(5.0));
    assert_eq!(between(&known, 31.0), None);
    assert_eq!(between(&[], 1.0), None);
    assert_eq!(nearest_radius(&known, 12.0), Some(3.0));
    assert_eq!(nearest_radius(&known, 90.0), Some(5.0));
}
