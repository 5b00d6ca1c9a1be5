//! The values of a mask as labels, for all voxel types.

use lumencut_core::volume::{Volume, Voxels};

/// Up to this value (2²⁴), single precision represents all integers exactly.
const LARGEST_FLOAT: f64 = 16_777_216.0;

pub(crate) trait LabelValue: Sized {
    const IS_WHOLE: bool;

    fn label(self) -> i64;

    fn odd(self) -> Option<f64> {
        None
    }
}

macro_rules! label_values {
    ($($type:ty),*) => {$(
        impl LabelValue for $type {
            const IS_WHOLE: bool = true;

            #[allow(clippy::cast_lossless)]
            fn label(self) -> i64 {
                self as i64
            }
        }
    )*};
}
label_values!(i8, u8, i16, u16, i32, u32, i64, u64);

macro_rules! float_label_values {
    ($($type:ty),*) => {$(
        impl LabelValue for $type {
            const IS_WHOLE: bool = false;

            fn label(self) -> i64 {
                self as i64
            }

            #[allow(clippy::cast_lossless)]
            fn odd(self) -> Option<f64> {
                let value = self as f64;
                (!(value.fract() == 0.0 && value.abs() <= LARGEST_FLOAT)).then_some(value)
            }
        }
    )*};
}
float_label_values!(f32, f64);

pub(crate) fn label_at(mask: &Volume, index: [usize; 3]) -> i64 {
    let place: usize = (0..3).map(|a| index[a] * mask.strides()[a]).sum();
    match mask.voxels() {
        #[cfg(not(target_arch = "wasm32"))]
        Voxels::I8(voxels) => voxels[place].label(),
        Voxels::U8(voxels) => voxels[place].label(),
        Voxels::I16(voxels) => voxels[place].label(),
        Voxels::U16(voxels) => voxels[place].label(),
        #[cfg(not(target_arch = "wasm32"))]
        Voxels::I32(voxels) => voxels[place].label(),
        #[cfg(not(target_arch = "wasm32"))]
        Voxels::U32(voxels) => voxels[place].label(),
        #[cfg(not(target_arch = "wasm32"))]
        Voxels::I64(voxels) => voxels[place].label(),
        #[cfg(not(target_arch = "wasm32"))]
        Voxels::U64(voxels) => voxels[place].label(),
        Voxels::F32(voxels) => voxels[place].label(),
        #[cfg(not(target_arch = "wasm32"))]
        Voxels::F64(voxels) => voxels[place].label(),
    }
}
