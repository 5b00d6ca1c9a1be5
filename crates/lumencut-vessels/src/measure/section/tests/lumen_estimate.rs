use super::*;
use glam::{DAffine3, DVec3};
use lumencut_core::volume::{Volume, Voxels as Stored};

/// Sampling steps (mm): of rays, and of the search within 30 mm, in a volume of 32 × 22 × 22 voxels.
fn steps(sides: [f64; 3]) -> [f64; 2] {
    let values = vec![0.0_f32; 32 * 22 * 22];
    let placed = DAffine3::from_scale(DVec3::from_array(sides));
    let volume = Volume::new(Stored::F32(&values), [32, 22, 22], [1, 32, 32 * 22], placed).expect("a volume");
    let voxels = Voxels::new(&volume);
    [voxels.sampling_side, search_step(&voxels, 30.0)]
}

#[test]
fn even_voxels_are_sampled_by_their_side() {
    assert_eq!(steps([0.7; 3]), [0.7; 2]);
    assert_eq!(steps([0.6, 0.6, 5.0]), [0.6; 2]);
}

#[test]
fn the_number_of_samples_does_not_grow_with_how_uneven_voxels_are() {
    for thin in [0.2, 0.02, 0.000_2] {
        assert_eq!(steps([6.0, 2.0, thin])[0], 0.5);
        let [_, search] = steps([6.0, thin, thin]);
        let count = (2.0 * 30.0 / search).powi(2);
        assert!(count <= 32.0 * 22.0 * 22.0 + 1.0, "{count} places for {thin} mm");
    }
}
