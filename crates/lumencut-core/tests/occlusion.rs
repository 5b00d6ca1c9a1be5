//! Occlusion, compared with closed forms; lumen and wall keep their bits.
#![allow(clippy::unwrap_used)]

use lumencut_core::camera::Camera;
use lumencut_core::frame::Frame;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::{LeveledTree, Scene};
use lumencut_core::settings::Settings;
use lumencut_core::stages::occlusion::{OcclusionParameters, occlusion};
use lumencut_core::stages::{Image, ImageSet};
use lumencut_phantom::{crossing, y_junction};
use lumencut_scenes::views::{front, on_cpu, view};

/// The share by which each pixel is darkened, with an occlusion of 1 everywhere.
fn darkened(camera: &Camera, depth: &[f32]) -> Vec<f32> {
    let mut shares = vec![[1.0; 4]; depth.len()];
    occlusion(&on_cpu(camera), &OcclusionParameters::new(camera), depth, &mut shares).unwrap();
    shares.iter().map(|shares| shares[3]).collect()
}

/// The depths of columns of pixels, blurred by a Gaussian of this deviation (pixels) that ends at three deviations.
fn blurred(depth: impl Fn(i64) -> f64, column: i64, sigma: f64) -> f64 {
    let reach = (3.0 * sigma).ceil() as i64;
    let weight = |n: i64| (-0.5 * (n as f64 / sigma).powi(2)).exp();
    let all: f64 = (-reach..=reach).map(weight).sum();
    (-reach..=reach).map(|n| weight(n) * depth(column + n)).sum::<f64>() / all
}

fn expected(depth: impl Fn(i64) -> f64 + Copy, column: i64, spacing: f64) -> f64 {
    let behind = [1.5, 6.0]
        .map(|sigma| depth(column) - blurred(depth, column, sigma / spacing))
        .map(|deeper| ((deeper - 0.5) / 10.0).clamp(0.0, 1.0));
    (1.6 * 0.5 * (behind[0] + behind[1])).min(1.0)
}

#[test]
fn behind_a_step_the_deeper_side_is_darkened_as_the_closed_form_says() {
    // At 2 mm both deviations are below four pixels, so no image is reduced; at 0.25 mm the larger one is by 12.
    for (spacing, width, most) in [(2.0, 80, 1e-4), (0.25, 400, 0.06)] {
        let camera = front([width, 6], spacing);
        for height in [3.0, 12.0, 60.0] {
            let step = |column: i64| {
                let column = column.clamp(0, width as i64 - 1);
                if column < width as i64 / 2 { 0.0 } else { height }
            };
            let depth: Vec<f32> = (0..6 * width).map(|n| step((n % width) as i64) as f32).collect();
            for (n, found) in darkened(&camera, &depth).iter().enumerate() {
                let expected = expected(step, (n % width) as i64, spacing);
                let apart = (f64::from(*found) - expected).abs();
                assert!(apart <= most, "{spacing} mm, step of {height} mm, pixel {n}: {found}, {expected}");
                assert!(n % width >= width / 2 || *found == 0.0, "the nearer side stays");
            }
        }
    }
}

#[test]
fn a_plane_is_not_darkened() {
    for spacing in [0.1, 0.7, 5.0] {
        let camera = front([90, 70], spacing);
        let plane =
            |n: usize| (20.0 + 0.4 * spacing * (n % 90) as f64 - 0.3 * spacing * (n / 90) as f64) as f32;
        let found = darkened(&camera, &(0..90 * 70).map(plane).collect::<Vec<_>>());
        let margin = (20.0 / spacing) as usize;
        let inner = |n: &usize| {
            (margin..90 - margin.min(89)).contains(&(n % 90))
                && (margin..70 - margin.min(69)).contains(&(n / 90))
        };
        assert!((0..90 * 70).filter(inner).all(|n| found[n] == 0.0), "{spacing} mm");
    }
}

fn framed(scene: &Scene, camera: &Camera, settings: &Settings) -> Frame {
    let images = ImageSet::ALL.and(ImageSet::of(&[Image::Focus]));
    CpuRenderer::default().render(scene, &Request { images, ..Request::new(camera, settings) }).unwrap()
}

#[test]
fn lumen_and_wall_keep_their_grey_to_the_bit() {
    let camera = view([0.2, 1.0, 0.3], [160, 120], 0.7);
    for phantom in [crossing().unwrap(), y_junction().unwrap()] {
        let scene = Scene::new(phantom.volume().unwrap(), phantom.tree.clone());
        let plain = Settings::default();
        let dark = Settings { occlusion: 1.0, ..plain.clone() };
        let [before, after] = [&plain, &dark].map(|settings| framed(&scene, &camera, settings));
        let leveled = LeveledTree::new(phantom.tree.clone());
        let details = CpuRenderer::default().details(&leveled, &Request::new(&camera, &plain)).unwrap();
        assert_eq!((before.depth(), &before.vessel), (after.depth(), &after.vessel));
        let mut kept = [0, 0];
        for n in 0..before.image.len() {
            let is_lumen = details.sheet[n][2] > 0.0;
            if after.focus[n][3] == 0.0 {
                assert_eq!(before.image[n], after.image[n], "pixel {n}");
                kept[0] += usize::from(is_lumen);
            } else {
                assert!(!is_lumen, "lumen at pixel {n}");
                assert!(after.image[n][2] <= before.image[n][2], "pixel {n}");
                kept[1] += usize::from(after.image[n] != before.image[n]);
            }
        }
        assert!(kept[0] > 500, "lumen, and darker pixels beyond: {kept:?}");
    }
}

#[test]
fn without_occlusion_the_stage_does_not_run() {
    let phantom = crossing().unwrap();
    let scene = Scene::new(phantom.volume().unwrap(), phantom.tree.clone());
    let camera = front([40, 30], 1.5);
    for (occlusion, runs) in [(0.0, false), (0.6, true)] {
        let settings = Settings { occlusion, silhouette_reach: None, ..Settings::default() };
        let frame = CpuRenderer::default().render(&scene, &Request::new(&camera, &settings)).unwrap();
        assert_eq!(frame.timings.iter().any(|timing| timing.stage == "occlusion"), runs);
    }
}
