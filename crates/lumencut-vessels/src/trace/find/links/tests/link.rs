use super::*;
use crate::trace::find::made::{LEVEL, TISSUE, with_scan};

#[test]
fn the_lowest_level_is_that_of_the_darkest_place_between_both_ends() {
    // A slab 4 mm thick at half brightness lies between the lumens.
    let half = f64::midpoint(LEVEL, TISSUE);
    let value = |place: DVec3| if (place.x - 10.0).abs() < 2.0 { half } else { LEVEL };
    let end = |x: f64, level: f64| WayEnd { place: DVec3::new(x, 5.0, 5.0), level, contrast: level - TISSUE };
    with_scan([40, 20, 20], 0.5, value, |scan| {
        let lowest = |from, to| lowest_level(scan, from, to);
        assert!((lowest(end(4.0, LEVEL), end(16.0, LEVEL)) - 0.5).abs() < 1e-6);
        assert!((lowest(end(4.0, LEVEL), end(7.0, LEVEL)) - 1.0).abs() < 1e-6);
        // If the branch is darker, the slab is as bright as the branch.
        let darker = lowest(end(4.0, LEVEL), end(16.0, half));
        assert!((darker - 1.0).abs() < 1e-6, "{darker}");
        assert_eq!(lowest(end(4.0, LEVEL), end(40.0, LEVEL)), 0.0);
    });
}
