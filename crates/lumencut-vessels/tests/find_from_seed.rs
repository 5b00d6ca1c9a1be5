//! Tests which vessels a seed selects, in synthetic trees.
#![allow(clippy::unwrap_used)]

use glam::{DAffine3, DVec3};
use lumencut_core::error::ErrorKind;
use lumencut_core::volume::{Volume, Voxels};
use lumencut_phantom::y_junction;
use lumencut_vessels::trace::find::FindRequest;
use lumencut_vessels::trace::find::found::{FoundVessel, Trees};
use lumencut_vessels::trace::find::from_seed::{find_from, part_at};
use lumencut_vessels::trace::find::track::TrackDoubt;
use lumencut_vessels::trace::lines::centerline::Centerline;

/// A straight vessel along z, from 0 to 20 mm.
fn straight(x: f64, radius: f64, part: usize, doubt: Option<TrackDoubt>) -> FoundVessel {
    let points: Vec<DVec3> = (0..=20).map(|z| DVec3::new(x, 0.0, f64::from(z))).collect();
    let line = Centerline { radius: vec![radius; points.len()], confidence: vec![1.0; points.len()], points };
    FoundVessel { line, part, confidence: 0.9, doubt }
}

fn trees(vessels: Vec<FoundVessel>) -> Trees {
    Trees { vessels, level: 300.0, contrast: 250.0, ..Trees::default() }
}

#[test]
fn the_nearest_part_in_units_of_radius_is_chosen() {
    let trees = trees(vec![
        straight(0.0, 10.0, 0, None),
        straight(14.0, 1.0, 1, None),
        straight(-40.0, 10.0, 0, Some(TrackDoubt::Short)),
    ]);
    // At 8 mm from the wide vessel (0.8 radii) the wide one is selected, though the narrow one is nearer in mm.
    for (x, part) in [(8.0, 0), (12.4, 0), (12.9, 1), (15.4, 1), (-40.0, 0), (-14.9, 0)] {
        assert_eq!(part_at(&trees, DVec3::new(x, 0.0, 7.5), 0.5), Ok(part), "{x}");
    }
}

#[test]
fn a_seed_beyond_its_reach_is_told_where_the_nearest_vessel_is() {
    let trees = trees(vec![straight(0.0, 2.0, 0, None), straight(50.0, 1.0, 1, None)]);
    assert_eq!(part_at(&trees, DVec3::new(2.99, 0.0, 10.0), 0.5), Ok(0));
    let (nearest, distance) = part_at(&trees, DVec3::new(3.01, 0.0, 10.0), 0.5).unwrap_err();
    assert_eq!((nearest, distance), (DVec3::new(0.0, 0.0, 10.0), 3.01));
    // A seed selects a narrow vessel from up to one voxel away.
    assert_eq!(part_at(&trees, DVec3::new(51.9, 0.0, 10.0), 2.0), Ok(1));
    assert!(part_at(&trees, DVec3::new(52.1, 0.0, 10.0), 2.0).is_err());
}

#[test]
fn a_part_with_a_sure_vessel_comes_before_one_without() {
    let doubtful = Some(TrackDoubt::Flat);
    let trees = trees(vec![
        straight(0.0, 10.0, 0, None),
        straight(4.0, 2.0, 1, doubtful),
        straight(60.0, 2.0, 2, doubtful),
    ]);
    assert_eq!(part_at(&trees, DVec3::new(4.0, 0.0, 10.0), 0.5), Ok(0));
    assert_eq!(part_at(&trees, DVec3::new(60.0, 0.0, 10.0), 0.5), Ok(2));
}

#[test]
fn a_seed_outside_the_volume_is_refused_before_anything_is_found() {
    let values = vec![0_i16; 8 * 8 * 8];
    let volume = Volume::new(Voxels::I16(&values), [8; 3], [1, 8, 64], DAffine3::IDENTITY).unwrap();
    for seed in [DVec3::new(-1.0, 0.0, 0.0), DVec3::new(f64::NAN, 0.0, 0.0)] {
        let request = FindRequest { smallest_radius: None, stop: &|| true, progress: None };
        let error = find_from(&volume, seed, &request).unwrap_err();
        assert_eq!((error.kind, error.subject.as_str()), (ErrorKind::Tracing, "seed"));
    }
}

#[test]
fn every_seed_in_one_tree_gives_the_same_vessels_to_the_bit() {
    let made = y_junction().unwrap();
    let strides = [1, made.size[0], made.size[0] * made.size[1]];
    let volume = Volume::new(Voxels::I16(&made.voxels), made.size, strides, made.world_from_index).unwrap();
    let request = FindRequest { smallest_radius: None, stop: &|| false, progress: None };
    let lines = |seed: DVec3| -> Vec<Centerline> {
        let trees = find_from(&volume, seed, &request).unwrap();
        trees.vessels.into_iter().map(|vessel| vessel.line).collect()
    };
    let first = lines(DVec3::new(0.0, 0.0, -20.0));
    assert!(first.len() >= 2);
    // Seeds in the trunk off its centre, in both branches, and at the ends of the branches.
    for seed in [[2.9, 0.0, -10.0], [-12.0, 1.5, 20.0], [13.0, -1.0, 20.0], [-20.0, 0.0, 30.0]] {
        assert_eq!(lines(DVec3::from_array(seed)), first);
    }
    let error = find_from(&volume, DVec3::new(0.0, 14.0, -20.0), &request).unwrap_err();
    assert!(error.found.starts_with("no vessel here; the nearest one is 14.0 mm away"), "{error}");
}
