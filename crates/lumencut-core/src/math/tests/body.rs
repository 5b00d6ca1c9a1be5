use glam::{DAffine3, DMat3};

use super::*;
use crate::volume::Voxels;

const SIZE: [usize; 3] = [100, 90, 80];
const AIR_HU: f32 = -1000.0;

/// A scan of 2.5 mm voxels from a function of the world position (mm), which is 0 in its middle.
fn scan(value: impl Fn(DVec3) -> f32) -> Vec<f32> {
    let place = |n: usize| {
        let index = [n % SIZE[0], n / SIZE[0] % SIZE[1], n / SIZE[0] / SIZE[1]];
        DVec3::from_array(std::array::from_fn(|a| 2.5 * (index[a] as f64 - (SIZE[a] as f64 - 1.0) / 2.0)))
    };
    (0..SIZE.iter().product()).map(|n| value(place(n))).collect()
}

fn body(voxels: &[f32]) -> Option<Body> {
    let middle = DVec3::from_array(SIZE.map(|n| (n as f64 - 1.0) / 2.0));
    let affine = DAffine3::from_mat3_translation(DMat3::from_diagonal(DVec3::splat(2.5)), -2.5 * middle);
    let strides = [1, SIZE[0], SIZE[0] * SIZE[1]];
    let volume = Volume::new(Voxels::F32(voxels), SIZE, strides, affine).expect("a volume");
    Body::of(&volume, &|| false).expect("not stopped")
}

/// A cylinder along z with a radius of 70 mm, and under it a table of three voxels, 85 mm from the axis.
fn patient(place: DVec3) -> f32 {
    let is_table = (place.y - 85.0).abs() < 4.0 && place.x.abs() < 110.0;
    if place.truncate().length() < 70.0 || is_table { 40.0 } else { AIR_HU }
}

#[test]
fn the_surface_is_that_of_the_cylinder_without_the_table() {
    let found = body(&scan(patient)).expect("a body");
    assert_eq!(found.side, 5.0);
    for cell in &found.cells {
        let radius = cell.place.truncate().length();
        assert!(cell.is_cut || (radius - 67.0).abs() < 6.0, "{radius} mm from the axis");
        assert_eq!(cell.is_cut, cell.place.z.abs() > 95.0, "only the ends are cut");
    }
    assert!(found.cells.len() > 1500);
}

#[test]
fn crops_and_masked_scans_have_no_outline() {
    let crop = |place: DVec3| if place.length() < 40.0 { AIR_HU } else { 40.0 };
    assert!(body(&scan(crop)).is_none(), "air inside the body");
    let masked = |air: f32| move |place: DVec3| if patient(place) < 0.0 { air } else { 40.0 };
    assert!(body(&scan(masked(0.0))).is_none(), "masked");
    assert!(body(&scan(masked(-1024.0))).is_some(), "air in HU");
    assert!(body(&scan(|_| 7.0)).is_none() && body(&scan(|_| f32::NAN)).is_none());
    let even = |place: DVec3| (place.x + 0.3 * place.y) as f32;
    assert!(body(&scan(even)).is_none(), "no gap between dark and bright");
}
