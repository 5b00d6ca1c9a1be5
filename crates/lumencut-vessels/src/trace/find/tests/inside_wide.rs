use super::*;
use crate::trace::find::candidates::{Floors, noise};
use crate::trace::find::grid::Grid;
use crate::trace::find::made::{LEVEL, TISSUE, away, blurred, straight_track, with_scan};
use crate::trace::find::pyramid::Pyramid;

/// The axis of a tube with a radius of 2 mm.
const TUBE: [DVec3; 2] = [DVec3::new(4.0, 20.0, 20.0), DVec3::new(56.0, 20.0, 20.0)];

fn behind(radius: f64, confidence: f64) -> Vec<Track> {
    let value = |place: DVec3| blurred(2.0 - away(place, &TUBE));
    with_scan([60, 40, 40], 1.0, value, |scan| {
        let grid = Grid::over(scan.voxels, 1.0);
        let pyramid = Pyramid::new(scan.voxels, grid, [0.0, 400.0], &|| false).expect("levels");
        let judge = |points: Vec<TrackPoint>| Track { points, confidence: 1.0, doubt: None };
        let floors = Floors { noise: noise(&pyramid.levels[0]), contrast: LEVEL - TISSUE };
        let pass = Tracking {
            pyramid: &pyramid,
            levels_examined: pyramid.all(),
            floors,
            stop: &|| false,
            judge: &judge,
            stages: Stages::default(),
        };
        let aside = DVec3::Y * 2.5;
        let wide = straight_track(TUBE[0] + aside, TUBE[1] + aside, radius);
        let judged = Track { confidence, ..wide.clone() };
        hidden(&pass, &pass.candidates().expect("candidates"), &[wide], &[judged]).expect("tracks")
    })
}

#[test]
fn a_tube_within_a_wide_track_is_found_once_that_is_no_vessel() {
    let found = behind(6.0, 0.1);
    assert_eq!(found.len(), 1);
    assert!((found[0].radius() - 2.0).abs() < 0.2 && found[0].length() > 45.0, "{}", found[0].length());
    let along = found[0].points.iter().filter(|point| (8.0..52.0).contains(&point.place.x));
    assert!(along.map(|point| away(point.place, &TUBE)).fold(0.0, f64::max) < 0.3);
    // A vessel, or a track that is hardly wider than the tube, still hides the tube.
    assert!(behind(6.0, 0.3).is_empty());
    assert!(behind(3.2, 0.1).is_empty());
}
