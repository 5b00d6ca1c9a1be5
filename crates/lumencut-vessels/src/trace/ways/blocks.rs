//! A volume as blocks of voxels, which are stored only when needed.

use std::ops::{Index, IndexMut};

/// Side of a block (voxels).
pub(crate) const SIDE: usize = 16;
pub(crate) const BLOCK: usize = SIDE * SIDE * SIDE;

const NO_BLOCK: u32 = u32::MAX;

/// The stored blocks. Each has a position in the volume, and an index among the stored blocks.
#[derive(Clone, Debug)]
pub(crate) struct Blocks<T> {
    /// Number of blocks along (i, j, k).
    count: [usize; 3],
    /// Index of each block of the volume among the stored ones.
    numbers: Vec<u32>,
    kept: Vec<Kept<T>>,
}

#[derive(Clone, Debug)]
struct Kept<T> {
    place: usize,
    block: T,
}

impl<T> Blocks<T> {
    pub(crate) fn new(size: [usize; 3]) -> Self {
        let count = size.map(|n| n.div_ceil(SIDE));
        Self { count, numbers: vec![NO_BLOCK; count.iter().product()], kept: Vec::new() }
    }

    #[inline]
    pub(crate) fn place_of(&self, voxel: [i32; 3]) -> usize {
        let [i, j, k] = voxel.map(|c| c as usize / SIDE);
        (k * self.count[1] + j) * self.count[0] + i
    }

    pub(crate) fn corner(&self, place: usize) -> [i32; 3] {
        let [ni, nj, _] = self.count;
        [place % ni, place / ni % nj, place / (ni * nj)].map(|c| (c * SIDE) as i32)
    }

    #[inline]
    pub(crate) fn find(&self, place: usize) -> Option<usize> {
        let number = self.numbers[place];
        (number != NO_BLOCK).then_some(number as usize)
    }

    #[inline]
    pub(crate) fn find_or_make(&mut self, place: usize, make: impl FnOnce(&Self) -> T) -> usize {
        self.find(place).unwrap_or_else(|| {
            let block = make(self);
            self.numbers[place] = self.kept.len() as u32;
            self.kept.push(Kept { place, block });
            self.kept.len() - 1
        })
    }

    pub(crate) fn places(&self) -> impl Iterator<Item = usize> {
        self.kept.iter().map(|kept| kept.place)
    }

    pub(crate) fn forget(&mut self, is_gone: impl Fn(usize) -> bool) {
        self.kept.retain(|kept| !is_gone(kept.place));
        self.numbers.fill(NO_BLOCK);
        for (number, kept) in self.kept.iter().enumerate() {
            self.numbers[kept.place] = number as u32;
        }
    }
}

impl<T> Index<usize> for Blocks<T> {
    type Output = T;

    #[inline]
    fn index(&self, number: usize) -> &T {
        &self.kept[number].block
    }
}

impl<T> IndexMut<usize> for Blocks<T> {
    #[inline]
    fn index_mut(&mut self, number: usize) -> &mut T {
        &mut self.kept[number].block
    }
}

#[inline]
pub(crate) fn voxel_of(corner: [i32; 3], n: usize) -> [i32; 3] {
    let step = [n % SIDE, n / SIDE % SIDE, n / (SIDE * SIDE)];
    std::array::from_fn(|a| corner[a] + step[a] as i32)
}

#[inline]
pub(crate) fn index_in(inside: [i32; 3]) -> usize {
    let [i, j, k] = inside.map(|c| c as usize);
    (k * SIDE + j) * SIDE + i
}

#[inline]
pub(crate) fn index_of(voxel: [i32; 3]) -> usize {
    index_in(voxel.map(|c| c % SIDE as i32))
}

/// Whether the block at `corner` intersects a box, given as its first voxel and its size.
pub(crate) fn meets(corner: [i32; 3], (first, count): ([i32; 3], [i32; 3])) -> bool {
    (0..3).all(|a| corner[a] < first[a] + count[a] && corner[a] + SIDE as i32 > first[a])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_are_made_once_and_forgotten_by_their_places() {
        let mut blocks = Blocks::new([40, 17, 16]);
        let voxels = [[0, 0, 0], [39, 16, 15], [16, 3, 2]];
        for (number, voxel) in voxels.into_iter().enumerate() {
            let place = blocks.place_of(voxel);
            assert_eq!(blocks.find(place), None);
            assert_eq!(blocks.find_or_make(place, |_| number * 10), number);
            assert_eq!(blocks.find_or_make(place, |_| 99), number);
            assert_eq!(voxel_of(blocks.corner(place), index_of(voxel)), voxel);
        }
        assert_eq!(blocks.places().collect::<Vec<_>>(), [0, 5, 1]);
        let gone = blocks.place_of(voxels[0]);
        blocks.forget(|place| place == gone);
        assert_eq!(blocks.find(gone), None);
        let kept = voxels[1..].iter().map(|voxel| blocks.find(blocks.place_of(*voxel)).map(|n| blocks[n]));
        assert_eq!(kept.collect::<Vec<_>>(), [Some(10), Some(20)]);
    }

    #[test]
    fn a_block_meets_a_box_that_shares_a_voxel_with_it() {
        for (first, is_met) in
            [([15, 15, 15], true), ([16, 15, 15], false), ([-3, 0, 0], true), ([-4, 0, 0], false)]
        {
            assert_eq!(meets([0; 3], (first, [4, 1, 1])), is_met, "{first:?}");
        }
    }
}
