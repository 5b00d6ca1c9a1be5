//! The cells that the rays of a tile meet, the most promising ones first.

use super::gathered::{Gathered, WINDOW};
use super::{Reduction, Shared};
use crate::math::block_cells::{BlockCells, BlockReader};
use crate::math::blocks::SIDE;
use crate::math::cell_projection::{Footprint, IndexBox, Slot, block_box, slots};
use crate::math::cubic::{Cubic, Weights};
use crate::math::lanes::{FAN, Kernel, larger, smaller};
use crate::volume::Real;

/// How far beside a face, along which the rays run, a ray counts as within a cell (voxels).
const BESIDE: f32 = 1e-5;
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
    /// The cell, counted from the first of its block, and the same from that of the volume.
    place: [usize; 3],
    origin: [f64; 3],
    /// Where the stretches begin and end.
    ends: [[f32; 2]; 3],
    /// Its largest value.
    top: f32,
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
        let size = self.shared.along.volume.size();
        let axes: [Vec<Slot>; 3] = std::array::from_fn(|a| slots(size[a], block[a]));
        for k in &axes[2] {
            for j in &axes[1] {
                for i in &axes[0] {
                    let place = [i.cell, j.cell, k.cell];
                    let top = smaller(self.cells.largest(place).to_f32(), self.limit());
                    if searches && top <= least {
                        continue;
                    }
                    let origin = std::array::from_fn(|a| (block[a] * SIDE + place[a]) as f64);
                    let ends = [i, j, k].map(|slot| slot.ends.map(|end| end as f32));
                    self.pass(&Cell { place, origin, ends, top });
                }
            }
        }
    }

    /// Follows the rays that may meet a cell, window by window.
    #[inline(always)]
    fn pass(&mut self, cell: &Cell) {
        let [low, high] = [0, 1].map(|end: usize| {
            glam::DVec3::from(std::array::from_fn(|a| cell.origin[a] + f64::from(cell.ends[a][end])))
        });
        let space = IndexBox::between(low, high);
        let (tile, depths) = ((self.place, self.size), self.gathered.depths);
        let Some(footprint) = self.shared.projection.footprint(&space, tile, depths) else { return };
        let depth = self.shared.projection.depth_of(space.center);
        for row in (footprint.rows[0]..=footprint.rows[1]).step_by(WINDOW) {
            for column in (footprint.columns[0]..=footprint.columns[1]).step_by(WINDOW) {
                self.follow(cell, depth, [column, row]);
            }
        }
    }

    /// Follows the rays of a window through a cell whose middle is at `depth`.
    #[inline(always)]
    fn follow(&mut self, cell: &Cell, depth: f64, window: [usize; 2]) {
        let pixels = Gathered::window(window);
        let best = self.gathered.best(&pixels);
        let searches = self.shared.along.reduction != Reduction::Mean;
        let mut asks = 0;
        for l in 0..FAN {
            asks |= u32::from(best[l] < cell.top);
        }
        if searches && asks == 0 {
            return;
        }
        let way = self.way(cell, depth, window, &pixels);
        let [enter, leave] = way.places(&self.shared.projection.toward.to_array().map(|t| t as f32));
        let cubic = Cubic::between(&self.cells.corners(cell.place), &enter, &leave);
        if searches {
            let (value, mut best) = (cubic.largest(), best);
            for l in 0..FAN {
                let value = value[l].to_f32();
                let value = if value > cell.top { cell.top } else { value };
                let is_met = way.enter[l] < way.leave[l];
                best[l] = if is_met & (value > best[l]) { value } else { best[l] };
            }
            self.gathered.set_best(&pixels, &best);
        } else {
            let mean = cubic.mean().map(Real::to_f32);
            let mut length = [0.0; FAN];
            for l in 0..FAN {
                length[l] = larger(way.leave[l] - way.enter[l], 0.0);
            }
            self.gathered.add(&pixels, &mean, &length);
        }
    }

    /// Where the rays of a window are within a cell.
    #[inline(always)]
    fn way(&self, cell: &Cell, depth: f64, window: [usize; 2], pixels: &[usize; FAN]) -> Way {
        let projection = self.shared.projection;
        let place = [0, 1].map(|a: usize| (self.place[a] + window[a]) as f64);
        let first = projection.index_at(place, depth);
        let mut way = Way { foot: self.shared.lanes, enter: [-FAR; FAN], leave: [FAR; FAN] };
        for a in 0..3 {
            let from = (first[a] - cell.origin[a]) as f32;
            let per_voxel = projection.per_voxel[a] as f32;
            let [begin, end] = cell.ends[a];
            for l in 0..FAN {
                let foot = way.foot[a][l] + from;
                way.foot[a][l] = foot;
                let (one, other) = ((begin - foot) * per_voxel, (end - foot) * per_voxel);
                let (low, high) = if per_voxel > 0.0 { (one, other) } else { (other, one) };
                let is_beside = (foot < begin - BESIDE) | (foot > end + BESIDE);
                let parallel = if is_beside { FAR } else { -FAR };
                let (low, high) = if per_voxel == 0.0 { (parallel, -parallel) } else { (low, high) };
                way.enter[l] = larger(way.enter[l], low);
                way.leave[l] = smaller(way.leave[l], high);
            }
        }
        let [near, far] = self.gathered.chords(pixels, depth);
        for l in 0..FAN {
            way.enter[l] = larger(way.enter[l], near[l]);
            way.leave[l] = smaller(way.leave[l], far[l]);
        }
        way
    }
}

/// Where sixteen rays are within a cell.
struct Way {
    /// The index at the depth of the cell's middle, counted from the cell.
    foot: [[f32; FAN]; 3],
    /// Where each ray enters the cell and leaves it, counted from that depth (mm); it misses the cell where it would leave
    /// before it enters.
    enter: [f32; FAN],
    leave: [f32; FAN],
}

impl Way {
    /// The places where the rays enter and leave.
    #[inline(always)]
    fn places<R: Real>(&self, toward: &[f32; 3]) -> [Weights<R, FAN>; 2] {
        [&self.enter, &self.leave].map(|depth| {
            std::array::from_fn(|a| {
                std::array::from_fn(|l| {
                    let place = self.foot[a][l] + toward[a] * depth[l];
                    R::from_f32(smaller(larger(place, 0.0), 1.0))
                })
            })
        })
    }
}
