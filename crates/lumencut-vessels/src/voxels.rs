//! Reads the voxels of a volume as numbers, for all voxel types and grids.

use std::sync::OnceLock;

use glam::{DAffine3, DVec3};

use lumencut_core::math::lanes::{FAN, Isa, Kernel, dispatch};
use lumencut_core::math::sampling::Grid;
use lumencut_core::polarity::Polarity;
use lumencut_core::volume::{Real, Volume, Voxel};
use lumencut_core::with_voxels;

pub(crate) trait VoxelSource: Sync {
    fn cube(&self, first: [i32; 3], side: usize, values: &mut [f32]);
    /// Trilinear value at a continuous index; NaN if it is more than half a voxel beyond the outermost voxel centres.
    fn at(&self, index: DVec3) -> f32;
    /// Value of a voxel inside the volume.
    fn voxel(&self, voxel: [i32; 3]) -> f32;
    fn along(&self, start: DVec3, stride: DVec3, values: &mut Vec<f32>);
    /// Whether any value is below `limit`; only every `every`-th row along i is read, starting with the first.
    fn goes_below(&self, limit: f32, every: usize) -> bool;
}

/// The values of a volume as they are traced, those of dark lumens negated, with the transforms between voxel index and world
/// space.
pub struct Voxels<'a> {
    source: Box<dyn VoxelSource + 'a>,
    /// Number of voxels along (i, j, k).
    pub size: [usize; 3],
    /// Transform from a continuous voxel index to a world position (LPS, mm).
    pub world_from_index: DAffine3,
    /// Transform from a world position (LPS, mm) to a continuous voxel index.
    pub index_from_world: DAffine3,
    /// Smallest voxel side (mm).
    pub smallest_side: f64,
    /// Unit of sampling distances (mm): the smallest voxel side, but at least a quarter of the middle one.
    /// Otherwise very uneven voxel sides would multiply the number of samples.
    pub sampling_side: f64,
    /// Whether the lumen is bright or dark in the volume; see [`Polarity::turned`].
    pub polarity: Polarity,
    negative: OnceLock<bool>,
}

/// Values below this limit mean that the volume is in HU and shows fat or air.
const NEGATIVE: f32 = -20.0;

/// Maximum number of voxels that are read to find negative values.
const MOST_VOXELS: usize = 400_000;

/// Minimum unit of sampling distances, as a fraction of the middle voxel side.
const LEAST_OF_MIDDLE: f64 = 0.25;

fn middle_side(world_from_index: DAffine3) -> f64 {
    let sides = world_from_index.matrix3;
    let mut lengths = [sides.x_axis, sides.y_axis, sides.z_axis].map(DVec3::length);
    lengths.sort_by(f64::total_cmp);
    lengths[1]
}

impl<'a> Voxels<'a> {
    /// Makes the voxels of `volume` readable as numbers.
    pub fn new(volume: &Volume<'a>) -> Self {
        let (size, strides) = (volume.size(), volume.strides());
        let source: Box<dyn VoxelSource + 'a> = with_voxels!(volume.voxels(), voxels => Box::new(Typed { voxels, grid: Grid::new(volume), size, strides }));
        let polarity = volume.polarity();
        let source = if polarity == Polarity::Dark { Box::new(Negated(source)) } else { source };
        Self {
            source,
            size,
            world_from_index: volume.world_from_index(),
            index_from_world: volume.index_from_world(),
            smallest_side: volume.smallest_side(),
            sampling_side: volume
                .smallest_side()
                .max(LEAST_OF_MIDDLE * middle_side(volume.world_from_index())),
            polarity,
            negative: OnceLock::new(),
        }
    }

    /// Side (mm) of a cube with the volume of a voxel.
    pub fn mean_side(&self) -> f64 {
        self.world_from_index.matrix3.determinant().abs().cbrt()
    }

    /// Writes the values of a cube of voxels, i fastest; NaN outside the volume.
    pub fn cube(&self, first: [i32; 3], side: usize, values: &mut [f32]) {
        self.source.cube(first, side, values);
    }

    /// Trilinear value at a world position (LPS, mm); NaN outside the volume.
    pub fn at(&self, place: DVec3) -> f32 {
        self.source.at(self.index_from_world.transform_point3(place))
    }

    /// As [`Voxels::at`], but as the volume has the value, also where lumen is dark.
    pub fn shown_at(&self, place: DVec3) -> f64 {
        self.polarity.turned(f64::from(self.at(place)))
    }

    /// Value of a voxel inside the volume.
    pub fn voxel(&self, voxel: [i32; 3]) -> f32 {
        self.source.voxel(voxel)
    }

    /// Trilinear value at a continuous index; NaN outside the volume.
    pub(crate) fn at_index(&self, index: DVec3) -> f32 {
        self.source.at(index)
    }

    /// Appends sixteen values in steps of `stride` from `start`, continuing after those already in `values`.
    pub fn along(&self, start: DVec3, stride: DVec3, values: &mut Vec<f32>) {
        self.source.along(start, stride, values);
    }

    /// Whether the volume has values as negative as those of fat and air in HU; only some rows are read. Never for dark lumens.
    pub(crate) fn has_negative(&self) -> bool {
        let voxels: usize = self.size.iter().product();
        self.polarity == Polarity::Bright
            && *self
                .negative
                .get_or_init(|| self.source.goes_below(NEGATIVE, voxels.div_ceil(MOST_VOXELS).max(1)))
    }

    /// The voxel nearest to a world position; None outside the volume.
    pub fn voxel_at(&self, place: DVec3) -> Option<[i32; 3]> {
        let voxel = self.index_from_world.transform_point3(place).round();
        let is_inside = (0..3).all(|a| voxel[a] >= 0.0 && voxel[a] < self.size[a] as f64);
        is_inside.then(|| voxel.to_array().map(|c| c as i32))
    }

    /// World position (LPS, mm) of a voxel centre.
    pub fn center(&self, voxel: [i32; 3]) -> DVec3 {
        self.world_from_index.transform_point3(DVec3::from_array(voxel.map(f64::from)))
    }

    /// Box of voxels around a ball: its first voxel, and the number of voxels along each axis.
    pub fn around(&self, center: DVec3, radius: f64) -> ([i32; 3], [i32; 3]) {
        let index = self.index_from_world.transform_point3(center);
        // The row lengths of the inverse matrix give the extent of a ball along each index axis.
        let rows = self.index_from_world.matrix3.transpose();
        let reach = DVec3::new(rows.x_axis.length(), rows.y_axis.length(), rows.z_axis.length()) * radius;
        let low = (index - reach).ceil();
        let high = (index + reach).floor();
        let first: [i32; 3] = std::array::from_fn(|a| low[a].max(0.0) as i32);
        let last: [i32; 3] = std::array::from_fn(|a| high[a].min(self.size[a] as f64 - 1.0) as i32);
        (first, std::array::from_fn(|a| (last[a] - first[a] + 1).max(0)))
    }

    /// Centres and values of the voxels whose centre lies within a ball.
    pub fn ball(&self, center: DVec3, radius: f64) -> Vec<(DVec3, f32)> {
        let (first, count) = self.around(center, radius);
        let mut found = Vec::new();
        for k in 0..count[2] {
            for j in 0..count[1] {
                for i in 0..count[0] {
                    let voxel = [first[0] + i, first[1] + j, first[2] + k];
                    let place = self.center(voxel);
                    if place.distance_squared(center) <= radius * radius {
                        found.push((place, self.voxel(voxel)));
                    }
                }
            }
        }
        found
    }
}

/// Negated values. Interpolation and negation commute to the bit.
struct Negated<'a>(Box<dyn VoxelSource + 'a>);

impl Negated<'_> {
    fn negate(values: &mut [f32]) {
        // Unlike `-value`, this has no negative zero.
        values.iter_mut().for_each(|value| *value = 0.0 - *value);
    }
}

impl VoxelSource for Negated<'_> {
    fn cube(&self, first: [i32; 3], side: usize, values: &mut [f32]) {
        self.0.cube(first, side, values);
        Self::negate(values);
    }

    fn at(&self, index: DVec3) -> f32 {
        0.0 - self.0.at(index)
    }

    fn voxel(&self, voxel: [i32; 3]) -> f32 {
        0.0 - self.0.voxel(voxel)
    }

    fn along(&self, start: DVec3, stride: DVec3, values: &mut Vec<f32>) {
        let first = values.len();
        self.0.along(start, stride, values);
        Self::negate(&mut values[first..]);
    }

    fn goes_below(&self, limit: f32, every: usize) -> bool {
        self.0.goes_below(limit, every)
    }
}

struct Typed<'a, T> {
    voxels: &'a [T],
    grid: Grid,
    size: [usize; 3],
    strides: [usize; 3],
}

impl<T: Voxel> VoxelSource for Typed<'_, T> {
    fn cube(&self, first: [i32; 3], side: usize, values: &mut [f32]) {
        let within = |a: usize, c: i32| c >= 0 && (c as usize) < self.size[a];
        for k in 0..side {
            for j in 0..side {
                let row = &mut values[(k * side + j) * side..][..side];
                let (y, z) = (first[1] + j as i32, first[2] + k as i32);
                if !within(1, y) || !within(2, z) {
                    row.fill(f32::NAN);
                    continue;
                }
                let start = y as usize * self.strides[1] + z as usize * self.strides[2];
                for (i, value) in row.iter_mut().enumerate() {
                    let x = first[0] + i as i32;
                    *value = if within(0, x) {
                        self.voxels[start + x as usize * self.strides[0]].real().to_f32()
                    } else {
                        f32::NAN
                    };
                }
            }
        }
    }

    #[inline]
    fn at(&self, index: DVec3) -> f32 {
        // Single precision makes the result independent of the voxel type.
        self.grid.trilinear_single(self.voxels, index)
    }

    #[inline]
    fn voxel(&self, voxel: [i32; 3]) -> f32 {
        self.voxels[(0..3).map(|a| voxel[a] as usize * self.strides[a]).sum::<usize>()].real().to_f32()
    }

    fn along(&self, start: DVec3, stride: DVec3, values: &mut Vec<f32>) {
        let first = values.len();
        // On the web, parallel code for each voxel type would enlarge the download.
        let is_number = start.is_finite() && stride.is_finite();
        if cfg!(target_arch = "wasm32") || !is_number {
            values.extend((first..first + FAN).map(|n| self.at(start + stride * n as f64)));
        } else {
            let kernel = Along { voxels: self.voxels, grid: &self.grid, start, stride, first };
            values.extend(dispatch(Isa::widest(), kernel));
        }
    }

    fn goes_below(&self, limit: f32, every: usize) -> bool {
        let ([nx, ny, nz], [si, sj, sk]) = (self.size, self.strides);
        (0..ny * nz).step_by(every).any(|row| {
            let first = row % ny * sj + row / ny * sk;
            (0..nx).any(|i| self.voxels[first + i * si].real().to_f32() < limit)
        })
    }
}

/// Kernel that computes sixteen values along a line.
struct Along<'a, T> {
    voxels: &'a [T],
    grid: &'a Grid,
    start: DVec3,
    stride: DVec3,
    first: usize,
}

impl<T: Voxel> Kernel for Along<'_, T> {
    type Output = [f32; FAN];

    #[inline(always)]
    fn run(self) -> [f32; FAN] {
        let [start, stride] = [self.start, self.stride].map(|vector| vector.to_array());
        let mut index = [[0.0; FAN]; 3];
        for a in 0..3 {
            for l in 0..FAN {
                index[a][l] = start[a] + stride[a] * (self.first + l) as f64;
            }
        }
        self.grid.trilinear_single_lanes(self.voxels, &index)
    }
}

#[cfg(test)]
#[path = "tests/voxels.rs"]
mod tests;
