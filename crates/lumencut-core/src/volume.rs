//! Volumes: borrowed voxels of any integer or float type on any invertible affine grid.

use glam::{DAffine3, DVec3};

use crate::error::{Error, ErrorKind, Result};
use crate::polarity::Polarity;

/// A voxel type, widened when it is read.
pub trait Voxel: Copy + Default + PartialOrd + Send + Sync + 'static {
    /// The type of interpolation: `f32` if it holds every value exactly, else `f64`.
    type Real: Real;
    /// Two neighbours, as one number if possible, so that one load fetches both.
    type Pair: Copy;
    /// The smallest finite value of the type.
    const SMALLEST: Self;
    /// The largest finite value of the type.
    const LARGEST: Self;
    /// The voxel's value.
    fn real(self) -> Self::Real;
    /// Two neighbours.
    fn pair(near: Self, far: Self) -> Self::Pair;
    /// The values of two neighbours.
    fn ends(pair: Self::Pair) -> (Self::Real, Self::Real);
}

/// The arithmetic that trilinear interpolation needs.
pub trait Real:
    Copy
    + PartialOrd
    + std::ops::Add<Output = Self>
    + std::ops::Sub<Output = Self>
    + std::ops::Mul<Output = Self>
    + std::ops::Div<Output = Self>
    + Send
    + Sync
    + 'static
{
    /// The square root, correctly rounded.
    fn square_root(self) -> Self;
    /// A weight in [0, 1], narrowed to this type.
    fn from_weight(weight: f64) -> Self;
    /// A number in this type.
    fn from_f32(number: f32) -> Self;
    /// The value as stored in a frame.
    fn to_f32(self) -> f32;
}

impl Real for f32 {
    #[inline(always)]
    fn square_root(self) -> Self {
        self.sqrt()
    }
    #[inline(always)]
    fn from_weight(weight: f64) -> Self {
        weight as f32
    }
    #[inline(always)]
    fn from_f32(number: f32) -> Self {
        number
    }
    #[inline(always)]
    fn to_f32(self) -> f32 {
        self
    }
}

impl Real for f64 {
    #[inline(always)]
    fn square_root(self) -> Self {
        self.sqrt()
    }
    #[inline(always)]
    fn from_weight(weight: f64) -> Self {
        weight
    }
    #[inline(always)]
    fn from_f32(number: f32) -> Self {
        Self::from(number)
    }
    #[inline(always)]
    fn to_f32(self) -> f32 {
        self as f32
    }
}

/// Implements voxels of integer types: two share an integer that is twice as wide.
macro_rules! packed {
    ($real:ty, $unsigned:ty, $pair:ty: $($type:ty),*) => {$(
        impl Voxel for $type {
            type Real = $real;
            type Pair = $pair;
            const SMALLEST: Self = <$type>::MIN;
            const LARGEST: Self = <$type>::MAX;
            #[inline(always)]
            fn real(self) -> $real {
                self as $real
            }
            #[inline(always)]
            fn pair(near: Self, far: Self) -> $pair {
                <$pair>::from(near as $unsigned) | <$pair>::from(far as $unsigned) << <$unsigned>::BITS
            }
            #[inline(always)]
            fn ends(pair: $pair) -> ($real, $real) {
                ((pair as $type).real(), ((pair >> <$unsigned>::BITS) as $type).real())
            }
        }
    )*};
}
#[cfg(not(target_arch = "wasm32"))]
packed!(f32, u8, u16: i8);
packed!(f32, u8, u16: u8);
packed!(f32, u16, u32: i16, u16);

macro_rules! plain {
    ($real:ty: $($type:ty),*) => {$(
        impl Voxel for $type {
            type Real = $real;
            type Pair = [Self; 2];
            const SMALLEST: Self = <$type>::MIN;
            const LARGEST: Self = <$type>::MAX;
            #[inline(always)]
            fn real(self) -> $real {
                self as $real
            }
            #[inline(always)]
            fn pair(near: Self, far: Self) -> [Self; 2] {
                [near, far]
            }
            #[inline(always)]
            fn ends([near, far]: [Self; 2]) -> ($real, $real) {
                (near.real(), far.real())
            }
        }
    )*};
}
plain!(f32: f32);
#[cfg(not(target_arch = "wasm32"))]
plain!(f64: i32, u32, i64, u64, f64);

/// The voxels of a volume, borrowed in their own type. The browser build is smaller, as it has code for only
/// four types. It converts all others exactly, except for numbers of more than 24 bits.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs)]
pub enum Voxels<'a> {
    #[cfg(not(target_arch = "wasm32"))]
    I8(&'a [i8]),
    U8(&'a [u8]),
    I16(&'a [i16]),
    U16(&'a [u16]),
    #[cfg(not(target_arch = "wasm32"))]
    I32(&'a [i32]),
    #[cfg(not(target_arch = "wasm32"))]
    U32(&'a [u32]),
    #[cfg(not(target_arch = "wasm32"))]
    I64(&'a [i64]),
    #[cfg(not(target_arch = "wasm32"))]
    U64(&'a [u64]),
    F32(&'a [f32]),
    #[cfg(not(target_arch = "wasm32"))]
    F64(&'a [f64]),
}

/// Runs `$body` with `$slice` bound to the voxels in their own type.
#[cfg(not(target_arch = "wasm32"))]
#[macro_export]
macro_rules! with_voxels {
    ($voxels:expr, $slice:ident => $body:expr) => {
        match $voxels {
            $crate::volume::Voxels::I8($slice) => $body,
            $crate::volume::Voxels::U8($slice) => $body,
            $crate::volume::Voxels::I16($slice) => $body,
            $crate::volume::Voxels::U16($slice) => $body,
            $crate::volume::Voxels::I32($slice) => $body,
            $crate::volume::Voxels::U32($slice) => $body,
            $crate::volume::Voxels::I64($slice) => $body,
            $crate::volume::Voxels::U64($slice) => $body,
            $crate::volume::Voxels::F32($slice) => $body,
            $crate::volume::Voxels::F64($slice) => $body,
        }
    };
}

/// Runs `$body` with `$slice` bound to the voxels in their own type.
#[cfg(target_arch = "wasm32")]
#[macro_export]
macro_rules! with_voxels {
    ($voxels:expr, $slice:ident => $body:expr) => {
        match $voxels {
            $crate::volume::Voxels::U8($slice) => $body,
            $crate::volume::Voxels::I16($slice) => $body,
            $crate::volume::Voxels::U16($slice) => $body,
            $crate::volume::Voxels::F32($slice) => $body,
        }
    };
}

/// A volume: voxels, their grid, and the grid's position in world space (LPS, mm).
#[derive(Clone, Copy, Debug)]
pub struct Volume<'a> {
    voxels: Voxels<'a>,
    size: [usize; 3],
    strides: [usize; 3],
    world_from_index: DAffine3,
    index_from_world: DAffine3,
    polarity: Polarity,
}

impl<'a> Volume<'a> {
    /// A volume over `voxels` with `size` voxels along (i, j, k); the voxel at (i, j, k) is element
    /// `i·strides[0] + j·strides[1] + k·strides[2]`. `world_from_index` may be oblique, left-handed or
    /// sheared. Fails with [`ErrorKind::Volume`] for an empty grid, strides that leave the slice, or an
    /// affine that is not finite and invertible.
    pub fn new(
        voxels: Voxels<'a>,
        size: [usize; 3],
        strides: [usize; 3],
        world_from_index: DAffine3,
    ) -> Result<Self> {
        let length = with_voxels!(voxels, slice => slice.len());
        let wrong = |subject: &str, found: String, expected: &str| {
            Err(Error::new(ErrorKind::Volume, subject, found, expected))
        };
        if size.contains(&0) {
            return wrong("size of the volume", format!("{size:?}"), "1 or more voxels along each axis");
        }
        let last = (0..3).try_fold(0usize, |sum, a| sum.checked_add((size[a] - 1).checked_mul(strides[a])?));
        if last.is_none_or(|last| last >= length) {
            let found = format!("size {size:?} with strides {strides:?} over {length} voxels");
            return wrong("voxels of the volume", found, "every voxel inside the array");
        }
        if (0..3).any(|a| size[a] > 1 && strides[a] == 0) {
            let found = format!("size {size:?} with strides {strides:?}");
            return wrong("voxels of the volume", found, "an element for every voxel");
        }
        let columns = world_from_index.matrix3;
        let scale = columns.x_axis.length() * columns.y_axis.length() * columns.z_axis.length();
        let singular = columns.determinant().abs() <= 1e-9 * scale;
        if !world_from_index.is_finite() || singular || scale == 0.0 {
            let found = format!("{world_from_index:?}");
            return wrong(
                "world_from_index of the volume",
                found,
                "a finite, invertible affine (mm per voxel)",
            );
        }
        let index_from_world = world_from_index.inverse();
        Ok(Self { voxels, size, strides, world_from_index, index_from_world, polarity: Polarity::Bright })
    }

    /// The same voxels, in which lumen is traced and measured with this polarity. Pictures ignore it.
    #[must_use]
    pub fn with_polarity(self, polarity: Polarity) -> Self {
        Self { polarity, ..self }
    }

    /// Whether the lumen that is traced and measured is bright or dark.
    pub fn polarity(&self) -> Polarity {
        self.polarity
    }

    /// The voxels in their own type.
    pub fn voxels(&self) -> Voxels<'a> {
        self.voxels
    }

    /// The number of voxels along (i, j, k).
    pub fn size(&self) -> [usize; 3] {
        self.size
    }

    /// The distance in elements between neighbours along (i, j, k).
    pub fn strides(&self) -> [usize; 3] {
        self.strides
    }

    /// World position (LPS, mm) of a continuous index; (0, 0, 0) is the centre of the first voxel.
    pub fn world_from_index(&self) -> DAffine3 {
        self.world_from_index
    }

    /// Continuous index of a world position.
    pub fn index_from_world(&self) -> DAffine3 {
        self.index_from_world
    }

    /// The length of the shortest side of a voxel (mm).
    pub fn smallest_side(&self) -> f64 {
        let sides = self.world_from_index.matrix3;
        sides.x_axis.length().min(sides.y_axis.length()).min(sides.z_axis.length())
    }

    /// The length of the longest line through the volume (mm).
    pub fn longest_way(&self) -> f64 {
        let corners = self.corners();
        (0..4).map(|c| corners[c].distance(corners[7 - c])).fold(0.0, f64::max)
    }

    /// The eight outer corners of the grid, half a voxel beyond the outermost centres (mm, LPS).
    pub fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|c| {
            let side = |a: usize| if c >> a & 1 == 0 { -0.5 } else { self.size[a] as f64 - 0.5 };
            self.world_from_index.transform_point3(DVec3::new(side(0), side(1), side(2)))
        })
    }
}
