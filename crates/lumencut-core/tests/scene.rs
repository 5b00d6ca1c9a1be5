//! A scene's tree can be exchanged, and `look` is independent of how positions were found.
#![allow(clippy::unwrap_used)]

use std::sync::Arc;

use glam::{DAffine3, DVec3};
use lumencut_core::camera::Camera;
use lumencut_core::error::ErrorKind;
use lumencut_core::frame::Frame;
use lumencut_core::geometry::{Curved, Geometry};
use lumencut_core::math::leaps::LEAPS;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::{LeveledTree, Scene, SharedVolume, VolumeKey};
use lumencut_core::settings::{Opacity, Settings, Slab, SlabMode};
use lumencut_core::stages::{Image, ImageSet};
use lumencut_core::volume::Volume;
use lumencut_phantom::{Phantom, crossing, y_junction};
use lumencut_scenes::trees::{tree, vessel};
use lumencut_scenes::views::{front, view};
use lumencut_scenes::volumes::{ball_and_rod, sheared};

const SIZE: [usize; 2] = [61, 43];

fn shown(scene: &Scene, camera: &Camera, settings: &Settings) -> Frame {
    CpuRenderer::default().render(scene, &Request::new(camera, settings)).unwrap()
}

fn scene(phantom: &Phantom) -> Scene<'_> {
    Scene::new(phantom.volume().unwrap(), phantom.tree.clone())
}

fn assert_identical(one: &Frame, other: &Frame) {
    let bits = |values: &[f32]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
    assert_eq!(one.image, other.image);
    assert_eq!(one.context, other.context);
    assert_eq!(one.vessel, other.vessel);
    assert_eq!(bits(one.depth()), bits(other.depth()));
    assert_eq!(bits(&one.distance), bits(&other.distance));
    assert_eq!(bits(&one.value), bits(&other.value));
}

/// Settings in which context, slab and silhouettes are all visible.
fn all_layers() -> Settings {
    Settings {
        opacity: Some(Opacity { transparent: 0.0, opaque: 400.0 }),
        slab: Some(Slab { thickness: 3.0, mode: SlabMode::Mean }),
        ..Settings::default()
    }
}

#[test]
fn an_exchanged_tree_is_shown_as_in_a_scene_of_its_own() {
    let (one, other) = (y_junction().unwrap(), crossing().unwrap());
    let camera = front(SIZE, 1.5);
    let mut renderer = CpuRenderer::default();
    let first = scene(&one);
    let exchanged = first.clone().with_tree(other.tree.clone());
    let fresh = Scene::new(one.volume().unwrap(), other.tree);
    let settings = all_layers();
    let request = Request::new(&camera, &settings);
    let before = renderer.render(&first, &request).unwrap();
    assert_identical(&renderer.render(&exchanged, &request).unwrap(), &shown(&fresh, &camera, &settings));
    assert_identical(&renderer.render(&first, &request).unwrap(), &before);
}

#[test]
fn an_exchanged_tree_leaves_what_is_known_of_the_volume() {
    let phantom = y_junction().unwrap();
    let first = scene(&phantom);
    let kept = first.volume.clone().unwrap();
    let made = std::ptr::from_ref(kept.blocks(&|| false).unwrap());
    let exchanged = first.with_tree(crossing().unwrap().tree).volume.unwrap();
    assert!(exchanged.key.downgrade().is(&kept.key));
    assert_eq!(std::ptr::from_ref(exchanged.blocks(&|| false).unwrap()), made);
    let other = SharedVolume::new(phantom.volume().unwrap(), VolumeKey::default());
    assert!(!other.key.downgrade().is(&kept.key));
}

#[test]
fn levels_are_made_once_for_all_renderers() {
    let leveled = LeveledTree::new(y_junction().unwrap().tree);
    let three = leveled.levels(3, 0.0);
    assert_eq!(three.len(), 4);
    assert!(
        Arc::ptr_eq(&three, &leveled.levels(2, 0.0)),
        "fewer levels are the first of those that are there"
    );
    assert_eq!(leveled.levels(6, 0.0).len(), 7);
    assert!(Arc::ptr_eq(&leveled.levels(6, 0.0), &leveled.levels(3, 0.0)));
}

#[test]
fn levels_are_kept_for_two_values_of_the_smoothing() {
    let leveled = LeveledTree::new(y_junction().unwrap().tree);
    let (none, half) = (leveled.levels(3, 0.0), leveled.levels(3, 0.5));
    assert!(!Arc::ptr_eq(&none, &half), "another value gives other levels");
    for _ in 0..2 {
        assert!(Arc::ptr_eq(&none, &leveled.levels(3, 0.0)));
        assert!(Arc::ptr_eq(&half, &leveled.levels(2, 0.5)));
    }
    // The smoothing used last stays cached when a third one is added.
    let two = leveled.levels(3, 2.0);
    assert!(Arc::ptr_eq(&half, &leveled.levels(3, 0.5)));
    assert!(Arc::ptr_eq(&two, &leveled.levels(3, 2.0)));
    assert!(!Arc::ptr_eq(&none, &leveled.levels(3, 0.0)), "made anew");
}

#[test]
fn looking_again_shows_the_same() {
    let (phantom, settings) = (y_junction().unwrap(), all_layers());
    let (camera, scene) = (view([0.3, 1.0, 0.2], SIZE, 1.5), scene(&phantom));
    let request = Request::new(&camera, &settings);
    let whole = shown(&scene, &camera, &settings);
    // Without a volume, a frame has depth jumps and focus shares only if they are requested.
    let cut = Scene { volume: None, ..scene.clone() };
    let images = ImageSet::ALL.and(ImageSet::of(&[Image::Leap, Image::Focus]));
    let with_leaps = Request { images, ..request };
    let surface = CpuRenderer::default().render(&cut, &with_leaps).unwrap();
    assert!(surface.value.is_empty() && surface.image.is_empty());
    assert!(surface.leap.iter().any(|leap| *leap & LEAPS != 0), "no silhouettes to show");
    let looked = CpuRenderer::default().look(scene.volume.as_ref().unwrap(), surface, &request).unwrap();
    assert_identical(&looked, &whole);
}

#[test]
fn vessels_without_a_depth_are_the_context_alone() {
    let (phantom, camera, settings) = (y_junction().unwrap(), front(SIZE, 1.5), Settings::default());
    let scene = scene(&phantom);
    let request = Request::new(&camera, &settings);
    let surface = shown(&Scene { volume: None, ..scene.clone() }, &camera, &settings);
    let vessels = surface.keeping(ImageSet::of(&[Image::Vessel]));
    let looked = CpuRenderer::default().look(scene.volume.as_ref().unwrap(), vessels, &request).unwrap();
    let alone = shown(&Scene { tree: None, ..scene }, &camera, &settings);
    assert_eq!((looked.image, looked.context), (alone.image, alone.context));
}

#[test]
fn a_frame_has_the_images_that_are_asked_for() {
    let (phantom, camera, settings) = (y_junction().unwrap(), front(SIZE, 1.5), Settings::default());
    let whole = shown(&scene(&phantom), &camera, &settings);
    for asked in [&[][..], &[Image::Picture], &[Image::Depth, Image::Value], &[Image::Vessel, Image::Context]]
    {
        let request = Request { images: ImageSet::of(asked), ..Request::new(&camera, &settings) };
        let frame = CpuRenderer::default().render(&scene(&phantom), &request).unwrap();
        assert_eq!(frame.images(), ImageSet::of(asked));
        assert_identical(&frame, &whole.clone().keeping(ImageSet::of(asked)));
    }
}

#[test]
fn neither_a_volume_nor_a_tree_is_an_error() {
    let (camera, settings) = (front(SIZE, 1.0), Settings::default());
    let nothing = CpuRenderer::default().render(&Scene::default(), &Request::new(&camera, &settings));
    assert_eq!(nothing.unwrap_err().kind, ErrorKind::Volume);
}

/// The positions of a frame's cut surface as a curved geometry.
fn as_curved(frame: &Frame) -> Geometry {
    let camera = *frame.geometry.camera().unwrap();
    let [width, height] = camera.size();
    let place = |p: usize| {
        let (x, y) = (camera.view_x(p % width), camera.view_y(p / width));
        camera.world_from_view(DVec3::new(x, y, f64::from(frame.depth()[p])))
    };
    let directions = vec![camera.direction().as_vec3(); width * height];
    Geometry::Curved(
        Curved::new([width, height], (0..width * height).map(place).collect(), directions).unwrap(),
    )
}

#[test]
fn places_of_their_own_show_the_values_that_a_camera_shows_there() {
    let (size, camera) = ([40, 36, 20], front(SIZE, 0.7));
    let voxels = ball_and_rod(size);
    let volume = Volume::new(
        lumencut_core::volume::Voxels::I16(&voxels),
        size,
        [1, size[0], size[0] * size[1]],
        sheared(size),
    )
    .unwrap();
    let line = tree(vec![vessel(&[[-8.0, 3.0, -9.0], [0.0, -2.0, 0.0], [9.0, 4.0, 10.0]], 2.0)]);
    let scene = Scene::new(volume, line);
    for slab in [None, Some((2.0, SlabMode::Max)), Some((5.0, SlabMode::Mean)), Some((3.0, SlabMode::Min))] {
        let slab = slab.map(|(thickness, mode)| Slab { thickness, mode });
        let settings = Settings { slab, context: None, silhouettes: false, ..Settings::default() };
        let orthographic = shown(&scene, &camera, &settings);
        let request = Request::new(&camera, &settings);
        let volume = scene.volume.as_ref().unwrap();
        let curved =
            CpuRenderer::default().look(volume, Frame::of(as_curved(&orthographic)), &request).unwrap();
        assert_eq!(curved.images(), ImageSet::of(&[Image::Picture, Image::Value]));
        let mut seen = 0;
        for (a, b) in curved.value.iter().zip(&orthographic.value) {
            // Rounding decides at the border of the volume; elsewhere indices differ in their last digits.
            assert!(a.is_nan() == b.is_nan() && (a.is_nan() || (a - b).abs() < 0.01), "{a} and {b}");
            seen += usize::from(!a.is_nan());
        }
        assert!(seen > 500, "{seen} pixels lie in the volume");
    }
}

#[test]
fn places_that_are_nowhere_show_nothing() {
    let voxels = [100i16; 8];
    let volume =
        Volume::new(lumencut_core::volume::Voxels::I16(&voxels), [2; 3], [1, 2, 4], DAffine3::IDENTITY)
            .unwrap();
    let shared = SharedVolume::new(volume, VolumeKey::default());
    let inside = DVec3::splat(0.5);
    let points = vec![
        inside,
        DVec3::new(f64::NAN, 0.5, 0.5),
        DVec3::new(0.5, f64::INFINITY, 0.5),
        DVec3::splat(1e300),
    ];
    let geometry = Curved::new([2, 2], points, vec![glam::Vec3::Z; 4]).unwrap();
    let (camera, settings) = (front([2, 2], 1.0), Settings::default());
    let request = Request::new(&camera, &settings);
    let frame =
        CpuRenderer::default().look(&shared, Frame::of(Geometry::Curved(geometry)), &request).unwrap();
    assert_eq!(frame.value[0], 100.0);
    assert!(frame.value[1..].iter().all(|value| value.is_nan()));
}

#[test]
fn curved_geometries_have_one_place_for_each_pixel() {
    let directions = vec![glam::Vec3::Z; 3];
    let error = Curved::new([2, 2], vec![DVec3::ZERO; 4], directions).unwrap_err();
    assert_eq!(error.kind, ErrorKind::Camera);
    assert!(error.to_string().contains("4 points and 3 directions"), "{error}");
    assert!(Curved::new([0, 2], Vec::new(), Vec::new()).is_err());
}
