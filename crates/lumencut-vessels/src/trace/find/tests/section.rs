use super::*;
use crate::trace::find::grid::Grid;
use crate::trace::find::made::{LEVEL, TISSUE, blurred, with_scan};
use crate::trace::find::pyramid::Pyramid;

const MIDDLE: DVec3 = DVec3::new(20.2, 19.7, 15.0);

/// A section perpendicular to z, in voxels of 1 mm.
fn look(value: impl Fn(DVec3) -> f64, place: DVec3, radius: f64) -> Section {
    looked(Section::look, value, place, radius)
}

fn looked(
    look: fn(&Level, DVec3, DVec3, f64) -> Section,
    value: impl Fn(DVec3) -> f64,
    place: DVec3,
    radius: f64,
) -> Section {
    with_scan([40, 40, 30], 1.0, value, |scan| {
        let grid = Grid::over(scan.voxels, 0.5);
        let pyramid = Pyramid::new(scan.voxels, grid, [0.0, 1000.0], &|| false).expect("levels");
        look(&pyramid.levels[0], place, DVec3::Z, radius)
    })
}

fn depth(place: DVec3, radius: f64) -> f64 {
    radius - (place - MIDDLE).truncate().length()
}

#[test]
fn a_tube_has_its_radius_level_and_contrast_and_walls_all_around() {
    for radius in [2.0, 3.0] {
        let seen = look(|place| blurred(depth(place, radius)), MIDDLE, radius);
        assert!((seen.radius - radius).abs() < 0.1, "{seen:?}");
        assert!(seen.shift.length() < 0.1, "{seen:?}");
        assert!(
            (seen.level - LEVEL).abs() < 1.0 && (seen.contrast - (LEVEL - TISSUE)).abs() < 1.0,
            "{seen:?}"
        );
        assert_eq!((seen.closure, seen.contrast_share), (1.0, 1.0));
    }
}

#[test]
fn beside_the_middle_the_shift_leads_to_it_and_it_is_at_most_half_a_radius() {
    let tube = |place: DVec3| blurred(depth(place, 3.0));
    let near = DVec3::new(0.8, -0.5, 0.0);
    let seen = look(tube, MIDDLE + near, 3.0);
    assert!((seen.shift + near).length() < 0.2, "{seen:?}");
    let far = look(tube, MIDDLE + DVec3::X * 2.6, 3.0);
    assert!(far.shift.length() <= 1.5 && far.shift.x < -1.0, "{far:?}");
}

#[test]
fn struts_on_some_sides_move_no_wall_and_a_plate_is_open() {
    let stent = |place: DVec3| {
        let away = place - MIDDLE;
        let is_strut =
            away.truncate().length() > 2.7 && away.truncate().length() < 3.5 && away.x > away.y.abs();
        if is_strut { 1000.0 } else { blurred(depth(place, 3.0)) }
    };
    let seen = look(stent, MIDDLE, 3.0);
    assert!((seen.radius - 3.0).abs() < 0.2 && (seen.level - LEVEL).abs() < 1.0, "{seen:?}");
    let plate = look(|place| blurred(2.0 - (place.x - MIDDLE.x).abs()), MIDDLE, 2.0);
    assert!(plate.closure <= 0.75 && plate.contrast_share <= 0.75, "{plate:?}");
}

#[test]
fn where_bone_touches_a_tube_its_walls_are_seen_once_bone_ends_rays() {
    // Bone lies on one side, behind a wall too thin to lose half of the contrast.
    let beside = |place: DVec3| {
        let beyond = (place - MIDDLE).x - 3.0;
        if beyond > -0.8 { LEVEL - 40.0 + 140.0 * beyond.clamp(0.0, 1.0) } else { blurred(depth(place, 3.0)) }
    };
    let plain = look(beside, MIDDLE, 3.0);
    let seen = looked(Section::beside_bone, beside, MIDDLE, 3.0);
    assert!(plain.shift.x > 0.4 && plain.closure < 0.9, "{plain:?}");
    assert!(seen.shift.length() < 0.3 && (seen.radius - 3.0).abs() < 0.15, "{seen:?}");
    assert!(seen.closure > 0.95 && seen.contrast_share > plain.contrast_share, "{seen:?} {plain:?}");
    // Without bone, both methods give the same section.
    let tube = |place: DVec3| blurred(depth(place, 3.0));
    assert_eq!(looked(Section::beside_bone, tube, MIDDLE, 3.0), look(tube, MIDDLE, 3.0));
}
