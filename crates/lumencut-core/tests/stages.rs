//! Levels, filter, surface, silhouettes and window, each compared with its closed form.
#![allow(clippy::unwrap_used)]

use glam::{DAffine3, DMat3, DVec3};
use lumencut_core::camera::Camera;
use lumencut_core::error::Result;
use lumencut_core::geometry::Geometry;
use lumencut_core::math::leaps::{LINE_TO_THE_RIGHT, LUMEN, TO_THE_RIGHT};
use lumencut_core::settings::{Context, Opacity, Settings, Slab, SlabMode, Window};
use lumencut_core::stages::Stage;
use lumencut_core::stages::composite::{CompositeParameters, Layers, composite};
use lumencut_core::stages::depth_filter::{DepthFilterParameters, depth_filter};
use lumencut_core::stages::leap::{LeapParameters, leap};
use lumencut_core::stages::levels::levels;
use lumencut_core::stages::silhouette::{SilhouetteParameters, silhouette};
use lumencut_core::stages::surface::{SurfaceScene, surface};
use lumencut_core::volume::{Volume, Voxels};
use lumencut_scenes::pictures::picture;
use lumencut_scenes::random_tree::random_tree;
use lumencut_scenes::tolerances::{CONSTANT, VALUE, WEIGHT};
use lumencut_scenes::trees::{tree, trefoil, vessel};
use lumencut_scenes::views::{on_cpu, pixel, view};

#[test]
fn levels_halve_the_points_and_keep_the_ends() {
    let scene = random_tree(31, 5, 97, 2.0, 50.0).unwrap();
    for pair in levels(&scene, 8).windows(2) {
        for (fine, coarse) in pair[0].vessels().iter().zip(pair[1].vessels()) {
            let (p, q) = (fine.points(), coarse.points());
            assert_eq!(q.len(), p.len().div_ceil(2).max(2));
            assert_eq!((q[0], q[q.len() - 1]), (p[0], p[p.len() - 1]));
            let (r, s) = (fine.radius().unwrap(), coarse.radius().unwrap());
            assert_eq!((s[0], s[s.len() - 1]), (r[0], r[r.len() - 1]));
        }
    }
}

#[test]
fn levels_of_short_vessels_are_straight() {
    let bent = vessel(&[[0., 0., 0.], [5., 5., 0.], [10., 0., 0.]], 1.0);
    let coarse = &levels(&tree(vec![bent]), 1)[1];
    assert_eq!(coarse.vessels()[0].points(), [DVec3::ZERO, DVec3::X * 10.0]);
}

#[test]
fn a_level_is_the_clamped_uniform_cubic_spline() {
    // Five control points: knots 0 0 0 0 1 2 2 2 2. Halfway, at u = 1, the basis is (0, 1/4, 1/2, 1/4, 0).
    let points = [[0., 0., 0.], [4., 8., 0.], [8., 0., 4.], [12., 8., 0.], [16., 0., 0.]];
    let coarse = &levels(&tree(vec![vessel(&points, 2.0)]), 1)[1];
    let middle = coarse.vessels()[0].points()[1];
    assert!((middle - DVec3::new(8.0, 4.0, 2.0)).length() < 1e-12, "{middle}");
    assert_eq!(coarse.vessels()[0].radius().unwrap(), [2.0; 3]);
}

#[test]
fn coarser_levels_are_calmer() {
    let length = |t: &lumencut_core::vessel_tree::VesselTree| -> f64 {
        t.vessels()[0].points().windows(2).map(|p| p[0].distance(p[1])).sum()
    };
    let lengths: Vec<f64> = levels(&trefoil(400), 6).iter().map(length).collect();
    assert!(lengths.windows(2).all(|l| l[1] < l[0]), "{lengths:?}");
}

#[test]
fn the_depth_filter_is_the_gaussian() {
    let camera = view([0.0, 1.0, 0.0], [21, 19], 1.0);
    let mut impulse = vec![0.0; 21 * 19];
    impulse[9 * 21 + 10] = 1.0;
    let mut smoothed = vec![-1.0; 21 * 19];
    depth_filter(&on_cpu(&camera), &DepthFilterParameters::new(), &impulse, None, &mut smoothed).unwrap();
    let variance = 8.0 * 2f64.ln() / std::f64::consts::PI.powi(2);
    let bell = |n: i32| (-f64::from(n * n) / (2.0 * variance)).exp();
    let total: f64 = (-3..=3).map(bell).sum::<f64>().powi(2);
    for (j, i) in (-4i32..=4).flat_map(|j| (-4i32..=4).map(move |i| (j, i))) {
        let expected = if i.abs().max(j.abs()) > 3 { 0.0 } else { bell(i) * bell(j) / total };
        let found = smoothed[((9 + j) * 21 + 10 + i) as usize];
        assert!(
            (f64::from(found) - expected).abs() < f64::from(WEIGHT.apart),
            "at {i}, {j}: {found}, {expected}"
        );
    }
}

#[test]
fn the_depth_filter_keeps_constants_to_the_border() {
    for size in [[1, 1], [2, 9], [40, 3]] {
        let camera = view([0.0, 1.0, 0.0], size, 1.0);
        let mut out = vec![0.0; size[0] * size[1]];
        let flat = vec![7.5; size[0] * size[1]];
        depth_filter(&on_cpu(&camera), &DepthFilterParameters::new(), &flat, None, &mut out).unwrap();
        assert!(out.iter().all(|z| CONSTANT.is_same(*z, 7.5)), "{size:?}");
    }
}

/// The values of the volume at the depths of a view.
fn sampled(volume: &Volume, camera: &Camera, depth: Vec<f32>, slab: Option<Slab>) -> Result<Vec<f32>> {
    let mut value = vec![0.0; depth.len()];
    let geometry = Geometry::Orthographic { camera: *camera, depth };
    let scene = SurfaceScene { geometry: &geometry, volume, blocks: None, slab };
    surface(&on_cpu(camera), &scene, &mut value)?;
    Ok(value)
}

/// A volume whose voxel (i, j, k) is i + 10 j + 100 k, on a sheared, left-handed grid.
fn linear_volume() -> (Vec<i16>, DAffine3) {
    let voxels = (0..9 * 8 * 7).map(|n| (n % 9 + n / 9 % 8 * 10 + n / 72 * 100) as i16).collect();
    let columns =
        DMat3::from_cols(DVec3::new(-2.0, 0.1, 0.0), DVec3::new(0.3, 1.5, 0.0), DVec3::new(0.0, 0.9, 3.0));
    (voxels, DAffine3::from_mat3_translation(columns, DVec3::new(5.0, -4.0, -8.0)))
}

#[test]
fn the_surface_reads_the_volume_where_the_depth_says() {
    let (voxels, affine) = linear_volume();
    let volume = Volume::new(Voxels::I16(&voxels), [9, 8, 7], [1, 9, 72], affine).unwrap();
    let camera = view([0.5, 1.0, -0.3], [64, 64], 0.5);
    let depth: Vec<f32> = (0..64 * 64).map(|p| (p % 13) as f32 - 6.0).collect();
    let value = sampled(&volume, &camera, depth.clone(), None).unwrap();
    let (mut inside, mut outside) = (0, 0);
    for p in 0..depth.len() {
        let at = DVec3::new(camera.view_x(p % 64), camera.view_y(p / 64), f64::from(depth[p]));
        let index = affine.inverse().transform_point3(camera.world_from_view(at));
        let last = DVec3::new(8.0, 7.0, 6.0);
        if (index + 0.5).min_element() < 0.0 || (last + 0.5 - index).min_element() < 0.0 {
            assert!(value[p].is_nan());
            outside += 1;
        } else {
            // Within half a voxel beyond the outermost centres, the outermost voxels continue.
            let expected = index.clamp(DVec3::ZERO, last).dot(DVec3::new(1.0, 10.0, 100.0));
            assert!(
                (f64::from(value[p]) - expected).abs() < f64::from(VALUE.apart),
                "{} {expected}",
                value[p]
            );
            inside += 1;
        }
    }
    assert!(inside > 500 && outside > 500, "{inside} {outside}");
}

#[test]
fn every_voxel_type_and_memory_order_reads_the_same() {
    let (voxels, affine) = linear_volume();
    let camera = view([0.0, 1.0, 0.0], [40, 40], 0.6);
    let read = |voxels: Voxels, strides: [usize; 3]| {
        let volume = Volume::new(voxels, [9, 8, 7], strides, affine).unwrap();
        let value = sampled(&volume, &camera, vec![0.5; 1600], None).unwrap();
        value.iter().map(|v| v.to_bits()).collect::<Vec<_>>()
    };
    let expected = read(Voxels::I16(&voxels), [1, 9, 72]);
    macro_rules! check {
        ($($name:ident $type:ty),*) => {$({
            let same: Vec<$type> = voxels.iter().map(|v| *v as $type).collect();
            let found = read(Voxels::$name(&same), [1, 9, 72]);
            // Wider types compute in f64, and are equal up to the last digits of f32.
            for (a, b) in found.iter().zip(&expected) {
                let (a, b) = (f32::from_bits(*a), f32::from_bits(*b));
                assert!((a.is_nan() && b.is_nan()) || VALUE.is_same(a, b), stringify!($name));
            }
        })*};
    }
    check!(U16 u16, I32 i32, U32 u32, I64 i64, U64 u64, F32 f32, F64 f64);
    let mut turned = vec![0i16; voxels.len()];
    for (n, v) in voxels.iter().enumerate() {
        turned[n % 9 * 56 + n / 9 % 8 * 7 + n / 72] = *v;
    }
    assert_eq!(read(Voxels::I16(&turned), [56, 7, 1]), expected);
}

#[test]
fn silhouettes_mark_leaps_and_nothing_else() {
    let camera = view([0.0, 1.0, 0.0], [60, 40], 0.5);
    let slope: Vec<f32> = (0..2400).map(|p| (p % 60) as f32 * 0.5).collect();
    let leap: Vec<f32> = (0..2400).map(|p| if p % 60 < 30 { 0.0 } else { 40.0 }).collect();
    let zones: Vec<i32> = (0..2400).map(|p| i32::from(p % 60 >= 30)).collect();
    let parameters =
        SilhouetteParameters::new(&Settings { silhouette_slope: 24.0, ..Settings::default() }, &camera);
    let strength = |depth: &[f32], vessel: &[i32]| {
        let mut out = vec![-1.0; 2400];
        silhouette(&on_cpu(&camera), &parameters, depth, vessel, &mut out).unwrap();
        out
    };
    assert!(strength(&slope, &[0; 2400]).iter().all(|s| *s < 0.01), "a slope of 1 is no silhouette");
    let (same, border) = (strength(&leap, &[0; 2400]), strength(&leap, &zones));
    assert!(border[20 * 60 + 30] > 0.9 && border[20 * 60 + 30] > same[20 * 60 + 30]);
    assert!(border[20 * 60 + 10] < 1e-6 && border[20 * 60 + 50] < 1e-6);
    assert!(
        strength(&[3.0; 2400], &zones).iter().all(|s| *s == 0.0),
        "a border without a leap is no silhouette"
    );
}

#[test]
fn the_picture_follows_window_opacity_and_background() {
    let camera = view([0.0, 1.0, 0.0], [5, 1], 1.0);
    let settings = Settings {
        window: Window { level: 100.0, width: 200.0 },
        opacity: Some(Opacity { transparent: 0.0, opaque: 100.0 }),
        background: [10, 20, 30, 255],
        ..Settings::default()
    };
    let mut image = vec![[0; 4]; 5];
    let view = on_cpu(&camera);
    let value = [f32::NAN, 300.0, 100.0, 50.0, -50.0];
    let layers = Layers {
        value: &value,
        strength: Some(&[0.0, 0.0, 1.0, 0.0, 1.0]),
        focus: None,
        rim: None,
        context: None,
    };
    composite(&view, &CompositeParameters::new(&settings), &layers, &mut image).unwrap();
    assert_eq!(image[0], [10, 20, 30, 255], "outside the volume: background");
    assert_eq!(image[1], [255, 255, 255, 255], "above the window: white");
    assert_eq!(image[2], [255, 220, 0, 255], "a full silhouette: its colour");
    assert_eq!(image[3], [37, 42, 47, 255], "half opaque: 63.75 over the background");
    assert_eq!(image[4], [10, 20, 30, 255], "transparent: background");
}

#[test]
fn a_whole_rendering_shows_a_bright_tube_on_a_dark_ground() {
    let size = [40usize, 40, 40];
    let bright = |n: usize| {
        let (j, k) = (n / 40 % 40, n / 1600);
        let off = (j as f64 - 19.5).hypot(k as f64 - 19.5);
        if off <= 5.0 { 300i16 } else { -100 }
    };
    let voxels: Vec<i16> = (0..64_000).map(bright).collect();
    let affine = DAffine3::from_translation(DVec3::splat(-19.5));
    let volume = Volume::new(Voxels::I16(&voxels), size, [1, 40, 1600], affine).unwrap();
    let tube = tree(vec![vessel(&[[-19.0, 0.0, 0.0], [0.0, 0.0, 0.0], [19.0, 0.0, 0.0]], 5.0)]);
    let window = Window { level: 100.0, width: 400.0 };
    let context = Some(Context { body: true, ..Context::default() });
    let settings = Settings { window, context, occlusion: 0.6, ..Settings::default() };
    let camera = view([0.0, 1.0, 0.0], [64, 64], 1.0);
    let frame = picture(volume, &tube, &camera, &settings);
    for (x, y, expected) in [(0.5, 0.5, 255), (10.5, 3.5, 255), (0.5, 8.5, 0), (-12.5, -9.5, 0)] {
        assert_eq!(frame.image[pixel(&frame, x, y)][0], expected, "at {x}, {y}");
    }
    let names: Vec<_> = frame.timings.iter().map(|t| t.stage).collect();
    let expected: Vec<_> = Stage::ALL
        .into_iter()
        .filter(|s| ![Stage::Steady, Stage::Rim].contains(s))
        .map(Stage::name)
        .collect();
    assert_eq!(names, expected);
}

#[test]
fn a_slab_far_thicker_than_the_volume_shows_all_of_it() {
    // A volume of eight voxels with a side of 0.0001 mm or 1 mm, in a slab of 1 m.
    for side in [1e-4, 1.0] {
        let voxels = [1i16, 2, 3, 4, 5, 6, 7, 8];
        let affine = DAffine3::from_scale_rotation_translation(
            DVec3::splat(side),
            Default::default(),
            DVec3::splat(-side / 2.0),
        );
        let volume = Volume::new(Voxels::I16(&voxels), [2; 3], [1, 2, 4], affine).unwrap();
        // The middle pixel's ray runs along k through the volume's middle: from 2.5 up to 6.5.
        let camera = view([0.0, 0.0, 1.0], [3, 3], side / 10.0);
        for (mode, expected) in [(SlabMode::Min, 2.5), (SlabMode::Mean, 4.5), (SlabMode::Max, 6.5)] {
            let slab = Some(Slab { thickness: 1000.0, mode });
            let value = sampled(&volume, &camera, vec![0.0; 9], slab).unwrap();
            assert!(VALUE.is_same(value[4], expected), "{mode:?} of {side} mm: {}", value[4]);
        }
    }
}

#[test]
fn leaps_are_where_neither_side_goes_on_and_never_beyond_the_image() {
    // A steep plane (90 mm per mm right, 70 up) with a 5 mm step after the third column, and a 3 mm step
    // after the second row. The latter is less than the diameter of a vessel with a radius of 2 mm.
    let size = [19, 7];
    let camera = view([0.0, 1.0, 0.0], size, 0.5);
    let place = |p: usize| (p % size[0], p / size[0]);
    let depth = |p: usize| {
        let (i, j) = place(p);
        let steps = if i > 2 { 5.0 } else { 0.0 } + if j > 1 { 3.0 } else { 0.0 };
        45.0 * i as f32 - 35.0 * j as f32 + steps
    };
    let depths: Vec<f32> = (0..19 * 7).map(depth).collect();
    let sheets = vec![[90.0, 70.0, 2.0, 0.0]; depths.len()];
    let mut found = vec![9; depths.len()];
    let places = (&depths[..], &vec![0; depths.len()][..]);
    leap(&on_cpu(&camera), &LeapParameters::new(&camera), places, &sheets, &mut found).unwrap();
    for (p, bits) in found.iter().enumerate() {
        // All pixels are lumen, and the right side of the step lies farther.
        let leap = if place(p).0 == 2 { TO_THE_RIGHT | LINE_TO_THE_RIGHT } else { 0 };
        assert_eq!(*bits, leap | LUMEN, "at {:?}", place(p));
    }
}
