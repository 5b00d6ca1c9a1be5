//! The depth filter against the CPU's: within two units of the last place of the largest depth.

use lumencut_core::stages::depth_filter::depth_filter;

use super::{Random, SIZES, camera, device, finish, on_cpu, on_gpu};
use crate::depth_filter::DepthFilter;
use crate::recording::Recording;

#[test]
fn the_filter_is_that_of_the_cpu() {
    const LARGEST: f32 = 300.0;
    let Some(device) = device() else { return };
    let filter = DepthFilter::new(device);
    let mut worst = 0f32;
    for size in SIZES {
        let camera = camera(size, 0.5);
        let pixels = size[0] * size[1];
        let image = Random::new(7).image(pixels, -LARGEST, LARGEST);
        let mut expected = vec![0.0; pixels];
        depth_filter(&on_cpu(&camera), &image, &mut expected).unwrap();
        let smoothed = device.image("smoothed", pixels, 4);
        let mut recording = Recording::new(device);
        let source = device.upload("image", &image);
        filter.record(&mut recording, &on_gpu(device, &camera), size, &source, &smoothed);
        recording.read(&smoothed, 4 * pixels as u64);
        let found: Vec<f32> = bytemuck::pod_collect_to_vec(&finish(recording).bytes[0]);
        assert_eq!(found.len(), pixels);
        assert!(pixels == 1 || found != image, "nothing was filtered");
        for (found, expected) in found.iter().zip(&expected) {
            worst = worst.max((found - expected).abs());
        }
    }
    println!("depth filter: at most {worst:e} mm apart");
    // Two units of the last place of 300: 2 · 2⁻¹⁵.
    assert!(worst <= 2.0 * 256.0 * f32::EPSILON, "{worst:e}");
}
