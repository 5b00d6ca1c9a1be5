//! Images by the paper's rules are bit-identical to those of the version that had only these rules.
#![allow(clippy::unwrap_used)]

use lumencut_core::camera::Camera;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::Scene;
use lumencut_core::settings::Settings;
use lumencut_core::stages::silhouette::{SilhouetteParameters, silhouette};
use lumencut_core::vessel_tree::{Vessel, VesselTree};
use lumencut_scenes::random_tree::random_tree;
use lumencut_scenes::trees::{tree, trefoil, vessel};
use lumencut_scenes::views::{on_cpu, view};

fn hash(bytes: impl IntoIterator<Item = u8>) -> u64 {
    bytes.into_iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

fn of_numbers(numbers: &[f32]) -> u64 {
    hash(numbers.iter().flat_map(|number| number.to_bits().to_le_bytes()))
}

/// Hashes of depth, vessel, distance and strength of the silhouettes.
fn hashes(scene: &VesselTree, camera: &Camera, settings: &Settings) -> [u64; 4] {
    let shown = Scene::default().with_tree(scene.clone());
    let frame = CpuRenderer::default().render(&shown, &Request::new(camera, settings)).unwrap();
    let mut strength = vec![0.0; frame.vessel.len()];
    let parameters = SilhouetteParameters::new(settings, camera);
    silhouette(&on_cpu(camera), &parameters, frame.depth(), &frame.vessel, &mut strength).unwrap();
    let vessels = hash(frame.vessel.iter().flat_map(|id| id.to_le_bytes()));
    [of_numbers(frame.depth()), vessels, of_numbers(&frame.distance), of_numbers(&strength)]
}

fn without_radii(scene: &VesselTree) -> VesselTree {
    let bare = |v: &Vessel| Vessel::new(v.points().to_vec(), None).unwrap();
    tree(scene.vessels().iter().map(bare).collect())
}

fn collinear() -> VesselTree {
    let step = [[-40., 0., -40.], [0., 0., -40.], [0., 30., -40.], [0., 30., 40.], [40., 0., 40.]];
    let axis = [[20., 9., -50.], [20., 9., 0.], [20., 9., 50.]];
    tree(vec![vessel(&step, 3.0), vessel(&axis, 2.0)])
}

fn scenes() -> [(&'static str, VesselTree); 5] {
    let random = random_tree(41, 14, 60, 2.0, 70.0).unwrap();
    [
        ("trefoil", trefoil(240)),
        ("without radii", without_radii(&random)),
        ("random", random),
        ("dense", random_tree(42, 90, 25, 2.0, 60.0).unwrap()),
        ("collinear", collinear()),
    ]
}

/// The paper's rules, and the same with some other settings changed.
fn rules() -> [Settings; 5] {
    let paper = Settings::paper;
    [
        paper(),
        Settings { depth_filter: false, cost_weight: 3.0, ..paper() },
        Settings { levels: 0, ..paper() },
        Settings { levels: 15, level_distance: 2.0, silhouette_slope: 3.0, ..paper() },
        Settings { preserve_lumen: false, cost_weight: 100.0, ..paper() },
    ]
}

#[test]
fn of_cut_surfaces_are_those_that_are_stored() {
    let stored = include_str!("paper.txt").lines().filter(|line| !line.starts_with('#'));
    let mut found = Vec::new();
    for (name, scene) in scenes() {
        for (n, settings) in rules().iter().enumerate() {
            let direction = [[0.0, 1.0, 0.0], [1.0, 2.0, 3.0], [-3.0, 1.0, -0.5]][n % 3];
            let [depth, vessel, distance, strength] =
                hashes(&scene, &view(direction, [121, 90], 1.3), settings);
            found.push(format!("{name} {n}: {depth:016x} {vessel:016x} {distance:016x} {strength:016x}"));
        }
    }
    let found_text = found.join("\n");
    assert!(
        found.iter().map(String::as_str).eq(stored),
        "found other images than those stored:\n{found_text}"
    );
}
