//! The cells that the rays of a tile meet, the most promising ones first.

use super::gathered::{Gathered, WINDOW};
use super::{Reduction, Shared};
use crate::math::block_cells::{BlockCells, BlockReader};
use crate::math::blocks::SIDE;
use crate::math::cell_projection::{Footprint, block_box};
use crate::math::cubic::Cubic;
use crate::math::lanes::{FAN, Kernel, larger, smaller};
use crate::volume::Real;

/// How far beside a face, along which the rays run, a ray counts as within a cell (voxels).
const BESIDE: f32 = 1e-4;
/// Longer than every ray (mm).
const FAR: f32 = 1e9;

/// A block of a level.
#[derive(Clone, Copy, Debug)]
struct Block {
    level: usize,
    place: [usize; 3],
    /// Its largest value.
    top: f32,
}

/// A tile of rays on their way through the volume.
pub(super) struct Tile<'a, R> {
    shared: &'a Shared<'a>,
    reader: &'a dyn BlockReader<R>,
    /// The first column and row, and how many there are.
    place: [usize; 2],
    size: [usize; 2],
    gathered: Gathered,
    cells: BlockCells<R>,
}

/// A stretch of each axis: a cell, or a part of it.
struct Cell {
    /// The cell, counted from the first of its block.
    place: [usize; 3],
    /// Where the stretches begin and end, counted from the cell.
    ends: [[f32; 2]; 3],
    /// Its largest value.
    top: f32,
}

/// Where a block is, in `f32`: all is counted from its first voxel, its middle and the tile.
struct BlockPlace {
    /// The column and the row of the first voxel, and from one voxel to the next along each axis.
    pixel: [f32; 2],
    pixel_steps: [[f32; 3]; 2],
    /// The index of the tile's first ray at the depth of the block's middle, and that depth (mm).
    foot: [f32; 3],
    depth: f64,
    /// Whether rays begin or end within the block.
    has_ends: bool,
}

impl<R: Real> Kernel for Tile<'_, R> {
    type Output = Gathered;

    #[inline(always)]
    fn run(mut self) -> Gathered {
        if self.gathered.is_empty() {
            return self.gathered;
        }
        let mut waiting = Vec::new();
        for block in self.sorted() {
            waiting.push(block);
            while let Some(block) = waiting.pop() {
                let Some(footprint) = self.footprint(&block) else { continue };
                if self.ignores(block.top, &footprint) {
                    continue;
                }
                if block.level == 0 {
                    self.visit(block.place, &footprint);
                } else {
                    self.halve(block, &mut waiting);
                }
            }
        }
        self.gathered
    }
}

impl<'a, R: Real> Tile<'a, R> {
    /// The rays of the pixels from `place` on.
    pub fn new(
        shared: &'a Shared<'a>,
        reader: &'a dyn BlockReader<R>,
        (place, size): ([usize; 2], [usize; 2]),
        chord: impl Fn([usize; 2]) -> [f64; 2],
    ) -> Self {
        let gathered = Gathered::new(size, shared.along.reduction, chord);
        Self { shared, reader, place, size, gathered, cells: BlockCells::new() }
    }

    /// The blocks that rays of the tile may meet, the most promising first.
    #[inline(always)]
    fn sorted(&self) -> Vec<Block> {
        let coarsest = self.shared.levels.len() - 1;
        let mut waiting = vec![self.block(coarsest, [0; 3])];
        let mut blocks = Vec::new();
        while let Some(block) = waiting.pop() {
            if self.footprint(&block).is_none() {
                continue;
            }
            if block.level == self.shared.sorted {
                blocks.push(block);
            } else {
                self.halve(block, &mut waiting);
            }
        }
        // Blocks of the same top stay in the order in which they were found.
        if self.shared.along.reduction != Reduction::Mean {
            blocks.sort_by(|one, other| other.top.total_cmp(&one.top));
        }
        blocks
    }

    #[inline(always)]
    fn block(&self, level: usize, place: [usize; 3]) -> Block {
        Block { level, place, top: smaller(self.shared.range(level, place).high, self.limit()) }
    }

    /// The largest value that makes a difference.
    #[inline(always)]
    fn limit(&self) -> f32 {
        self.shared.along.limit * self.shared.sign
    }

    /// Puts the blocks of half the size within a block onto those that wait.
    #[inline(always)]
    fn halve(&self, block: Block, waiting: &mut Vec<Block>) {
        let count = self.shared.levels[block.level - 1];
        for n in 0..8 {
            let place = std::array::from_fn(|a| 2 * block.place[a] + (n >> a & 1));
            if (0..3).all(|a| place[a] < count[a]) {
                waiting.push(self.block(block.level - 1, place));
            }
        }
    }

    #[inline(always)]
    fn footprint(&self, block: &Block) -> Option<Footprint> {
        let space = block_box(self.shared.along.volume.size(), block.level, block.place);
        self.shared.projection.footprint(&space, (self.place, self.size), self.gathered.depths)
    }

    /// Whether values up to `top` change nothing in a footprint.
    #[inline(always)]
    fn ignores(&self, top: f32, footprint: &Footprint) -> bool {
        let searches = self.shared.along.reduction != Reduction::Mean;
        searches && top <= self.gathered.smallest_best(footprint.columns, footprint.rows)
    }

    /// Follows the rays of a footprint through the cells of a block.
    #[inline(always)]
    fn visit(&mut self, block: [usize; 3], footprint: &Footprint) {
        self.reader.read(block, R::from_f32(self.shared.sign), &mut self.cells);
        self.cells.find_largest();
        let least = self.gathered.smallest_best(footprint.columns, footprint.rows);
        let searches = self.shared.along.reduction != Reduction::Mean;
        let place = self.block_place(block);
        let axes = [0, 1, 2].map(|a: usize| &self.shared.slots[a][self.shared.kind(a, block[a])][..]);
        for k in axes[2] {
            for j in axes[1] {
                for i in axes[0] {
                    let cell = [i.cell, j.cell, k.cell];
                    let top = smaller(self.cells.largest(cell).to_f32(), self.limit());
                    if searches && top <= least {
                        continue;
                    }
                    self.pass(&Cell { place: cell, ends: [i.ends, j.ends, k.ends], top }, &place);
                }
            }
        }
    }

    #[inline(always)]
    fn block_place(&self, block: [usize; 3]) -> BlockPlace {
        let projection = self.shared.projection;
        let origin = glam::DVec3::from(block.map(|b| (b * SIDE) as f64));
        let half = glam::DVec3::splat(SIDE as f64 / 2.0);
        let (depth, reach) = (projection.depth_of(origin + half), projection.depth_reach(half + 0.5));
        let tile = self.place.map(|p| p as f64);
        let foot = projection.index_at(tile, depth) - origin;
        let pixel = projection.pixel_of(origin);
        BlockPlace {
            pixel: [(pixel[0] - tile[0]) as f32, (pixel[1] - tile[1]) as f32],
            pixel_steps: self.shared.pixel_steps,
            foot: foot.as_vec3().to_array(),
            depth,
            has_ends: self.gathered.inner[0] > depth - reach || self.gathered.inner[1] < depth + reach,
        }
    }

    /// Follows the rays that may meet a cell, window by window.
    #[inline(always)]
    fn pass(&mut self, cell: &Cell, block: &BlockPlace) {
        let mut ends = [[0; 2]; 2];
        for axis in 0..2 {
            let steps = &block.pixel_steps[axis];
            let mut middle = block.pixel[axis];
            for a in 0..3 {
                middle += steps[a] * (cell.place[a] as f32 + 0.5 * (cell.ends[a][0] + cell.ends[a][1]));
            }
            let (low, high) = (middle - self.shared.reach[axis], middle + self.shared.reach[axis]);
            let last = (self.size[axis] - 1) as f32;
            if high < 0.0 || low > last {
                return;
            }
            // Upwards, for what lies above 0.
            let first = larger(low, 0.0);
            let first = first as usize + usize::from((first as usize as f32) < first);
            ends[axis] = [first, smaller(high, last) as usize];
        }
        let [columns, rows] = ends;
        for row in (rows[0]..=rows[1]).step_by(WINDOW) {
            for column in (columns[0]..=columns[1]).step_by(WINDOW) {
                self.follow(cell, block, [column, row]);
            }
        }
    }

    /// Follows the rays of a window through a cell.
    #[inline(always)]
    fn follow(&mut self, cell: &Cell, block: &BlockPlace, window: [usize; 2]) {
        if self.shared.along.reduction == Reduction::Mean {
            return self.average(cell, block, window);
        }
        let mut best = self.gathered.best(window);
        let mut asks = 0;
        for l in 0..FAN {
            asks |= u32::from(best[l] < cell.top);
        }
        if asks == 0 {
            return;
        }
        let way = self.way(cell, block, window);
        let mut meets = 0;
        for l in 0..FAN {
            meets |= u32::from((best[l] < cell.top) & (way.enter[l] < way.leave[l]));
        }
        if meets == 0 {
            return;
        }
        let cubic = self.cubic(cell, &way);
        let value = cubic.largest();
        for l in 0..FAN {
            let value = value[l].to_f32();
            let value = if value > cell.top { cell.top } else { value };
            let is_met = way.enter[l] < way.leave[l];
            best[l] = if is_met & (value > best[l]) { value } else { best[l] };
        }
        self.gathered.set_best(window, &best);
    }

    /// Adds the means of a window's rays within a cell.
    #[inline(always)]
    fn average(&mut self, cell: &Cell, block: &BlockPlace, window: [usize; 2]) {
        let way = self.way(cell, block, window);
        let mean = self.cubic(cell, &way).mean();
        let (mut length, mut value) = ([0.0; FAN], [0.0; FAN]);
        for l in 0..FAN {
            length[l] = larger(way.leave[l] - way.enter[l], 0.0);
            value[l] = mean[l].to_f32();
        }
        self.gathered.add(window, &value, &length);
    }

    /// The volume along a window's rays within a cell.
    #[inline(always)]
    fn cubic(&self, cell: &Cell, way: &Way) -> Cubic<R, FAN> {
        let [mut enter, mut leave] = [[[R::from_f32(0.0); FAN]; 3]; 2];
        for a in 0..3 {
            let toward = self.shared.projection.toward[a] as f32;
            for l in 0..FAN {
                let [first, last] = [way.enter[l], way.leave[l]].map(|depth| way.foot[a][l] + toward * depth);
                enter[a][l] = R::from_f32(smaller(larger(first, 0.0), 1.0));
                leave[a][l] = R::from_f32(smaller(larger(last, 0.0), 1.0));
            }
        }
        Cubic::between(&self.cells.corners(cell.place), &enter, &leave)
    }

    /// Where the rays of a window are within a cell.
    #[inline(always)]
    fn way(&self, cell: &Cell, block: &BlockPlace, window: [usize; 2]) -> Way {
        let projection = self.shared.projection;
        let mut way = Way { foot: self.shared.lanes, enter: [-FAR; FAN], leave: [FAR; FAN] };
        if block.has_ends {
            way.enter = self.gathered.ends(0, window, block.depth);
            way.leave = self.gathered.ends(1, window, block.depth);
        }
        for a in 0..3 {
            let steps = &self.shared.index_steps;
            let across = steps[0][a] * window[0] as f32 + steps[1][a] * window[1] as f32;
            let from = block.foot[a] - cell.place[a] as f32 + across;
            let per_voxel = projection.per_voxel[a] as f32;
            let [begin, end] = cell.ends[a];
            for l in 0..FAN {
                way.foot[a][l] += from;
            }
            if per_voxel == 0.0 {
                for l in 0..FAN {
                    let foot = way.foot[a][l];
                    let is_beside = (foot < begin - BESIDE) | (foot > end + BESIDE);
                    way.leave[l] = if is_beside { -FAR } else { way.leave[l] };
                }
                continue;
            }
            let [begin, end] = if per_voxel > 0.0 { [begin, end] } else { [end, begin] };
            for l in 0..FAN {
                let foot = way.foot[a][l];
                way.enter[l] = larger(way.enter[l], (begin - foot) * per_voxel);
                way.leave[l] = smaller(way.leave[l], (end - foot) * per_voxel);
            }
        }
        way
    }
}

/// Where sixteen rays are within a cell.
struct Way {
    /// The index at the depth of the block's middle, counted from the cell.
    foot: [[f32; FAN]; 3],
    /// Where each ray enters the cell and leaves it, counted from that depth (mm); it misses the cell where it would leave
    /// before it enters.
    enter: [f32; FAN],
    leave: [f32; FAN],
}
