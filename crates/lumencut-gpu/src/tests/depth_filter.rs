//! The depth filter on the GPU, compared with the CPU's.

use lumencut_core::settings::Settings;
use lumencut_core::stages::depth_filter::{DepthFilterParameters, depth_filter};
use lumencut_scenes::random::Random;
use lumencut_scenes::tolerances::{FILTERED_DEPTH, FILTERED_IN_ZONES};
use lumencut_scenes::views::{front, on_cpu};
use lumencut_scenes::zones::Zones;

use super::{SIZES, device, finish, on_gpu};
use crate::depth_filter::{DepthFilter, ZoneImages};
use crate::recording::Recording;

#[test]
fn the_filter_is_that_of_the_cpu() {
    const LARGEST: f32 = 300.0;
    let Some(device) = device() else { return };
    let filter = DepthFilter::new(device);
    let mut worst = 0f32;
    for size in SIZES {
        let camera = front(size, 0.5);
        let pixels = size[0] * size[1];
        let image = Random::new(7).image(pixels, -LARGEST, LARGEST);
        let mut expected = vec![0.0; pixels];
        depth_filter(&on_cpu(&camera), &DepthFilterParameters::new(), &image, None, &mut expected).unwrap();
        let smoothed = device.image("smoothed", pixels, 4);
        let mut recording = Recording::new(device);
        let source = device.upload("image", &image);
        filter.record(&mut recording, &on_gpu(device, &camera), size, [&source, &smoothed]);
        recording.read(&smoothed, 4 * pixels as u64);
        let found: Vec<f32> = finish(recording).numbers(0);
        assert!(pixels == 1 || found != image, "nothing was filtered");
        worst = worst.max(FILTERED_DEPTH.assert_same(&found, &expected, &format!("{size:?}")));
    }
    println!("depth filter: at most {worst:e} mm apart");
}

#[test]
fn the_filter_within_zones_is_that_of_the_cpu() {
    let Some(device) = device() else { return };
    let filter = DepthFilter::new(device);
    let mut worst = 0f32;
    for (depth_leap, size) in [0.2, 1.0, 50.0].into_iter().flat_map(|leap| SIZES.map(|size| (leap, size))) {
        let settings = Settings { depth_leap, ..Settings::default() };
        let (camera, pixels) = (front(size, 0.5), size[0] * size[1]);
        let Zones { depth, vessel } = Zones::new(7, size);
        let mut expected = vec![0.0; pixels];
        let parameters = DepthFilterParameters::of(&settings);
        depth_filter(&on_cpu(&camera), &parameters, &depth, Some(&vessel), &mut expected).unwrap();
        let [columns, smoothed] = ["columns", "smoothed"].map(|label| device.image(label, pixels, 4));
        let images = ZoneImages {
            image: &device.upload("depth", &depth),
            vessel: &device.upload("vessel", &vessel),
            columns: &columns,
            smoothed: &smoothed,
        };
        let mut recording = Recording::new(device);
        filter.write(device, &settings);
        filter.record_within_zones(&mut recording, &on_gpu(device, &camera), size, images);
        recording.read(&smoothed, 4 * pixels as u64);
        let found: Vec<f32> = finish(recording).numbers(0);
        assert!(pixels < 100 || found != depth, "nothing was filtered");
        let what = format!("{size:?}, leap {depth_leap}");
        worst = worst.max(FILTERED_IN_ZONES.assert_same(&found, &expected, &what));
    }
    println!("depth filter within zones: at most {worst:e} mm apart");
}
