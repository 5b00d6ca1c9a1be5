use super::*;
use lumencut_core::volume::Voxels as Values;

const SIZE: [usize; 3] = [7, 5, 9];
const STRIDES: [usize; 3] = [1, 7, 35];

fn volume(values: Values<'_>) -> Volume<'_> {
    Volume::new(values, SIZE, STRIDES, DAffine3::IDENTITY).expect("a volume")
}

#[test]
fn values_along_a_line_are_those_of_its_places() {
    let numbers: Vec<i32> = (0..315).map(|n| (n * 7919) % 1013 - 500).collect();
    let short: Vec<i16> = numbers.iter().map(|n| *n as i16).collect();
    let double: Vec<f64> = numbers.iter().map(|n| f64::from(*n) + 0.1).collect();
    for values in [Values::I16(&short), Values::I32(&numbers), Values::F64(&double)] {
        let volume = volume(values);
        let voxels = Voxels::new(&volume);
        let (start, stride) = (DVec3::new(0.3, 4.1, 1.7), DVec3::new(0.21, -0.13, 0.17));
        let mut found = Vec::new();
        for _ in 0..3 {
            voxels.along(start, stride, &mut found);
        }
        let expected: Vec<f32> = (0..48).map(|n| voxels.at_index(start + stride * f64::from(n))).collect();
        assert!(
            expected.iter().any(|value| value.is_nan()) && expected.iter().any(|value| value.is_finite())
        );
        let bits = |values: &[f32]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&found), bits(&expected));
        let mut nowhere = Vec::new();
        voxels.along(DVec3::NAN, stride, &mut nowhere);
        assert!(nowhere.iter().all(|value| value.is_nan()));
    }
}

#[test]
fn a_voxel_has_its_value() {
    let numbers: Vec<i16> = (0..315).collect();
    let volume = volume(Values::I16(&numbers));
    let voxels = Voxels::new(&volume);
    assert_eq!(voxels.voxel([6, 4, 8]), 314.0);
    assert_eq!(voxels.voxel([2, 3, 1]), voxels.at_index(DVec3::new(2.0, 3.0, 1.0)));
}

#[test]
fn a_volume_is_as_negative_as_its_most_negative_voxel() {
    for (lowest, is_negative) in [(-21, true), (-20, false), (0, false)] {
        let mut numbers = vec![40i16; 315];
        numbers[200] = lowest;
        let volume = volume(Values::I16(&numbers));
        assert_eq!(Voxels::new(&volume).has_negative(), is_negative, "{lowest}");
    }
}
