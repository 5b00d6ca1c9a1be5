//! The focus on the GPU, compared with the CPU's around vessels of all kinds.

use lumencut_core::camera::Camera;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::{LeveledTree, Scene};
use lumencut_core::settings::{Context, Focus, Settings};
use lumencut_core::stages::focus::FocusParameters;
use lumencut_core::stages::{Image, ImageSet};
use lumencut_core::vessel_tree::VesselTree;
use lumencut_scenes::random_tree::random_tree;
use lumencut_scenes::tolerances::SHARE;
use lumencut_scenes::trees::{tree, trefoil, vessel};
use lumencut_scenes::views::{front, view};

use super::{SIZES, device, finish, on_gpu};
use crate::cut_surface::CutSurfaceStages;
use crate::device::Device;
use crate::images::Images;
use crate::levels::DeviceLevels;
use crate::recording::Recording;

type OnGpu<'a> = (&'a Device, CutSurfaceStages);

/// The shares of cut surface and silhouettes, made on the GPU and on the CPU.
fn both(
    (device, stages): &mut OnGpu,
    tree: &VesselTree,
    camera: &Camera,
    settings: &Settings,
) -> [Vec<f32>; 2] {
    let request = Request { images: ImageSet::of(&[Image::Focus]), ..Request::new(camera, settings) };
    let scene = Scene::default().with_tree(tree.clone());
    let expected = CpuRenderer::default().render(&scene, &request).unwrap().focus;
    let levels = LeveledTree::new(tree.clone()).levels(settings.levels, 0.0);
    let mut on_device = DeviceLevels::new(device, &levels[..=settings.levels]).unwrap();
    on_device.put_first(device, &levels[..=settings.levels], &settings.focus_vessels);
    let images = Images::new(device, camera.size()).unwrap();
    let (mut recording, view) = (Recording::new(device), on_gpu(device, camera));
    stages.look(device, &on_device, &request);
    stages.project(&mut recording, &view, &on_device, settings.levels);
    stages.focus(&mut recording, &view, &on_device, FocusParameters::new(settings, camera).unwrap(), &images);
    recording.read(&images.focus, 16 * images.pixels() as u64);
    [finish(recording).numbers(0), expected.into_flattened()]
}

#[test]
fn shares_are_those_of_the_cpu() {
    let Some(device) = device() else { return };
    let mut gpu = (device, CutSurfaceStages::new(device));
    let along = tree(vec![vessel(&[[0.0, -30.0, 0.0], [0.0, 30.0, 0.0], [9.0, 31.0, 4.0]], 5.0)]);
    for tree in [trefoil(200), random_tree(5, 30, 40, 3.0, 40.0).unwrap(), along] {
        for (margin, fade, silhouette_reach) in [
            (2.0, 6.0, None),
            (-1.5, 4.0, Some(3.0)),
            (0.5, 40.0, Some(5.0)),
            (-1e6, 6.0, Some(1e6)),
            (1e6, 6.0, Some(8.0)),
        ] {
            let focus = Some(Focus { margin, fade });
            let context = Some(Context { halo: 0.6, ..Context::default() });
            let settings = Settings { focus, silhouette_reach, context, ..Settings::default() };
            for size in SIZES {
                let camera = view([0.2, 1.0, -0.4], size, 0.6);
                let [found, expected] = both(&mut gpu, &tree, &camera, &settings);
                SHARE.assert_same(&found, &expected, &format!("{size:?}, {margin} mm + {fade} mm"));
            }
        }
    }
}

#[test]
fn shares_of_chosen_vessels_are_those_of_the_cpu() {
    let Some(device) = device() else { return };
    let mut gpu = (device, CutSurfaceStages::new(device));
    let tree = random_tree(5, 30, 40, 3.0, 40.0).unwrap();
    for (margin, fade, others_strength) in [(2.0, 6.0, 0.5), (-1.5, 4.0, 0.0), (0.5, 40.0, 0.9)] {
        let focus = Some(Focus { margin, fade });
        let settings = Settings { focus, focus_vessels: vec![3, 17], others_strength, ..Settings::default() };
        let camera = view([0.2, 1.0, -0.4], [96, 80], 0.6);
        let [found, expected] = both(&mut gpu, &tree, &camera, &settings);
        SHARE.assert_same(&found, &expected, &format!("{margin} mm + {fade} mm, {others_strength}"));
    }
}

#[test]
fn a_hard_edge_lies_where_that_of_the_cpu_does() {
    let Some(device) = device() else { return };
    let mut gpu = (device, CutSurfaceStages::new(device));
    let tube = tree(vec![vessel(&[[-50.0, 0.0, 0.0], [50.0, 0.0, 0.0]], 4.0)]);
    let settings = Settings {
        focus: Some(Focus { margin: 1.0, fade: 0.0 }),
        silhouette_reach: Some(0.0),
        ..Settings::default()
    };
    let [found, expected] = both(&mut gpu, &tube, &front([33, 47], 0.7), &settings);
    assert_eq!(found, expected);
    assert!(found.contains(&0.0) && found.contains(&1.0));
}
