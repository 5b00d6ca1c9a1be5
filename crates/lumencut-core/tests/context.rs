//! The context has the same bits with and without skipping, for all instruction sets, threads and layouts.
#![allow(clippy::unwrap_used)]

use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{DAffine3, DVec3};
use lumencut_core::camera::Camera;
use lumencut_core::error::ErrorKind;
use lumencut_core::math::blocks::Blocks;
use lumencut_core::math::lanes::Isa;
use lumencut_core::math::ray::{NONE, WHOLE};
use lumencut_core::settings::{
    Context, ContextMode, ControlPoint, Preset, Settings, TransferFunction, Window,
};
use lumencut_core::stages::Work;
use lumencut_core::stages::context::{Surroundings, context};
use lumencut_core::volume::{Volume, Voxels};
use lumencut_scenes::pictures::context_alone;
use lumencut_scenes::settings::{WINDOW, gaps};
use lumencut_scenes::views::{on_cpu, view};
use lumencut_scenes::volumes::{ball_and_rod, sheared, volume};

const SIZE: [usize; 3] = [41, 37, 29];

fn placed(voxels: Voxels<'_>) -> Volume<'_> {
    volume(voxels, SIZE, sheared(SIZE))
}

fn contexts() -> Vec<Context> {
    let base = Context { window: WINDOW, ..Context::default() };
    let mut all = Vec::new();
    for gamma in [-1.0, -0.4, 0.0, 0.3, 1.0] {
        for transfer in [Preset::Angio.transfer_function(WINDOW), gaps()] {
            let mode = ContextMode::Blend { gamma };
            all.push(Context { mode, transfer, shading: gamma < 0.2, ..base.clone() });
        }
    }
    all.push(Context { mode: ContextMode::Minimum, ..base.clone() });
    all.push(Context { mode: ContextMode::Average, preview: true, ..base });
    all
}

fn cameras() -> Vec<Camera> {
    let far = view([0.3, 1.0, -0.4], [22, 18], 4.5);
    vec![
        view([0.0, 1.0, 0.0], [67, 45], 0.7),
        view([0.5, -0.6, 0.4], [64, 33], 0.9),
        view([0.0, 0.0, 1.0], [40, 40], 1.3),
        far,
    ]
}

/// Rays that start everywhere: before the volume, within it, behind it, or nowhere.
fn starts(camera: &Camera) -> Vec<f32> {
    let start = |p| match p % 5 {
        0 => NONE,
        1 => (p % 37) as f32 - 18.0,
        _ => WHOLE,
    };
    (0..camera.size()[0] * camera.size()[1]).map(start).collect()
}

fn traced(
    volume: &Volume,
    camera: &Camera,
    isa: Isa,
    settings: &Context,
    blocks: Option<&Blocks>,
) -> Vec<[u32; 4]> {
    let start = starts(camera);
    let mut pixels = vec![[-1.0f32; 4]; start.len()];
    let work = Work { size: camera.size(), isa, stop: &|| false, progress: None };
    let surroundings = Surroundings { camera, volume, blocks };
    context(&work, &surroundings, &Settings::default(), settings, &start, &mut pixels).unwrap();
    assert!(
        pixels.iter().flatten().all(|c| (0.0..=1.001).contains(c)),
        "colours and opacities lie between 0 and 1"
    );
    pixels.iter().map(|pixel| pixel.map(f32::to_bits)).collect()
}

fn assert_skipping_changes_nothing(volume: &Volume, what: &str) {
    let blocks = Blocks::new(volume, &|| false).unwrap();
    for camera in cameras() {
        for settings in contexts() {
            let whole = traced(volume, &camera, Isa::widest(), &settings, None);
            let skipped = traced(volume, &camera, Isa::widest(), &settings, Some(&blocks));
            assert!(whole.iter().flatten().any(|c| *c != 0), "{what}: something is seen");
            assert!(whole == skipped, "{what}: {:?} in a view along {}", settings.mode, camera.direction());
        }
    }
}

#[test]
fn skipping_changes_no_bit() {
    let integers = ball_and_rod(SIZE);
    assert_skipping_changes_nothing(&placed(Voxels::I16(&integers)), "int16");
    let bytes: Vec<u8> = integers.iter().map(|v| (v / 4) as u8).collect();
    assert_skipping_changes_nothing(&placed(Voxels::U8(&bytes)), "uint8");
    let doubles: Vec<f64> = integers.iter().map(|v| f64::from(*v) / 3.0).collect();
    assert_skipping_changes_nothing(&placed(Voxels::F64(&doubles)), "float64");
}

#[test]
fn skipping_changes_no_bit_beside_voxels_without_a_number() {
    let mut floats: Vec<f32> = ball_and_rod(SIZE).into_iter().map(f32::from).collect();
    let odd = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30, -1e30];
    for n in (0..floats.len()).step_by(977) {
        floats[n] = odd[n % odd.len()];
    }
    floats[..2000].fill(f32::NAN);
    assert_skipping_changes_nothing(&placed(Voxels::F32(&floats)), "float32");
}

#[test]
fn a_falling_step_at_a_value_that_blocks_hold_alone_is_seen() {
    let point = |(intensity, opacity)| ControlPoint { intensity, color: [255; 3], opacity };
    for at in [0.0, 1.0, 300.0] {
        let transfer = TransferFunction {
            points: [(-10.0, 1.0), (at, 1.0), (at, 0.0), (900.0, 0.0)].map(point).to_vec(),
        };
        let context = Context { mode: ContextMode::Blend { gamma: -1.0 }, transfer, ..Context::default() };
        let voxels = vec![at as i16; SIZE.iter().product()];
        let volume = placed(Voxels::I16(&voxels));
        let blocks = Blocks::new(&volume, &|| false).unwrap();
        let camera = &cameras()[0];
        let seen = traced(&volume, camera, Isa::widest(), &context, Some(&blocks));
        assert!(seen == traced(&volume, camera, Isa::widest(), &context, None), "at {at}");
        assert!(
            seen.iter().any(|pixel| f32::from_bits(pixel[3]) > 0.99),
            "at {at}: the value of a step is its first"
        );
    }
}

#[test]
fn a_preview_shows_nothing_before_the_cut_surface() {
    // The volume is white before depth 0 and black behind; the cut surface at depth 0 covers one side only.
    let voxels: Vec<i16> = (0..20 * 20 * 20).map(|n| if n / 20 % 20 < 10 { 1000 } else { 0 }).collect();
    let place = DAffine3::from_translation(DVec3::splat(-9.5));
    let volume = Volume::new(Voxels::I16(&voxels), [20; 3], [1, 20, 400], place).unwrap();
    let camera = view([0.0, 1.0, 0.0], [18, 8], 1.0);
    let start: Vec<f32> = (0..144).map(|p| if p % 18 < 9 { WHOLE } else { 1.0 }).collect();
    let mode = ContextMode::Blend { gamma: 1.0 };
    let settings = Context {
        mode,
        preview: true,
        transfer: Preset::Grey.transfer_function(WINDOW),
        ..Context::default()
    };
    let mut pixels = vec![[0.0; 4]; 144];
    let surroundings = Surroundings { camera: &camera, volume: &volume, blocks: None };
    context(&on_cpu(&camera), &surroundings, &Settings::default(), &settings, &start, &mut pixels).unwrap();
    for (p, pixel) in pixels.iter().enumerate() {
        let white = p % 18 < 9;
        assert_eq!(pixel[0] > 0.5, white, "pixel {p}: white where the ray starts in front, {pixel:?}");
        assert_eq!(pixel[3], 1.0);
    }
}

#[test]
fn every_instruction_set_and_number_of_threads_gives_the_same_bits() {
    let voxels = ball_and_rod(SIZE);
    let volume = placed(Voxels::I16(&voxels));
    let blocks = Blocks::new(&volume, &|| false).unwrap();
    for camera in &cameras()[1..3] {
        for settings in contexts() {
            let trace = |isa| traced(&volume, camera, isa, &settings, Some(&blocks));
            let widest = trace(Isa::widest());
            for isa in Isa::available() {
                assert!(trace(isa) == widest, "{isa:?}, {:?}", settings.mode);
            }
            let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
            assert!(alone.install(|| trace(Isa::widest())) == widest, "one thread, {:?}", settings.mode);
        }
    }
}

#[test]
fn the_order_of_voxels_in_memory_changes_no_bit() {
    let voxels = ball_and_rod(SIZE);
    let [ni, nj, nk] = SIZE;
    let mut turned = vec![0; voxels.len()];
    let strides = [nj * nk, nk, 1];
    for (n, voxel) in voxels.iter().enumerate() {
        turned[n % ni * strides[0] + n / ni % nj * strides[1] + n / (ni * nj)] = *voxel;
    }
    let turned = Volume::new(Voxels::I16(&turned), SIZE, strides, sheared(SIZE)).unwrap();
    let straight = placed(Voxels::I16(&voxels));
    for settings in contexts() {
        let trace = |volume: &Volume| {
            let blocks = Blocks::new(volume, &|| false).unwrap();
            traced(volume, &cameras()[1], Isa::widest(), &settings, Some(&blocks))
        };
        assert!(trace(&turned) == trace(&straight), "{:?}", settings.mode);
    }
}

#[test]
fn voxels_more_than_32_bits_apart_are_found() {
    // The allocator returns untouched pages of zeros, so this memory is never really used.
    let far = (1usize << 32) + 1;
    let mut sparse = vec![0u8; far + 4];
    let near = [10u8, 50, 200, 90, 40, 160, 120, 240];
    for (n, voxel) in near.iter().enumerate() {
        sparse[n % 2 + n / 2 % 2 * 2 + n / 4 * far] = *voxel;
    }
    let place = DAffine3::from_translation(DVec3::splat(-0.5));
    let sparse = Volume::new(Voxels::U8(&sparse), [2; 3], [1, 2, far], place).unwrap();
    let dense = Volume::new(Voxels::U8(&near), [2; 3], [1, 2, 4], place).unwrap();
    let camera = view([0.4, 1.0, 0.3], [9, 9], 0.3);
    let transfer = Preset::Grey.transfer_function(Window { level: 120.0, width: 240.0 });
    for gamma in [0.0, 1.0] {
        let context =
            Context { mode: ContextMode::Blend { gamma }, transfer: transfer.clone(), ..Context::default() };
        let settings = Settings { context: Some(context), ..Settings::default() };
        let draw = |volume| context_alone(volume, &camera, &settings, &|| false).unwrap().image;
        let (found, expected) = (draw(sparse), draw(dense));
        let difference = |(a, b): (&[u8; 4], &[u8; 4])| (0..4).map(|c| a[c].abs_diff(b[c])).max().unwrap();
        assert!(found.iter().zip(&expected).all(|pair| difference(pair) <= 1));
        assert!(expected.iter().any(|pixel| pixel[0] > 20));
    }
}

#[test]
fn a_context_stops_when_asked() {
    let voxels = ball_and_rod(SIZE);
    let camera = view([0.0, 1.0, 0.0], [256, 256], 0.2);
    // Stops before the blocks are made, and between tiles of rays.
    for patience in [0, 100] {
        let asked = AtomicUsize::new(0);
        let stop = || asked.fetch_add(1, Ordering::Relaxed) >= patience;
        let volume = placed(Voxels::I16(&voxels));
        let error = context_alone(volume, &camera, &Settings::default(), &stop).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Interrupted);
    }
}

#[test]
fn a_step_too_small_for_the_volume_is_refused_and_the_default_never_is() {
    let voxels = [0i16; 64];
    let flat = DAffine3::from_scale(DVec3::new(1e-3, 1e3, 1e3));
    let volume = Volume::new(Voxels::I16(&voxels), [4; 3], [1, 4, 16], flat).unwrap();
    let draw = |step| {
        let settings =
            Settings { context: Some(Context { step, ..Context::default() }), ..Settings::default() };
        let camera = view([0.0, 1.0, 0.0], [3, 3], 1.0);
        context_alone(volume, &camera, &settings, &|| false)
    };
    let error = draw(Some(0.01)).unwrap_err();
    assert_eq!((error.kind, &*error.subject), (ErrorKind::Settings, "context_step"));
    assert!(draw(None).is_ok());
    let named: f64 = error.expected.split(' ').nth(2).unwrap().parse().unwrap();
    assert!(draw(Some(named)).is_ok(), "the step that the error names is taken: {}", error.expected);
}
