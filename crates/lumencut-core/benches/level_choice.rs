//! Times of the cut surface at several pixel spacings; the default and the paper's rules take turns.

use glam::DVec3;
use lumencut_core::camera::Camera;
use lumencut_core::error::Result;
use lumencut_core::math::statistics::median;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::Scene;
use lumencut_core::settings::Settings;
use lumencut_core::stages::{Image, ImageSet};
use lumencut_core::vessel_tree::VesselTree;
use lumencut_scenes::random_tree::random_tree;
use lumencut_scenes::timing::{head, once, row};
use lumencut_scenes::workloads::WORKLOADS;

const RUNS: usize = 41;
/// The requested images. The distance is not among them, because the paper's rule computes it in any case.
const SURFACE: ImageSet = ImageSet::of(&[Image::Depth, Image::Vessel]);

/// The median time of each rule (ms), and the median ratio of the times of neighbouring runs.
fn in_turns(scene: &Scene, camera: &Camera) -> Result<[f64; 3]> {
    // Depth filter, silhouettes and picture are off, since `workloads` measures complete frames.
    let rules = [Settings::default(), Settings::paper()];
    let rules = rules.map(|rule| Settings { depth_filter: false, ..rule });
    let mut renderers = [CpuRenderer::default(), CpuRenderer::default()];
    let mut times = [Vec::new(), Vec::new(), Vec::new()];
    for run in 0..=RUNS {
        let mut pair = [0.0; 2];
        for (n, renderer) in renderers.iter_mut().enumerate() {
            let request = Request { images: SURFACE, ..Request::new(camera, &rules[n]) };
            let (milliseconds, frame) = once(|| renderer.render(scene, &request));
            frame?;
            pair[n] = milliseconds;
        }
        // The first run only warms up the caches.
        if run > 0 {
            times[0].push(pair[0]);
            times[1].push(pair[1]);
            times[2].push(pair[0] / pair[1]);
        }
    }
    Ok(times.map(|mut all| median(&mut all).unwrap_or(f64::NAN)))
}

fn compare(name: &str, tree: &VesselTree) -> Result<()> {
    let (low, high) = tree.bounds();
    let (center, extent) = ((low + high) * 0.5, (high - low).max_element());
    let spacings =
        [("0.3", 0.3), ("1", 1.0), ("3", 3.0), ("tree in 128 pixels", extent / 128.0), ("0.05", 0.05)];
    let scene = Scene::default().with_tree(tree.clone());
    for (view, direction) in [("front", DVec3::Y), ("oblique", DVec3::new(0.5, 1.0, -0.4))] {
        for (label, spacing) in spacings {
            // The closest view is centred on a point of the first vessel.
            let first = tree.vessels()[0].points();
            let center = if spacing < 0.1 { first[first.len() / 2] } else { center };
            let camera = Camera::new(center, direction, DVec3::Z, [512, 512], spacing)?;
            let [own, paper, ratio] = in_turns(&scene, &camera)?;
            let numbers = [own, paper, ratio].map(|number| format!("{number:.2}"));
            row([&[name.to_owned(), view.to_owned(), label.to_owned()][..], &numbers[..]].concat());
        }
    }
    Ok(())
}

fn main() -> Result<()> {
    head(
        "Projection and cut surface, 512 × 512, both cores (ms)",
        &["tree", "view", "mm per pixel", "default rules", "paper's rules", "ratio"],
    );
    compare("31 vessels", &random_tree(7, 31, 160, 1.5, 150.0)?)?;
    compare("124 vessels", &random_tree(7, 124, 160, 1.5, 150.0)?)?;
    for (name, make) in WORKLOADS {
        compare(name, &make(0, 0.1)?.tree)?;
    }
    Ok(())
}
