use super::*;
use crate::trace::find::made::{LEVEL, TISSUE, away, blurred, with_scan};
use crate::trace::find::progress::Stages;
use glam::DVec3;

const SIZE: [usize; 3] = [70, 60, 50];

/// Level, contrast and tracks found in voxels of 1 mm.
fn found(value: impl Fn(DVec3) -> f64) -> Option<([f64; 2], Vec<Track>)> {
    with_scan(SIZE, 1.0, value, |scan| {
        let grid = Grid::over(scan.voxels, 1.0);
        let found = tubes(scan.voxels, grid, None, &|| false, Stages::begin(None)).expect("tubes");
        found.map(|found| ([found.scan.level, found.scan.contrast], found.tracks))
    })
}

#[test]
fn two_tubes_are_two_tracks_in_their_middles_with_their_radii() {
    let wide = [DVec3::new(4.0, 15.0, 20.0), DVec3::new(66.0, 22.0, 28.0)];
    let narrow = [DVec3::new(4.0, 45.0, 30.0), DVec3::new(66.0, 40.0, 20.0)];
    let value = |place: DVec3| blurred((4.0 - away(place, &wide)).max(2.0 - away(place, &narrow)));
    let ([level, contrast], tracks) = found(value).expect("tubes");
    assert!((level - LEVEL).abs() < 6.0 && (contrast - (LEVEL - TISSUE)).abs() < 6.0, "{level} {contrast}");
    assert_eq!(tracks.len(), 2);
    for (line, radius) in [(wide, 4.0), (narrow, 2.0)] {
        let track = tracks.iter().find(|track| (track.radius() - radius).abs() < 0.2).expect("a track");
        // The tubes have round ends, which are left out.
        let along = track.points.iter().filter(|point| (6.0..64.0).contains(&point.place.x));
        let worst = along.map(|point| away(point.place, &line)).fold(0.0, f64::max);
        assert!(worst < 0.5, "{worst}");
        assert!(track.length() > 56.0 && track.confidence > 0.9, "{} {}", track.length(), track.confidence);
    }
}

#[test]
fn a_constant_and_a_plate_have_no_tubes() {
    assert!(found(|_| TISSUE).is_none());
    let plate = found(|place: DVec3| blurred(2.0 - (place.z - 25.0).abs()));
    assert!(plate.is_none_or(|(_, tracks)| tracks.is_empty()));
}

/// Level and other level of a scan with a large oval vessel, and with this many pale round organs beside it.
fn levels(organs: usize) -> (f64, Option<[f64; 2]>) {
    let value = |place: DVec3| {
        let oval = ((place.y - 16.0) / 13.0).hypot((place.z - 25.0) / 7.5);
        let organ = |n: usize| {
            let [y, z] = [[50.0, 10.0], [50.0, 25.0], [50.0, 40.0]][n];
            5.0 - (place.y - y).hypot(place.z - z)
        };
        let pale = (0..organs).map(|n| blurred(organ(n))).fold(TISSUE, f64::max);
        let grain = (place.dot(DVec3::new(79.0, 113.0, 187.0)).sin() * 1e4).rem_euclid(8.0);
        blurred(9.0 * (1.0 - oval)).max(TISSUE + 0.33 * (pale - TISSUE)) + grain
    };
    with_scan(SIZE, 1.0, value, |scan| {
        let grid = Grid::over(scan.voxels, 1.0);
        let found = tubes(scan.voxels, grid, None, &|| false, Stages::begin(None)).expect("tubes");
        let found = found.expect("a level");
        (found.scan.level, found.other)
    })
}

#[test]
fn few_pale_organs_do_not_set_the_level_and_many_do_but_both_are_told() {
    let organ = TISSUE + 0.33 * (LEVEL - TISSUE);
    let (level, other) = levels(1);
    assert!(
        (level - LEVEL).abs() < 6.0 && (other.expect("organs")[0] - organ).abs() < 6.0,
        "{level} {other:?}"
    );
    let (level, other) = levels(3);
    assert!(
        (level - organ).abs() < 6.0 && (other.expect("vessels")[0] - LEVEL).abs() < 6.0,
        "{level} {other:?}"
    );
    assert_eq!(levels(0).1, None);
}
