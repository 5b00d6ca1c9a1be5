use super::*;
use glam::DVec2;

#[test]
fn a_fit_that_runs_away_is_of_another_lumen() {
    let first = Ellipse::circle(DVec2::new(1.0, 2.0), 5.0);
    let at = |away: f64, radius: f64| Ellipse::circle(first.center + DVec2::X * away, radius);
    assert!(is_same_lumen(&first, &at(2.9, 7.9)));
    assert!(is_same_lumen(&first, &at(0.0, 3.2)));
    assert!(!is_same_lumen(&first, &at(3.1, 5.0)), "its centre is elsewhere");
    assert!(!is_same_lumen(&first, &at(0.0, 8.1)), "it is wider");
    assert!(!is_same_lumen(&first, &at(0.0, 3.1)), "it is narrower");
}
