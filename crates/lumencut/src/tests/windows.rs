use glam::DAffine3;
use lumencut_core::vessel_tree::Vessel;
use lumencut_core::volume::Voxels;

use super::*;

/// Voxels of 1 mm whose values `value` gives for each index.
fn grid(size: [usize; 3], value: impl Fn([usize; 3]) -> f32) -> Vec<f32> {
    let [ni, nj, nk] = size;
    (0..ni * nj * nk).map(|n| value([n % ni, n / ni % nj, n / (ni * nj)])).collect()
}

fn volume(voxels: &[f32], size: [usize; 3]) -> Volume<'_> {
    Volume::new(Voxels::F32(voxels), size, [1, size[0], size[0] * size[1]], DAffine3::IDENTITY).unwrap()
}

fn tree(radius: Option<f64>) -> VesselTree {
    let points = vec![DVec3::new(2.0, 20.0, 20.0), DVec3::new(37.0, 20.0, 20.0)];
    VesselTree::new(vec![Vessel::new(points, radius.map(|r| vec![r; 2])).unwrap()]).unwrap()
}

/// A bright rod along i in dark tissue.
fn rod() -> Vec<f32> {
    grid([40, 40, 40], |[_, j, k]| if j.abs_diff(20) < 5 && k.abs_diff(20) < 5 { 400.0 } else { 100.0 })
}

#[test]
fn a_window_along_centerlines_is_three_times_as_wide_as_lumen_over_tissue() {
    let voxels = rod();
    for radius in [None, Some(4.0), Some(0.0)] {
        let found = along(&volume(&voxels, [40; 3]), &tree(radius)).unwrap();
        assert_eq!(found, Window { level: 400.0, width: 900.0 });
    }
}

#[test]
fn a_noisy_lumen_widens_the_window() {
    let voxels = grid([40; 3], |[i, ..]| if i < 20 { 0.0 } else { 10.0 });
    let found = along(&volume(&voxels, [40; 3]), &tree(Some(1.0))).unwrap();
    assert_eq!(found, Window { level: 5.0, width: 20.0 });
}

#[test]
fn beside_a_point_are_six_places_beyond_its_wall() {
    let places = beside(&tree(Some(3.0)));
    assert_eq!(places.len(), 12);
    assert!(places[..6].iter().all(|place| place.distance(DVec3::new(2.0, 20.0, 20.0)) == 13.0));
    assert_eq!(places[0], DVec3::new(15.0, 20.0, 20.0));
    assert_eq!(places[11], DVec3::new(37.0, 20.0, 7.0));
}

#[test]
fn without_a_tree_percentiles_stand_for_air_lumen_and_tissue() {
    // Half air, then tissue, and 2 % of lumen.
    let voxels = grid([100, 1, 1], |[i, ..]| {
        if i < 50 {
            -1000.0
        } else if i < 98 {
            50.0
        } else {
            450.0
        }
    });
    let volume = volume(&voxels, [100, 1, 1]);
    assert_eq!(of_volume(&volume).unwrap(), Window { level: 450.0, width: 1200.0 });
    assert_eq!(whole(&volume).unwrap(), Window { level: -275.0, width: 1450.0 });
}

#[test]
fn one_value_has_a_window_of_some_width() {
    let voxels = vec![2000.0; 8];
    assert_eq!(of_volume(&volume(&voxels, [2; 3])).unwrap(), Window { level: 2000.0, width: 2.0 });
    let voxels = vec![0.0; 8];
    assert_eq!(whole(&volume(&voxels, [2; 3])).unwrap(), Window { level: 0.0, width: 1e-6 });
}

#[test]
fn what_is_no_number_is_left_out() {
    let voxels = vec![f32::NAN, f32::INFINITY, 7.0, f32::NEG_INFINITY];
    assert_eq!(whole(&volume(&voxels, [4, 1, 1])).unwrap(), Window { level: 7.0, width: 7e-3 });
    let voxels = vec![f32::NAN; 4];
    for found in [whole(&volume(&voxels, [4, 1, 1])), of_volume(&volume(&voxels, [4, 1, 1]))] {
        assert_eq!(found.unwrap(), OF_NOTHING);
    }
    assert_eq!(along(&volume(&voxels, [4, 1, 1]), &tree(None)).unwrap(), OF_NOTHING);
}

#[test]
fn values_beyond_all_windows_are_refused_with_what_was_found() {
    let voxels = vec![3e20; 8];
    let error = whole(&volume(&voxels, [2; 3])).unwrap_err();
    assert_eq!((error.kind, error.found.as_str()), (ErrorKind::Volume, "values from 3e+20 to 3e+20"));
}

#[test]
fn of_many_voxels_every_nth_along_each_axis_is_looked_at() {
    let voxels = grid([200; 3], |[i, j, k]| if i % 2 + j % 2 + k % 2 == 0 { 5.0 } else { 9.0 });
    let values = spread_voxels(&volume(&voxels, [200; 3]));
    assert_eq!((values.len(), values.iter().all(|value| *value == 5.0)), (1_000_000, true));
}
