//! Where the cells of a volume lie in a raster of pixels: cells and blocks of them are projected onto the pixels whose
//! rays may meet them.

use glam::DVec3;

use super::blocks::SIDE;
use super::ray::{IndexFromView, PARALLEL};
use crate::camera::Camera;
use crate::volume::Volume;

/// Wider than what rounding moves a projected border (pixels).
pub const PIXEL_ROUNDING: f64 = 1e-3;

/// The rays of a raster: one through each of its pixels.
#[derive(Clone, Copy, Debug)]
pub struct RayGrid {
    /// Columns and rows.
    pub size: [usize; 2],
    /// View x and y of the first ray (mm).
    pub first: [f64; 2],
    /// View x from a column to the next, and y from a row to the next (mm).
    pub next: [f64; 2],
}

impl RayGrid {
    /// A ray for every pixel.
    pub fn fine(camera: &Camera) -> Self {
        let s = camera.pixel_spacing();
        Self { size: camera.size(), first: [camera.view_x(0), camera.view_y(0)], next: [s, -s] }
    }

    /// A ray for every square of four pixels.
    pub fn coarse(camera: &Camera) -> Self {
        let fine = Self::fine(camera);
        let first = std::array::from_fn(|a| fine.first[a] + fine.next[a] / 2.0);
        Self { size: fine.size.map(|n| n.div_ceil(2)), first, next: fine.next.map(|s| 2.0 * s) }
    }
}

/// A linear function of the continuous index.
#[derive(Clone, Copy, Debug)]
struct Linear {
    per_index: DVec3,
    origin: f64,
}

impl Linear {
    fn at(&self, index: DVec3) -> f64 {
        self.per_index.dot(index) + self.origin
    }

    /// How far the function reaches to both sides within a box.
    fn reach(&self, half: DVec3) -> f64 {
        self.per_index.abs().dot(half)
    }
}

/// A volume in a raster of parallel rays.
#[derive(Clone, Copy, Debug)]
pub struct CellProjection {
    /// The index where each ray is at depth 0: of the first ray, from a column to the next, from a row to the next.
    foot: [DVec3; 3],
    /// Index per mm of depth.
    pub toward: DVec3,
    /// Depth per voxel along each axis (mm); 0 along an axis that the rays run across.
    pub per_voxel: DVec3,
    column: Linear,
    row: Linear,
    depth: Linear,
}

/// The pixels of a tile that the rays through a box belong to, both ends included.
#[derive(Clone, Copy, Debug)]
pub struct Footprint {
    /// The first and the last column.
    pub columns: [usize; 2],
    /// The first and the last row.
    pub rows: [usize; 2],
}

/// A box in the index space of a volume.
#[derive(Clone, Copy, Debug)]
pub struct IndexBox {
    /// Its middle.
    pub center: DVec3,
    /// Half its sides.
    pub half: DVec3,
}

impl IndexBox {
    /// The box between two corners.
    pub fn between(low: DVec3, high: DVec3) -> Self {
        Self { center: (low + high) / 2.0, half: (high - low) / 2.0 }
    }
}

impl CellProjection {
    /// The projection of `volume` in the view of `camera`.
    pub fn new(volume: &Volume, camera: &Camera, rays: &RayGrid) -> Self {
        let to = IndexFromView::new(volume, camera);
        let matrix = volume.world_from_index();
        let along = |axis: DVec3| Linear {
            per_index: matrix.matrix3.transpose() * axis,
            origin: axis.dot(matrix.translation - camera.center()),
        };
        let raster = |linear: Linear, a: usize| Linear {
            per_index: linear.per_index / rays.next[a],
            origin: (linear.origin - rays.first[a]) / rays.next[a],
        };
        let per_voxel = to.z.to_array().map(|z| if z.abs() < PARALLEL { 0.0 } else { 1.0 / z });
        Self {
            foot: [to.origin + to.x * rays.first[0] + to.y * rays.first[1], to.x * rays.next[0], to.y * rays.next[1]],
            toward: to.z,
            per_voxel: DVec3::from(per_voxel),
            column: raster(along(camera.right()), 0),
            row: raster(along(camera.up()), 1),
            depth: along(camera.direction()),
        }
    }

    /// The index where the ray of a pixel is at a depth (mm).
    #[inline(always)]
    pub fn index_at(&self, [column, row]: [f64; 2], depth: f64) -> DVec3 {
        self.foot[0] + self.foot[1] * column + self.foot[2] * row + self.toward * depth
    }

    /// The index from a column to the next, and from a row to the next.
    pub fn index_steps(&self) -> [DVec3; 2] {
        [self.foot[1], self.foot[2]]
    }

    /// Columns, and rows, per index.
    pub fn pixel_steps(&self) -> [DVec3; 2] {
        [self.column.per_index, self.row.per_index]
    }

    /// The column and the row of a place.
    #[inline(always)]
    pub fn pixel_of(&self, index: DVec3) -> [f64; 2] {
        [self.column.at(index), self.row.at(index)]
    }

    /// How far a box reaches in depth to both sides (mm).
    #[inline(always)]
    pub fn depth_reach(&self, half: DVec3) -> f64 {
        self.depth.reach(half)
    }

    /// The depth of a place (mm).
    #[inline(always)]
    pub fn depth_of(&self, index: DVec3) -> f64 {
        self.depth.at(index)
    }

    /// How far a box reaches to both sides in the raster, in pixels of the longer of both ways.
    pub fn reach(&self, half: DVec3) -> f64 {
        self.column.reach(half).max(self.row.reach(half))
    }

    /// The pixels of the tile of `size` pixels from `place` on whose rays may meet a box between two depths; their columns and
    /// rows count from those of the tile.
    #[inline(always)]
    pub fn footprint(
        &self,
        space: &IndexBox,
        (place, size): ([usize; 2], [usize; 2]),
        [near, far]: [f64; 2],
    ) -> Option<Footprint> {
        let (depth, reach) = (self.depth.at(space.center), self.depth.reach(space.half));
        if depth + reach < near || depth - reach > far {
            return None;
        }
        let across = |linear: &Linear, a: usize| {
            let (middle, reach) = (linear.at(space.center) - place[a] as f64, linear.reach(space.half) + PIXEL_ROUNDING);
            let (low, high) = (middle - reach, middle + reach);
            let last = (size[a] - 1) as f64;
            if high < 0.0 || low > last {
                return None;
            }
            let first = if low > 0.0 { low } else { 0.0 };
            let end = if high < last { high } else { last };
            let first = first as usize + usize::from((first as usize as f64) < first);
            let end = end as usize;
            (first <= end).then_some([first, end])
        };
        Some(Footprint { columns: across(&self.column, 0)?, rows: across(&self.row, 1)? })
    }
}

/// The number of cells along each axis; one along an axis with one voxel.
fn cells(size: [usize; 3]) -> [usize; 3] {
    size.map(|n| (n - 1).max(1))
}

/// The space of a block: its cells, and half a voxel more at the ends of the volume. Blocks of a `level` are
/// 4·2^level cells long.
#[inline(always)]
pub fn block_box(size: [usize; 3], level: usize, block: [usize; 3]) -> IndexBox {
    let (mut low, mut high) = (DVec3::ZERO, DVec3::ZERO);
    let count = cells(size);
    for a in 0..3 {
        let (first, end) = (block[a] * (SIDE << level), (block[a] + 1) * (SIDE << level));
        low[a] = if first == 0 { -0.5 } else { first as f64 };
        high[a] = if end >= count[a] { size[a] as f64 - 0.5 } else { end as f64 };
    }
    IndexBox::between(low, high)
}

/// A stretch along an axis in which rays run through the same cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slot {
    /// The cell, counted from the first one of its block.
    pub cell: usize,
    /// Where the stretch begins and ends, counted from the cell: 0 to 1 between the centres of voxels; the half voxels
    /// beyond the outermost centres are stretches of their own, in which the outermost voxels go on.
    pub ends: [f64; 2],
}

/// The stretches of a block along one axis with `size` voxels.
pub fn slots(size: usize, block: usize) -> Vec<Slot> {
    if size == 1 {
        return vec![Slot { cell: 0, ends: [-0.5, 0.5] }];
    }
    let (first, last) = (block * SIDE, (block * SIDE + SIDE).min(size - 1) - block * SIDE);
    let mut slots = Vec::with_capacity(SIDE + 2);
    if first == 0 {
        slots.push(Slot { cell: 0, ends: [-0.5, 0.0] });
    }
    slots.extend((0..last).map(|cell| Slot { cell, ends: [0.0, 1.0] }));
    if first + last == size - 1 {
        slots.push(Slot { cell: last - 1, ends: [1.0, 1.5] });
    }
    slots
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slots_fill_the_axis_without_gap_or_overlap() {
        for size in [1, 2, 3, 4, 5, 8, 9, 10, 13] {
            let mut end = -0.5;
            for block in 0..cells([size; 3])[0].div_ceil(SIDE) {
                for slot in slots(size, block) {
                    let cell = (block * SIDE + slot.cell) as f64;
                    assert_eq!(cell + slot.ends[0], end, "{size} voxels");
                    assert!(slot.cell < SIDE && cell <= (size.max(2) - 2) as f64);
                    end = cell + slot.ends[1];
                }
            }
            assert_eq!(end, size as f64 - 0.5, "{size} voxels");
        }
    }

    #[test]
    fn blocks_fill_the_volume() {
        for size in [[1, 5, 6], [9, 4, 17]] {
            for level in 0..3 {
                let count = cells(size).map(|n| n.div_ceil(SIDE << level));
                let sum: f64 = (0..count.iter().product())
                    .map(|n| {
                        let block = [n % count[0], n / count[0] % count[1], n / (count[0] * count[1])];
                        let IndexBox { half, .. } = block_box(size, level, block);
                        8.0 * half.element_product()
                    })
                    .sum();
                assert!((sum - size.iter().product::<usize>() as f64).abs() < 1e-9);
            }
        }
    }
}
