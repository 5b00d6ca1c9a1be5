//! Bad input is rejected with the reason, and every error kind of this crate occurs.
#![allow(clippy::unwrap_used)]

use std::collections::HashSet;

use glam::{DAffine3, DMat3, DVec3};
use lumencut_core::camera::Camera;
use lumencut_core::error::{Error, ErrorKind};
use lumencut_core::scene::Scene;
use lumencut_core::settings::{Context, ContextMode, Settings, Slab, SlabMode, Window};
use lumencut_core::vessel_tree::{Vessel, VesselTree};
use lumencut_core::volume::{Volume, Voxels};
use lumencut_scenes::pictures::render;
use lumencut_scenes::trees::trefoil;
use lumencut_scenes::views::front;

fn vessel_errors() -> Vec<Error> {
    let two = vec![DVec3::ZERO, DVec3::X];
    vec![
        Vessel::new(vec![], None).unwrap_err(),
        Vessel::new(vec![DVec3::ZERO], None).unwrap_err(),
        Vessel::new(vec![DVec3::ZERO, DVec3::NAN], None).unwrap_err(),
        Vessel::new(vec![DVec3::ZERO, DVec3::INFINITY], None).unwrap_err(),
        Vessel::new(vec![DVec3::ZERO, DVec3::splat(1e7)], None).unwrap_err(),
        Vessel::new(two.clone(), Some(vec![1.0])).unwrap_err(),
        Vessel::new(two.clone(), Some(vec![1.0, -1.0])).unwrap_err(),
        Vessel::new(two, Some(vec![1.0, f64::NAN])).unwrap_err(),
        VesselTree::new(vec![]).unwrap_err(),
    ]
}

fn camera_errors() -> Vec<Error> {
    let make = |center, direction, up, size, spacing| Camera::new(center, direction, up, size, spacing);
    let (o, y, z) = (DVec3::ZERO, DVec3::Y, DVec3::Z);
    vec![
        make(DVec3::NAN, y, z, [9, 9], 1.0).unwrap_err(),
        make(o, o, z, [9, 9], 1.0).unwrap_err(),
        make(o, y, DVec3::INFINITY, [9, 9], 1.0).unwrap_err(),
        make(o, y, -y, [9, 9], 1.0).unwrap_err(),
        make(o, y, z, [0, 9], 1.0).unwrap_err(),
        make(o, y, z, [9, 40_000], 1.0).unwrap_err(),
        make(o, y, z, [32_768, 32_768], 1.0).unwrap_err(),
        make(o, y, z, [9, 9], 0.0).unwrap_err(),
        make(o, y, z, [9, 9], 1.1e4).unwrap_err(),
        make(o, y, z, [9, 9], f64::NAN).unwrap_err(),
        make(o, y, z, [9, 9], 1.0).and_then(|camera| camera.with_axes(y, -DVec3::X, z)).unwrap_err(),
    ]
}

fn volume_errors() -> Vec<Error> {
    let voxels = [0i16; 24];
    let make = |size, strides, affine| Volume::new(Voxels::I16(&voxels), size, strides, affine).unwrap_err();
    let flat = DAffine3::from_mat3(DMat3::from_cols(DVec3::X, DVec3::Y, DVec3::X + DVec3::Y));
    vec![
        make([2, 3, 0], [1, 2, 6], DAffine3::IDENTITY),
        make([2, 3, 5], [1, 2, 6], DAffine3::IDENTITY),
        make([2, 3, 4], [1, 0, 6], DAffine3::IDENTITY),
        make([2, 3, usize::MAX], [1, 2, 6], DAffine3::IDENTITY),
        make([2, 3, 4], [1, 2, 6], flat),
        make([2, 3, 4], [1, 2, 6], DAffine3::ZERO),
        make([2, 3, 4], [1, 2, 6], DAffine3::from_translation(DVec3::NAN)),
    ]
}

fn settings_errors() -> Vec<Error> {
    let wrong = |change: fn(&mut Settings)| {
        let mut settings = Settings::default();
        change(&mut settings);
        settings.check().unwrap_err()
    };
    let with = |change: fn(&mut Context)| {
        let mut context = Context::default();
        change(&mut context);
        Settings { context: Some(context), ..Settings::default() }.check().unwrap_err()
    };
    vec![
        wrong(|s| s.cost_weight = -1.0),
        wrong(|s| s.cost_weight = f64::NAN),
        wrong(|s| s.lumen_margin = f64::INFINITY),
        wrong(|s| s.levels = 16),
        wrong(|s| s.level_distance = 0.0),
        wrong(|s| s.silhouette_slope = 0.0),
        wrong(|s| s.window = Window { level: 0.0, width: 0.0 }),
        wrong(|s| s.slab = Some(Slab { thickness: -1.0, mode: SlabMode::Max })),
        with(|c| c.mode = ContextMode::Blend { gamma: 1.5 }),
        with(|c| c.mode = ContextMode::Blend { gamma: f64::NAN }),
        with(|c| c.window = Window { level: 0.0, width: 0.0 }),
        with(|c| c.step = Some(0.0)),
        with(|c| c.transfer.points.clear()),
        with(|c| c.transfer.points.swap(0, 1)),
        with(|c| c.transfer.points[0].opacity = 1.5),
        with(|c| c.transfer.points[0].intensity = f64::NAN),
        with(|c| c.transfer.points = vec![c.transfer.points[0]; 65]),
    ]
}

fn input_errors() -> Vec<Error> {
    [vessel_errors(), camera_errors(), volume_errors(), settings_errors()].concat()
}

#[test]
fn errors_name_what_was_found_and_what_was_expected() {
    for error in &input_errors() {
        let line = error.to_string();
        assert!(line.contains("found ") && line.contains("expected ") && !line.contains('\n'), "{line}");
        assert!(!error.subject.is_empty() && !error.found.is_empty() && !error.expected.is_empty(), "{line}");
    }
}

/// The error kinds of `lumencut-gpu` and `lumencut-vessels`, which those crates' tests cover.
const OF_OTHER_CRATES: [ErrorKind; 3] = [ErrorKind::Device, ErrorKind::Tracing, ErrorKind::Measuring];

#[test]
fn every_kind_of_error_can_be_met() {
    let scene = trefoil(30);
    let camera = front([9, 9], 1.0);
    let stopped =
        render(&Scene::default().with_tree(scene), &camera, &Settings::default(), &|| true).unwrap_err();
    let all = [input_errors(), vec![stopped]].concat();
    let met: HashSet<_> = all.iter().map(|e| e.kind).collect();
    assert_eq!(met, ErrorKind::ALL.into_iter().filter(|kind| !OF_OTHER_CRATES.contains(kind)).collect());
}
