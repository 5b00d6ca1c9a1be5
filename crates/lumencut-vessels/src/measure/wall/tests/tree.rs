use super::*;
use glam::DVec3;

const CT: Level = [45.0, 25.0];

fn is_near([level, deviation]: Level, [other, unsure]: Level) -> bool {
    (level - other).abs() < 1e-9 && (deviation - unsure).abs() < 1e-9
}

#[test]
fn a_vessel_alone_has_what_is_expected_beforehand() {
    assert!(is_near(by_others(CT, &[]), CT));
}

#[test]
fn vessels_that_agree_make_the_level_surer_and_never_sure() {
    let one = by_others(CT, &[[20.0, 5.0]]);
    let six = by_others(CT, &[[20.0, 5.0], [22.0, 5.0], [18.0, 5.0], [21.0, 5.0], [19.0, 5.0], [20.0, 5.0]]);
    assert!(one[0] < 37.0 && one[1] < CT[1], "{one:?}");
    assert!((six[0] - 20.0).abs() < 2.0 && six[1] < one[1], "{six:?}");
    assert!(six[1] > TRIED_DEVIATIONS[0] * CT[1], "{six:?}");
}

#[test]
fn vessels_that_differ_say_little_of_another_one() {
    let alike = by_others(CT, &[[40.0, 4.0], [42.0, 4.0], [44.0, 4.0]]);
    let apart = by_others(CT, &[[5.0, 4.0], [42.0, 4.0], [79.0, 4.0]]);
    assert!(apart[1] > 2.0 * alike[1], "{alike:?} {apart:?}");
}

#[test]
fn what_is_told_vaguely_changes_nothing() {
    assert!(is_near(by_others(CT, &[[-300.0, 1e9], [900.0, 1e9]]), CT));
}

#[test]
fn the_order_of_vessels_does_not_matter() {
    let walls = [[31.7, 5.3], [48.2, 7.1], [12.9, 11.7], [31.7, 4.9]];
    let turned = [walls[2], walls[0], walls[3], walls[1]];
    assert_eq!(by_others(CT, &walls), by_others(CT, &turned));
}

#[test]
fn vessels_on_the_same_line_are_not_asked() {
    let vessel = |from: f64, to: f64| {
        let points = (0..=10).map(|n| DVec3::new(0.0, 0.0, from + (to - from) * f64::from(n) / 10.0));
        Vessel::new(points.collect(), None).unwrap()
    };
    // The second vessel begins where the first ends; `path` leads through both.
    let tree = [vessel(0.0, 10.0), vessel(10.0, 20.0)];
    let path = Vessel::new((0..=20).map(|z| DVec3::new(0.0, 0.0, f64::from(z))).collect(), None).unwrap();
    let walls = [[30.0, 5.0], [60.0, 5.0]];
    let walls: Vec<VesselWall> =
        walls.into_iter().enumerate().map(|(vessel, level)| VesselWall { vessel, level }).collect();
    let of_first = wall_beside(&walls, &tree, &tree[0], CT).unwrap();
    assert_eq!(of_first, PooledWall { level: by_others(CT, &[[60.0, 5.0]]), vessels: 1 });
    assert_eq!(wall_beside(&walls, &tree, &path, CT), None);
    assert_eq!(wall_beside(&walls, &tree, &vessel(30.0, 40.0), CT).unwrap().vessels, 2);
}
