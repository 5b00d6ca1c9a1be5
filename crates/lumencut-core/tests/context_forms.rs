//! The context along rays through volumes for which a formula gives the answer.
#![allow(clippy::unwrap_used)]

use glam::{DAffine3, DVec3};
use lumencut_core::camera::Camera;
use lumencut_core::math::light::{AMBIENT, SPECULAR};
use lumencut_core::settings::{Context, ContextMode, Preset, Window};
use lumencut_core::volume::{Volume, Voxels};
use lumencut_scenes::contexts::{COLOURS, DVR, LOW_WINDOW, MIDA, MIP, Points, apart, coloured, drawn};
use lumencut_scenes::random::Random;
use lumencut_scenes::views::view;
use lumencut_scenes::volumes::{sheared, volume};

/// Error from rounding to a byte, and from rounding of 32-bit floats.
const BYTE: f64 = 0.52;
/// Views along the axes of a plain grid: the axis of the index, and from which end.
const ALONG: [(usize, f64); 3] = [(0, 1.0), (1, 1.0), (2, -1.0)];
/// Voxels along the other two axes.
const BESIDE: usize = 5;

/// Checks the pixels of a volume with the values of `profile` along a view, whose pixels see voxel centres.
fn along(profile: &[f32], context: &Context, (axis, sign): (usize, f64)) -> Vec<[f64; 4]> {
    let mut size = [BESIDE; 3];
    size[axis] = profile.len();
    let stride = [1, size[0], size[0] * size[1]];
    let value = |n: usize| {
        let at = n / stride[axis] % size[axis];
        profile[if sign > 0.0 { at } else { profile.len() - 1 - at }]
    };
    let voxels: Vec<f32> = (0..size.iter().product()).map(value).collect();
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let center = DVec3::splat((BESIDE - 1) as f64 / 2.0) * (DVec3::ONE - axes[axis]);
    let up = axes[(axis + 1) % 3];
    let camera = Camera::new(center, axes[axis] * sign, up, [BESIDE; 2], 1.0).unwrap();
    let pixels = drawn(volume(Voxels::F32(&voxels), size, DAffine3::IDENTITY), &camera, context.clone());
    pixels.into_iter().map(|pixel| pixel.map(f64::from)).collect()
}

/// Checks that every pixel of every view along an axis has this colour.
fn assert_along(profile: &[f32], context: &Context, expected: [f64; 4]) {
    for view in ALONG {
        for pixel in along(profile, context, view) {
            let apart = (0..4).map(|c| (pixel[c] - expected[c]).abs()).fold(0.0, f64::max);
            assert!(apart <= BYTE, "{view:?}, {:?}: {pixel:?} instead of {expected:?}", context.mode);
        }
    }
}

fn noise(seed: u64, size: [usize; 3]) -> Vec<f32> {
    Random::new(seed).image(size.iter().product(), 0.0, 250.0)
}

/// Opaque after two slabs, the first one `front` opaque, the second one with opacity `back` behind it.
fn two([first, second]: [[f64; 3]; 2], front: f64, back: f64) -> [f64; 4] {
    let alpha = front + back;
    let colour = |c: usize| (first[c] * front + second[c] * back) / alpha;
    [colour(0), colour(1), colour(2), 255.0 * alpha]
}

/// The length of a ray through the box of a volume (mm).
fn chord(volume: &Volume, from: DVec3, direction: DVec3) -> f64 {
    let (start, way) = (
        volume.index_from_world().transform_point3(from),
        volume.index_from_world().transform_vector3(direction),
    );
    let last = DVec3::from(volume.size().map(|n| n as f64 - 0.5));
    let ends = [(DVec3::splat(-0.5) - start) / way, (last - start) / way];
    (ends[0].max(ends[1]).min_element() - ends[0].min(ends[1]).max_element()).max(0.0)
}

#[test]
fn a_constant_volume_lets_through_what_its_thickness_does_whatever_the_step() {
    let size = [13, 11, 9];
    let voxels = vec![100i16; size.iter().product()];
    let even = volume(Voxels::I16(&voxels), size, sheared(size));
    let camera = view([0.4, 1.0, -0.7], [37, 23], 0.8);
    for gamma in [-1.0, -0.5, 0.0] {
        for step in [0.05, 0.7, 2.0, 100.0] {
            let mode = ContextMode::Blend { gamma };
            let context = Context { step: Some(step), ..coloured(mode, &[(0.0, [200, 100, 50], 0.1)]) };
            for (p, pixel) in drawn(even, &camera, context).into_iter().enumerate() {
                let [x, y] = [camera.view_x(p % 37), camera.view_y(p / 37)];
                let from = camera.world_from_view(DVec3::new(x, y, 0.0));
                let expected = 255.0 * (1.0 - 0.9f64.powf(chord(&even, from, camera.direction())));
                assert!((f64::from(pixel[3]) - expected).abs() <= BYTE, "{step} mm: {pixel:?} {expected}");
                let colour = if pixel[3] > 0 { [200, 100, 50] } else { [0; 3] };
                assert_eq!(pixel[..3], colour);
            }
        }
    }
}

#[test]
fn opacity_is_per_millimetre_also_where_voxels_are_not() {
    let size = [40, 30, 20];
    let voxels = vec![7.0f32; size.iter().product()];
    let sides = DVec3::new(0.25, 0.5, 2.0);
    let middle = DVec3::from(size.map(|n| (n - 1) as f64)) * sides / 2.0;
    let place = DAffine3::from_translation(-middle) * DAffine3::from_scale(sides);
    let volume = volume(Voxels::F32(&voxels), size, place);
    for (direction, length) in [([1.0, 0.0, 0.0], 10.0), ([0.0, 1.0, 0.0], 15.0), ([0.0, 0.0, -1.0], 40.0)] {
        for opacity in [0.0, 1e-3, 0.5, 0.999, 1.0] {
            for step in [0.3, 1.0, 7.0] {
                let context = Context { step: Some(step), ..coloured(DVR, &[(0.0, [255; 3], opacity)]) };
                let expected = 255.0 * (1.0 - (1.0 - opacity).powf(length));
                for pixel in drawn(volume, &view(direction, [3, 3], 0.5), context) {
                    assert!((f64::from(pixel[3]) - expected).abs() <= BYTE, "{opacity}, {step}: {pixel:?}");
                }
            }
        }
    }
}

#[test]
fn projections_of_a_ramp_are_its_ends_and_its_mean() {
    let profile: Vec<f32> = (2..22).map(|n| 10.0 * n as f32).collect();
    let points: Points = &[(10.0, [0; 3], 0.0), (230.0, [255; 3], 0.0)];
    for (mode, value) in [(ContextMode::Minimum, 20.0), (ContextMode::Average, 115.0), (MIP, 210.0)] {
        let grey = 255.0 * (value - 10.0) / 220.0;
        assert_along(&profile, &coloured(mode, points), [grey, grey, grey, 255.0]);
    }
}

#[test]
fn projections_do_not_see_the_opacity() {
    let size = [13, 11, 9];
    let voxels = noise(0, size);
    let volume = volume(Voxels::F32(&voxels), size, sheared(size));
    let camera = view([0.4, 1.0, -0.7], [37, 23], 0.8);
    let clear: Vec<_> = COLOURS.iter().map(|&(at, color, _)| (at, color, 0.0)).collect();
    for mode in [MIP, ContextMode::Minimum, ContextMode::Average] {
        let [seen, same] = [COLOURS, &clear].map(|points| drawn(volume, &camera, coloured(mode, points)));
        assert!(seen == same && seen.iter().any(|pixel| pixel[3] > 0), "{mode:?}");
    }
}

#[test]
fn dvr_of_a_ramp_tends_to_the_integral() {
    // The integral of -ln(1 - o) over a length on which the opacity o per mm rises linearly.
    let part = |o: f64| (1.0 - o) * ((1.0 - o).ln() - 1.0);
    let most = 0.9 * 180.0 / 200.0;
    let depth = -(part(0.0) - part(most)) / most - 0.5 * (1.0 - most).ln();
    let exact = 255.0 * (1.0 - (-depth).exp());
    let points: Points = &[(0.0, [255; 3], 0.0), (200.0, [255; 3], 0.9)];
    for (step, low, high) in [(2.0, 20.0, 255.0), (0.7, 0.0, 1.0), (0.25, 0.0, 1.0), (0.02, 0.0, BYTE + 0.1)]
    {
        let context = Context { step: Some(step), ..coloured(DVR, points) };
        for pixel in ALONG.into_iter().flat_map(|view| along(&[0.0, 180.0], &context, view)) {
            let error = (pixel[3] - exact).abs();
            assert!((low..=high).contains(&error), "a step of {step} mm is {error} of 255 away");
        }
    }
}

#[test]
fn a_brighter_slab_shines_through_by_the_formula() {
    // Samples lie on voxel centres: 3 mm of one value, a gap, then 2 mm of another value.
    let (dim, bright) = (65.0, 175.0);
    let points: Points = &[(60.0, [0; 3], 0.0), (65.0, [250, 0, 0], 0.6), (175.0, [0, 250, 0], 0.3)];
    let profile = [0.0, dim, dim, dim, 0.0, 0.0, bright, bright, 0.0];
    let window = Window { level: 100.0, width: 200.0 };
    for gamma in [-1.0f64, -0.7, 0.0, 0.4, 1.0] {
        let context = Context { window, ..coloured(ContextMode::Blend { gamma }, points) };
        let rise = f64::from(bright - dim) / 200.0;
        let front = (1.0 - rise * (1.0 + gamma.min(0.0))) * (1.0 - 0.4f64.powi(3));
        let (mix, back) = (gamma.max(0.0), (1.0 - front) * (1.0 - 0.7f64.powi(2)));
        let [red, green] = [front * (1.0 - mix), back * (1.0 - mix) + mix];
        assert_along(&profile, &context, two([[250.0, 0.0, 0.0], [0.0, 250.0, 0.0]], red, green));
    }
}

#[test]
fn a_dimmer_slab_behind_is_composited_as_in_dvr() {
    let points: Points = &[(60.0, [0; 3], 0.0), (65.0, [250, 0, 0], 0.6), (175.0, [0, 250, 0], 0.3)];
    let front = 1.0 - 0.7f64.powi(2);
    let expected = two([[0.0, 250.0, 0.0], [250.0, 0.0, 0.0]], front, (1.0 - front) * (1.0 - 0.4f64.powi(3)));
    for mode in [MIDA, DVR] {
        assert_along(&[0., 175., 175., 0., 65., 65., 65., 0.], &coloured(mode, points), expected);
    }
}

#[test]
fn clear_values_in_front_do_not_dampen_what_shines() {
    // Transparent values raise the maximum too: behind 120, the value 150 is only 30 brighter.
    let points: Points = &[
        (60.0, [0; 3], 0.0),
        (65.0, [250, 0, 0], 0.6),
        (70.0, [0; 3], 0.0),
        (140.0, [0; 3], 0.0),
        (150.0, [0, 250, 0], 0.5),
    ];
    let context = Context { window: Window { level: 100.0, width: 200.0 }, ..coloured(MIDA, points) };
    for (gap, rises) in [(0.0, [85.0 / 200.0, 0.0]), (120.0, [30.0 / 200.0, 55.0 / 200.0])] {
        let front = 0.6 * (1.0 - rises[0]) * (1.0 - rises[1]);
        let expected = two([[250.0, 0.0, 0.0], [0.0, 250.0, 0.0]], front, (1.0 - front) * 0.5);
        assert_along(&[0.0, 65.0, gap, gap, 150.0, 0.0], &context, expected);
    }
}

#[test]
fn a_single_bright_voxel_peaks_as_a_tent() {
    let mut voxels = [0i16; 343];
    voxels[3 * 49 + 3 * 7 + 3] = 200;
    let camera = Camera::new(DVec3::new(3.0, 0.0, 3.0), DVec3::Y, DVec3::Z, [33, 31], 0.125).unwrap();
    let context = coloured(MIP, &[(0.0, [0; 3], 0.0), (200.0, [250; 3], 1.0)]);
    let volume = volume(Voxels::I16(&voxels), [7; 3], DAffine3::IDENTITY);
    for (p, pixel) in drawn(volume, &camera, context).into_iter().enumerate() {
        let [x, y] = [camera.view_x(p % 33), camera.view_y(p / 33)].map(|at| (1.0 - at.abs()).max(0.0));
        assert!((f64::from(pixel[0]) - 250.0 * x * y).abs() <= BYTE && pixel[3] == 255, "{pixel:?}");
    }
}

#[test]
fn along_an_axis_the_largest_value_is_that_of_a_voxel() {
    let size = [29, 31, 23];
    let mut random = Random::new(1);
    let voxels: Vec<u8> = (0..size.iter().product()).map(|_| (random.number() * 256.0) as u8).collect();
    for side in [0.7, 0.1, 1.0 / 3.0, 0.976_562_5, 1.5] {
        let place = DAffine3::from_translation(DVec3::new(17.3, -211.7, 1033.1))
            * DAffine3::from_scale(DVec3::splat(side));
        let volume = volume(Voxels::U8(&voxels), size, place);
        let middle = place.transform_point3(DVec3::from(size.map(|n| (n - 1) as f64)) / 2.0);
        let camera = Camera::new(middle, DVec3::Y, DVec3::Z, [29, 23], side).unwrap();
        let context = coloured(MIP, &[(0.0, [0; 3], 0.0), (255.0, [255; 3], 1.0)]);
        for (p, pixel) in drawn(volume, &camera, context).into_iter().enumerate() {
            let (i, k) = (p % 29, 22 - p / 29);
            let largest = (0..31).map(|j| voxels[k * 29 * 31 + j * 29 + i]).max().unwrap();
            assert_eq!(pixel[0], largest, "voxels of {side} mm, column {i}, slice {k}");
        }
    }
}

#[test]
fn gamma_moves_the_picture_without_leaps_and_smaller_steps_converge() {
    let size = [13, 11, 9];
    let voxels = noise(3, size);
    let volume = volume(Voxels::F32(&voxels), size, sheared(size));
    let camera = view([0.4, 1.0, -0.7], [37, 23], 0.4);
    let fine = |gamma, step| {
        let context = coloured(ContextMode::Blend { gamma }, COLOURS);
        drawn(volume, &camera, Context { step: (gamma < 1.0).then_some(step), ..context })
    };
    for [gamma, near] in [[-0.999, -1.0], [-1e-3, 0.0], [1e-3, 0.0], [0.999, 1.0]] {
        // γ = 1 takes the exact maximum; the maximum of dense samples is close to it.
        let apart = apart(&fine(near, 0.002), &fine(gamma, 0.002), 50);
        assert!(apart <= 3, "γ of {gamma} is {apart} of 255 from that of {near}");
    }
    let limit = fine(0.0, 0.01);
    let error = |step| {
        let found = fine(0.0, step);
        let both = found.iter().flatten().zip(limit.iter().flatten());
        both.map(|(a, b)| f64::from(a.abs_diff(*b))).sum::<f64>() / (4 * limit.len()) as f64
    };
    assert!(error(4.0) > 1.5 * error(0.5) && error(0.5) > 1.5 * error(0.05) && error(0.05) < 0.5);
}

#[test]
fn two_control_points_at_one_intensity_make_a_step() {
    let camera = Camera::new(DVec3::new(1.0, 0.0, 1.0), DVec3::Y, DVec3::Z, [1, 1], 1.0).unwrap();
    for at in [0.0, 100.0, -1000.0, 1e6] {
        let points: Points = &[
            (at - 5.0, [9; 3], 0.1),
            (at, [20, 30, 40], 0.1),
            (at, [240, 30, 40], 0.8),
            (at + 5.0, [0; 3], 0.8),
        ];
        for (beside, red, opacity) in [(-0.125, 20.0, 0.1), (0.125, 240.0, 0.8)] {
            let voxels = [at + beside; 9];
            let volume = volume(Voxels::F64(&voxels), [3, 1, 3], DAffine3::IDENTITY);
            let pixel = drawn(volume, &camera, coloured(DVR, points))[0].map(f64::from);
            assert!((pixel[0] - red * (1.0 - 0.125 / 5.0)).abs() <= 0.8, "{pixel:?} at {at}");
            assert!((pixel[3] - 255.0 * opacity).abs() <= BYTE, "{pixel:?} at {at}");
            assert_eq!(drawn(volume, &camera, coloured(MIP, points))[0][3], 255);
        }
    }
}

#[test]
fn values_beyond_all_windows_count_as_bright_or_dark_as_there_is() {
    let points: Points = &[(0.0, [0; 3], 0.0), (200.0, [250, 0, 0], 0.5)];
    let camera = view([0.4, 1.0, -0.7], [37, 23], 0.5);
    for value in [f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300, 3e38] {
        let mut voxels = [100.0; 210];
        voxels[2 * 42 + 3 * 7 + 3] = value;
        let place = DAffine3::from_translation(DVec3::new(-3.0, -2.5, -2.0));
        let volume = volume(Voxels::F64(&voxels), [7, 6, 5], place);
        for mode in [DVR, MIDA, MIP, ContextMode::Minimum, ContextMode::Average] {
            let pixels = drawn(volume, &camera, coloured(mode, points));
            assert!(pixels.iter().any(|pixel| pixel[3] > 0));
            let is_grey = !matches!(mode, ContextMode::Blend { .. });
            assert!(is_grey || pixels.iter().all(|pixel| pixel[1..3] == [0, 0]), "{mode:?} of {value}");
            let largest = pixels.iter().map(|pixel| pixel[0]).max();
            assert!(mode != MIP || largest == Some(if value > 200.0 { 250 } else { 125 }), "{value}");
        }
    }
}

#[test]
fn presets_follow_the_context_window() {
    let camera = Camera::new(DVec3::new(1.0, 0.0, 1.0), DVec3::Y, DVec3::Z, [1, 1], 1.0).unwrap();
    for (preset, clear, (last, most)) in [
        (Preset::Grey, 0.0, (1.0, 0.3)),
        (Preset::Angio, 0.28, (1.0, 0.7)),
        (Preset::Bone, 0.6, (1.2, 0.7)),
        (Preset::SoftTissue, 0.03, (1.0, 0.5)),
    ] {
        for (scale, shift) in [(1.0, 0.0), (8.0, -1000.0)] {
            let [level, width] = [LOW_WINDOW.level * scale + shift, LOW_WINDOW.width * scale];
            let window = Window { level, width };
            let context =
                Context { window, transfer: preset.transfer_function(window), ..coloured(DVR, COLOURS) };
            for (place, opacity) in [(clear, 0.0), (last, most), (last + 0.5, most)] {
                let voxels = [level + width * (place - 0.5); 9];
                let volume = volume(Voxels::F64(&voxels), [3, 1, 3], DAffine3::IDENTITY);
                let found = f64::from(drawn(volume, &camera, context.clone())[0][3]);
                assert!((found - 255.0 * opacity).abs() <= BYTE, "{preset:?} at {place}: {found}");
            }
        }
    }
}

#[test]
fn shading_is_that_of_the_direction_in_which_values_rise_at_the_place() {
    let size = [16, 12, 12];
    let value = |n: usize| (100 + 1000 * if n % 16 < 8 { n / 16 % 12 } else { n / 192 }) as i16;
    let voxels: Vec<i16> = (0..size.iter().product()).map(value).collect();
    let scene = volume(Voxels::I16(&voxels), size, DAffine3::IDENTITY);
    let camera = Camera::new(DVec3::new(7.5, 0.0, 5.5), DVec3::Y, DVec3::Z, [16, 12], 1.0).unwrap();
    let context = Context { shading: true, ..coloured(DVR, &[(0.0, [100; 3], 1.0)]) };
    let pixels = drawn(scene, &camera, context);
    // A surface that faces the viewer keeps its colour and reflects; one seen edge on keeps the ambient share.
    let [faces, edge_on] = [f64::from(100.0 + 255.0 * SPECULAR), f64::from(100.0 * AMBIENT)];
    for row in pixels.chunks(16).skip(2).take(8) {
        assert!(row[2..6].iter().all(|pixel| (f64::from(pixel[0]) - faces).abs() < 3.0), "{row:?}");
        assert!(row[10..14].iter().all(|pixel| (f64::from(pixel[0]) - edge_on).abs() < 3.0), "{row:?}");
    }
}
