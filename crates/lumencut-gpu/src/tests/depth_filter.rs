//! The depth filter against the CPU's.

use lumencut_core::stages::depth_filter::{DepthFilterParameters, depth_filter};
use lumencut_scenes::random::Random;
use lumencut_scenes::tolerances::FILTERED_DEPTH;
use lumencut_scenes::views::{front, on_cpu};

use super::{SIZES, device, finish, on_gpu};
use crate::depth_filter::DepthFilter;
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
        depth_filter(&on_cpu(&camera), &DepthFilterParameters::new(), &image, &mut expected).unwrap();
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
