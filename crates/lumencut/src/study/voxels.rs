//! Voxels in one of four types. The page converts voxels of other types to one of them.

use lumencut_core::error::{Error, ErrorKind, Mend};
use lumencut_core::volume::Voxels;

use crate::study::failure::{Failure, Result};

/// The voxel types of a volume in a browser.
#[derive(Debug)]
pub enum Stored {
    /// `uint8`
    U8(Vec<u8>),
    /// `int16`
    I16(Vec<i16>),
    /// `uint16`
    U16(Vec<u16>),
    /// `float32`
    F32(Vec<f32>),
}

/// Evaluates `$body` with `$voxels` bound to the voxels in their type.
macro_rules! with_stored {
    ($stored:expr, $voxels:ident => $body:expr) => {
        match $stored {
            Stored::U8($voxels) => $body,
            Stored::I16($voxels) => $body,
            Stored::U16($voxels) => $body,
            Stored::F32($voxels) => $body,
        }
    };
}

impl Stored {
    /// `count` voxels of NumPy's type `dtype`, all 0.
    pub(crate) fn zeros(dtype: &str, count: f64) -> Result<Self> {
        Ok(match dtype {
            "uint8" => Self::U8(room(count)?),
            "int16" => Self::I16(room(count)?),
            "uint16" => Self::U16(room(count)?),
            "float32" => Self::F32(room(count)?),
            other => {
                let expected = "uint8, int16, uint16 or float32";
                return Err(Failure {
                    kind: "volume",
                    ..Failure::of_message("type of the voxels", &other, expected)
                });
            }
        })
    }

    pub(crate) fn bytes_mut(&mut self) -> &mut [u8] {
        with_stored!(self, voxels => bytemuck::cast_slice_mut(voxels))
    }

    /// `count` voxels of the same type: the voxels of `self` at the indices in `place`, and 0 elsewhere.
    pub(crate) fn placed(&self, count: usize, place: impl Iterator<Item = usize>) -> Result<Self> {
        Ok(match self {
            Self::U8(voxels) => Self::U8(scattered(voxels, count, place)?),
            Self::I16(voxels) => Self::I16(scattered(voxels, count, place)?),
            Self::U16(voxels) => Self::U16(scattered(voxels, count, place)?),
            Self::F32(voxels) => Self::F32(scattered(voxels, count, place)?),
        })
    }

    /// A copy in which the voxels that `is_replaced` chooses by their index have this value, or the nearest one of the type.
    pub(crate) fn replaced(&self, is_replaced: impl Fn(usize) -> bool, value: f64) -> Result<Self> {
        let (dtype, value) = match self {
            Self::U8(_) => ("uint8", vec![value.round() as u8]),
            Self::I16(_) => ("int16", (value.round() as i16).to_ne_bytes().to_vec()),
            Self::U16(_) => ("uint16", (value.round() as u16).to_ne_bytes().to_vec()),
            Self::F32(_) => ("float32", (value as f32).to_ne_bytes().to_vec()),
        };
        let mut copy = Self::zeros(dtype, (self.bytes().len() / value.len()) as f64)?;
        let bytes = copy.bytes_mut();
        bytes.copy_from_slice(self.bytes());
        for (n, voxel) in bytes.chunks_exact_mut(value.len()).enumerate() {
            if is_replaced(n) {
                voxel.copy_from_slice(&value);
            }
        }
        Ok(copy)
    }

    /// Takes over a voxel of voxels of the same type and number.
    pub(crate) fn take_voxel(&mut self, other: &Self, n: usize) {
        let side = match self {
            Self::U8(_) => 1,
            Self::I16(_) | Self::U16(_) => 2,
            Self::F32(_) => 4,
        };
        let voxel = n * side..(n + 1) * side;
        self.bytes_mut()[voxel.clone()].copy_from_slice(&other.bytes()[voxel]);
    }

    fn bytes(&self) -> &[u8] {
        with_stored!(self, voxels => bytemuck::cast_slice(voxels))
    }

    /// The voxels as the type of the core, which borrows them.
    pub fn voxels(&self) -> Voxels<'_> {
        match self {
            Self::U8(voxels) => Voxels::U8(voxels),
            Self::I16(voxels) => Voxels::I16(voxels),
            Self::U16(voxels) => Voxels::U16(voxels),
            Self::F32(voxels) => Voxels::F32(voxels),
        }
    }
}

fn scattered<T: Copy + Default>(
    voxels: &[T],
    count: usize,
    place: impl Iterator<Item = usize>,
) -> Result<Vec<T>> {
    let mut whole = room(count as f64)?;
    for (voxel, at) in voxels.iter().zip(place) {
        whole[at] = *voxel;
    }
    Ok(whole)
}

fn room<T: Clone + Default>(count: f64) -> Result<Vec<T>> {
    let mut voxels = reserved(count)?;
    voxels.resize(count as usize, T::default());
    Ok(voxels)
}

/// An empty list with room for `count` voxels. Fails with an error of kind `volume` if there is not enough memory.
pub(crate) fn reserved<T>(count: f64) -> Result<Vec<T>> {
    let mut voxels = Vec::new();
    // The cast saturates, but a count larger than any memory cannot be allocated anyway.
    if voxels.try_reserve_exact(count as usize).is_err() {
        let megabytes = (count * size_of::<T>() as f64 / 1e6).ceil();
        let found = format!("{megabytes} MB of voxels");
        let expected = "no more than this page can have in memory";
        return Err(Error::new(ErrorKind::Volume, "size of the volume", found, expected)
            .mend("close other pages")
            .mended_by(Mend::EverySecond)
            .into());
    }
    Ok(voxels)
}
