use glam::DVec3;

use super::*;
use crate::trace::find::made::{LEVEL, TISSUE, away, with_scan};

const SIZE: [usize; 3] = [48, 40, 40];
const RADIUS: f64 = 4.0;
const HARD: f64 = 800.0;

/// A vessel along z that touches a bone: a shell of 3 mm with marrow inside.
fn line() -> [DVec3; 2] {
    [DVec3::new(12.0, 20.0, 0.0), DVec3::new(12.0, 20.0, 39.0)]
}

fn depth_in_bone(place: DVec3) -> f64 {
    let low = DVec3::new(16.5, 6.0, 4.0);
    let high = DVec3::new(28.0, 34.0, 35.0);
    (place - low).min(high - place).min_element()
}

/// A vessel that nobody traced, far from bone; and a plaque in the wall of the vessel.
const UNTRACED: DVec3 = DVec3::new(40.0, 8.0, 0.0);
const PLAQUE: DVec3 = DVec3::new(7.5, 20.0, 20.0);

fn value(place: DVec3) -> f64 {
    let depth = depth_in_bone(place);
    if place.distance(PLAQUE) < 1.2 {
        1200.0
    } else if away(place, &line()) < RADIUS || (place - UNTRACED).truncate().length() < 2.0 {
        LEVEL
    } else if depth >= 0.0 {
        if depth < 3.0 { HARD } else { 130.0 }
    } else {
        TISSUE
    }
}

fn vessel() -> Centerline {
    Centerline { points: line().to_vec(), radius: vec![RADIUS; 2], confidence: Vec::new() }
}

fn found(vessels: &[Centerline]) -> Vec<(DVec3, bool)> {
    with_scan(SIZE, 1.0, value, |scan| {
        let request = BoneRequest { level: scan.level, contrast: scan.contrast, vessels, stop: &|| false };
        let bone = bone(scan.voxels, &request).expect("memory");
        let place = |n: usize| [n % SIZE[0], n / SIZE[0] % SIZE[1], n / SIZE[0] / SIZE[1]];
        let center = |n| scan.voxels.center(place(n).map(|c| c as i32));
        bone.into_iter().enumerate().map(|(n, is)| (center(n), is)).collect()
    })
}

#[test]
fn no_voxel_of_a_vessel_or_its_wall_is_bone_although_they_touch() {
    for (place, is_bone) in found(&[vessel()]) {
        assert!(!is_bone || away(place, &line()) > RADIUS + WALL_MM, "{place}");
        assert!(!is_bone || (place - UNTRACED).truncate().length() >= 2.0, "{place}");
        assert!(!is_bone || place.distance(PLAQUE) >= 1.2, "{place}");
    }
}

#[test]
fn a_bone_goes_with_its_marrow_except_next_to_the_vessel() {
    for (place, is_bone) in found(&[vessel()]) {
        let is_free = away(place, &line()) > RADIUS + WALL_MM;
        assert!(is_bone || depth_in_bone(place) < 0.0 || !is_free, "{place}");
        // The surface that is hidden too is at most a voxel thick. At the border of the scan, bone may continue outside.
        let is_at_border = place.z <= MARROW_MM || place.z >= 39.0 - MARROW_MM;
        assert!(!is_bone || is_at_border || depth_in_bone(place) > -2.0, "{place}");
    }
}

#[test]
fn a_lumen_wider_than_its_circle_is_kept() {
    let narrow = Centerline { radius: vec![1.0; 2], ..vessel() };
    for (place, is_bone) in found(&[narrow]) {
        assert!(!is_bone || away(place, &line()) >= RADIUS, "{place}");
    }
}

#[test]
fn the_work_stops_when_asked() {
    let stopped = with_scan(SIZE, 1.0, value, |scan| {
        let request = BoneRequest { level: LEVEL, contrast: 250.0, vessels: &[], stop: &|| true };
        bone(scan.voxels, &request).expect_err("a stop").kind
    });
    assert_eq!(stopped, lumencut_core::error::ErrorKind::Interrupted);
}
