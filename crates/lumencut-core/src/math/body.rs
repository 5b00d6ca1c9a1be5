//! The body in a scan, as coarse cells: all that is brighter than the air around it, without the table.

use glam::DVec3;
use rayon::prelude::*;

use super::statistics::two_groups;
use crate::error::Result;
use crate::stop::{Stop, go_on};
use crate::volume::{Real, Volume, Voxel};
use crate::with_voxels;

/// Sides of cells (mm), and the most cells along the longest line through the volume.
const CELL_MM: f64 = 5.0;
const MOST_ACROSS: f64 = 200.0;
/// The number of cells from which the level between air and body comes.
const JUDGED: usize = 1 << 16;
/// At least this share of the cells is air, and as many are body.
const LEAST_SHARE: f64 = 0.05;
/// At most this share of the cells lies in the middle third between air and body: values of tissue have no such gap.
const MOST_BETWEEN: f64 = 0.1;
/// If more than this share of the dark cells has one value, the scan was masked; air has noise, or this value (HU).
const MOST_ALIKE: f64 = 0.9;
const AIR: [f64; 2] = [-1100.0, -900.0];
/// A face of the volume with more body than this share cuts it; a scan in which more than two faces do shows a crop.
const CUT_SHARE: f64 = 0.25;
const MOST_CUT_FACES: usize = 2;
/// Smaller parts, as a share of the largest, are not the body.
const SMALLEST_PART: f64 = 0.05;

/// A cell at the surface of the body.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceCell {
    /// World position of its centre (mm, LPS).
    pub place: DVec3,
    /// Whether it lies at a face of the volume: the body continues beyond.
    pub is_cut: bool,
}

/// The surface of the body.
#[derive(Clone, Debug)]
pub struct Body {
    /// Every cell that touches another one outside the body, or a face of the volume.
    pub cells: Vec<SurfaceCell>,
    /// The longest side of a cell (mm).
    pub side: f64,
}

impl Body {
    /// The body of a volume; `None` without air around it, as in a crop or a masked scan.
    pub fn of(volume: &Volume, stop: Stop) -> Result<Option<Self>> {
        let grid = Cells::of(volume);
        let means = grid.means(volume, stop)?;
        let Some(level) = air_level(&means) else { return Ok(None) };
        let mut body: Vec<bool> = means.iter().map(|mean| *mean > level).collect();
        let cut_faces = grid.faces().into_iter().filter(|face| is_cut(face, &body)).count();
        if cut_faces > MOST_CUT_FACES {
            return Ok(None);
        }
        go_on(stop)?;
        grid.keep_large_parts(&mut body);
        Ok(Some(Self { cells: grid.surface(volume, &body), side: grid.side(volume) }))
    }
}

fn is_cut(face: &[usize], body: &[bool]) -> bool {
    face.iter().filter(|cell| body[**cell]).count() as f64 > CUT_SHARE * face.len() as f64
}

/// The value halfway between air and body; `None` if no dark cells stand apart.
fn air_level(means: &[f32]) -> Option<f32> {
    let step = means.len().div_ceil(JUDGED);
    let finite = |mean: &f64| mean.is_finite();
    let mut rising: Vec<f64> =
        means.iter().step_by(step).map(|mean| f64::from(*mean)).filter(finite).collect();
    rising.sort_unstable_by(f64::total_cmp);
    // Bone and metal shall not outweigh the body.
    let most = *rising.get(rising.len() * 3 / 4)?;
    let mut clipped = rising.clone();
    clipped.iter_mut().for_each(|value| *value = value.min(most));
    let first = two_groups(&clipped)?;
    let (count, least) = (rising.len() as f64, (LEAST_SHARE * rising.len() as f64) as usize);
    if first < least || rising.len() - first < least {
        return None;
    }
    let [air, body] = [rising[first / 2], rising[first + (rising.len() - first) / 2]];
    let below = |share: f64| rising.partition_point(|value| *value < air + share * (body - air));
    let between = (below(2.0 / 3.0) - below(1.0 / 3.0)) as f64;
    let alike = rising[..first].iter().filter(|value| **value == air).count();
    let is_masked = alike as f64 > MOST_ALIKE * first as f64 && !(AIR[0]..AIR[1]).contains(&air);
    (between <= MOST_BETWEEN * count && !is_masked).then_some(f64::midpoint(air, body) as f32)
}

/// A grid of cells, each of `voxels` along the axes of the volume.
struct Cells {
    voxels: [usize; 3],
    size: [usize; 3],
}

impl Cells {
    fn of(volume: &Volume) -> Self {
        let axes = volume.world_from_index().matrix3;
        let side = CELL_MM.max(volume.longest_way() / MOST_ACROSS);
        let voxels = [axes.x_axis, axes.y_axis, axes.z_axis]
            .map(|axis| (side / axis.length()).round().clamp(1.0, 1e6) as usize);
        let size = std::array::from_fn(|a| volume.size()[a].div_ceil(voxels[a]));
        Self { voxels, size }
    }

    fn side(&self, volume: &Volume) -> f64 {
        let axes = volume.world_from_index().matrix3;
        let lengths = [axes.x_axis, axes.y_axis, axes.z_axis].map(|axis| axis.length());
        (0..3).map(|a| lengths[a] * self.voxels[a] as f64).fold(0.0, f64::max)
    }

    fn count(&self) -> usize {
        self.size.iter().product()
    }

    fn place(&self, cell: usize) -> [usize; 3] {
        [cell % self.size[0], cell / self.size[0] % self.size[1], cell / self.size[0] / self.size[1]]
    }

    /// The mean of eight voxels of each cell; those that are not finite count as dark.
    fn means(&self, volume: &Volume, stop: Stop) -> Result<Vec<f32>> {
        let mut means = vec![0.0; self.count()];
        let slice = self.size[0] * self.size[1];
        with_voxels!(volume.voxels(), voxels => {
            means.par_chunks_mut(slice).enumerate().try_for_each(|(k, means)| {
                go_on(stop)?;
                for (n, mean) in means.iter_mut().enumerate() {
                    *mean = self.mean(voxels, volume, self.place(k * slice + n));
                }
                Ok(())
            })
        })?;
        Ok(means)
    }

    fn mean<T: Voxel>(&self, voxels: &[T], volume: &Volume, cell: [usize; 3]) -> f32 {
        let (size, strides) = (volume.size(), volume.strides());
        let offset = |a: usize, half: usize| {
            let within = self.voxels[a] * (1 + 2 * half) / 4;
            (cell[a] * self.voxels[a] + within).min(size[a] - 1) * strides[a]
        };
        let value = |corner: usize| {
            let at = (0..3).map(|a| offset(a, corner >> a & 1)).sum::<usize>();
            voxels[at].real().to_f32()
        };
        (0..8).map(value).sum::<f32>() / 8.0
    }

    /// The cells of each face of the volume.
    fn faces(&self) -> [Vec<usize>; 6] {
        std::array::from_fn(|face| {
            let (axis, end) = (face / 2, if face % 2 == 0 { 0 } else { self.size[face / 2] - 1 });
            (0..self.count()).filter(|cell| self.place(*cell)[axis] == end).collect()
        })
    }

    /// The neighbours of a cell; `None` beyond the volume.
    fn neighbours(&self, cell: usize) -> [Option<usize>; 6] {
        let (place, strides) = (self.place(cell), [1, self.size[0], self.size[0] * self.size[1]]);
        std::array::from_fn(|n| {
            let axis = n / 2;
            if n % 2 == 0 {
                (place[axis] > 0).then(|| cell - strides[axis])
            } else {
                (place[axis] + 1 < self.size[axis]).then(|| cell + strides[axis])
            }
        })
    }

    /// Keeps parts that hold together by more than a cell's width, such as a body but not the table under it.
    fn keep_large_parts(&self, body: &mut [bool]) {
        let is_inner = |cell: usize| body[cell] && self.neighbours(cell).iter().flatten().all(|n| body[*n]);
        let inner: Vec<bool> = (0..body.len()).into_par_iter().map(is_inner).collect();
        let parts = self.parts(&inner);
        let largest = parts.iter().map(Vec::len).max().unwrap_or(0) as f64;
        let mut kept = vec![false; body.len()];
        for cell in parts.iter().filter(|part| part.len() as f64 >= SMALLEST_PART * largest).flatten() {
            kept[*cell] = true;
            self.neighbours(*cell).iter().flatten().for_each(|neighbour| kept[*neighbour] = true);
        }
        body.copy_from_slice(&kept);
    }

    fn parts(&self, cells: &[bool]) -> Vec<Vec<usize>> {
        let (mut seen, mut parts) = (vec![false; cells.len()], Vec::new());
        for first in 0..cells.len() {
            if !cells[first] || seen[first] {
                continue;
            }
            let (mut part, mut next) = (vec![first], 0);
            seen[first] = true;
            while let Some(cell) = part.get(next).copied() {
                next += 1;
                for neighbour in self.neighbours(cell).into_iter().flatten() {
                    if cells[neighbour] && !seen[neighbour] {
                        seen[neighbour] = true;
                        part.push(neighbour);
                    }
                }
            }
            parts.push(part);
        }
        parts
    }

    fn surface(&self, volume: &Volume, body: &[bool]) -> Vec<SurfaceCell> {
        let surface = |cell: usize| {
            let around = self.neighbours(cell);
            let is_cut = around.contains(&None);
            if !body[cell] || !(is_cut || around.iter().flatten().any(|n| !body[*n])) {
                return None;
            }
            let place = self.place(cell);
            let middle = |a: usize| (place[a] as f64 + 0.5) * self.voxels[a] as f64 - 0.5;
            let index = DVec3::new(middle(0), middle(1), middle(2));
            Some(SurfaceCell { place: volume.world_from_index().transform_point3(index), is_cut })
        };
        (0..self.count()).into_par_iter().filter_map(surface).collect()
    }
}

#[cfg(test)]
#[path = "tests/body.rs"]
mod tests;
