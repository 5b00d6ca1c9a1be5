//! The largest, the smallest or the mean value of the volume along rays, exactly: not at samples, but everywhere on the
//! chord of each ray. Within a cell the volume along a ray is a cubic, whose maximum and mean have closed forms.
//!
//! Cells are projected onto the pixels whose rays meet them (cell projection): so each voxel is loaded a few times, however
//! many rays pass it, and sixteen rays share one cell's corners. Blocks with the largest values go first; what cannot win
//! is skipped, block by block and cell by cell.

mod gathered;
mod tile;

use rayon::prelude::*;

use self::gathered::{TILE, WINDOW};
use self::tile::Tile;
use super::Work;
use crate::camera::Camera;
use crate::error::Result;
use crate::math::block_cells::{BlockReader, TypedBlocks};
use crate::math::blocks::{Blocks, Range, SIDE};
use crate::math::cell_projection::{CellProjection, PIXEL_ROUNDING, RayGrid, Slot as CellSlot, slots};
use crate::math::lanes::{FAN, dispatch};
use crate::volume::{Real, Volume};
use crate::with_voxels;

/// What is kept of the values along a ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reduction {
    /// The largest.
    Largest,
    /// The smallest.
    Smallest,
    /// The mean, each value weighted with the length that it takes of the ray.
    Mean,
}

/// Rays through a volume, and what is kept of the values along them.
#[derive(Clone, Copy)]
pub struct AlongRays<'a> {
    /// The view.
    pub camera: &'a Camera,
    /// The volume.
    pub volume: &'a Volume<'a>,
    /// What can be skipped; `None` looks at everything, with the same result.
    pub blocks: Option<&'a Blocks>,
    /// Where the rays are.
    pub rays: RayGrid,
    /// What is kept.
    pub reduction: Reduction,
    /// The value from which on none that is larger (smaller) makes a difference.
    pub limit: f32,
}

/// The first and the last depth of a ray (mm); no ray where the first lies behind the last.
pub type Chord<'a> = dyn Fn(usize) -> [f64; 2] + Sync + 'a;

/// Writes the value of each ray; NaN where it meets no value.
///
/// # Errors
/// [`crate::error::ErrorKind::Interrupted`].
pub fn along_rays(work: &Work, along: &AlongRays, chord: &Chord, values: &mut [f32]) -> Result<()> {
    with_voxels!(along.volume.voxels(), voxels => {
        tiles(work, along, &TypedBlocks::new(along.volume, voxels), chord, values)
    })
}

/// Fills the values tile by tile.
fn tiles<R: Real>(
    work: &Work,
    along: &AlongRays,
    reader: &dyn BlockReader<R>,
    chord: &Chord,
    values: &mut [f32],
) -> Result<()> {
    let (width, projection) = (along.rays.size[0], CellProjection::new(along.volume, along.camera, &along.rays));
    let shared = Shared::new(along, &projection);
    let rows = values.par_chunks_mut(TILE[1] * width).enumerate();
    rows.try_for_each(|(row, values)| {
        for column in (0..width).step_by(TILE[0]) {
            work.go_on()?;
            let size = [TILE[0].min(width - column), values.len() / width];
            let first = row * TILE[1] * width + column;
            let chord = |[i, j]: [usize; 2]| chord(first + j * width + i);
            let place = [column, row * TILE[1]];
            let gathered = dispatch(work.isa, Tile::new(&shared, reader, (place, size), chord));
            for j in 0..size[1] {
                for i in 0..size[0] {
                    values[j * width + column + i] = gathered.value([i, j], along.reduction, shared.sign);
                }
            }
        }
        Ok(())
    })
}

/// What all tiles share.
struct Shared<'a> {
    along: &'a AlongRays<'a>,
    projection: &'a CellProjection,
    /// How many blocks there are along each axis, level by level, up to one that holds all.
    levels: Vec<[usize; 3]>,
    /// The level whose blocks are sorted: they are about as wide as a window.
    sorted: usize,
    /// −1 where the smallest value is kept: it is the largest with the other sign.
    sign: f32,
    /// The index from a window's first pixel to each of them, axis by axis; from a column to the next, and from a row to
    /// the next.
    lanes: [[f32; FAN]; 3],
    index_steps: [[f32; 3]; 2],
    /// Columns and rows from a voxel to the next along each axis, and how far a cell reaches to both sides.
    pixel_steps: [[f32; 3]; 2],
    reach: [f32; 2],
    /// The stretches along each axis of the first block, of one in the middle and of the last.
    slots: [[Vec<Slot>; 3]; 3],
    blocks: [usize; 3],
}

/// A stretch along an axis, in `f32`.
struct Slot {
    cell: usize,
    ends: [f32; 2],
}

impl<'a> Shared<'a> {
    fn new(along: &'a AlongRays<'a>, projection: &'a CellProjection) -> Self {
        let size = along.volume.size();
        let blocks = size.map(|n| (n.max(2) - 1).div_ceil(SIDE));
        let mut levels = vec![blocks];
        while levels[levels.len() - 1].iter().any(|n| *n > 1) {
            levels.push(levels[levels.len() - 1].map(|n| n.div_ceil(2)));
        }
        let is_narrow =
            |level: &usize| projection.reach([(SIDE << level) as f64 / 2.0; 3].into()) <= WINDOW as f64;
        let sorted = (0..levels.len()).rev().find(is_narrow).unwrap_or(0);
        let steps = projection.index_steps();
        let lanes = std::array::from_fn(|a| {
            std::array::from_fn(|l| {
                (steps[0][a] * (l % WINDOW) as f64 + steps[1][a] * (l / WINDOW) as f64) as f32
            })
        });
        let sign = if along.reduction == Reduction::Smallest { -1.0 } else { 1.0 };
        let slots = std::array::from_fn(|a| {
            [0, 1, blocks[a] - 1].map(|block| {
                let slot = |slot: CellSlot| Slot { cell: slot.cell, ends: slot.ends.map(|end| end as f32) };
                slots(size[a], block.min(blocks[a] - 1)).into_iter().map(slot).collect()
            })
        });
        let pixel_steps = projection.pixel_steps();
        Self {
            along,
            projection,
            levels,
            sorted,
            sign,
            lanes,
            index_steps: steps.map(|step| step.as_vec3().to_array()),
            pixel_steps: pixel_steps.map(|step| step.as_vec3().to_array()),
            reach: pixel_steps.map(|step| (step.abs().element_sum() / 2.0 + PIXEL_ROUNDING) as f32),
            slots,
            blocks,
        }
    }

    /// Which of the kinds of blocks along an axis a block is.
    #[inline(always)]
    fn kind(&self, axis: usize, block: usize) -> usize {
        match block {
            0 => 0,
            _ if block + 1 == self.blocks[axis] => 2,
            _ => 1,
        }
    }

    /// The values of a block, with the sign that makes the wanted one the largest.
    #[inline(always)]
    fn range(&self, level: usize, block: [usize; 3]) -> Range {
        match self.along.blocks {
            Some(blocks) if self.sign > 0.0 => blocks.range_of(level, block),
            Some(blocks) => blocks.range_of(level, block).negated(),
            None => Range::ALL,
        }
    }
}
