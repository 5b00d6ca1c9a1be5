use super::*;
use crate::trace::find::grid::Grid;
use crate::trace::find::made::{TISSUE, away, blurred, with_scan};

const FLOORS: Floors = Floors { noise: 0.0, contrast: 250.0 };

/// Reproducible random numbers, uniform between -1 and 1.
fn even(place: DVec3, number: u64) -> f64 {
    let voxel = place.round().to_array().map(|c| c as u64);
    let mixed = (voxel[0] + 1009 * voxel[1] + 2_000_003 * voxel[2] + 1_000_000_007 * number + 1)
        .wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let mixed = (mixed ^ (mixed >> 29)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    (mixed >> 33) as f64 / f64::from(1_u32 << 30) - 1.0
}

fn with_levels<T>(value: impl Fn(DVec3) -> f64, work: impl FnOnce(&Pyramid) -> T) -> T {
    with_scan([60, 40, 40], 1.0, value, |scan| {
        let grid = Grid::over(scan.voxels, 0.5);
        work(&Pyramid::new(scan.voxels, grid, [0.0, 600.0], &|| false).expect("levels"))
    })
}

#[test]
fn the_noise_is_its_standard_deviation_with_and_without_an_edge() {
    // The sum of three uniform random numbers from -a to a has the standard deviation a.
    let noisy = |place: DVec3| 300.0 + 20.0 * (even(place, 0) + even(place, 1) + even(place, 2));
    let flat = with_levels(noisy, |pyramid| noise(&pyramid.levels[0]));
    assert!((flat - 20.0).abs() < 1.5, "{flat}");
    let step = |place: DVec3| noisy(place) - if place.x < 30.0 { 200.0 } else { 0.0 };
    let with_edge = with_levels(step, |pyramid| noise(&pyramid.levels[0]));
    assert!((with_edge - 20.0).abs() < 3.0, "{with_edge}");
    assert_eq!(with_levels(|_| 0.0, |pyramid| noise(&pyramid.levels[0])), 0.0);
}

#[test]
fn candidates_of_a_tube_lie_in_its_middle_and_along_it() {
    let line = [DVec3::new(0.0, 18.0, 20.0), DVec3::new(60.0, 22.0, 17.0)];
    for radius in [1.5, 4.0] {
        let tube = |place: DVec3| blurred(radius - away(place, &line));
        let found = with_levels(tube, |pyramid| {
            candidates(pyramid, &pyramid.all(), &FLOORS, &|| false, Stages::begin(None)).expect("candidates")
        });
        assert!(found.len() > 10, "{}", found.len());
        let along = (line[1] - line[0]).normalize();
        for candidate in found.iter().filter(|one| (8.0..52.0).contains(&one.place.x)) {
            assert!(away(candidate.place, &line) < 0.5, "{candidate:?}");
            assert!(candidate.direction.dot(along).abs() > 0.95, "{candidate:?}");
            assert!((candidate.radius / radius - 1.0).abs() < 0.25, "{candidate:?}");
        }
    }
}

#[test]
fn even_tissue_and_a_plate_have_no_candidates() {
    let plate = |place: DVec3| blurred(2.0 - (place.z - 20.0).abs());
    let count = |value: &dyn Fn(DVec3) -> f64| {
        with_levels(value, |pyramid| {
            candidates(pyramid, &pyramid.all(), &FLOORS, &|| false, Stages::begin(None)).expect("none").len()
        })
    };
    assert_eq!([count(&|_| TISSUE), count(&plate)], [0, 0]);
}
