//! Complete frames of small phantoms compared with the CPU's, also with a single stage on the GPU.

use std::sync::Arc;

use lumencut_core::camera::Camera;
use lumencut_core::error::ErrorKind;
use lumencut_core::frame::Frame;
use lumencut_core::math::leaps::LEAPS;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::{Scene, SharedVolume, VolumeKey};
use lumencut_core::settings::{
    Context, ContextFrom, DistanceRule, Focus, LevelChoice, Opacity, RimValue, Settings, SilhouetteRule,
    Slab, SlabMode,
};
use lumencut_core::stages::{Image, ImageSet, Stage};
use lumencut_phantom::{Phantom, collinear_run, crossing, trefoil, y_junction};
use lumencut_scenes::pictures::context_alone;
use lumencut_scenes::random_tree::random_tree;
use lumencut_scenes::tolerances::{COST, DEPTH, LEVEL};
use lumencut_scenes::views::{front, view};

use super::both_sides::{BothSides, assert_same};
use super::{shared, ties};
use crate::on_cpu::on_either;
use crate::renderer::GpuRenderer;

const SIZE: [usize; 2] = [96, 80];
/// At single pixels two pieces of the trefoil knot are equally near, and the depth filter spreads each
/// difference over nine pixels. In smaller pictures these would exceed a thousandth.
const KNOT_SIZE: [usize; 2] = [130, 108];

fn with(change: impl Fn(&mut Settings)) -> Settings {
    let mut settings = Settings::default();
    change(&mut settings);
    settings
}

fn all_settings() -> Vec<(&'static str, Settings)> {
    vec![
        ("default", Settings::default()),
        ("the paper's", Settings::paper()),
        ("own levels by cost", with(|s| s.lumen_first = false)),
        ("the whole curve", Settings { distance_rule: DistanceRule::WholeCurve, ..Settings::paper() }),
        ("lumen first, nearest", with(|s| s.level_choice = LevelChoice::Nearest)),
        ("many own levels", with(|s| (s.levels, s.level_distance) = (15, 1.0))),
        ("no wall, no radius", with(|s| (s.lumen_margin, s.preserve_lumen) = (0.0, false))),
        ("gradients of own levels", with(|s| s.silhouette_rule = SilhouetteRule::Gradient)),
        (
            "leaps of the paper's levels",
            Settings { silhouette_rule: SilhouetteRule::Leap, ..Settings::paper() },
        ),
        ("quiet centerlines", with(|s| s.centerline_smoothing = 0.5)),
        ("one level", with(|s| s.levels = 0)),
        ("no filter", with(|s| s.depth_filter = false)),
        ("filter over the whole image", with(|s| s.zone_filter = false)),
        ("filter within the paper's zones", Settings { zone_filter: true, ..Settings::paper() }),
        ("small leaps", with(|s| s.depth_leap = 0.2)),
        ("slab", with(|s| s.slab = Some(Slab { thickness: 4.0, mode: SlabMode::Max }))),
        ("focus", with(|s| s.focus = Some(Focus::default()))),
        ("a chosen vessel", with(|s| s.focus_vessels = vec![0])),
        (
            "a chosen vessel on the paper's levels",
            with(|s| (s.focus_vessels, s.level_choice) = (vec![0], LevelChoice::Nearest)),
        ),
        (
            "a chosen vessel in a focus",
            with(|s| {
                (s.focus, s.focus_vessels, s.others_strength) = (Some(Focus::default()), vec![0], 0.3);
            }),
        ),
        ("lines everywhere", with(|s| s.silhouette_reach = None)),
        ("quiet surroundings", with(|s| s.silhouette_reach = Some(3.0))),
        ("focus amid whole rays", with(|s| focus_amid(s, ContextFrom::Whole))),
        ("focus amid rays from the cut", with(|s| focus_amid(s, ContextFrom::Cut))),
        ("a rim of the paper's levels", Settings { rim: Some(RimValue::Diameter), ..Settings::paper() }),
        ("occlusion", with(|s| s.occlusion = 0.6)),
        ("occlusion of the unfiltered depth", with(|s| (s.occlusion, s.depth_filter) = (1.0, false))),
        ("a halo and the body around the focus", with(|s| halo_around(s, &[]))),
        ("a halo around a chosen vessel", with(|s| halo_around(s, &[0]))),
        ("opacity", with(|s| s.opacity = Some(Opacity { transparent: -50.0, opaque: 250.0 }))),
        ("no silhouettes, no context", with(|s| (s.silhouettes, s.context) = (false, None))),
    ]
}

fn halo_around(settings: &mut Settings, chosen: &[usize]) {
    settings.focus = Some(Focus { margin: 0.5, fade: 3.0 });
    settings.focus_vessels = chosen.to_vec();
    settings.context = Some(Context { halo: 0.6, body: true, ..Context::default() });
}

fn focus_amid(settings: &mut Settings, from: ContextFrom) {
    settings.focus = Some(Focus { margin: 0.5, fade: 30.0 });
    settings.opacity = Some(Opacity { transparent: -50.0, opaque: 250.0 });
    settings.context = Some(Context { from, strength: 0.6, ..Context::default() });
}

fn with_all_settings(phantom: Phantom, camera: &Camera) {
    let Some(device) = shared() else { return };
    let mut scene = BothSides::new(device, phantom);
    for (name, settings) in all_settings() {
        println!("{}, {name}", scene.phantom.name);
        scene.check(camera, &settings);
    }
}

#[test]
fn junctions_with_all_settings() {
    with_all_settings(y_junction().unwrap(), &view([0.3, 1.0, 0.2], SIZE, 0.8));
}

#[test]
fn runs_along_the_view_with_all_settings() {
    with_all_settings(collinear_run().unwrap(), &front(SIZE, 0.9));
}

#[test]
fn a_knot_with_all_settings() {
    with_all_settings(trefoil().unwrap(), &front(KNOT_SIZE, 0.52));
}

#[test]
fn each_choice_of_vessels_holds_for_its_view_alone() {
    let Some(device) = shared() else { return };
    let mut scene = BothSides::new(device, crossing().unwrap());
    let camera = view([0.2, 1.0, 0.3], SIZE, 0.8);
    for chosen in [vec![1], Vec::new(), vec![0], vec![0, 1]] {
        println!("{chosen:?}");
        let focus = Some(Focus { margin: 1.0, fade: 9.0 });
        scene.check(&camera, &Settings { focus, focus_vessels: chosen, ..Settings::default() });
    }
}

#[test]
fn pictures_of_all_sizes() {
    let Some(device) = shared() else { return };
    let mut scene = BothSides::new(device, y_junction().unwrap());
    for ((size, spacing), direction) in [([1, 17], 1.0), ([17, 1], 1.0), ([257, 257], 0.4)]
        .into_iter()
        .flat_map(|size| [[0.0, 1.0, 0.0], [0.4, -1.0, 0.3]].map(|direction| (size, direction)))
    {
        println!("{size:?} along {direction:?}");
        scene.check(&view(direction, size, spacing), &Settings::default());
    }
}

#[test]
fn pixels_of_all_sizes() {
    let Some(device) = shared() else { return };
    let mut scene = BothSides::new(device, collinear_run().unwrap());
    for (spacing, direction) in [0.05, 0.2, 2.0, 5.0]
        .into_iter()
        .flat_map(|spacing| [[0.0, 1.0, 0.0], [0.4, -1.0, 0.3]].map(|direction| (spacing, direction)))
    {
        println!("{spacing} mm along {direction:?}");
        scene.check(&view(direction, SIZE, spacing), &Settings::default());
    }
}

fn each_stage() -> impl Iterator<Item = (Stage, Vec<String>)> {
    let others = |stage| on_either().filter(|other| *other != stage).map(|s| s.name().to_owned()).collect();
    on_either().map(move |stage| (stage, others(stage)))
}

/// All features: a filter within zones, slab, silhouettes, focus, rim, and context behind transparent parts.
fn everything() -> Settings {
    with(|s| {
        s.slab = Some(Slab { thickness: 3.0, mode: SlabMode::Mean });
        s.focus = Some(Focus { margin: 1.0, fade: 20.0 });
        (s.rim, s.turning_limit) = (Some(RimValue::Diameter), Some(4.0));
        s.occlusion = 0.6;
        s.context = Some(Context { body: true, ..Context::default() });
        s.opacity = Some(Opacity { transparent: -50.0, opaque: 250.0 });
    })
}

#[test]
fn each_stage_alone() {
    let Some(device) = shared() else { return };
    let mut scene = BothSides::new(device, y_junction().unwrap());
    let (camera, settings) = (view([0.3, 1.0, 0.2], SIZE, 0.8), everything());
    let cpu = scene.on_cpu(&camera, &settings);
    for (stage, others) in each_stage() {
        println!("{stage:?} alone");
        scene.gpu.force_to_cpu(&others).unwrap();
        let gpu = scene.on_gpu(&camera, &settings);
        scene.assert_same(gpu, &cpu, &settings);
        println!("all but {stage:?}");
        scene.gpu.force_to_cpu(&[stage.name().to_owned()]).unwrap();
        let gpu = scene.on_gpu(&camera, &settings);
        assert!(gpu.timings.iter().any(|timing| timing.stage == stage.name()), "{:?}", gpu.timings);
        scene.assert_same(gpu, &cpu, &settings);
    }
    let all: Vec<_> = on_either().map(|stage| stage.name().to_owned()).collect();
    scene.gpu.force_to_cpu(&all).unwrap();
    let all_on_cpu = scene.on_gpu(&camera, &settings);
    assert_eq!(
        (&all_on_cpu.image, all_on_cpu.depth()),
        (&cpu.image, cpu.depth()),
        "nothing to compute on the GPU"
    );
}

#[test]
fn an_unknown_stage_is_refused_and_changes_nothing() {
    let Some(device) = shared() else { return };
    let mut renderer = GpuRenderer::new(Arc::clone(device));
    let error = renderer.force_to_cpu(&["depth".to_owned(), "dept".to_owned()]).unwrap_err();
    assert_eq!((error.kind, error.found.as_str()), (ErrorKind::Settings, "'dept'"));
    assert!(on_either().all(|stage| error.expected.contains(stage.name())), "{error}");
    renderer.force_to_cpu(&[]).unwrap();
}

#[test]
fn a_volume_alone() {
    let Some(device) = shared() else { return };
    let phantom = trefoil().unwrap();
    let volume = phantom.volume().unwrap();
    let mut gpu = GpuRenderer::new(Arc::clone(device));
    let settings = Settings::default();
    let cases = [
        (front(SIZE, 0.7), settings.clone()),
        (view([0.4, -1.0, 0.3], [1, 17], 2.0), settings.clone()),
        (front(SIZE, 0.7), Settings { context: None, ..settings.clone() }),
        (
            front(SIZE, 1.1),
            Settings { context: Some(Context { shading: true, ..Context::default() }), ..settings },
        ),
    ];
    for (camera, settings) in &cases {
        let cpu = context_alone(volume, camera, settings, &|| false).unwrap();
        let scene = Scene::default().with_volume(volume);
        let frame = pollster::block_on(gpu.render(&scene, &Request::new(camera, settings))).unwrap();
        assert_same(&frame, &cpu);
    }
    let (nothing, request) = (Scene::default(), Request::new(&cases[0].0, &cases[0].1));
    assert_eq!(pollster::block_on(gpu.render(&nothing, &request)).unwrap_err().kind, ErrorKind::Volume);
}

#[test]
fn the_cut_surface_alone() {
    let Some(device) = shared() else { return };
    let phantom = trefoil().unwrap();
    let scene = Scene::default().with_tree(phantom.tree);
    let (camera, settings) = (front(KNOT_SIZE, 0.52), Settings::default());
    let request = Request::new(&camera, &settings);
    let cpu = CpuRenderer::default().render(&scene, &request).unwrap();
    let gpu = pollster::block_on(GpuRenderer::new(Arc::clone(device)).render(&scene, &request)).unwrap();
    assert!(gpu.image.is_empty() && gpu.value.is_empty());
    assert_same(&gpu, &cpu);
}

#[test]
fn blends_of_the_cut_surface_are_those_of_the_cpu() {
    let Some(device) = shared() else { return };
    let tree = random_tree(92, 8, 50, 2.0, 50.0).unwrap();
    let (scene, camera) = (Scene::default().with_tree(tree), view([0.3, 1.0, 0.2], SIZE, 1.1));
    let mut renderer = GpuRenderer::new(Arc::clone(device));
    for settings in [Settings::default(), with(|s| s.lumen_first = false), Settings::paper()] {
        for more in [&[][..], &[Image::Leap], &[Image::Distance, Image::Depth]] {
            let images = ImageSet::of(&[Image::Blend]).and(ImageSet::of(more));
            let request = Request { images, ..Request::new(&camera, &settings) };
            let cpu = CpuRenderer::default().render(&scene, &request).unwrap();
            let gpu = pollster::block_on(renderer.render(&scene, &request)).unwrap();
            assert_eq!((gpu.images(), cpu.images()), (images, images));
            let channel = |frame: &Frame, c: usize| frame.blend.iter().map(|b| b[c]).collect::<Vec<_>>();
            for (c, name, tolerance) in [(0, "cost", COST), (1, "level", LEVEL), (2, "piece", DEPTH)] {
                let [found, expected] = [&gpu, &cpu].map(|frame| channel(frame, c));
                assert!(expected.iter().any(|number| *number != expected[0]), "something to compare");
                tolerance.assert_same(&found, &expected, name);
            }
        }
    }
}

#[test]
fn a_view_that_shows_the_volume_has_no_blend() {
    let Some(device) = shared() else { return };
    let mut both = BothSides::new(device, y_junction().unwrap());
    let (camera, settings) = (front(SIZE, 0.8), Settings::default());
    let images = ImageSet::of(&[Image::Blend, Image::Picture]);
    let request = Request { images, ..Request::new(&camera, &settings) };
    let scene = Scene::new(both.phantom.volume().unwrap(), both.phantom.tree.clone());
    let frame = pollster::block_on(both.gpu.render(&scene, &request)).unwrap();
    assert_eq!(frame.images(), ImageSet::of(&[Image::Picture]));
    assert_eq!(CpuRenderer::default().render(&scene, &request).unwrap().images(), frame.images());
}

#[test]
fn looking_where_the_cpu_found_the_cut_surface_shows_the_same() {
    let Some(device) = shared() else { return };
    let both = BothSides::new(device, y_junction().unwrap());
    let (camera, scene) = (view([0.3, 1.0, 0.2], SIZE, 0.8), both.scene());
    let mut gpu = GpuRenderer::new(Arc::clone(device));
    for settings in [Settings { turning_limit: None, ..everything() }, Settings::default()] {
        let request = Request::new(&camera, &settings);
        let cut = Scene { volume: None, ..scene.clone() };
        // Without a volume, a frame has depth jumps and focus shares only if they are requested.
        let images = ImageSet::ALL.and(ImageSet::of(&[Image::Leap, Image::Focus]));
        let surface = CpuRenderer::default().render(&cut, &Request { images, ..request }).unwrap();
        assert!(surface.leap.iter().any(|leap| *leap & LEAPS != 0), "no silhouettes to show");
        let shared = scene.volume.as_ref().unwrap();
        let looked = pollster::block_on(gpu.look(shared, surface, &request)).unwrap();
        assert_same(&looked, &both.on_cpu(&camera, &settings));
    }
}

#[test]
fn a_frame_has_the_images_that_are_asked_for() {
    let Some(device) = shared() else { return };
    let mut both = BothSides::new(device, y_junction().unwrap());
    let (camera, settings) = (front(SIZE, 0.8), Settings::default());
    let whole = both.on_gpu(&camera, &settings);
    assert_eq!(whole.images(), ImageSet::ALL);
    for asked in [&[][..], &[Image::Picture], &[Image::Depth, Image::Value], &[Image::Vessel, Image::Context]]
    {
        let request = Request { images: ImageSet::of(asked), ..Request::new(&camera, &settings) };
        let scene = Scene::new(both.phantom.volume().unwrap(), both.phantom.tree.clone());
        let frame = pollster::block_on(both.gpu.render(&scene, &request)).unwrap();
        assert_eq!(frame.images(), ImageSet::of(asked));
        let expected = whole.clone().keeping(ImageSet::of(asked));
        assert_eq!((&frame.image, &frame.vessel), (&expected.image, &expected.vessel));
        assert_eq!((frame.depth(), &frame.context), (expected.depth(), &expected.context));
    }
}

#[test]
fn another_tree_sends_no_voxels() {
    let Some(device) = shared() else { return };
    let phantom = y_junction().unwrap();
    let (camera, settings) = (front(SIZE, 0.8), Settings::default());
    let request = Request::new(&camera, &settings);
    let first = Scene::new(phantom.volume().unwrap(), phantom.tree.clone());
    let second = first.clone().with_tree(trefoil().unwrap().tree);
    let mut gpu = GpuRenderer::new(Arc::clone(device));
    pollster::block_on(gpu.render(&first, &request)).unwrap();
    let sent = gpu.voxels();
    let exchanged = pollster::block_on(gpu.render(&second, &request)).unwrap();
    assert!(sent.is_some() && gpu.voxels() == sent, "the texture is the same one");
    let fresh = pollster::block_on(GpuRenderer::new(Arc::clone(device)).render(&second, &request)).unwrap();
    assert_eq!((&exchanged.image, exchanged.depth()), (&fresh.image, fresh.depth()));
}

#[test]
fn another_volume_is_shown_and_not_the_first_one_again() {
    let Some(device) = shared() else { return };
    let (one, other) = (y_junction().unwrap(), trefoil().unwrap());
    let (camera, settings) = (front(SIZE, 0.8), Settings::default());
    let request = Request::new(&camera, &settings);
    let mut gpu = GpuRenderer::new(Arc::clone(device));
    for phantom in [&one, &other, &one] {
        let scene = Scene::new(phantom.volume().unwrap(), one.tree.clone());
        let cpu = CpuRenderer::default().render(&scene, &request).unwrap();
        assert_same(&pollster::block_on(gpu.render(&scene, &request)).unwrap(), &cpu);
    }
}

#[test]
fn a_view_leaves_nothing_behind_for_the_next() {
    let Some(device) = shared() else { return };
    let mut used = BothSides::new(device, y_junction().unwrap());
    let few_levels = with(|s| (s.levels, s.depth_filter) = (2, false));
    let views = [
        (view([0.3, 1.0, 0.2], SIZE, 0.8), few_levels),
        (view([-0.5, 1.0, 0.4], [70, 90], 0.6), everything()),
        (front([96, 33], 1.3), Settings { silhouettes: false, context: None, ..Settings::paper() }),
        (front(SIZE, 0.8), Settings::default()),
    ];
    for (camera, settings) in &views {
        let mut fresh = BothSides::new(device, y_junction().unwrap());
        let (a, b) = (used.on_gpu(camera, settings), fresh.on_gpu(camera, settings));
        assert_eq!((&a.image, &a.context, &a.vessel), (&b.image, &b.context, &b.vessel));
        assert_eq!((a.depth(), &a.distance), (b.depth(), &b.distance));
    }
}

#[test]
fn the_context_of_another_volume_leaves_the_cut_surface_alone() {
    let Some(device) = shared() else { return };
    let phantom = y_junction().unwrap();
    let scan = Scene::new(phantom.volume().unwrap(), phantom.tree.clone());
    let voxels: Vec<i16> = phantom.voxels.iter().map(|value| value * 9 - 20_000).collect();
    let around = Phantom { voxels, ..phantom.clone() };
    let context = SharedVolume::new(around.volume().unwrap(), VolumeKey::default());
    let both = Scene { context: Some(context), ..scan.clone() };
    let camera = view([0.3, 1.0, 0.2], SIZE, 0.8);
    let settings = Settings { rim: None, ..everything() };
    let request = Request::new(&camera, &settings);
    let mut gpu = GpuRenderer::new(Arc::clone(device));
    for (name, scene) in [("scan", &scan), ("both", &both), ("scan again", &scan)] {
        println!("{name}");
        let cpu = CpuRenderer::default().render(scene, &request).unwrap();
        let mut frame = pollster::block_on(gpu.render(scene, &request)).unwrap();
        ties::excuse(&mut frame, &cpu, &phantom.tree, &settings);
        assert_same(&frame, &cpu);
    }
    let [alone, within] = [&scan, &both].map(|scene| CpuRenderer::default().render(scene, &request).unwrap());
    let bits = |frame: &Frame| frame.value.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
    assert!(bits(&alone) == bits(&within), "the cut shows the scan");
    assert!(alone.context != within.context, "the context shows the other volume");
}
