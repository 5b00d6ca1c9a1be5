use super::*;
use crate::trace::find::made::{LEVEL, TISSUE, blurred, straight_track, with_scan};

const SIZE: [usize; 3] = [60, 60, 40];
const SIDE: f64 = 0.5;
const MIDDLE: DVec3 = DVec3::new(15.0, 15.0, 10.0);

fn section(radius: f64, value: impl Fn(DVec3) -> f64) -> Option<RawSection> {
    let track = straight_track(MIDDLE - DVec3::Z, MIDDLE + DVec3::Z, radius);
    with_scan(SIZE, SIDE, |place| value(place - MIDDLE), |scan| RawSection::at(scan, &track.points[2]))
}

fn depth(place: DVec3, half: [f64; 2]) -> f64 {
    (half[0] - place.x.abs()).min(half[1] - place.y.abs())
}

fn from_axis(place: DVec3) -> f64 {
    place.x.hypot(place.y)
}

#[test]
fn a_tube_is_round_and_even_whatever_its_width() {
    for radius in [1.5, 3.0, 6.0] {
        let found = section(radius, |place| blurred(radius - from_axis(place))).expect("a tube");
        assert!((1.0..1.06).contains(&found.elongation), "{radius} mm: {found:?}");
        assert!(found.spread < 0.01 && !found.is_marrow, "{radius} mm: {found:?}");
        assert!((found.level - LEVEL).abs() < 1.0, "{radius} mm: {found:?}");
    }
}

#[test]
fn a_plate_is_as_long_as_it_is_wide_and_no_longer_than_is_looked() {
    // Diameters are measured every 15°, and the longest one is the length of the plate.
    let found = section(1.0, |place| blurred(depth(place, [1.0, 5.0]))).expect("a plate");
    assert!((found.elongation - 5.0).abs() < 0.2, "{found:?}");
    // The length of a ray is the smaller of 3 r + 4 mm and 6 r + 1.5 mm.
    let found = section(1.0, |place| blurred(depth(place, [1.0, 50.0]))).expect("a plate");
    assert!((found.elongation - 7.0).abs() < 0.2, "{found:?}");
    let found = section(0.6, |place| blurred(depth(place, [1.0, 50.0]))).expect("a plate");
    assert!((found.elongation - 5.1).abs() < 0.2, "{found:?}");
}

#[test]
fn marrow_is_uneven_and_has_a_cortex() {
    let bone = |place: DVec3| {
        let away = from_axis(place);
        let stripes = if (place.x / 1.5).floor().rem_euclid(2.0) < 1.0 { 120.0 } else { -120.0 };
        match away {
            away if away > 5.0 => TISSUE,
            away if away > 4.0 => 900.0,
            _ => 220.0 + stripes,
        }
    };
    let found = section(4.0, bone).expect("bone");
    assert!(found.is_marrow && found.spread > 0.24, "{found:?}");
    let open = section(4.0, |place| if from_axis(place) > 4.0 { TISSUE } else { bone(place) }).expect("bone");
    assert!(!open.is_marrow && open.spread > 0.24, "{open:?}");
    let bright = section(4.0, |place| bone(place) + 100.0).expect("bone");
    assert!(!bright.is_marrow, "{bright:?}");
}

#[test]
fn what_is_no_brighter_than_its_surroundings_has_no_section() {
    assert_eq!(section(3.0, |_| LEVEL), None);
    assert_eq!(section(3.0, |place| if from_axis(place) < 3.0 { TISSUE } else { LEVEL }), None);
    let nowhere = straight_track(DVec3::splat(1e6), DVec3::splat(1e6 + 2.0), 1.0);
    assert_eq!(with_scan(SIZE, SIDE, |_| LEVEL, |scan| RawSection::at(scan, &nowhere.points[0])), None);
}

#[test]
fn a_lumen_as_bright_as_vessels_ends_where_bone_touches_it() {
    // Bone lies on one side of the tube, beyond a wall of 0.5 mm.
    let beside = |lumen: f64| {
        move |place: DVec3| {
            let tube =
                TISSUE + (blurred(1.5 - from_axis(place)) - TISSUE) * (lumen - TISSUE) / (LEVEL - TISSUE);
            if place.x > 2.0 { 900.0 } else { tube }
        }
    };
    let found = section(1.5, beside(LEVEL)).expect("a tube");
    assert!(found.elongation < 1.15, "{found:?}");
    // A much paler inside may be marrow, so bone does not end its rays.
    let touching = |lumen: f64| move |place: DVec3| if place.x > 1.0 { 900.0 } else { beside(lumen)(place) };
    let found = section(1.5, touching(LEVEL)).expect("a tube");
    let pale = section(1.5, touching(LEVEL - 60.0)).expect("a tube");
    assert!(found.elongation < 1.3 && pale.elongation > 2.0, "{found:?} {pale:?}");
}
