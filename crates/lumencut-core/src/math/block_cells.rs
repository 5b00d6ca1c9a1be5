//! The cells of one block of a volume: their corners, and the largest value of each.

use super::blocks::SIDE;
use super::cubic::{Corners, larger};
use crate::volume::{Real, Volume, Voxel};

/// The voxels along each axis of a block: one more than cells.
const VOXELS: usize = SIDE + 1;
/// From a row of voxels to the next; longer than a row, so that rows are computed as vectors.
const ROW: usize = 8;
/// From a plane of voxels to the next.
const PLANE: usize = ROW * VOXELS;
/// The numbers of a block, and as many more as are read beyond its last.
const LENGTH: usize = PLANE * VOXELS;

/// The voxels of a block as numbers to compute with.
#[derive(Clone, Debug)]
pub struct BlockCells<R> {
    values: [R; LENGTH],
    largest: [R; LENGTH],
}

impl<R: Real> BlockCells<R> {
    /// Nothing read yet.
    pub fn new() -> Self {
        let zero = R::from_f32(0.0);
        Self { values: [zero; LENGTH], largest: [zero; LENGTH] }
    }

    /// Finds the largest corner of each cell.
    #[inline(always)]
    pub fn find_largest(&mut self) {
        self.largest = self.values;
        for step in [1, ROW, PLANE] {
            for n in 0..LENGTH - step {
                self.largest[n] = larger(self.largest[n], self.largest[n + step]);
            }
        }
    }

    /// The largest corner of a cell.
    #[inline(always)]
    pub fn largest(&self, [i, j, k]: [usize; 3]) -> R {
        self.largest[i + ROW * j + PLANE * k]
    }

    /// The corners of a cell.
    #[inline(always)]
    pub fn corners(&self, [i, j, k]: [usize; 3]) -> Corners<R> {
        let first = i + ROW * j + PLANE * k;
        let at = |n: usize| self.values[first + n];
        let (row, plane) = (ROW, PLANE);
        [at(0), at(1), at(row), at(row + 1), at(plane), at(plane + 1), at(plane + row), at(plane + row + 1)]
    }
}

impl<R: Real> Default for BlockCells<R> {
    fn default() -> Self {
        Self::new()
    }
}

/// A volume whose voxels may be of any type, read block by block.
pub trait BlockReader<R>: Sync {
    /// Reads the voxels of one of the smallest blocks, each times `sign`; beyond the outermost voxels these go on.
    fn read(&self, block: [usize; 3], sign: R, cells: &mut BlockCells<R>);
}

/// The voxels of a volume in their own type.
#[derive(Clone, Copy, Debug)]
pub struct TypedBlocks<'a, T> {
    size: [usize; 3],
    strides: [usize; 3],
    voxels: &'a [T],
}

impl<'a, T> TypedBlocks<'a, T> {
    /// `voxels` are those of `volume`.
    pub fn new(volume: &Volume, voxels: &'a [T]) -> Self {
        Self { size: volume.size(), strides: volume.strides(), voxels }
    }
}

impl<T: Voxel> BlockReader<T::Real> for TypedBlocks<'_, T> {
    fn read(&self, block: [usize; 3], sign: T::Real, cells: &mut BlockCells<T::Real>) {
        let offset: [[usize; VOXELS]; 3] = std::array::from_fn(|a| {
            std::array::from_fn(|n| (block[a] * SIDE + n).min(self.size[a] - 1) * self.strides[a])
        });
        for k in 0..VOXELS {
            for j in 0..VOXELS {
                let row = offset[1][j] + offset[2][k];
                let values = &mut cells.values[j * ROW + k * PLANE..][..VOXELS];
                if self.strides[0] == 1 && offset[0][VOXELS - 1] == offset[0][0] + SIDE {
                    let voxels = &self.voxels[row + offset[0][0]..][..VOXELS];
                    for i in 0..VOXELS {
                        values[i] = voxels[i].real() * sign;
                    }
                } else {
                    for i in 0..VOXELS {
                        values[i] = self.voxels[row + offset[0][i]].real() * sign;
                    }
                }
            }
        }
    }
}
