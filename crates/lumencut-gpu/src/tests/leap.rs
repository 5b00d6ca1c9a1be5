//! Depth jumps are bit-identical to the CPU's for equal depths and sheets; sheets are compared as well.

use lumencut_core::math::leaps::{DOWNWARDS, LUMEN, TO_THE_RIGHT};
use lumencut_core::pipeline::{CpuRenderer, Request, SurfaceDetails};
use lumencut_core::scene::LeveledTree;
use lumencut_core::settings::{LevelChoice, Settings};
use lumencut_core::stages::depth::{Sheet, WALL_GAP};
use lumencut_core::stages::leap::{LeapParameters, leap};
use lumencut_core::stages::{Image, ImageSet};
use lumencut_core::vessel_tree::VesselTree;
use lumencut_scenes::random::Random;
use lumencut_scenes::random_tree::random_tree;
use lumencut_scenes::settings::unfiltered;
use lumencut_scenes::tolerances::{SHEET_GAP, SHEET_RADIUS, SHEET_SLOPE};
use lumencut_scenes::trees::{tree, trefoil, vessel};
use lumencut_scenes::views::{front, on_cpu, view};

use super::{SIZES, device, finish, on_gpu};
use crate::cut_surface::{CutSurfaceStages, DepthRules};
use crate::device::Device;
use crate::images::Images;
use crate::leap::Leap;
use crate::levels::DeviceLevels;
use crate::recording::Recording;

/// Depth jumps found on the GPU and on the CPU. All numbers are multiples of a quarter, so no sum is rounded.
fn both(
    device: &Device,
    size: [usize; 2],
    (depth, vessel): (&[f32], &[i32]),
    sheet: &[Sheet],
) -> [Vec<u32>; 2] {
    let camera = front(size, 0.5);
    let mut expected = vec![0; depth.len()];
    leap(&on_cpu(&camera), &LeapParameters::new(&camera), (depth, vessel), sheet, &mut expected).unwrap();
    let (stage, images) = (Leap::new(device), Images::new(device, size).unwrap());
    device.write(&images.sheet, sheet);
    device.write(&images.vessel, vessel);
    device.write(&images.leap, &vec![9u32; depth.len()]);
    let mut recording = Recording::new(device);
    stage.write(device, &camera);
    stage.record(&mut recording, &on_gpu(device, &camera), &images, &device.upload("depth", depth));
    recording.read(&images.leap, 4 * depth.len() as u64);
    [finish(recording).numbers(0), expected]
}

#[test]
fn leaps_are_those_of_the_cpu_to_the_bit() {
    let Some(device) = device() else { return };
    let mut random = Random::new(91);
    for size in SIZES {
        let pixels = size[0] * size[1];
        let mut quarters = |most: f32| (random.between(-most, most) * 4.0).round() / 4.0;
        let depth: Vec<f32> = (0..pixels).map(|_| quarters(6.0)).collect();
        let vessel: Vec<i32> = (0..pixels).map(|_| i32::from(quarters(1.0) > 0.5)).collect();
        // Three of four pixels are lumen with a place along the vessel, so folds are tried too.
        let mut gap = || if quarters(1.0) > 0.5 { 0.0 } else { WALL_GAP - 4.0 - quarters(4.0) };
        let gaps: Vec<f32> = (0..pixels).map(|_| gap()).collect();
        let of_gap = |gap: &f32| [quarters(8.0), quarters(8.0), quarters(2.0), *gap];
        let sheet: Vec<Sheet> = gaps.iter().map(of_gap).collect();
        let [found, expected] = both(device, size, (&depth, &vessel), &sheet);
        assert_eq!(found, expected, "{size:?}");
        if pixels > 100 {
            let bits =
                [TO_THE_RIGHT, DOWNWARDS].map(|bit| found.iter().filter(|leap| *leap & bit != 0).count());
            assert!(bits.iter().all(|count| (pixels / 10..pixels).contains(count)), "{bits:?} of {pixels}");
        }
    }
}

#[test]
fn a_steep_surface_has_no_leap_at_the_borders_of_the_image() {
    let Some(device) = device() else { return };
    for size in SIZES {
        let at = |p: usize| ((p % size[0]) as f32, (p / size[0]) as f32);
        let depth: Vec<f32> = (0..size[0] * size[1]).map(|p| 20.0 * at(p).0 - 30.0 * at(p).1).collect();
        let [found, expected] =
            both(device, size, (&depth, &vec![0; depth.len()]), &vec![[40.0, 60.0, 1.0, 0.0]; depth.len()]);
        assert_eq!(found, expected, "{size:?}");
        assert!(found.iter().all(|leap| *leap == LUMEN), "{size:?}");
    }
}

fn sheet_on_gpu(device: &Device, tree: &LeveledTree, request: &Request) -> Vec<Sheet> {
    let settings = request.settings;
    let levels = DeviceLevels::new(device, &tree.levels(settings.levels, 0.0)).unwrap();
    let images = Images::new(device, request.camera.size()).unwrap();
    let (view, mut stages) = (on_gpu(device, request.camera), CutSurfaceStages::new(device));
    let mut recording = Recording::new(device);
    stages.look(device, &levels, request);
    stages.project(&mut recording, &view, &levels, settings.levels);
    stages.distance(&mut recording, &view, &levels, &images);
    for rules in DepthRules::of(request) {
        stages.depth(&mut recording, &view, &levels, rules, &images, &images.unfiltered_depth);
    }
    recording.read(&images.sheet, 16 * images.pixels() as u64);
    finish(recording).numbers(0)
}

fn trees() -> [VesselTree; 3] {
    let steep = vessel(&[[-40., -90., 0.], [0., 0., 5.], [40., 120., -9.], [41., 140., -30.]], 3.0);
    [random_tree(92, 8, 50, 2.0, 50.0).unwrap(), trefoil(200), tree(vec![steep])]
}

#[test]
fn sheets_are_those_of_the_cpu() {
    let Some(device) = device() else { return };
    let (mut worst, mut varies) = ([0f32; 3], [false; 4]);
    for (scene, level_choice) in
        trees().iter().flat_map(|tree| [LevelChoice::Own, LevelChoice::Nearest].map(|choice| (tree, choice)))
    {
        let (scene, settings) = (LeveledTree::new(scene.clone()), Settings { level_choice, ..unfiltered() });
        let camera = view([0.3, 1.0, 0.2], [96, 80], 1.1);
        let request = Request { images: ImageSet::of(&[Image::Sheet]), ..Request::new(&camera, &settings) };
        let SurfaceDetails { sheet: expected, .. } =
            CpuRenderer::default().details(&scene, &request).unwrap();
        let found = sheet_on_gpu(device, &scene, &request);
        let channel = |sheets: &[Sheet], c: usize| sheets.iter().map(|sheet| sheet[c]).collect::<Vec<_>>();
        for (c, of, tolerance) in
            [(0, 0, SHEET_SLOPE), (1, 0, SHEET_SLOPE), (2, 1, SHEET_RADIUS), (3, 2, SHEET_GAP)]
        {
            let [found, expected] = [&found, &expected].map(|sheets| channel(sheets, c));
            varies[c] |= expected.iter().any(|number| *number != expected[0]);
            worst[of] = worst[of].max(tolerance.assert_same(
                &found,
                &expected,
                &format!("channel {c}, {level_choice:?}"),
            ));
        }
    }
    assert_eq!(varies, [true; 4], "something to compare in every channel");
    println!("sheets: slopes, radii and gaps at most {worst:?} apart");
}
