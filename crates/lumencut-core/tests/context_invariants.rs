//! The context does not change if the whole scene moves, or if invisible values change.
#![allow(clippy::unwrap_used)]

use glam::{DAffine3, DMat3, DQuat, DVec3};
use lumencut_core::camera::Camera;
use lumencut_core::settings::{Context, ContextMode, Window};
use lumencut_core::volume::{Volume, Voxels};
use lumencut_scenes::contexts::{COLOURS, DVR, MIDA, MIP, Points, apart, coloured, drawn};
use lumencut_scenes::random::Random;
use lumencut_scenes::views::view;
use lumencut_scenes::volumes::{sheared, volume};

const SIZE: [usize; 3] = [13, 11, 9];
const BLOBS: [usize; 3] = [48, 44, 40];

fn oblique(size: [usize; 2]) -> Camera {
    view([0.4, 1.0, -0.7], size, 0.8)
}

/// The whole scene moved: volume and camera together.
fn moved<'a>(scene: Volume<'a>, camera: &Camera, turn: DMat3, shift: DVec3) -> (Volume<'a>, Camera) {
    let place = DAffine3::from_mat3_translation(turn, shift) * scene.world_from_index();
    let [center, direction, up] = [camera.center(), camera.direction(), camera.up()].map(|v| turn * v);
    let size = camera.size();
    let view = Camera::new(center + shift, direction, up, size, camera.pixel_spacing()).unwrap();
    (Volume::new(scene.voxels(), scene.size(), scene.strides(), place).unwrap(), view)
}

#[test]
fn turning_scene_and_camera_together_changes_nothing() {
    let voxels = Random::new(10).image(SIZE.iter().product(), 0.0, 250.0);
    let scene = volume(Voxels::F32(&voxels), SIZE, sheared(SIZE));
    let camera = oblique([37, 23]);
    let turn = DMat3::from_quat(DQuat::from_axis_angle(DVec3::new(0.3, -0.5, 0.8).normalize(), 2.1));
    let (other, view) = moved(scene, &camera, turn, DVec3::new(500.0, -800.0, 300.0));
    for mode in [DVR, MIDA, MIP, ContextMode::Minimum, ContextMode::Average] {
        for shading in [false, true] {
            let context = Context { shading, ..coloured(mode, COLOURS) };
            let one = drawn(scene, &camera, context.clone());
            let two = drawn(other, &view, context);
            assert!(one.iter().zip(&two).all(|(a, b)| (a[3] > 0) == (b[3] > 0)), "{mode:?}");
            assert!(apart(&one, &two, 2) <= 1, "{mode:?}");
        }
    }
}

#[test]
fn a_mirrored_scene_gives_the_mirrored_picture() {
    let voxels = Random::new(11).image(SIZE.iter().product(), 0.0, 250.0);
    let scene = volume(Voxels::F32(&voxels), SIZE, sheared(SIZE));
    let camera = oblique([37, 23]);
    let mirror = DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0));
    // A camera is always right-handed, so the columns of the mirrored view run in the other direction.
    let (other, view) = moved(scene, &camera, mirror, DVec3::ZERO);
    for mode in [DVR, MIDA] {
        let one = drawn(scene, &camera, coloured(mode, COLOURS));
        let two = drawn(other, &view, coloured(mode, COLOURS));
        let back: Vec<[u8; 4]> = two.chunks(37).flat_map(|row| row.iter().rev().copied()).collect();
        assert!(apart(&one, &back, 2) <= 1, "{mode:?}");
    }
}

/// Bright blobs in values below 55, which are transparent.
fn blobs() -> Vec<f32> {
    let mut random = Random::new(12);
    let mut voxels = random.image(BLOBS.iter().product(), 0.0, 55.0);
    for _ in 0..5 {
        let center = random.next_point() * 12.0 + 20.0;
        for (n, voxel) in voxels.iter_mut().enumerate() {
            if index(n).distance_squared(center) < 16.0 {
                *voxel = random.between(90.0, 240.0);
            }
        }
    }
    voxels
}

fn index(n: usize) -> DVec3 {
    let [ni, nj, _] = BLOBS;
    DVec3::new((n % ni) as f64, (n / ni % nj) as f64, (n / (ni * nj)) as f64)
}

/// Voxels of which all voxels at most `reach` steps away fulfil a condition; none beyond the border does.
fn deep(voxels: &[f32], reach: i64, fulfils: impl Fn(f32) -> bool) -> Vec<bool> {
    let [ni, nj, nk] = BLOBS.map(|n| n as i64);
    let near = |n: usize| {
        let at = index(n).as_i64vec3();
        let steps = || -reach..=reach;
        steps().all(|dk| {
            steps().all(|dj| {
                steps().all(|di| {
                    let [i, j, k] = [at.x + di, at.y + dj, at.z + dk];
                    let is_inside = (0..ni).contains(&i) && (0..nj).contains(&j) && (0..nk).contains(&k);
                    is_inside && fulfils(voxels[((k * nj + j) * ni + i) as usize])
                })
            })
        })
    };
    (0..voxels.len()).map(near).collect()
}

fn painted(voxels: &[f32], places: &[bool], value: f32) -> Vec<f32> {
    voxels.iter().zip(places).map(|(voxel, place)| if *place { value } else { *voxel }).collect()
}

#[test]
fn painting_what_is_clear_changes_nothing_to_the_bit() {
    // Changes voxels whose neighbours, and theirs, are hidden too: no visible sample uses them.
    let array = blobs();
    let hidden = deep(&array, 2, |value| value <= 60.0);
    assert!(hidden.iter().filter(|place| **place).count() > array.len() / 3);
    let blend = |gamma| ContextMode::Blend { gamma };
    for (gamma, shading) in [(-1.0, false), (-1.0, true), (0.0, false), (-0.5, false)] {
        let context = Context { shading, ..coloured(blend(gamma), COLOURS) };
        for camera in [view([0.0, 1.0, 0.0], [61, 47], 0.8), oblique([61, 47])] {
            let draw = |voxels: &[f32]| {
                drawn(volume(Voxels::F32(voxels), BLOBS, sheared(BLOBS)), &camera, context.clone())
            };
            let expected = draw(&array);
            assert!(expected.iter().any(|pixel| pixel[3] > 100));
            for value in [-1000.0, 0.0, 59.0] {
                assert!(draw(&painted(&array, &hidden, value)) == expected, "γ of {gamma}, {value}");
            }
        }
    }
}

#[test]
fn painting_what_is_too_bright_to_be_seen_changes_nothing_for_dvr() {
    // Transparent above 300 as well: DVR ignores this, MIDA dims what lies in front.
    let points = [COLOURS, &[(300.0, [0; 3], 0.0)]].concat();
    let mut array = blobs();
    let clear = deep(&array, 1, |value| value <= 60.0);
    for (n, voxel) in array.iter_mut().enumerate() {
        if clear[n] && index(n).y >= 34.0 {
            *voxel = 300.0;
        }
    }
    let bright = painted(&array, &deep(&array, 1, |value| value >= 300.0), 5000.0);
    let camera = view([0.0, 1.0, 0.0], [61, 47], 0.8);
    let draw = |voxels: &[f32], mode| {
        let window = Window { level: 2500.0, width: 5000.0 };
        let context = Context { window, ..coloured(mode, &points) };
        drawn(volume(Voxels::F32(voxels), BLOBS, sheared(BLOBS)), &camera, context)
    };
    assert!(draw(&array, DVR) == draw(&bright, DVR));
    let (one, two) = (draw(&array, MIDA), draw(&bright, MIDA));
    assert!(one.iter().zip(&two).filter(|(a, b)| a != b).count() > one.len() / 100);
}

#[test]
fn nothing_dimmer_shows_behind_what_is_opaque() {
    let size = [25, 30, 20];
    let mut one = Random::new(13).image(size.iter().product(), 0.0, 190.0);
    let row = |n: usize| n / 25 % 30;
    (0..one.len()).filter(|n| (10..13).contains(&row(*n))).for_each(|n| one[n] = 200.0);
    let other = Random::new(14).image(one.len(), 0.0, 200.0);
    let two: Vec<f32> = (0..one.len()).map(|n| if row(n) < 14 { one[n] } else { other[n] }).collect();
    let points: Points = &[(60.0, [20, 200, 90], 0.0), (200.0, [250, 240, 10], 1.0)];
    for mode in [DVR, MIDA] {
        let [one, two] = [&one, &two].map(|voxels| {
            let place = DAffine3::from_translation(DVec3::new(-12.0, -14.5, -9.5));
            let scene = volume(Voxels::F32(voxels), size, place);
            drawn(scene, &view([0.0, 1.0, 0.0], [37, 23], 0.5), coloured(mode, points))
        });
        let opaque = one.iter().zip(&two).filter(|(one, _)| one[3] == 255);
        assert!(opaque.clone().count() > 200 && opaque.clone().all(|(one, two)| one == two), "{mode:?}");
    }
}

#[test]
fn something_brighter_shines_through_what_is_opaque_in_mida() {
    let points: Points = &[(60.0, [20, 200, 90], 0.0), (200.0, [250, 0, 0], 1.0), (400.0, [0, 0, 250], 1.0)];
    let value = |n: usize| match n / 5 % 20 {
        5..8 => 200.0,
        12..15 => 400.0,
        _ => 0.0,
    };
    let voxels: Vec<f32> = (0..500).map(value).collect();
    let scene = volume(Voxels::F32(&voxels), [5, 20, 5], DAffine3::IDENTITY);
    let camera = Camera::new(DVec3::new(2.0, 0.0, 2.0), DVec3::Y, DVec3::Z, [5, 5], 1.0).unwrap();
    let window = Window { level: 200.0, width: 400.0 };
    // The samples lie on voxel centres: a difference of half the window keeps half of the red.
    for pixel in drawn(scene, &camera, Context { window, ..coloured(MIDA, points) }) {
        assert!([125, 0, 125, 255].iter().zip(pixel).all(|(a, b)| b.abs_diff(*a) <= 1), "{pixel:?}");
    }
    let plain = drawn(scene, &camera, Context { window, ..coloured(DVR, points) });
    assert!(plain.iter().all(|pixel| pixel[..3] == [250, 0, 0]));
}
