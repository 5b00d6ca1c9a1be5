//! Chosen vessels, compared with pictures of only these vessels, with plain pictures, and with closed forms.
#![allow(clippy::unwrap_used)]

use glam::DVec3;
use lumencut_core::camera::Camera;
use lumencut_core::error::ErrorKind;
use lumencut_core::frame::Frame;
use lumencut_core::math::lanes::Isa;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::Scene;
use lumencut_core::settings::{Focus, LevelChoice, Settings};
use lumencut_core::stages::{Image, ImageSet};
use lumencut_core::vessel_tree::{Vessel, VesselTree};
use lumencut_phantom::{Phantom, crossing};
use lumencut_scenes::brute_force::{by_brute_force, by_hierarchy};
use lumencut_scenes::compare::different_pixels;
use lumencut_scenes::pictures::context_alone;
use lumencut_scenes::random_tree::random_tree;
use lumencut_scenes::settings::unfiltered;
use lumencut_scenes::trees::{tree, vessel};
use lumencut_scenes::views::{front, pixel, view};

const IMAGES: ImageSet = ImageSet::ALL.and(ImageSet::of(&[Image::Focus, Image::Leap]));

fn rendered(renderer: &mut CpuRenderer, scene: &Scene, camera: &Camera, settings: &Settings) -> Frame {
    renderer.render(scene, &Request { images: IMAGES, ..Request::new(camera, settings) }).unwrap()
}

fn shown(phantom: &Phantom, camera: &Camera, settings: &Settings) -> Frame {
    let scene = Scene::new(phantom.volume().unwrap(), phantom.tree.clone());
    rendered(&mut CpuRenderer::default(), &scene, camera, settings)
}

fn cut(tree: &VesselTree, camera: &Camera, settings: &Settings) -> Frame {
    rendered(&mut CpuRenderer::default(), &Scene::default().with_tree(tree.clone()), camera, settings)
}

/// A thick tube in front of a thin one that crosses it 60 mm behind.
fn crossing_tubes() -> VesselTree {
    tree(vec![
        vessel(&[[-80.0, 0.0, 0.0], [80.0, 0.0, 0.0]], 10.0),
        vessel(&[[0.0, 60.0, -80.0], [0.0, 60.0, 80.0]], 3.0),
    ])
}

fn choosing(vessels: &[usize]) -> Settings {
    Settings { focus_vessels: vessels.to_vec(), ..Settings::default() }
}

#[test]
fn a_chosen_vessel_behind_another_shows_its_lumen_and_its_wall() {
    let camera = front([160, 160], 0.5);
    for level_choice in [LevelChoice::Own, LevelChoice::Nearest] {
        let settings = Settings { depth_filter: false, level_choice, ..choosing(&[1]) };
        let frame = cut(&crossing_tubes(), &camera, &settings);
        for (x, expected) in [(0.2, 1), (2.9, 1), (3.9, 1), (4.3, 0), (9.0, 0)] {
            let at = pixel(&frame, x, 3.0);
            assert_eq!(frame.vessel[at], expected, "{x} mm beside its centerline");
            assert_eq!(frame.depth()[at], if expected == 1 { 60.0 } else { 0.0 });
        }
        let plain = cut(&crossing_tubes(), &camera, &Settings { focus_vessels: Vec::new(), ..settings });
        assert_eq!(plain.vessel[pixel(&plain, 0.2, 3.0)], 0, "it lies behind");
    }
}

#[test]
fn a_chosen_vessel_is_seen_wherever_its_own_cut_would_be_if_it_were_alone() {
    for seed in 0..5 {
        let all = random_tree(seed, 9, 12, 4.0, 60.0).unwrap();
        // If a vessel begins or ends in another's lumen, only a part of it takes precedence.
        let chosen = (0..9).find(|n| is_free(&all, *n)).unwrap();
        let alone = tree(vec![all.vessels()[chosen].clone()]);
        let camera = view([0.3, 1.0, -0.2], [150, 130], 1.0);
        let settings = Settings { depth_filter: false, ..choosing(&[chosen]) };
        let [found, own] = [
            cut(&all, &camera, &settings),
            cut(&alone, &camera, &Settings { focus_vessels: Vec::new(), silhouette_reach: None, ..settings }),
        ];
        let mut pixels = 0;
        for n in 0..own.vessel.len() {
            // Up to 1 mm (the assumed wall) beyond its lumen, the chosen vessel is shown.
            let edge = beyond(&alone, &camera, n);
            if edge < 0.999 {
                assert_eq!(found.vessel[n], chosen as i32, "seed {seed}, pixel {n}");
                assert_eq!(found.depth()[n], own.depth()[n], "seed {seed}, pixel {n}");
                pixels += 1;
            }
        }
        assert!(pixels > 50, "{pixels} pixels of the vessel");
    }
}

/// Whether both ends of a vessel lie outside all others, tested with many balls along the others.
fn is_free(all: &VesselTree, chosen: usize) -> bool {
    let points = all.vessels()[chosen].points();
    let ends = [points[0], points[points.len() - 1]];
    let others = all.vessels().iter().enumerate().filter(|(n, _)| *n != chosen);
    let mut balls = others.flat_map(|(_, other)| {
        (0..other.points().len() - 1).flat_map(|n| {
            let [a, b] = [n, n + 1].map(|n| (other.points()[n], other.radius_or_zero(n)));
            (0..=100).map(f64::from).map(move |t| (a.0.lerp(b.0, t / 100.0), a.1 + (b.1 - a.1) * t / 100.0))
        })
    });
    balls.all(|(center, radius)| ends.iter().all(|end| end.distance(center) > radius))
}

/// Distance of a pixel beyond the wall of a tree's only vessel (mm, negative inside), from every segment.
fn beyond(tree: &VesselTree, camera: &Camera, n: usize) -> f64 {
    let [width, _] = camera.size();
    let place = glam::DVec2::new(camera.view_x(n % width), camera.view_y(n / width));
    let vessel = &tree.vessels()[0];
    let segments = vessel.points().windows(2).enumerate().map(|(i, ends)| {
        let [from, to] = [ends[0], ends[1]].map(|point| camera.view_from_world(point).truncate());
        let along = to - from;
        let t = ((place - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        let radius = vessel.radius_or_zero(i) * (1.0 - t) + vessel.radius_or_zero(i + 1) * t;
        (place - from - along * t).length() - radius
    });
    segments.fold(f64::MAX, f64::min)
}

/// A tube across the view, a branch of the same radius up from its middle, and a tube before the branch.
fn branching() -> VesselTree {
    let across = vessel(&[[-80.0, 0.0, 0.0], [0.0, 0.0, 0.0], [80.0, 0.0, 0.0]], 10.0);
    let points = (0..=60).map(|n| DVec3::new(0.0, 0.0, f64::from(n)));
    let radii = (0..=60).map(|n: i32| f64::from(10 - n).clamp(3.0, 10.0));
    let branch = Vessel::new(points.collect(), Some(radii.collect())).unwrap();
    tree(vec![across, branch, vessel(&[[-80.0, -30.0, 30.0], [80.0, -30.0, 30.0]], 6.0)])
}

#[test]
fn a_chosen_branch_comes_first_from_where_it_leaves_its_parent() {
    let camera = front([160, 160], 0.5);
    let mut reversed = branching().vessels().to_vec();
    let points = reversed[1].points().iter().rev().copied().collect();
    let radii = reversed[1].radius().map(|radii| radii.iter().rev().copied().collect());
    reversed[1] = Vessel::new(points, radii).unwrap();
    for scene in [branching(), tree(reversed)] {
        let frame = cut(&scene, &camera, &choosing(&[1]));
        let shown = |x: f64, y: f64| frame.vessel[pixel(&frame, x, y)];
        // The branch's first disc does not cover the parent: neither next to the branch nor opposite.
        assert_eq!([shown(6.2, 0.2), shown(-6.2, 3.0), shown(0.2, -8.0), shown(0.2, 6.0)], [0; 4]);
        // Outside the parent the branch is seen, also through the tube that lies before it.
        assert_eq!([shown(0.2, 13.0), shown(0.2, 30.0), shown(2.6, 33.0), shown(0.2, 55.0)], [1; 4]);
        assert_eq!(shown(20.0, 30.0), 2);
    }
    // If the parent is chosen too, all of the branch takes precedence.
    let both = cut(&branching(), &camera, &choosing(&[0, 1]));
    let alone = cut(&tree(branching().vessels()[..2].to_vec()), &camera, &Settings::default());
    for y in [-8.0, 0.2, 6.0, 13.0, 55.0] {
        let at = [&both, &alone].map(|frame| pixel(frame, 0.2, y));
        assert_eq!(both.vessel[at[0]], alone.vessel[at[1]], "{y} mm above");
    }
}

#[test]
fn a_chosen_vessel_that_leaves_no_other_comes_first_as_a_whole() {
    // The inner vessel lies entirely within the thick one, and behind its centerline.
    let inner = vessel(&[[-20.0, 4.0, 0.0], [20.0, 4.0, 0.0]], 3.0);
    let scene = tree(vec![vessel(&[[-80.0, 0.0, 0.0], [80.0, 0.0, 0.0]], 10.0), inner]);
    let frame = cut(&scene, &front([160, 160], 0.5), &choosing(&[1]));
    let shown = |x: f64| frame.vessel[pixel(&frame, x, 0.2)];
    assert_eq!([shown(-19.0), shown(0.2), shown(19.0), shown(30.0)], [1, 1, 1, 0]);
}

#[test]
fn all_vessels_or_none_set_none_apart_to_the_bit() {
    let phantom = crossing().unwrap();
    let camera = view([0.2, 1.0, 0.3], [120, 100], 0.9);
    let count = phantom.tree.vessels().len();
    let focus = Some(Focus { margin: 1.0, fade: 8.0 });
    for base in [
        Settings { focus, ..Settings::default() },
        Settings::default(),
        Settings { silhouettes: false, ..Settings::default() },
    ] {
        let plain = shown(&phantom, &camera, &base);
        for chosen in [Vec::new(), (0..count).collect::<Vec<_>>(), (0..count).rev().chain([0]).collect()] {
            let settings = Settings { focus_vessels: chosen, others_strength: 0.25, ..base.clone() };
            let found = shown(&phantom, &camera, &settings);
            assert_eq!((&found.image, &found.vessel), (&plain.image, &plain.vessel));
            assert_eq!(different_pixels(&found, &plain), 0);
        }
    }
}

#[test]
fn the_hierarchy_finds_what_every_piece_finds() {
    for (seed, vessels) in [(1, 3), (2, 12), (3, 60)] {
        let scene = random_tree(seed, vessels, 30, 3.0, 80.0).unwrap();
        for direction in [[0.0, 1.0, 0.0], [1.0, 2.0, 3.0], [1e-5, 1e-5, 1.0]] {
            for level_choice in [LevelChoice::Own, LevelChoice::Nearest] {
                let camera = view(direction, [120, 88], 1.7);
                let focus_vessels = (0..vessels).step_by(3).collect();
                let settings = Settings { focus_vessels, level_choice, ..unfiltered() };
                let [found, expected] =
                    [by_hierarchy(&scene, &camera, &settings), by_brute_force(&scene, &camera, &settings)];
                assert_eq!(different_pixels(&found, &expected), 0, "seed {seed} from {direction:?}");
            }
        }
    }
}

#[test]
fn a_choice_holds_for_its_view_alone() {
    let (camera, scene) = (front([80, 80], 1.0), Scene::default().with_tree(crossing_tubes()));
    let mut renderer = CpuRenderer::default();
    let first = rendered(&mut renderer, &scene, &camera, &Settings::default());
    let chosen = rendered(&mut renderer, &scene, &camera, &choosing(&[1]));
    let again = rendered(&mut renderer, &scene, &camera, &Settings::default());
    assert_eq!(different_pixels(&first, &again), 0);
    assert!(different_pixels(&first, &chosen) > 100);
}

#[test]
fn the_strength_of_the_others_is_their_share_beside_that_of_the_chosen() {
    let phantom = crossing().unwrap();
    let camera = view([0.2, 1.0, 0.3], [140, 110], 0.8);
    let focus = Some(Focus { margin: 2.0, fade: 6.0 });
    let with = |others_strength: f64| {
        let settings = Settings {
            focus,
            focus_vessels: vec![0],
            others_strength,
            silhouettes: true,
            ..Settings::default()
        };
        shown(&phantom, &camera, &settings)
    };
    let of_surface = |frame: &Frame| frame.focus.iter().map(|shares| shares[0]).collect::<Vec<_>>();
    let plain = of_surface(&shown(&phantom, &camera, &Settings { focus, ..Settings::default() }));
    let one = tree(vec![phantom.tree.vessels()[0].clone()]);
    let scene = Scene::new(phantom.volume().unwrap(), one);
    let around_the_chosen = of_surface(&rendered(
        &mut CpuRenderer::default(),
        &scene,
        &camera,
        &Settings { focus, ..Settings::default() },
    ));
    assert_eq!(of_surface(&with(1.0)), plain, "the others are as before");
    assert_eq!(of_surface(&with(0.0)), around_the_chosen, "the others are gone");
    let half: Vec<f32> = plain.iter().zip(&around_the_chosen).map(|(all, own)| own.max(all * 0.5)).collect();
    assert_eq!(of_surface(&with(0.5)), half);
    assert!(half.contains(&0.5) && half.contains(&1.0));
    // Where nothing of the cut surface is shown, the picture is the context.
    let (gone, alone) = (
        with(0.0),
        context_alone(phantom.volume().unwrap(), &camera, &Settings::default(), &|| false).unwrap(),
    );
    let whole = Settings { focus, focus_vessels: vec![0], others_strength: 0.0, ..whole_rays() };
    let found = shown(&phantom, &camera, &whole);
    let context: Vec<usize> = (0..found.image.len()).filter(|n| found.focus[*n][0] == 0.0).collect();
    assert!(context.len() > 500);
    assert!(context.iter().all(|n| found.image[*n] == alone.image[*n]));
    assert_eq!(gone.focus, found.focus);
}

/// Settings in which context rays around a focus cross the entire volume.
fn whole_rays() -> Settings {
    let context = Settings::default().context.unwrap();
    let context =
        lumencut_core::settings::Context { from: lumencut_core::settings::ContextFrom::Whole, ..context };
    Settings { context: Some(context), ..Settings::default() }
}

#[test]
fn the_outline_of_a_chosen_vessel_is_drawn_whatever_silhouettes_say() {
    // The tubes are 15 mm apart, less than the diameter of the thick one, so there is no other depth jump.
    let near = tree(vec![
        vessel(&[[-80.0, 0.0, 0.0], [80.0, 0.0, 0.0]], 10.0),
        vessel(&[[0.0, 15.0, -80.0], [0.0, 15.0, 80.0]], 3.0),
    ]);
    let camera = front([100, 100], 0.5);
    for silhouettes in [true, false] {
        let frame = cut(&near, &camera, &Settings { silhouettes, ..choosing(&[1]) });
        let row = pixel(&frame, 0.0, 2.0) / 100 * 100;
        let leaps: Vec<usize> = (0..99).filter(|i| frame.leap[row + i] & 1 != 0).collect();
        // The chosen vessel's wall ends 4 mm from its centerline: between columns 41 and 42, and 57 and 58.
        assert_eq!(leaps, [41, 57]);
    }
    let picture = shown(
        &crossing().unwrap(),
        &front([100, 100], 0.8),
        &Settings { silhouettes: false, silhouette_color: [255, 0, 0], context: None, ..choosing(&[1]) },
    );
    assert!(picture.image.iter().any(|pixel| pixel[0] > 100 && pixel[1] < 90), "a red line");
}

#[test]
fn all_instruction_sets_give_the_same_bits() {
    let scene = Scene::default().with_tree(random_tree(3, 40, 30, 4.0, 60.0).unwrap());
    let camera = view([0.1, 0.9, 0.3], [203, 111], 0.7);
    let settings = Settings { focus: Some(Focus::default()), ..choosing(&[1, 7, 30]) };
    let frames: Vec<Frame> = Isa::available()
        .into_iter()
        .map(|isa| rendered(&mut CpuRenderer::new(isa), &scene, &camera, &settings))
        .collect();
    for frame in &frames {
        assert_eq!(different_pixels(frame, &frames[0]), 0);
        assert_eq!(frame.focus, frames[0].focus);
        assert_eq!(frame.leap, frames[0].leap);
    }
}

#[test]
fn vessels_that_are_not_there_and_rules_without_tiers_are_refused() {
    let camera = front([9, 9], 1.0);
    let scene = Scene::default().with_tree(crossing_tubes());
    let refused = |scene: &Scene, settings: &Settings| {
        CpuRenderer::default().render(scene, &Request::new(&camera, settings)).unwrap_err()
    };
    let error = refused(&scene, &choosing(&[0, 2]));
    assert_eq!((error.kind, error.subject.as_str()), (ErrorKind::Settings, "focus_vessels"));
    assert!(error.to_string().contains("vessel 2 in a tree of 2; expected ids from 0 to 1"), "{error}");
    let error = refused(&scene, &Settings { focus_vessels: vec![1], ..Settings::paper() });
    assert!(error.to_string().contains("chosen vessels without lumen_first"), "{error}");
    let phantom = crossing().unwrap();
    let error = refused(&Scene::default().with_volume(phantom.volume().unwrap()), &choosing(&[0]));
    assert!(error.to_string().contains("chosen vessels for a scene without centerlines"), "{error}");
    for others_strength in [-0.1, 1.1, f64::NAN] {
        let error = Settings { others_strength, ..Settings::default() }.check().unwrap_err();
        assert_eq!(error.subject, "others_strength");
    }
}
