//! Tests edge letters and reported points in volumes whose values are positions.

use glam::{DAffine3, DVec3};
use lumencut_core::vessel_tree::{Vessel, VesselTree};
use serde_json::{from_value, json};

use crate::letters::{EdgeLetters, sides};
use crate::study::held_volume::HeldVolume;
use crate::study::labels::{LaidPicture, PictureLabels};
use crate::study::open_study::{Picture, Study};
use crate::study::planes::Plane;
use crate::study::straightened::CprMessage;
use crate::study::voxels::Stored;

const SIDE: usize = 41;
/// A window from -40 to 40 mm.
const WINDOW: [f64; 2] = [0.0, 80.0];

fn grid() -> DAffine3 {
    let across = DVec3::new(1.0, 0.3, -0.2).normalize();
    let ahead = DVec3::new(-0.3, 1.0, 0.1).reject_from_normalized(across).normalize();
    let along = ahead.cross(across);
    let middle = (across + ahead + along) * ((SIDE - 1) as f64 / 2.0) * 1.5;
    let [across, ahead, along, middle] = [across * 1.5, ahead * 1.5, along * 1.5, -middle];
    DAffine3::from_cols(across, ahead, along, middle)
}

/// A volume whose values are positions along a patient axis (mm), and a vessel along a direction.
fn ramp(axis: usize, way: DVec3) -> Study {
    let places = (0..SIDE.pow(3)).map(|n| {
        let index = DVec3::new((n % SIDE) as f64, (n / SIDE % SIDE) as f64, (n / SIDE / SIDE) as f64);
        grid().transform_point3(index)[axis] as f32
    });
    let held = HeldVolume {
        stored: Stored::F32(places.collect()),
        size: [SIDE; 3],
        world_from_index: grid(),
        key: Default::default(),
        scan: Default::default(),
    };
    let points = (-15..=15).map(|n| way.normalize() * f64::from(n)).collect();
    let tree = VesselTree::new(vec![Vessel::new(points, None).expect("a vessel")]).expect("a tree");
    let mut study = Study::default();
    study.open(held, tree, vec![String::new()]).expect("a study");
    study
}

fn ways(way: DVec3, mut picture: impl FnMut(&mut Study) -> Picture) -> [DVec3; 2] {
    let made = [0, 1, 2].map(|axis| picture(&mut ramp(axis, way)));
    let [width, height] = made[0].size;
    let value = |axis: usize, column: usize, row: usize| {
        f64::from(made[axis].bytes[4 * (row * width + column)]) / 255.0 * WINDOW[1] - 40.0
    };
    let between = |from: [usize; 2], to: [usize; 2]| {
        DVec3::from_array([0, 1, 2].map(|axis| value(axis, to[0], to[1]) - value(axis, from[0], from[1])))
    };
    let [column, row] = [width / 2, height / 2];
    [between([width / 4, row], [3 * width / 4, row]), between([column, height / 4], [column, 3 * height / 4])]
}

fn letters(plane: &Plane) -> EdgeLetters {
    let laid = json!({"right": plane.right, "down": plane.down, "width": 64.0, "pixel_spacing": plane.pixel_spacing});
    PictureLabels::from(from_value::<LaidPicture>(laid).expect("a picture")).letters
}

/// Whether letters agree. Values are known only to a window step, so letters of components near a fifth may differ.
fn agree(letters: &str, way: DVec3) -> bool {
    let named = |least: f64| sides(way).chars().filter(|side| part(*side, way) > least).collect::<String>();
    named(0.25).chars().all(|side| letters.contains(side))
        && letters.chars().all(|side| part(side, way) > 0.15)
}

fn part(side: char, way: DVec3) -> f64 {
    let way = way.normalize();
    match side {
        'L' => way.x,
        'R' => -way.x,
        'P' => way.y,
        'A' => -way.y,
        'S' => way.z,
        _ => -way.z,
    }
}

#[test]
fn letters_of_sections_and_slices_are_the_true_sides() {
    let flat = |[center, right, down]: [[f64; 3]; 3]| Plane {
        center,
        right,
        down,
        size: [65, 65],
        pixel_spacing: 0.25,
        slab: None,
    };
    let slices = [
        [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]],
        [[0.0; 3], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]],
    ];
    for way in [DVec3::Z, DVec3::NEG_Z, DVec3::X, DVec3::NEG_Y, DVec3::new(0.5, -0.4, 0.7)] {
        let section = ramp(0, way).across(0, 15.0).expect("a section");
        for plane in slices.into_iter().chain([section]).map(flat) {
            let [right, down] = ways(way, |study| study.slice(&plane, WINDOW).expect("a slice"));
            let found = letters(&plane);
            let edges =
                [(&found.right, right), (&found.left, -right), (&found.bottom, down), (&found.top, -down)];
            for (edge, true_way) in edges {
                assert!(agree(edge, true_way), "{plane:?}: {edge} for {true_way}");
            }
        }
    }
}

#[test]
fn a_click_in_the_straightened_vessel_tells_the_true_place() {
    let cpr =
        CprMessage { vessel: 0, angle: 0.4, width: 16.0, pixel_spacing: 0.5, feature: None, roll: None };
    for way in [DVec3::Z, DVec3::NEG_Z, DVec3::new(0.5, -0.4, 0.7)] {
        for axis in 0..3 {
            let mut study = ramp(axis, way);
            study.straightened(cpr, (WINDOW, &|| false)).expect("a CPR");
            for pixel in [[3.0, 10.0], [20.0, 41.0], [30.0, 5.0]] {
                let pick = study.pick_straightened(pixel).expect("a place");
                let value = f64::from(pick.value.expect("a value"));
                assert!((value - pick.point[axis]).abs() < 1e-3, "{value} for {:?}", pick.point);
                let back = study.on_straightened(pick.point).expect("a pixel");
                assert!((back[0] - pixel[0]).abs() < 1e-6 && (back[1] - pixel[1]).abs() < 1e-6);
            }
        }
    }
}

/// Volumes are ramps, so the mean of a slab is the value of its middle, and its ends differ by half the thickness times
/// the normal's part along the ramp.
#[test]
fn a_slab_of_an_oblique_slice_shows_its_mean_and_its_ends() {
    let [right, down] = [DVec3::new(0.8, 0.6, 0.0), DVec3::new(-0.36, 0.48, -0.8)];
    let normal = right.cross(down);
    for axis in 0..3 {
        let study = ramp(axis, DVec3::Z);
        let shown = |slab: Option<(f64, &str)>| {
            let slab = slab.map(|(thickness, mode)| (thickness, mode.to_owned()));
            let [right, down] = [right, down].map(|vector| vector.to_array());
            let plane =
                Plane { center: [2.0, -1.0, 3.0], right, down, size: [33, 33], pixel_spacing: 0.5, slab };
            study.slice(&plane, WINDOW).expect("a slice").bytes
        };
        let (thin, half) = (shown(None), 5.0 * normal[axis].abs() / WINDOW[1] * 255.0);
        for (mode, away) in [("mean", 0.0), ("max", half), ("min", -half)] {
            for (thin, thick) in thin.chunks_exact(4).zip(shown(Some((10.0, mode))).chunks_exact(4)) {
                let error = f64::from(thick[0]) - f64::from(thin[0]) - away;
                assert!(error.abs() <= 1.5, "{mode} along axis {axis}: {error} steps of the window");
            }
        }
    }
}

#[test]
fn a_slab_that_cannot_be_is_rejected() {
    let study = ramp(0, DVec3::Z);
    let with = |thickness: f64, mode: &str| Plane {
        center: [0.0; 3],
        right: [1.0, 0.0, 0.0],
        down: [0.0, 1.0, 0.0],
        size: [3, 3],
        pixel_spacing: 1.0,
        slab: Some((thickness, mode.to_owned())),
    };
    for (thickness, mode) in [(-1.0, "max"), (f64::NAN, "mean"), (1e9, "min"), (5.0, "median")] {
        assert_eq!(study.slice(&with(thickness, mode), WINDOW).expect_err("no slab").kind, "settings");
    }
}
