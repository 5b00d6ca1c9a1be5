//! The smallest and largest value of each block of the volume, so that rays skip blocks they cannot see.

use rayon::prelude::*;

use super::lanes::{larger, smaller};
use crate::error::Result;
use crate::stop::{Stop, go_on};
use crate::volume::{Real, Volume, Voxel};
use crate::with_voxels;

/// The side of the smallest block is 2 to this power (cells).
pub const SIDE_BITS: u32 = 2;
/// The side of a block, in cells; a cell lies between eight neighbouring voxels.
pub const SIDE: usize = 1 << SIDE_BITS;

/// The most blocks read along each axis; for more, a coarser level is read.
const MAX_LOOKUPS: i32 = 3;

/// A bound on the rounding of trilinear interpolation, relative to the range's largest absolute value.
const ROUNDING: f32 = 1e-6;

/// A number above every voxel value; `f64` values are clamped to it.
pub const HUGE: f32 = 3e38;

/// An empty range, which every value widens.
const NOTHING: Range = Range { low: HUGE, high: -HUGE };

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    pub low: f32,
    pub high: f32,
}

impl Range {
    pub const ALL: Self = Self { low: -HUGE, high: HUGE };

    fn between<T: Voxel>(low: T, high: T) -> Self {
        let [low, high] = [low, high].map(|v| smaller(larger(v.real().to_f32(), -HUGE), HUGE));
        Self { low, high }
    }

    #[inline(always)]
    pub fn negated(self) -> Self {
        Self { low: -self.high, high: -self.low }
    }

    #[inline(always)]
    fn with(self, other: Self) -> Self {
        Self { low: smaller(self.low, other.low), high: larger(self.high, other.high) }
    }

    /// The range, widened a little so that rounding moves no interpolated value out of it.
    fn rounded(self) -> Self {
        let slack = ROUNDING * larger(self.low.abs(), self.high.abs());
        Self { low: larger(self.low - slack, -HUGE), high: smaller(self.high + slack, HUGE) }
    }
}

/// The ranges of all blocks of a volume. A block bounds all values interpolated in its cells; the first
/// voxels of the cells of block b are 4·b to 4·b + 3 along each axis. NaN voxels are ignored. Each coarser
/// level joins two blocks along each axis, down to a single block.
#[derive(Debug)]
pub struct Blocks {
    levels: Vec<Level>,
}

#[derive(Debug)]
struct Level {
    size: [usize; 3],
    ranges: Vec<Range>,
}

impl Blocks {
    pub fn new(volume: &Volume, stop: Stop) -> Result<Self> {
        let size = volume.size().map(|n| (n.max(2) - 1).div_ceil(SIDE));
        let mut ranges = vec![NOTHING; size.iter().product()];
        with_voxels!(volume.voxels(), voxels => ranges
        .par_chunks_mut(size[0])
        .enumerate()
        .try_for_each(|(row, ranges)| {
            go_on(stop)?;
            row_of_blocks(voxels, volume, [row % size[1], row / size[1]], ranges);
            Ok(())
        }))?;
        let mut levels = vec![Level { size, ranges }];
        while let Some(level) = levels.last().and_then(Level::coarser) {
            levels.push(level);
        }
        Ok(Self { levels })
    }

    /// The number of blocks along each axis and their ranges, i fastest, the finest level first.
    pub fn levels(&self) -> impl Iterator<Item = ([usize; 3], &[Range])> {
        self.levels.iter().map(|level| (level.size, &level.ranges[..]))
    }

    /// A range that holds all values interpolated in the cells whose first voxels are `first` to `last`.
    #[inline(always)]
    pub fn range(&self, first: [i32; 3], last: [i32; 3]) -> Range {
        let side = SIDE as i32;
        let (mut first, mut last) = (first.map(|c| c / side), last.map(|c| c / side));
        let mut level = 0;
        while (0..3).any(|a| last[a] - first[a] >= MAX_LOOKUPS) {
            (first, last) = (first.map(|b| b / 2), last.map(|b| b / 2));
            level += 1;
        }
        let Level { size, ranges } = &self.levels[level];
        let mut range = NOTHING;
        for k in first[2]..=last[2] {
            for j in first[1]..=last[1] {
                let row = (k as usize * size[1] + j as usize) * size[0];
                for i in first[0]..=last[0] {
                    range = range.with(ranges[row + i as usize]);
                }
            }
        }
        range
    }
}

impl Level {
    fn coarser(&self) -> Option<Self> {
        let size = self.size.map(|n| n.div_ceil(2));
        let mut ranges = vec![NOTHING; size.iter().product()];
        for (row, fine) in self.ranges.chunks(self.size[0]).enumerate() {
            let (j, k) = (row % self.size[1] / 2, row / self.size[1] / 2);
            let coarse = &mut ranges[(k * size[1] + j) * size[0]..];
            for (i, range) in fine.iter().enumerate() {
                coarse[i / 2] = coarse[i / 2].with(*range);
            }
        }
        (self.ranges.len() > 1).then_some(Self { size, ranges })
    }
}

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
        let least =
            low[along.clone()].iter().fold(T::LARGEST, |least, v| if *v < least { *v } else { least });
        let most = high[along].iter().fold(T::SMALLEST, |most, v| if *v > most { *v } else { most });
        *range = Range::between(least, most).rounded();
    }
}

/// Widens ranges, one per voxel of a line, by the voxels of another line; the comparisons ignore NaN.
#[inline(always)]
fn widen<'a, T: Voxel>(low: &mut [T], high: &mut [T], line: impl Iterator<Item = &'a T>) {
    for ((low, high), voxel) in low.iter_mut().zip(high).zip(line) {
        *low = if *voxel < *low { *voxel } else { *low };
        *high = if *voxel > *high { *voxel } else { *high };
    }
}
