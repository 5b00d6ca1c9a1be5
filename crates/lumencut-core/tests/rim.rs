//! The rim against closed forms; lumen, wall and bright pixels keep their grey to the bit.
#![allow(clippy::unwrap_used)]

use glam::DVec3;
use lumencut_core::error::ErrorKind;
use lumencut_core::frame::Frame;
use lumencut_core::math::leaps::LUMEN;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::Scene;
use lumencut_core::settings::{LevelChoice, RimValue, Settings};
use lumencut_core::stages::rim::RimColors;
use lumencut_core::stages::{Image, ImageSet};
use lumencut_core::vessel_tree::{Vessel, VesselTree};
use lumencut_phantom::{Phantom, calcified_wall, crossing, straight_tube, y_junction};
use lumencut_scenes::trees::tree;
use lumencut_scenes::views::{front, view};

const IMAGES: ImageSet = ImageSet::of(&[Image::Picture, Image::Rim, Image::Leap, Image::Value]);

fn with_rim() -> Settings {
    Settings { rim: Some(RimValue::Diameter), ..Settings::default() }
}

/// A straight vessel along z from −40 to 40 mm, whose radius grows from 1 to 5 mm.
fn cone() -> VesselTree {
    let steps = (0..=80).map(f64::from);
    let points = steps.clone().map(|n| DVec3::Z * (n - 40.0)).collect();
    tree(vec![Vessel::new(points, Some(steps.map(|n| 1.0 + n / 20.0).collect())).unwrap()])
}

/// One colour per mm: red states the arc length.
fn ruler() -> RimColors {
    RimColors::new(&[(0..=80).map(|n| [n, 0, 200, 255]).collect()])
}

#[test]
fn colours_of_a_cone_follow_its_arc_length_in_a_band_beside_its_wall() {
    for (settings, spacing) in [
        (with_rim(), 0.5),
        (Settings { level_choice: LevelChoice::Nearest, levels: 0, ..with_rim() }, 0.5),
        (Settings { lumen_margin: 2.5, ..with_rim() }, 0.4),
        (Settings { centerline_smoothing: 2.0, ..with_rim() }, 1.6),
        (Settings { lumen_first: false, ..with_rim() }, 0.7),
    ] {
        let (camera, colors) = (front([61, 91], spacing), ruler());
        let request = Request {
            images: ImageSet::of(&[Image::Rim]),
            rim: Some(&colors),
            ..Request::new(&camera, &settings)
        };
        let frame = CpuRenderer::default().render(&Scene::default().with_tree(cone()), &request).unwrap();
        let near = 1.2f64.max(settings.lumen_margin + 0.2) + spacing / 2.0;
        let far = near + 1.6f64.max(2.0 * spacing);
        let mut coloured = 0;
        for (place, rim) in frame.rim.iter().enumerate() {
            let [x, z] = [camera.view_x(place % 61), camera.view_y(place / 61)];
            let (along, beyond) = (z + 40.0, x.abs() - (3.0 + z / 20.0));
            if !(1.0..79.0).contains(&along) {
                continue;
            }
            let share = |inside: f64| (inside / spacing + 0.5).clamp(0.0, 1.0);
            let expected = 0.9 * 255.0 * share(beyond - near) * share(far - beyond);
            assert!((f64::from(rim[3]) - expected).abs() <= 1.0, "{x}, {z}: {rim:?}, {expected}");
            if rim[3] > 0 {
                assert!((f64::from(rim[0]) - along).abs() <= 0.51, "{x}, {z}: {rim:?}");
                assert_eq!([rim[1], rim[2]], [0, 200]);
                coloured += 1;
            }
        }
        assert!(coloured > 80, "{coloured} pixels have a colour");
    }
}

fn both(phantom: &Phantom, spacing: f64) -> [Frame; 2] {
    let scene = Scene::new(phantom.volume().unwrap(), phantom.tree.clone());
    let camera = view([0.3, 1.0, 0.2], [96, 80], spacing);
    let colors = RimColors::new(&vec![vec![[0, 255, 40, 255]; 9]; phantom.tree.vessels().len()]);
    [Settings::default(), with_rim()].map(|settings| {
        let request = Request { images: IMAGES, rim: Some(&colors), ..Request::new(&camera, &settings) };
        CpuRenderer::default().render(&scene, &request).unwrap()
    })
}

#[test]
fn lumen_calcium_and_all_that_is_no_rim_keep_their_bytes() {
    for phantom in [straight_tube(), crossing(), y_junction(), calcified_wall()] {
        let phantom = phantom.unwrap();
        for spacing in [0.3, 0.8, 2.0] {
            let [plain, rimmed] = both(&phantom, spacing);
            let mut changed = 0;
            for place in 0..plain.image.len() {
                let is_kept = plain.leap[place] & LUMEN != 0 || rimmed.rim[place][3] == 0;
                let (before, after) = (plain.image[place], rimmed.image[place]);
                assert!(!is_kept || before == after, "{}, pixel {place}", phantom.name);
                changed += usize::from(before != after);
            }
            assert_eq!(plain.value.len(), rimmed.value.len());
            assert!(changed > 50, "{}: {changed} pixels of the rim", phantom.name);
        }
    }
}

#[test]
fn what_is_brighter_than_nine_tenths_has_no_rim() {
    let phantom = straight_tube().unwrap();
    let scene = Scene::new(phantom.volume().unwrap(), phantom.tree.clone());
    let (camera, colors) = (front([96, 80], 0.8), RimColors::new(&[vec![[0, 255, 40, 255]]]));
    let pictures = [None, Some(RimValue::Diameter)].map(|rim| {
        // Everything is white.
        let window = lumencut_core::settings::Window { level: -5000.0, width: 10.0 };
        let settings = Settings { rim, window, ..Settings::default() };
        let request = Request { rim: Some(&colors), ..Request::new(&camera, &settings) };
        CpuRenderer::default().render(&scene, &request).unwrap().image
    });
    assert_eq!(pictures[0], pictures[1]);
}

#[test]
fn a_rim_without_values_is_refused() {
    let phantom = crossing().unwrap();
    let scene = Scene::new(phantom.volume().unwrap(), phantom.tree.clone());
    let (camera, settings, colors) = (front([8, 8], 1.0), with_rim(), ruler());
    for rim in [None, Some(&colors)] {
        let request = Request { rim, ..Request::new(&camera, &settings) };
        let error = CpuRenderer::default().render(&scene, &request).unwrap_err();
        assert_eq!((error.kind, error.subject.as_str()), (ErrorKind::Settings, "rim"));
    }
    let settings = Settings { preserve_lumen: false, ..with_rim() };
    assert_eq!(settings.check().unwrap_err().subject, "rim");
}
