//! The smallest and the largest value of each block of the volume: what a ray cannot see there it need not sample.

use rayon::prelude::*;

use super::lanes::{larger, smaller};
use crate::error::{Error, Result};
use crate::stages::Stop;
use crate::volume::{Real, Volume, Voxel};
use crate::with_voxels;

/// The side of a block (cells between neighbouring voxels).
pub const SIDE: usize = 4;

/// Of more blocks than these the range of the whole volume is taken: asking them all would cost more than samples.
const MOST_ASKED: i32 = 256;

/// More than trilinear interpolation rounds, as a share of the larger end of a range.
const ROUNDING: f32 = 1e-6;

/// Beyond every value; what is larger in a volume of `f64`, or infinite, counts as this.
pub const HUGE: f32 = 3e38;

/// A range that holds nothing: every value widens it.
const NOTHING: Range = Range { low: HUGE, high: -HUGE };

/// The values between two voxels, both included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The smallest.
    pub low: f32,
    /// The largest.
    pub high: f32,
}

impl Range {
    /// Every value.
    pub const ALL: Self = Self { low: -HUGE, high: HUGE };

    /// The range between two voxels.
    fn between<T: Voxel>(low: T, high: T) -> Self {
        let [low, high] = [low, high].map(|v| smaller(larger(v.real().to_f32(), -HUGE), HUGE));
        Self { low, high }
    }

    /// The range that holds both.
    #[inline(always)]
    fn with(self, other: Self) -> Self {
        Self { low: smaller(self.low, other.low), high: larger(self.high, other.high) }
    }

    /// The range a little wider, so that no interpolated value leaves it by rounding.
    fn rounded(self) -> Self {
        let slack = ROUNDING * larger(self.low.abs(), self.high.abs());
        Self { low: larger(self.low - slack, -HUGE), high: smaller(self.high + slack, HUGE) }
    }
}

/// The ranges of all blocks of a volume. Block b holds the values of all samples whose lower corner is one of the
/// voxels from 4·b to 4·b + 3 along each axis; voxels that are NaN are left out.
#[derive(Debug)]
pub struct Blocks {
    size: [usize; 3],
    ranges: Vec<Range>,
    whole: Range,
}

impl Blocks {
    /// Reads the volume once.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Interrupted`] once `stop` says so.
    pub fn new(volume: &Volume, stop: Stop) -> Result<Self> {
        let size = volume.size().map(|n| (n.max(2) - 1).div_ceil(SIDE));
        let mut ranges = vec![NOTHING; size.iter().product()];
        with_voxels!(volume.voxels(), voxels => ranges
        .par_chunks_mut(size[0])
        .enumerate()
        .try_for_each(|(row, ranges)| {
            if stop() {
                return Err(Error::interrupted());
            }
            row_of_blocks(voxels, volume, [row % size[1], row / size[1]], ranges);
            Ok(())
        }))?;
        let whole = ranges.iter().fold(NOTHING, |all, range| all.with(*range));
        Ok(Self { size, ranges, whole })
    }

    /// The range of the samples whose lower corners lie between two voxels, both included.
    #[inline(always)]
    pub fn range(&self, first: [i32; 3], last: [i32; 3]) -> Range {
        let side = SIDE as i32;
        let (first, last) = (first.map(|c| c / side), last.map(|c| c / side));
        let asked = [0, 1, 2].map(|a| last[a] - first[a] + 1);
        if asked[0].max(asked[1]).max(asked[2]) > MOST_ASKED || asked[0] * asked[1] * asked[2] > MOST_ASKED {
            return self.whole;
        }
        let mut range = NOTHING;
        for k in first[2]..=last[2] {
            for j in first[1]..=last[1] {
                let row = (k as usize * self.size[1] + j as usize) * self.size[0];
                for i in first[0]..=last[0] {
                    range = range.with(self.ranges[row + i as usize]);
                }
            }
        }
        range
    }
}

/// The ranges of the blocks along i at (`j`, `k`).
fn row_of_blocks<T: Voxel>(voxels: &[T], volume: &Volume, [j, k]: [usize; 2], ranges: &mut [Range]) {
    let (size, strides) = (volume.size(), volume.strides());
    let reach = |block: usize, n: usize| block * SIDE..((block + 1) * SIDE + 1).min(n);
    let (mut low, mut high) = (vec![T::LARGEST; size[0]], vec![T::SMALLEST; size[0]]);
    for k in reach(k, size[2]) {
        for j in reach(j, size[1]) {
            let line = &voxels[j * strides[1] + k * strides[2]..];
            if strides[0] == 1 {
                widen(&mut low, &mut high, line[..size[0]].iter());
            } else {
                widen(&mut low, &mut high, line.iter().step_by(strides[0].max(1)));
            }
        }
    }
    for (block, range) in ranges.iter_mut().enumerate() {
        let along = reach(block, size[0]);
        *range = along.fold(NOTHING, |range, i| range.with(Range::between(low[i], high[i]))).rounded();
    }
}

/// Widens the ranges of a line of voxels by another line. NaN is neither smaller nor larger: it is left out.
#[inline(always)]
fn widen<'a, T: Voxel>(low: &mut [T], high: &mut [T], line: impl Iterator<Item = &'a T>) {
    for ((low, high), voxel) in low.iter_mut().zip(high).zip(line) {
        *low = if *voxel < *low { *voxel } else { *low };
        *high = if *voxel > *high { *voxel } else { *high };
    }
}
