//! The GPU that the other tests run on.

use lumencut_scenes::random::Random;
use lumencut_scenes::views::front;

use super::{device, finish, on_gpu};
use crate::adapter::{Choice, Description, choose};
use crate::depth_filter::DepthFilter;
use crate::recording::Recording;

#[test]
fn the_description_names_the_adapter_that_runs() {
    let Some(device) = device() else { return };
    let (found, info) = (device.description(), device.device.adapter_info());
    assert_eq!((&found.name, found.backend.as_str()), (&info.name, info.backend.to_str()));
    assert!(!found.name.is_empty() && found.driver.starts_with(&info.driver), "{found:?}");
    assert_eq!(found.is_software, info.device_type == wgpu::DeviceType::Cpu);
    assert!(found.is_software || !found.name.contains("llvmpipe"), "{found:?}");
    println!("{} by {} ({})", found.name, found.backend, found.driver);
    // Asking again would return this GPU, not another one.
    let first = pollster::block_on(choose(Choice::Any)).unwrap();
    assert_eq!(*found, Description::of(&first));
}

#[test]
fn software_runs_only_where_it_is_asked_for() {
    let Some(device) = device() else { return };
    match pollster::block_on(choose(Choice::Hardware)) {
        Ok(adapter) => assert!(!Description::of(&adapter).is_software),
        Err(error) => {
            assert!(device.description().is_software, "hardware that is not found: {error}");
            assert_eq!(error.found, "software only");
        }
    }
}

#[test]
fn the_passes_of_a_stage_in_a_row_count_together() {
    let Some(device) = device() else { return };
    let camera = front([33, 20], 0.5);
    let (view, filter) = (on_gpu(device, &camera), DepthFilter::new(device));
    let image = device.upload("image", &Random::new(1).image(660, 0.0, 1.0));
    let smoothed = device.image("smoothed", 660, 4);
    let mut recording = Recording::new(device);
    filter.record(&mut recording, &view, camera.size(), [&image, &smoothed]);
    filter.record(&mut recording, &view, camera.size(), [&image, &smoothed]);
    filter.record_as("silhouette", &mut recording, &view, camera.size(), [&image, &smoothed]);
    let results = finish(recording);
    let names: Vec<_> = results.timings.iter().map(|timing| timing.stage).collect();
    let expected: &[&str] = if device.has_timestamps { &["depth_filter", "silhouette"] } else { &[] };
    assert_eq!(names, expected);
    assert!(results.timings.iter().all(|timing| (0.0..1e4).contains(&timing.milliseconds)));
}
