use super::*;
use glam::DVec3;

fn across(axes: [DVec3; 2]) -> SectionPlane {
    SectionPlane { at: 0.0, origin: DVec3::ZERO, axes, normal: axes[0].cross(axes[1]) }
}

#[test]
fn widths_and_variances_belong_together() {
    assert!((fwhm_of(variance_of(0.8)) - 0.8).abs() < 1e-15);
    // At a distance of half its full width from the centre, the Gaussian has half of its maximum.
    assert!(((-0.4_f64.powi(2) / (2.0 * variance_of(0.8))).exp() - 0.5).abs() < 1e-12);
}

#[test]
fn uneven_voxels_blur_by_their_sides() {
    let blur = Blur::new(0.8, DMat3::from_diagonal(DVec3::new(0.4, 0.5, 1.2)));
    let spread = variance_of(0.8);
    let found = blur.of_voxels(&across([DVec3::X, DVec3::Z]));
    assert!((found.x_axis.x - (spread + 0.16 / 12.0)).abs() < 1e-12);
    assert!((found.y_axis.y - (spread + 1.44 / 12.0)).abs() < 1e-12);
    assert!(found.x_axis.y.abs() < 1e-15);
    let found = blur.interpolated(&across([DVec3::X, DVec3::Y]));
    assert!((found.y_axis.y - (spread + 0.25 / 4.0)).abs() < 1e-12);
}

#[test]
fn sheared_voxels_blur_as_their_corners_lie() {
    // The variance along a direction is a twelfth of the sum of the squared components of the voxel sides.
    let sides = DMat3::from_cols(DVec3::X, DVec3::Y, DVec3::new(0.0, 0.5, 2.0));
    let found = Blur::new(1e-9, sides).of_voxels(&across([DVec3::Y, DVec3::Z]));
    assert!((found.x_axis.x - 1.25 / 12.0).abs() < 1e-12);
    assert!((found.y_axis.y - 4.0 / 12.0).abs() < 1e-12);
    assert!((found.x_axis.y - 1.0 / 12.0).abs() < 1e-12);
}
