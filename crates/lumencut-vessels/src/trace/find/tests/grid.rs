use super::*;
use glam::DMat3;
use lumencut_core::volume::{self, Volume};

/// The grid over 20 × 10 × 5 voxels with these axes (mm).
fn grid(axes: DMat3, smallest_radius: f64) -> Grid {
    let values = vec![0.0_f32; 1000];
    let world = DAffine3 { matrix3: axes, translation: DVec3::new(5.0, -7.0, 11.0) };
    let volume =
        Volume::new(volume::Voxels::F32(&values), [20, 10, 5], [1, 20, 200], world).expect("a volume");
    Grid::over(&Voxels::new(&volume), smallest_radius)
}

#[test]
fn cubes_are_kept_as_they_are() {
    let made = grid(DMat3::from_diagonal(DVec3::splat(1.5)), 1.0);
    assert_eq!((made.size, made.side), ([20, 10, 5], 1.5));
    assert!(made.world(DVec3::new(2.0, 3.0, 4.0)).distance(DVec3::new(8.0, -2.5, 17.0)) < 1e-12);
    assert!(made.holds(DVec3::new(-0.5, 9.5, 4.5)) && !made.holds(DVec3::new(-0.6, 0.0, 0.0)));
}

#[test]
fn uneven_voxels_become_cubes_of_their_mean_side_and_fine_ones_no_finer_than_is_needed() {
    let uneven = grid(DMat3::from_diagonal(DVec3::new(1.0, 1.0, 8.0)), 1.0);
    assert_eq!((uneven.side, uneven.size), (2.0, [10, 5, 17]));
    assert_eq!(grid(DMat3::from_diagonal(DVec3::splat(0.2)), 0.52).side, 0.4);
    // The surroundings stay visible if only wide vessels are wanted.
    assert_eq!(grid(DMat3::from_diagonal(DVec3::splat(0.2)), 5.0).side, 0.8);
}

#[test]
fn sheared_and_left_handed_grids_lie_within_square_ones() {
    let sheared = DMat3::from_cols(DVec3::X, DVec3::Y, DVec3::new(0.0, 0.5, -1.0));
    let made = grid(sheared, 0.5);
    let axes = made.world_from_grid.matrix3;
    assert!(axes.x_axis.dot(axes.y_axis).abs() < 1e-12 && axes.y_axis.dot(axes.z_axis).abs() < 1e-12);
    let corner = sheared * DVec3::new(19.0, 9.0, 4.0) + DVec3::new(5.0, -7.0, 11.0);
    assert!(made.holds(made.grid_from_world.transform_point3(corner)));
    assert!(made.world(made.grid_from_world.transform_point3(corner)).distance(corner) < 1e-9);
}
