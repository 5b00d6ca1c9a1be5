//! Silhouettes compared with the CPU's: on smooth depth, at borders of zones, and at single depth jumps;
//! likewise the lines at jumps.

use lumencut_core::math::blocks::HUGE;
use lumencut_core::math::leaps::{DOWNWARDS, LINE_DOWNWARDS, LINE_TO_THE_RIGHT, LUMEN, TO_THE_RIGHT};
use lumencut_core::settings::Settings;
use lumencut_core::stages::silhouette::{SilhouetteParameters, silhouette, silhouette_of_leaps};
use lumencut_scenes::random::Random;
use lumencut_scenes::tolerances::SILHOUETTE;
use lumencut_scenes::views::{front, on_cpu};

use super::{SIZES, device, finish, on_gpu};
use crate::depth_filter::DepthFilter;
use crate::device::Device;
use crate::images::Images;
use crate::recording::Recording;
use crate::silhouette::{Silhouette, SilhouetteImages};

/// The strengths of an image, made on the GPU and on the CPU, and the names of the timings.
fn both(
    size: [usize; 2],
    depth: &[f32],
    vessel: &[i32],
    half_slope: f64,
) -> Option<(Vec<f32>, Vec<f32>, Vec<&'static str>)> {
    let device = device()?;
    let camera = front(size, 0.4);
    let mut expected = vec![0.0; depth.len()];
    let settings = Settings { silhouette_slope: half_slope, ..Settings::default() };
    let parameters = SilhouetteParameters::new(&settings, &camera);
    silhouette(&on_cpu(&camera), &parameters, depth, vessel, &mut expected).unwrap();
    let (stage, filter) = (Silhouette::new(device), DepthFilter::new(device));
    let [raised, strength] = ["raised", "strength"].map(|label| device.image(label, depth.len(), 4));
    let images = SilhouetteImages {
        size,
        depth: &device.upload("depth", depth),
        vessel: &device.upload("vessel", vessel),
        raised: &raised,
        strength: &strength,
    };
    let mut recording = Recording::new(device);
    stage.write(device, &settings, &camera);
    stage.record(&mut recording, &filter, &on_gpu(device, &camera), images);
    recording.read(&strength, 4 * depth.len() as u64);
    let results = finish(recording);
    let names = results.timings.iter().map(|timing| timing.stage).collect();
    Some((results.numbers(0), expected, names))
}

#[test]
fn strengths_are_those_of_the_cpu() {
    for size in SIZES {
        let at = |p: usize| ((p % size[0]) as f32, (p / size[0]) as f32);
        let pixels = 0..size[0] * size[1];
        // Waves with two depth jumps; zones also end at places without a jump.
        let height = |(x, y): (f32, f32)| {
            let leap = if x + 0.3 * y > 20.0 { 35.0 } else { 0.0 } + if y > 9.5 { -20.0 } else { 0.0 };
            30.0 * (0.11 * x).sin() * (0.07 * y).cos() + leap
        };
        let zone = |(x, y): (f32, f32)| i32::from(x + 0.3 * y > 20.0) + 2 * i32::from(y > 5.0) - 1;
        let depth: Vec<f32> = pixels.clone().map(|p| height(at(p))).collect();
        let vessel: Vec<i32> = pixels.map(|p| zone(at(p))).collect();
        let Some((found, expected, _)) = both(size, &depth, &vessel, 24.0) else { return };
        let worst = SILHOUETTE.assert_same(&found, &expected, &format!("{size:?}"));
        println!("silhouette of {size:?}: at most {worst:e} apart");
        if size[0] > 100 {
            let range = expected.iter().fold([1f32, 0.0], |[low, high], s| [low.min(*s), high.max(*s)]);
            assert!(range[0] < 0.01 && range[1] > 0.9, "nothing to see: {range:?}");
        }
    }
}

#[test]
fn strengths_of_noise_are_those_of_the_cpu() {
    for size in SIZES {
        let mut random = Random::new(3);
        let pixels = size[0] * size[1];
        let depth = random.image(pixels, -9.0, 9.0);
        let vessel: Vec<i32> = (0..pixels).map(|_| random.between(0.0, 3.0) as i32).collect();
        let Some((found, expected, _)) = both(size, &depth, &vessel, 60.0) else { return };
        let worst = SILHOUETTE.assert_same(&found, &expected, &format!("{size:?}"));
        println!("silhouette of noise of {size:?}: at most {worst:e} apart");
    }
}

#[test]
fn three_passes_are_one_stage() {
    let Some((found, _, names)) = both([8, 8], &[1.0; 64], &[0; 64], 24.0) else { return };
    assert!(found.iter().all(|s| *s == 0.0), "a plane has no silhouette");
    assert!(names.is_empty() || names == ["silhouette"], "{names:?}");
}

/// Strengths of lines for random depth jumps, lumens and values, made on the GPU and on the CPU.
fn lines(device: &Device, size: [usize; 2], spacing: f64) -> [Vec<f32>; 2] {
    let (camera, settings, mut random) = (front(size, spacing), Settings::default(), Random::new(17));
    let pixels = size[0] * size[1];
    let leap: Vec<u32> = (0..pixels)
        .map(|p| {
            let [right, down, lumen] = [0.2, 0.2, 0.6].map(|share| random.between(0.0, 1.0) < share);
            // Pixels of the last column have no neighbour to the right, those of the last row none below.
            let (right, down) = (right && (p + 1) % size[0] != 0, down && p + size[0] < pixels);
            let [line_right, line_down] = [0; 2].map(|_| random.between(0.0, 1.0) < 0.5);
            let bits = [
                (TO_THE_RIGHT, right),
                (DOWNWARDS, down),
                (LINE_TO_THE_RIGHT, right && line_right),
                (LINE_DOWNWARDS, down && line_down),
                (LUMEN, lumen),
            ];
            bits.iter().map(|(bit, is_set)| bit * u32::from(*is_set)).sum()
        })
        .collect();
    let value: Vec<f32> =
        (0..pixels).map(|_| if random.between(0.0, 1.0) < 0.3 { f32::NAN } else { 7.0 }).collect();
    let parameters = SilhouetteParameters::new(&settings, &camera);
    let mut expected = vec![9.0; pixels];
    silhouette_of_leaps(&on_cpu(&camera), &parameters, &leap, &value, &mut expected).unwrap();
    let (stage, images) = (Silhouette::new(device), Images::new(device, size).unwrap());
    let on_device: Vec<f32> = value.iter().map(|value| if value.is_nan() { HUGE } else { *value }).collect();
    device.write(&images.leap, &leap);
    device.write(&images.value, &on_device);
    let mut recording = Recording::new(device);
    stage.write(device, &settings, &camera);
    stage.record_leaps(&mut recording, &on_gpu(device, &camera), &images);
    recording.read(&images.strength, 4 * pixels as u64);
    [finish(recording).numbers(0), expected]
}

#[test]
fn lines_of_leaps_are_those_of_the_cpu() {
    let Some(device) = device() else { return };
    for (size, spacing) in
        SIZES.into_iter().flat_map(|size| [0.2, 0.8, 1.0, 3.0].map(|spacing| (size, spacing)))
    {
        let [found, expected] = lines(device, size, spacing);
        SILHOUETTE.assert_same(&found, &expected, &format!("{size:?}, {spacing} mm"));
        if size[0] > 100 {
            let drawn = expected.iter().filter(|s| **s > 0.0).count();
            assert!(drawn > expected.len() / 10 && drawn < expected.len(), "{drawn} pixels with a line");
        }
    }
}
