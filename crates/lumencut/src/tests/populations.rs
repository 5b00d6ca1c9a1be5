use glam::DAffine3;
use lumencut_core::volume::Voxels;

use super::*;

fn volume(voxels: &[f32], size: [usize; 3]) -> Volume<'_> {
    Volume::new(Voxels::F32(voxels), size, [1, size[0], size[0] * size[1]], DAffine3::IDENTITY)
        .expect("a volume")
}

fn sampled(voxels: &[f32], size: [usize; 3]) -> VoxelSample {
    VoxelSample::at(&volume(voxels, size))
}

#[test]
fn all_of_a_small_volume_is_looked_at() {
    let voxels: Vec<f32> = (0..5 * 4 * 9).map(|n| n as f32).collect();
    let found = sampled(&voxels, [5, 4, 9]);
    assert!(found.voxels.iter().copied().eq((0..180).map(f64::from)));
    assert_eq!(found.count, 180);
    // The last voxel of each cube has i = 3 or 4, j = 3, and k = 3, 7 or 8.
    assert_eq!(found.largest, [78.0, 79.0, 158.0, 159.0, 178.0, 179.0]);
}

#[test]
fn what_is_no_number_counts_as_a_voxel_only() {
    let found = sampled(&[f32::NAN, f32::INFINITY, 7.0, f32::NEG_INFINITY], [4, 1, 1]);
    assert_eq!((found.voxels, found.largest, found.count), (vec![7.0], vec![7.0], 4));
    let found = sampled(&[f32::NAN; 4], [4, 1, 1]);
    assert_eq!((found.voxels.len(), found.largest.len(), found.count), (0, 0, 4));
    assert!(Populations::of(&found).is_none());
    assert_eq!(range(&volume(&[f32::NAN, 3.0, -2.0, f32::INFINITY], [4, 1, 1])), [-2.0, 3.0]);
}

#[test]
fn of_a_large_volume_cubes_that_are_spread_over_it_are_looked_at() {
    let size = [256, 256, 128];
    let found = sampled(&vec![1.0; 256 * 256 * 128], size);
    // There are 64 × 64 × 32 cubes, four times too many, so every second one along each axis is used.
    assert_eq!((found.largest.len(), found.voxels.len()), (32 * 32 * 16, 32 * 32 * 16 * 64));
}

#[test]
fn padding_is_a_dark_value_that_many_voxels_have() {
    let padded = [vec![-2000.0; 30], (0..70).map(f64::from).collect()].concat();
    assert_eq!(without_padding(&padded).len(), 70);
    // Equally many voxels of a middle value are no padding, and neither is a constant volume.
    let tissue =
        [(0..35).map(f64::from).collect(), vec![35.0; 31], (36..70).map(f64::from).collect()].concat();
    assert_eq!(without_padding(&tissue).len(), 100);
    assert_eq!(without_padding(&[0.0; 50]).len(), 50);
    assert_eq!(without_padding(&[]).len(), 0);
}

#[test]
fn few_voxels_beside_padding_are_vessels() {
    // 0.8 % of the voxels have the value 200.
    let voxels: Vec<f32> = (0..1000).map(|n| if n < 8 { 200.0 } else { 0.0 }).collect();
    let found = Populations::of(&sampled(&voxels, [10; 3])).expect("voxels");
    assert_eq!(
        (found.darkest, found.lumen, found.tissue, found.brightest_tissue),
        (0.0, 200.0, 150.0, 150.0)
    );
}

/// Air clipped at −1000, tissue of 40 to 60, a rod of 300, and a thicker rod of 1000.
fn body() -> Vec<f32> {
    let value = |[i, j, k]: [usize; 3]| match (i, j, k) {
        (0..6, ..) => -1000.0,
        (6..8, ..) => -990.0 + (5 * j + 3 * k) as f32 % 50.0,
        (20..24, 8..16, _) => 300.0,
        (32..40, 32..40, _) => 1000.0,
        _ => 40.0 + ((7 * i + 5 * j + 3 * k) % 21) as f32,
    };
    (0..48 * 48 * 48).map(|n| value([n % 48, n / 48 % 48, n / (48 * 48)])).collect()
}

#[test]
fn lumen_is_told_from_tissue_and_bone_by_cubes() {
    let found = Populations::of(&sampled(&body(), [48; 3])).expect("voxels");
    assert_eq!((found.darkest, found.lumen, found.brightest_tissue), (-1000.0, 300.0, 60.0));
    assert!((48.0..=52.0).contains(&found.tissue), "tissue {}", found.tissue);
}

#[test]
fn units_do_not_matter() {
    let voxels = body();
    let [plain, other] = [voxels.clone(), voxels.iter().map(|value| value * 0.5 + 8192.0).collect()]
        .map(|voxels: Vec<f32>| Populations::of(&sampled(&voxels, [48; 3])).expect("voxels"));
    assert_eq!(other.lumen, plain.lumen * 0.5 + 8192.0);
    assert_eq!(other.tissue, plain.tissue * 0.5 + 8192.0);
}
