//! Compares parts of mask tracing with slow exhaustive computations.

use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{DAffine3, DMat3, DVec3};
use lumencut_core::error::ErrorKind;
use lumencut_core::volume::{Volume, Voxels};
use lumencut_vessels::trace::lines::centerline::Centerline;
use lumencut_vessels::trace::mask::{MaskRequest, trace_mask};
use lumencut_vessels::trace::skeleton::distance_transform::squared_distances;
use lumencut_vessels::trace::skeleton::foreground::{Foreground, LUMEN};

const SIZE: [usize; 3] = [14, 11, 9];

fn voxels(seed: u32) -> Vec<u8> {
    let mut state = seed;
    let next = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        u8::from((state >> 16) % 16 > 1)
    };
    std::iter::repeat_with(next).take(SIZE.iter().product()).collect()
}

fn foreground(voxels: &[u8], axes: DMat3) -> Foreground {
    let strides = [1, SIZE[0], SIZE[0] * SIZE[1]];
    let affine = DAffine3::from_mat3_translation(axes, DVec3::new(3.0, -7.0, 11.0));
    let volume =
        Volume::new(Voxels::U8(voxels), SIZE, strides, affine).unwrap_or_else(|error| panic!("{error}"));
    Foreground::new(&volume, None, &|| false).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn distances_are_those_to_the_nearest_background() {
    let columns = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| {
        DMat3::from_cols(DVec3::from_array(a), DVec3::from_array(b), DVec3::from_array(c))
    };
    let grids = [
        columns([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]),
        columns([0.4, 0.0, 0.0], [0.0, 0.7, 0.0], [0.0, 0.0, 2.1]),
        // A rotated grid and a left-handed one, both rectangular.
        columns([0.6, 0.8, 0.0], [0.8, -0.6, 0.0], [0.0, 0.0, 1.5]),
        columns([0.8, 0.0, 0.0], [0.0, 0.8, 0.3], [0.0, 0.0, 1.0]),
        columns([0.5, 0.1, 0.0], [-0.2, 0.6, 0.0], [0.3, 0.1, 0.9]),
    ];
    for (seed, axes) in (1..).zip(grids) {
        let grid = foreground(&voxels(seed), axes);
        let (lumen, outside): (Vec<usize>, Vec<usize>) =
            (0..grid.cells.len()).partition(|&cell| grid.cells[cell] == LUMEN);
        let lumen: Vec<u32> = lumen.into_iter().map(|cell| cell as u32).collect();
        let background: Vec<DVec3> = outside.iter().map(|&cell| grid.position(cell)).collect();
        let squares = squared_distances(&grid, &lumen, &|| false).unwrap_or_else(|error| panic!("{error}"));
        for &cell in &lumen {
            let place = grid.position(cell as usize);
            let nearest =
                background.iter().map(|other| other.distance_squared(place)).fold(f64::MAX, f64::min);
            let found = f64::from(squares[cell as usize]);
            assert!((found - nearest).abs() <= 1e-5 * nearest, "{found} {nearest} at {place}");
        }
        assert!(outside.into_iter().all(|cell| squares[cell].to_bits() == 0));
    }
}

fn bar(voxels: &mut Vec<u8>) -> Volume<'_> {
    voxels.resize(40 * 12 * 12, 0);
    for k in 4..8 {
        for j in 4..8 {
            for i in 3..37 {
                voxels[i + 40 * (j + 12 * k)] = 1;
            }
        }
    }
    Volume::new(Voxels::U8(voxels), [40, 12, 12], [1, 40, 480], DAffine3::IDENTITY)
        .unwrap_or_else(|error| panic!("{error}"))
}

fn request<'a>(stop: &'a (dyn Fn() -> bool + Sync)) -> MaskRequest<'a> {
    let (labels, refine, progress) = (None, None, None);
    MaskRequest { labels, parent_radii: 2.0, step: 0.5, bridge: 0.0, refine, stop, progress }
}

#[test]
fn a_refinement_moves_the_lines_and_measures_radii() {
    let mut voxels = Vec::new();
    let volume = bar(&mut voxels);
    let shifted = |points: &[DVec3], radius: &[f64]| {
        assert!(radius.iter().all(|radius| (1.5..2.5).contains(radius)), "{radius:?}");
        let moved = points.iter().map(|point| *point + DVec3::new(0.0, 0.3, 0.0)).collect();
        let [radius, confidence] = [1.25, 0.75].map(|value| vec![value; points.len()]);
        Ok(Some(Centerline { points: moved, radius, confidence }))
    };
    let plain = trace_mask(&volume, &request(&|| false)).unwrap_or_else(|error| panic!("{error}"));
    let refined = MaskRequest { refine: Some(&shifted), ..request(&|| false) };
    let refined = trace_mask(&volume, &refined).unwrap_or_else(|error| panic!("{error}"));
    let pairs = plain.vessels[0].points.iter().zip(&refined.vessels[0].points);
    assert!(pairs.into_iter().all(|(before, after)| (after.y - before.y - 0.3).abs() < 1e-9));
    assert_eq!(refined.vessels[0].radius, vec![1.25; plain.vessels[0].points.len()]);
}

#[test]
fn every_step_hears_a_request_to_stop() {
    let mut voxels = Vec::new();
    let volume = bar(&mut voxels);
    let asked = AtomicUsize::new(0);
    let count = || {
        asked.fetch_add(1, Ordering::Relaxed);
        false
    };
    trace_mask(&volume, &request(&count)).unwrap_or_else(|error| panic!("{error}"));
    let whole = asked.load(Ordering::Relaxed);
    assert!(whole > 10, "{whole}");
    for last in (0..whole).step_by(3) {
        let asked = AtomicUsize::new(0);
        let stop = || asked.fetch_add(1, Ordering::Relaxed) >= last;
        let kind = trace_mask(&volume, &request(&stop)).err().map(|error| error.kind);
        assert_eq!(kind, Some(ErrorKind::Interrupted), "after {last}");
    }
}
