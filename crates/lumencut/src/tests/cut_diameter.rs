use glam::{DAffine3, DVec3};
use lumencut_core::volume::Voxels;

use super::*;

/// A slab from i = 12 to 20 in uniform surroundings, in 1 mm voxels.
fn slab(lumen: f32, around: f32) -> Vec<f32> {
    (0..40 * 9 * 9).map(|n| if (12..=20).contains(&(n % 40)) { lumen } else { around }).collect()
}

/// The diameter in a view from the front, centred `beside` mm away from the slab's middle.
fn described(voxels: &[f32], beside: f64, radius: f64) -> Option<f64> {
    let volume = Volume::new(Voxels::F32(voxels), [40, 9, 9], [1, 40, 360], DAffine3::IDENTITY).unwrap();
    let place = DVec3::new(16.0 + beside, 4.0, 4.0);
    cut_diameter(&volume, &Camera::new(place, DVec3::Y, DVec3::Z, [40, 40], 1.0).unwrap(), radius)
}

#[test]
fn the_walls_lie_half_way_whichever_is_brighter_and_wherever_the_place_is() {
    for (lumen, around) in [(300.0, 0.0), (0.0, 300.0), (-50.0, -1000.0)] {
        for beside in [0.0, 1.2] {
            // Half of the values lies half a voxel outside the outermost lumen voxels.
            let found = described(&slab(lumen, around), beside, 4.0).unwrap();
            assert!((found - 9.0).abs() < 0.01, "{lumen} in {around}, {beside} mm off: {found}");
        }
    }
}

#[test]
fn the_far_wall_of_a_vessel_that_touches_this_one_is_not_its_own() {
    // Between the two slabs, the values fall by only a tenth.
    let touching = |lumen: f32, other: f32| -> Vec<f32> {
        let value = |i: usize| match i {
            12..=20 => lumen,
            21 => 0.9 * lumen,
            22..=25 => other,
            _ => 0.0,
        };
        (0..40 * 9 * 9).map(|n| value(n % 40)).collect()
    };
    for other in [300.0, 900.0] {
        assert_eq!(described(&touching(300.0, other), 0.0, 4.5), None, "beside {other}");
    }
}

#[test]
fn without_two_walls_there_is_none() {
    assert_eq!(described(&slab(40.0, 40.0), 0.0, 4.0), None, "nothing differs");
    assert_eq!(described(&slab(300.0, 0.0), 100.0, 4.0), None, "outside the volume");
    let one: Vec<f32> = (0..40 * 9 * 9).map(|n| if n % 40 < 18 { 300.0 } else { 0.0 }).collect();
    assert_eq!(described(&one, 0.0, 4.0), None, "a single wall");
    let mut voxels = slab(300.0, 0.0);
    for (n, value) in voxels.iter_mut().enumerate() {
        if n % 40 == 11 {
            *value = f32::NAN;
        }
    }
    assert_eq!(described(&voxels, 0.0, 4.0), None, "beside what is no number");
}
