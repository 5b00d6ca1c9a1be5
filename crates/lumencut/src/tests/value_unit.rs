//! Tests of the guessed units of volumes with few distinct values.

use lumencut_core::settings::Window;
use lumencut_core::volume::{Volume, Voxels};

use super::*;

/// The unit of a 40³ cube with one value, except for some voxels at its beginning.
fn unit(level: i16, others: &[(usize, i16)], lumen: Window) -> ValueUnit {
    let mut values = vec![level; 40 * 40 * 40];
    let mut rest = &mut values[..];
    for (count, other) in others {
        let (own, after) = rest.split_at_mut(*count);
        own.fill(*other);
        rest = after;
    }
    let volume = Volume::new(Voxels::I16(&values), [40; 3], [1, 40, 1600], glam::DAffine3::IDENTITY)
        .expect("a volume");
    ValueUnit::of(&VoxelSample::at(&volume), &volume, lumen)
}

const CTA: Window = Window { level: 300.0, width: 900.0 };

#[test]
fn air_and_fat_tell_hounsfield_units() {
    assert!(unit(40, &[(2000, -1000)], CTA).is_hounsfield);
    assert!(!unit(40, &[(100, -1000)], CTA).is_hounsfield, "noise of a volume in another unit");
    assert!(!unit(40, &[], CTA).is_hounsfield);
}

#[test]
fn metal_lies_far_above_the_lumen() {
    let lumen = Window { level: 320.0, width: 320.0 };
    assert!(unit(0, &[(400, 375), (100, 2000)], lumen).has_metal, "as in a CT whose values begin at 0");
    let mr = Window { level: 700.0, width: 600.0 };
    assert!(!unit(200, &[(400, 1700), (100, 2200)], mr).has_metal, "bright blood in MR");
    assert!(!unit(0, &[], lumen).has_metal);
}
