use glam::DAffine3;
use lumencut_core::vessel_tree::Vessel;
use lumencut_core::volume::Voxels;

use super::*;

/// Voxels of 1 mm, with a value for each index.
fn grid(size: [usize; 3], value: impl Fn([usize; 3]) -> f32) -> Vec<f32> {
    let [ni, nj, nk] = size;
    (0..ni * nj * nk).map(|n| value([n % ni, n / ni % nj, n / (ni * nj)])).collect()
}

fn volume(voxels: &[f32], size: [usize; 3]) -> Volume<'_> {
    Volume::new(Voxels::F32(voxels), size, [1, size[0], size[0] * size[1]], DAffine3::IDENTITY).unwrap()
}

/// The windows by volume alone.
fn along(volume: &Volume, tree: &VesselTree) -> Result<Window> {
    super::along(&VoxelSample::at(volume), volume, tree)
}

fn of_volume(volume: &Volume) -> Result<Window> {
    super::of_volume(&VoxelSample::at(volume))
}

fn of_mip(volume: &Volume) -> Result<Window> {
    super::of_mip(&VoxelSample::at(volume))
}

fn of_slices(volume: &Volume) -> Result<Window> {
    super::of_slices(&VoxelSample::at(volume))
}

fn whole(volume: &Volume) -> Result<Window> {
    super::whole(&VoxelSample::at(volume))
}

fn mra(volume: &Volume) -> Result<Window> {
    super::mra(&VoxelSample::at(volume))
}

fn tree(radius: Option<f64>) -> VesselTree {
    let points = vec![DVec3::new(2.0, 20.0, 20.0), DVec3::new(37.0, 20.0, 20.0)];
    VesselTree::new(vec![Vessel::new(points, radius.map(|r| vec![r; 2])).unwrap()]).unwrap()
}

fn rod() -> Vec<f32> {
    grid([40, 40, 40], |[_, j, k]| if j.abs_diff(20) < 5 && k.abs_diff(20) < 5 { 400.0 } else { 100.0 })
}

/// The position of a value in a window: 0 is black, 1 is white.
fn share(window: Window, value: f64) -> f64 {
    (value - window.level) / window.width + 0.5
}

#[test]
fn a_window_along_centerlines_has_the_lumen_light_and_the_darkest_tissue_black() {
    let voxels = rod();
    for radius in [None, Some(4.0), Some(0.0)] {
        let found = along(&volume(&voxels, [40; 3]), &tree(radius)).unwrap();
        assert!(share(found, 100.0).abs() < 1e-12);
        // No voxel is brighter than the lumen.
        assert!((share(found, 400.0) - LUMEN_POSITION[1]).abs() < 1e-12);
    }
}

#[test]
fn a_dark_lumen_has_the_mirrored_window_of_a_bright_one() {
    let [bright, dark] = [1.0, -1.0].map(|sign| {
        // Some voxels are brighter than white; in the negated volume they are darker than black.
        let voxels: Vec<f32> =
            rod().iter().enumerate().map(|(i, value)| sign * if i < 50 { 1500.0 } else { *value }).collect();
        along(&volume(&voxels, [40; 3]), &tree(Some(4.0))).unwrap()
    });
    assert_eq!(dark, Window { level: -bright.level, width: bright.width });
}

#[test]
fn white_is_the_brightest_there_is_and_black_the_darkest_within_what_the_lumen_needs() {
    for (ends, expected) in [
        // Black lies below the lumen by 1.5 times the difference.
        ([-1000.0, 550.0], [-50.0, 550.0]),
        ([0.0, 500.0], [0.0, 500.0]),
        ([-1000.0, 5000.0], [-50.0, 325.0 + 375.0 * (1.0 / 0.60 - 1.0)]),
        ([-1000.0, 330.0], [-50.0, 325.0 + 375.0 * (1.0 / 0.72 - 1.0)]),
        // Black never lies above the tissue.
        ([90.0, 330.0], [75.0, 325.0 + 250.0 * (1.0 / 0.72 - 1.0)]),
    ] {
        let found = around_lumen(325.0, Tissue { middle: 75.0, darkest: None }, 0.0, ends);
        let close = found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-9);
        assert!(close, "{found:?}, expected {expected:?}");
    }
}

#[test]
fn the_darkest_tissue_is_above_black_as_long_as_the_tissue_stays_dark() {
    let ends = [-1000.0, 5000.0];
    for (darkest, expected) in [
        // The tissue is bright enough: black lies below the lumen by 1.5 times the difference.
        (-10.0, -75.0),
        (-100.0, 300.0 - 1.1 * 400.0),
        // Black lies below the lumen by at most 2.2 times the difference.
        (-800.0, -250.0),
    ] {
        let tissue = Tissue { middle: 50.0, darkest: Some(darkest) };
        let [black, white] = around_lumen(300.0, tissue, 0.0, ends);
        assert!((black - expected).abs() < 1e-9, "{darkest}: {black}");
        assert!((50.0 - black) / (white - black) < 0.4);
    }
}

#[test]
fn no_window_begins_below_the_smallest_value() {
    // A thick rod in tissue; a quarter of the volume is masked with 0.
    let voxels = grid([40; 3], |[i, j, k]| match (j.abs_diff(20), k.abs_diff(20)) {
        (0..7, 0..7) => 300.0,
        _ if i < 30 => 10.0 + ((3 * i + 5 * j + 7 * k) % 101) as f32,
        _ => 0.0,
    });
    let masked = volume(&voxels, [40; 3]);
    let black = |window: Window| window.level - window.width / 2.0;
    for found in [of_volume(&masked), of_mip(&masked), along(&masked, &tree(Some(6.0)))] {
        assert!(black(found.unwrap()).abs() < 1e-9);
    }
    assert!((share(of_volume(&masked).unwrap(), 300.0) - VOLUME_LUMEN_POSITION).abs() < 1e-9);
    // With a dark lumen, no voxel is as dark as black would be.
    let voxels =
        grid([40; 3], |[_, j, k]| if j.abs_diff(20) < 5 && k.abs_diff(20) < 5 { 20.0 } else { 200.0 });
    let dark = along(&volume(&voxels, [40; 3]), &tree(Some(4.0))).unwrap();
    assert!((black(dark) - 20.0).abs() < 1e-9 && share(dark, 200.0) > 0.6, "{dark:?}");
}

#[test]
fn noise_widens_a_window_until_the_tissue_would_be_grey() {
    let ends = [-1000.0, 5000.0];
    let black = |spread| around_lumen(300.0, Tissue { middle: 200.0, darkest: None }, spread, ends)[0];
    for (spread, expected) in [(10.0, 150.0), (75.0, 150.0), (100.0, 100.0), (110.0, 80.0), (190.0, 80.0)] {
        assert!((black(spread) - expected).abs() < 1e-9, "noise of {spread}: {}", black(spread));
    }
    // If lumen and tissue do not differ, the noise defines the window.
    assert_eq!(black(210.0), -120.0);
    for spread in [0.0, 60.0, 190.0] {
        let [black, white] = around_lumen(300.0, Tissue { middle: 200.0, darkest: None }, spread, ends);
        assert!((200.0 - black) / (white - black) < 0.4);
    }
}

#[test]
fn vessels_without_tissue_have_their_edges_for_it() {
    for nothing in [0.0, f32::NAN] {
        let voxels = grid([40; 3], |[i, j, k]| match (j.abs_diff(20), k.abs_diff(20)) {
            (0..2, 0..2) => 300.0,
            (0..3, 0..3) => 180.0 + ((3 * i + 5 * j + 7 * k) % 41) as f32,
            _ => nothing,
        });
        let found = along(&volume(&voxels, [40; 3]), &tree(Some(2.0))).unwrap();
        assert!((share(found, 300.0) - LUMEN_POSITION[1]).abs() < 1e-12, "{nothing}: {found:?}");
        let black = found.level - found.width / 2.0;
        assert!((100.0..200.0).contains(&black), "black at {black}");
    }
}

#[test]
fn tissue_among_padding_is_darker_than_edges_between_bright_structures() {
    // Values below 60, as most voxels have, were clipped to 0. What touches the vessel is as bright as bone.
    let voxels = grid([10, 40, 40], |[i, j, k]| match (j.abs_diff(20), k.abs_diff(20)) {
        (0..2, 0..2) => 300.0,
        (0..3, 0..3) => 200.0 + ((3 * i + 5 * j + 7 * k) % 41) as f32,
        _ if k < 10 => 60.0,
        _ => 0.0,
    });
    let points = vec![DVec3::new(2.0, 20.0, 20.0), DVec3::new(7.0, 20.0, 20.0)];
    let vessel = Vessel::new(points, Some(vec![2.0; 2])).unwrap();
    let found = along(&volume(&voxels, [10, 40, 40]), &VesselTree::new(vec![vessel]).unwrap()).unwrap();
    let black = found.level - found.width / 2.0;
    assert!(black < 1e-9 && share(found, 300.0) >= LUMEN_POSITION[0], "{found:?}");
}

#[test]
fn beside_a_point_are_six_places_beyond_its_wall() {
    let places = beside(&tree(Some(3.0)), TISSUE_DISTANCE_MM);
    assert_eq!(places.len(), 12);
    assert!(places[..6].iter().all(|place| place.distance(DVec3::new(2.0, 20.0, 20.0)) == 13.0));
    assert_eq!(places[0], DVec3::new(15.0, 20.0, 20.0));
    assert_eq!(places[11], DVec3::new(37.0, 20.0, 7.0));
}

#[test]
fn windows_of_the_whole_leave_padding_out_and_the_full_one_nothing() {
    // Half of the voxels is padding, then follow tissue and 2 % lumen; one voxel of each has an extreme value.
    let voxels = grid([100, 1, 1], |[i, ..]| match i {
        0..50 => -1000.0,
        50..98 => 50.0,
        98 => 450.0,
        _ => 5000.0,
    });
    let volume = volume(&voxels, [100, 1, 1]);
    assert_eq!(full(&volume).unwrap(), Window { level: 2000.0, width: 6000.0 });
    let [whole, mra] = [whole(&volume).unwrap(), mra(&volume).unwrap()];
    assert_eq!(whole.level - whole.width / 2.0, -1000.0);
    assert!((1.0..5000.0).contains(&(whole.level + whole.width / 2.0)) && mra.width > whole.width);
}

#[test]
fn one_value_has_a_window_of_some_width() {
    let voxels = vec![2000.0; 8];
    let constant = volume(&voxels, [2; 3]);
    for found in [of_volume(&constant), whole(&constant), mra(&constant), full(&constant)] {
        assert_eq!(found.unwrap(), Window { level: 2000.0, width: 2.0 });
    }
    let voxels = vec![0.0; 8];
    assert_eq!(whole(&volume(&voxels, [2; 3])).unwrap(), Window { level: 0.0, width: 1e-6 });
}

#[test]
fn what_is_no_number_is_left_out() {
    let voxels = vec![f32::NAN, f32::INFINITY, 7.0, f32::NEG_INFINITY];
    assert_eq!(whole(&volume(&voxels, [4, 1, 1])).unwrap(), Window { level: 7.0, width: 7e-3 });
    let voxels = vec![f32::NAN; 4];
    let empty = volume(&voxels, [4, 1, 1]);
    for found in [whole(&empty), of_volume(&empty), full(&empty), mra(&empty)] {
        assert_eq!(found.unwrap(), EMPTY_VOLUME_WINDOW);
    }
    assert_eq!(along(&volume(&voxels, [4, 1, 1]), &tree(None)).unwrap(), EMPTY_VOLUME_WINDOW);
}

#[test]
fn values_beyond_all_windows_are_refused_with_what_was_found() {
    let voxels = vec![3e20; 8];
    let error = whole(&volume(&voxels, [2; 3])).unwrap_err();
    assert_eq!((error.kind, error.found.as_str()), (ErrorKind::Volume, "values from 3e+20 to 3e+20"));
}

#[test]
fn the_window_of_a_mip_reaches_to_the_brightest_and_is_at_most_so_much_wider() {
    let tissue = |i: usize, j: usize, k: usize| 40.0 + ((3 * i + 5 * j + 7 * k) % 41) as f32;
    for (brightest, wider) in [(300.0, 1.0), (3000.0, MIP_MAX_WIDENING)] {
        let voxels = grid([40; 3], |[i, j, k]| match (j.abs_diff(20), k.abs_diff(20)) {
            (0..2, 0..2) => brightest,
            (0..5, 0..5) => 300.0,
            _ => tissue(i, j, k),
        });
        let volume = volume(&voxels, [40; 3]);
        let [blended, mip] = [of_volume(&volume).unwrap(), of_mip(&volume).unwrap()];
        assert!((mip.width / blended.width - wider).abs() < 1e-9, "{brightest}: {mip:?} of {blended:?}");
        let black = |window: Window| window.level - window.width / 2.0;
        assert!((black(mip) - black(blended)).abs() < 1e-9);
    }
    // Between the two limits, white is at the brightest value.
    let voxels = grid([40; 3], |[i, j, k]| match (j.abs_diff(20), k.abs_diff(20)) {
        (0..2, 0..2) => 390.0,
        (0..5, 0..5) => 300.0,
        _ => tissue(i, j, k),
    });
    let found = of_mip(&volume(&voxels, [40; 3])).unwrap();
    assert!((found.level + found.width / 2.0 - 390.0).abs() < 1e-9, "{found:?}");
}

/// Air, fat and muscle with noise; a sac with the value 40 and a lumen of 350 along i.
fn sac() -> Vec<f32> {
    grid([40, 40, 40], |[i, j, k]| {
        let noise = ((i * 7919 + j * 104_729 + k * 1_299_709) % 97) as f32 / 97.0 - 0.5;
        let value = match (j.abs_diff(20), k.abs_diff(20), k) {
            (0..4, 0..4, _) => 350.0,
            (0..10, 0..10, _) => 40.0,
            (_, _, 0..4) => -1000.0,
            (_, _, 4..8) => -100.0,
            _ => 60.0,
        };
        value + 40.0 * noise
    })
}

#[test]
fn slices_without_vessels_show_a_sac_around_the_lumen() {
    let voxels = sac();
    let found = of_slices(&volume(&voxels, [40; 3])).unwrap();
    let [sac, lumen] = [40.0, 350.0].map(|value| share(found, value));
    assert!((0.12..0.35).contains(&sac), "{sac}");
    assert!((0.55..=0.75).contains(&lumen), "{lumen}");
}

#[test]
fn a_lumen_that_is_white_is_not_held() {
    let voxels = rod();
    let held = |level, width| holds_lumen(Window { level, width }, &volume(&voxels, [40; 3]), &tree(None));
    assert_eq!([held(300.0, 900.0), held(200.0, 200.0), held(1000.0, 100.0)], [true, false, true]);
}

#[test]
fn bright_vessels_beside_many_faint_ones_are_held() {
    // A third of the line is twice as bright as the rest.
    let voxels = grid([40, 40, 40], |[i, j, k]| match (i, j.abs_diff(20), k.abs_diff(20)) {
        (0..14, 0..5, 0..5) => 800.0,
        (_, 0..5, 0..5) => 400.0,
        _ => 100.0,
    });
    let (volume, tree) = (volume(&voxels, [40; 3]), line_of_points());
    assert!(!holds_lumen(along(&volume, &tree).unwrap(), &volume, &tree));
    let found = holding_lumen(&VoxelSample::at(&volume), &volume, &tree).unwrap();
    assert!(holds_lumen(found, &volume, &tree));
    assert!((share(found, 800.0) - BRIGHT_LUMEN_POSITION[0]).abs() < 1e-9);
}

/// The line of [`tree`], with a point every mm.
fn line_of_points() -> VesselTree {
    let points = (2..38).map(|i| DVec3::new(f64::from(i), 20.0, 20.0)).collect();
    VesselTree::new(vec![Vessel::new(points, None).unwrap()]).unwrap()
}

#[test]
fn slices_of_a_scan_whose_dark_values_are_cut_off_begin_there() {
    // A CT angiography with soft tissue of 62, in which all darker values are 0.
    let voxels: Vec<f32> = sac().iter().map(|value| if *value < 0.0 { 0.0 } else { *value }).collect();
    let found = of_slices(&volume(&voxels, [40; 3])).unwrap();
    assert!(share(found, 0.0) < 0.05 && share(found, 40.0) > 0.05, "{found:?}");
}
