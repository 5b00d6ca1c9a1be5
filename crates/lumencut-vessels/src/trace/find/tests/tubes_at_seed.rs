use super::*;
use crate::trace::find::made::{TISSUE, away, blurred, with_scan};
use crate::trace::find::progress::Stages;
use crate::trace::find::tubes::tubes;

const SIZE: [usize; 3] = [70, 60, 50];
const WIDE_TUBE: [DVec3; 2] = [DVec3::new(4.0, 15.0, 20.0), DVec3::new(66.0, 22.0, 28.0)];
const FAINT: [DVec3; 2] = [DVec3::new(4.0, 45.0, 30.0), DVec3::new(66.0, 40.0, 20.0)];

/// A tube of normal contrast, and one with only 0.17 of that contrast.
fn value(place: DVec3) -> f64 {
    let faint = blurred(2.0 - away(place, &FAINT)) - TISSUE;
    blurred(4.0 - away(place, &WIDE_TUBE)) + 0.17 * faint
}

fn found(seed: Option<DVec3>) -> Vec<Track> {
    with_scan(SIZE, 1.0, value, |scan| {
        let grid = Grid::over(scan.voxels, 1.0);
        tubes(scan.voxels, grid, seed, &|| false, Stages::begin(None)).expect("tubes").expect("tracks").tracks
    })
}

#[test]
fn a_seed_off_all_tracks_finds_a_fainter_tube_and_one_in_a_track_changes_nothing() {
    let without = found(None);
    assert_eq!(without.len(), 1);
    let within = found(Some(WIDE_TUBE[0].lerp(WIDE_TUBE[1], 0.5) + DVec3::Y * 3.0));
    assert_eq!(within.len(), 1);
    assert_eq!(within[0].points, without[0].points);
    let beside = found(Some(FAINT[0].lerp(FAINT[1], 0.5)));
    assert_eq!(beside.len(), 2);
    assert_eq!(beside[0].points, without[0].points);
    assert!(beside[1].length() > 50.0, "{}", beside[1].length());
    let middle = beside[1].points.iter().filter(|point| (8.0..62.0).contains(&point.place.x));
    assert!(middle.map(|point| away(point.place, &FAINT)).fold(0.0, f64::max) < 0.7);
    assert_eq!(found(Some(DVec3::new(35.0, 30.0, 45.0))).len(), 1);
}
