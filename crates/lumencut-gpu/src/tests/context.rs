//! The context made on the GPU equals the CPU's.
#![allow(clippy::unwrap_used)]

use glam::{DAffine3, DVec3};
use lumencut_core::camera::Camera;
use lumencut_core::math::blocks::Blocks;
use lumencut_core::math::context_parameters::StartParameters;
use lumencut_core::math::ray::WHOLE;
use lumencut_core::settings::{
    Context, ContextFrom, ContextMode, Opacity, Preset, Settings, Slab, SlabMode, Window,
};
use lumencut_core::stages::context::{SurfaceImages, Surroundings, context, starts};
use lumencut_core::stages::focus::Shares;
use lumencut_core::volume::{Volume, Voxels};
use lumencut_phantom::{calcified_wall, trefoil};
use lumencut_scenes::settings::{WINDOW, gaps};
use lumencut_scenes::tolerances::{CONTEXT, CONTEXT_LEAP};
use lumencut_scenes::views::{self, view_beside_voxels};
use lumencut_scenes::volumes::{ball_and_rod, sheared, volume};

use super::placed::Placed;
use super::{device, without_holes};
use crate::context::{ContextImages, ContextStage};
use crate::recording::Recording;

const SIZE: [usize; 3] = [41, 37, 29];

/// A cut surface: values (NaN outside the volume), depths, and shown shares.
struct CutSurface {
    value: Vec<f32>,
    depth: Vec<f32>,
    focus: Option<Vec<Shares>>,
}

/// A surface that is outside the volume, opaque and transparent in turn, in squares of different sizes.
fn cut_surface(camera: &Camera) -> CutSurface {
    let [width, height] = camera.size();
    let value = |p: usize| match p % width / 5 % 4 + p / width / 3 % 3 {
        0 | 3 => f32::NAN,
        1 => 900.0,
        _ => (p % 600) as f32,
    };
    let depth = |p: usize| (p % 37) as f32 - 18.0;
    CutSurface {
        value: (0..width * height).map(value).collect(),
        depth: (0..width * height).map(depth).collect(),
        focus: None,
    }
}

fn contexts() -> Vec<Context> {
    let base = Context { window: WINDOW, ..Context::default() };
    let mut all = Vec::new();
    for gamma in [-1.0, -0.5, 0.0, 0.5, 1.0] {
        for transfer in [Preset::Angio.transfer_function(WINDOW), gaps()] {
            for shading in [false, true] {
                let mode = ContextMode::Blend { gamma };
                all.push(Context { mode, transfer: transfer.clone(), shading, ..base.clone() });
            }
        }
    }
    for mode in [ContextMode::Minimum, ContextMode::Average] {
        all.push(Context { mode, ..base.clone() });
    }
    all.push(Context { preview: true, ..base.clone() });
    all.push(Context { preview: true, mode: ContextMode::Average, ..base.clone() });
    all.push(Context { step: Some(2.3), shading: true, ..base });
    all
}

fn starts_on_cpu(camera: &Camera, settings: &Settings, surface: &CutSurface) -> Vec<f32> {
    let mut start = vec![0.0; surface.value.len()];
    let parameters = StartParameters::new(settings);
    let CutSurface { value, depth, focus } = surface;
    let images = SurfaceImages { value, depth, focus: focus.as_deref() };
    starts(&views::on_cpu(camera), &parameters, &images, &mut start);
    start
}

fn on_cpu(volume: &Volume, camera: &Camera, settings: &Settings, start: &[f32]) -> Vec<[f32; 4]> {
    let mut pixels = vec![[-1.0; 4]; start.len()];
    let blocks = Blocks::new(volume, &|| false).unwrap();
    let surroundings = Surroundings { camera, volume, blocks: Some(&blocks) };
    let chosen = settings.context.as_ref().unwrap();
    context(&views::on_cpu(camera), &surroundings, settings, chosen, start, &mut pixels).unwrap();
    pixels
}

fn on_gpu(
    stage: &mut ContextStage,
    placed: &Placed,
    settings: &Settings,
    surface: Option<&CutSurface>,
) -> Vec<[f32; 4]> {
    starts_and_context(stage, placed, settings, surface).1
}

fn starts_and_context(
    stage: &mut ContextStage,
    placed: &Placed,
    settings: &Settings,
    surface: Option<&CutSurface>,
) -> (Vec<f32>, Vec<[f32; 4]>) {
    let pixels = placed.pixels();
    let nowhere = CutSurface { value: vec![0.0; pixels], depth: vec![0.0; pixels], focus: None };
    let CutSurface { value, depth, focus } = surface.unwrap_or(&nowhere);
    let [value, depth] = [placed.image(&without_holes(value)), placed.image(depth)];
    let focus = focus.as_ref().map(|focus| placed.device.upload("focus", focus));
    let start = placed.device.image("start", pixels, 4);
    let gathered = placed.device.image("gathered", pixels, 16);
    let squares = placed.device.image("squares", pixels, 32);
    let blocks = placed.blocks();
    let chosen = settings.context.as_ref().unwrap();
    stage.write(placed.device, settings, chosen, (placed.volume, placed.camera), &blocks).unwrap();
    let images = ContextImages {
        size: placed.camera.size(),
        has_surface: surface.is_some(),
        focus: focus.as_ref(),
        depth: &depth,
        value: &value,
        start: &start,
        gathered: &gathered,
        squares: &squares,
    };
    let mut recording = Recording::new(placed.device);
    let volumes = (&placed.on_device, &blocks);
    stage.record(&mut recording, [&placed.view, &placed.grid], volumes, chosen, images);
    recording.read(&start, start.size());
    recording.read(&gathered, gathered.size());
    let results = super::finish(recording);
    let names: Vec<_> = results.timings.iter().map(|timing| timing.stage).collect();
    assert!(names.is_empty() || names == ["context"], "{names:?}");
    (results.numbers(0), results.numbers(1))
}

#[test]
fn rays_start_where_those_of_the_cpu_do() {
    let Some(device) = device() else { return };
    let voxels = ball_and_rod(SIZE);
    let volume = volume(Voxels::I16(&voxels), SIZE, sheared(SIZE));
    let mut stage = ContextStage::new(device);
    for camera in views() {
        let placed = Placed::new(device, &volume, &camera);
        let surface = cut_surface(&camera);
        for opacity in [None, Some([100.5, 400.5]), Some([400.5, 100.5])] {
            let settings = Settings {
                opacity: opacity.map(|[transparent, opaque]| Opacity { transparent, opaque }),
                slab: opacity.map(|_| Slab { thickness: 3.0, mode: SlabMode::Mean }),
                ..Settings::default()
            };
            let (found, _) = starts_and_context(&mut stage, &placed, &settings, Some(&surface));
            assert_eq!(found, starts_on_cpu(&camera, &settings, &surface), "{opacity:?}");
            let (alone, _) = starts_and_context(&mut stage, &placed, &settings, None);
            assert!(alone.iter().all(|start| start.to_bits() == WHOLE.to_bits()));
        }
    }
}

#[test]
fn around_a_focus_rays_start_where_those_of_the_cpu_do() {
    let Some(device) = device() else { return };
    let voxels = ball_and_rod(SIZE);
    let volume = volume(Voxels::I16(&voxels), SIZE, sheared(SIZE));
    let mut stage = ContextStage::new(device);
    for camera in views() {
        let placed = Placed::new(device, &volume, &camera);
        let share = |n: usize| [(n % 13) as f32 / 12.0, 1.0, 1.0, 0.0];
        let focus = (0..placed.pixels()).map(share).collect();
        let surface = CutSurface { focus: Some(focus), ..cut_surface(&camera) };
        for from in [ContextFrom::Cut, ContextFrom::Whole] {
            for opacity in [None, Some(Opacity { transparent: 100.5, opaque: 400.5 })] {
                let context = Some(Context { from, ..Context::default() });
                let settings = Settings { opacity, context, ..Settings::default() };
                let (found, _) = starts_and_context(&mut stage, &placed, &settings, Some(&surface));
                assert_eq!(found, starts_on_cpu(&camera, &settings, &surface), "{from:?}, {opacity:?}");
            }
        }
    }
}

#[derive(Debug, Default)]
struct Difference {
    pixels: usize,
    /// Number of pixels with a channel that differs by more than [`CONTEXT`] and [`CONTEXT_LEAP`] allow.
    visible: usize,
    large: usize,
    most: f32,
}

impl Difference {
    fn add(&mut self, one: &[[f32; 4]], other: &[[f32; 4]]) {
        for (one, other) in one.iter().zip(other) {
            assert!(one.iter().all(|c| (0.0..=1.001).contains(c)), "{one:?} beside {other:?}");
            let most = (0..4).map(|c| (one[c] - other[c]).abs()).fold(0.0, f32::max);
            self.pixels += 1;
            self.visible += usize::from(most > CONTEXT.apart);
            self.large += usize::from(most > CONTEXT_LEAP.apart);
            self.most = self.most.max(most);
        }
    }

    fn check(&self, what: &str) {
        // Even a small picture may have one visible difference.
        let few_are_visible = self.visible <= 1 || CONTEXT.allows(self.visible, self.pixels);
        assert!(few_are_visible && CONTEXT_LEAP.allows(self.large, self.pixels), "{what}: {self:?}");
    }
}

/// Views of many and of few pixels; the largest has `large` times `large`.
fn views_up_to(large: usize) -> Vec<Camera> {
    vec![
        view_beside_voxels([0.0, 1.0, 0.0], [large; 2], 51.4 / large as f64),
        view_beside_voxels([0.5, -0.6, 0.4], [33, 20], 1.3),
        view_beside_voxels([0.0, 0.0, -1.0], [1, 17], 2.1),
        view_beside_voxels([-1.0, 0.2, 0.1], [65, 49], 0.9),
        view_beside_voxels([-0.4, 0.7, -0.3], [11, 9], 9.0),
    ]
}

fn views() -> Vec<Camera> {
    views_up_to(257)
}

fn compare(volume: &Volume, contexts: &[Context], scale: f64, what: &str) {
    let Some(device) = device() else { return };
    let mut stage = ContextStage::new(device);
    for camera in views_up_to(97) {
        let placed = Placed::new(device, volume, &camera);
        let surface = cut_surface(&camera);
        for (n, context) in contexts.iter().enumerate() {
            let settings = Settings {
                context: Some(scaled(context, scale)),
                opacity: Some(Opacity { transparent: 100.0, opaque: 400.0 }),
                slab: (n % 2 == 0).then_some(Slab { thickness: 3.0, mode: SlabMode::Mean }),
                ..Settings::default()
            };
            let mut difference = Difference::default();
            let start = starts_on_cpu(&camera, &settings, &surface);
            let expected = on_cpu(volume, &camera, &settings, &start);
            difference.add(&on_gpu(&mut stage, &placed, &settings, Some(&surface)), &expected);
            let alone = vec![WHOLE; placed.pixels()];
            let expected = on_cpu(volume, &camera, &settings, &alone);
            difference.add(&on_gpu(&mut stage, &placed, &settings, None), &expected);
            let Context { mode, shading, preview, .. } = context;
            difference.check(&format!(
                "{what} {:?} along {}, {n}: {mode:?} {shading} {preview}",
                camera.size(),
                camera.direction()
            ));
        }
    }
}

/// The same context for a volume whose values are `scale` times as large.
fn scaled(context: &Context, scale: f64) -> Context {
    let mut context = context.clone();
    context.window = Window { level: context.window.level * scale, width: context.window.width * scale };
    for point in &mut context.transfer.points {
        point.intensity *= scale;
    }
    context
}

#[test]
fn every_mode_is_that_of_the_cpu() {
    let voxels = ball_and_rod(SIZE);
    compare(&volume(Voxels::I16(&voxels), SIZE, sheared(SIZE)), &contexts(), 1.0, "int16");
}

#[test]
fn other_types_of_voxels_give_the_same() {
    let shorts = ball_and_rod(SIZE);
    let bytes: Vec<u8> = shorts.iter().map(|v| (v / 4) as u8).collect();
    let unsigned: Vec<u16> = shorts.iter().map(|v| *v as u16 * 60).collect();
    let doubles: Vec<f64> = shorts.iter().map(|v| f64::from(*v) / 3.0).collect();
    let some: Vec<_> = contexts().into_iter().step_by(3).collect();
    for (voxels, scale, what) in [
        (Voxels::U8(&bytes), 0.25, "uint8"),
        (Voxels::U16(&unsigned), 60.0, "uint16"),
        (Voxels::F64(&doubles), 1.0 / 3.0, "float64"),
    ] {
        compare(&volume(voxels, SIZE, sheared(SIZE)), &some, scale, what);
    }
}

#[test]
fn voxels_without_a_number() {
    // With even sizes no sample lies on a voxel, where rounding would decide whether neighbouring voxels count.
    const EVEN: [usize; 3] = [40, 36, 28];
    let mut floats: Vec<f32> = ball_and_rod(EVEN).into_iter().map(f32::from).collect();
    for n in (0..floats.len()).step_by(977) {
        floats[n] = [f32::NAN, f32::INFINITY, -1e31][n % 3];
    }
    floats[..2000].fill(f32::NAN);
    let within: Vec<_> = floats.iter().map(|v| if v.abs() <= 1e30 { *v } else { f32::NAN }).collect();
    let some: Vec<_> = contexts().into_iter().filter(|c| c.step.is_none()).collect();
    let some: Vec<_> = some.into_iter().step_by(3).map(|c| Context { step: Some(0.57), ..c }).collect();
    compare(&volume(Voxels::F32(&within), EVEN, sheared(EVEN)), &some, 1.0, "NaN");
    let (all, camera) = (
        volume(Voxels::F32(&floats), EVEN, sheared(EVEN)),
        view_beside_voxels([0.3, 1.0, 0.2], [64, 48], 0.7),
    );
    let Some(device) = device() else { return };
    let mut stage = ContextStage::new(device);
    let gather = |volume: &Volume, stage: &mut ContextStage, context: &Context| {
        let settings = Settings { context: Some(context.clone()), ..Settings::default() };
        let placed = Placed::new(device, volume, &camera);
        on_gpu(stage, &placed, &settings, None)
    };
    for context in &some {
        let within = volume(Voxels::F32(&within), EVEN, sheared(EVEN));
        let mut difference = Difference::default();
        difference.add(&gather(&all, &mut stage, context), &gather(&within, &mut stage, context));
        difference.check(&format!("inf as NaN, {:?}", context.mode));
    }
}

#[test]
fn the_mean_of_many_samples_keeps_its_digits() {
    let Some(device) = device() else { return };
    let voxels = vec![1000.1f32; 2048];
    let volume =
        volume(Voxels::F32(&voxels), [1, 1, 2048], DAffine3::from_translation(DVec3::NEG_Z * 1023.5));
    let camera = view_beside_voxels([0.0, 0.0, 1.0], [3, 3], 0.1);
    let placed = Placed::new(device, &volume, &camera);
    let context = Context {
        mode: ContextMode::Average,
        window: Window { level: 1000.0, width: 1000.0 },
        step: Some(1.0 / 31.99),
        ..Context::default()
    };
    let settings = Settings { context: Some(context), ..Settings::default() };
    for pixel in on_gpu(&mut ContextStage::new(device), &placed, &settings, None) {
        assert!((pixel[0] - 0.500_1).abs() < 1e-6, "{pixel:?}");
    }
}

#[test]
fn axes_of_one_voxel() {
    let voxels = ball_and_rod([40, 30, 20]);
    let some: Vec<_> = contexts().into_iter().step_by(3).collect();
    for size in [[40, 30, 1], [1, 30, 20], [1, 1, 1], [2, 1, 40]] {
        compare(&volume(Voxels::I16(&voxels), size, sheared(size)), &some, 1.0, &format!("{size:?}"));
    }
}

#[test]
fn phantoms() {
    let some: Vec<_> = contexts().into_iter().step_by(2).collect();
    for phantom in [trefoil().unwrap(), calcified_wall().unwrap()] {
        compare(&phantom.volume().unwrap(), &some, 1.0, phantom.name);
    }
}
