//! The surface: the volume at the world point that each pixel's depth stands for (paper section 3.3.4).

use rayon::prelude::*;

use super::View;
use crate::camera::Camera;
use crate::error::{Error, ErrorKind, Result};
use crate::math::lanes::{FAN, Kernel, dispatch, larger, smaller};
use crate::math::ray::{IndexFromView, MOST_SAMPLES};
use crate::math::sampling::Grid;
use crate::settings::{Slab, SlabMode};
use crate::volume::{Volume, Voxel};
use crate::with_voxels;

/// Writes the volume's value at the cut surface, NaN outside the volume; with a slab the largest, mean or smallest of
/// the values within it, as far as it lies in the volume.
///
/// # Errors
/// [`ErrorKind::Settings`] for a slab of more than 65,536 voxels, [`ErrorKind::Interrupted`].
pub fn surface(
    view: &View,
    volume: &Volume,
    depth: &[f32],
    slab: Option<Slab>,
    value: &mut [f32],
) -> Result<()> {
    let offsets = offsets(slab, volume)?;
    let kind = slab.map(|slab| slab.mode);
    let grid = Grid::new(volume);
    let index_from_view = IndexFromView::new(volume, view.camera);
    // Row by row: slabs can take their time.
    let width = view.size()[0];
    value.par_chunks_mut(width).zip(depth.par_chunks(width)).enumerate().try_for_each(
        |(row, (value, depth))| {
            view.go_on()?;
            with_voxels!(volume.voxels(), voxels => {
                let sampler = Sampler { camera: view.camera, grid, index_from_view, voxels };
                dispatch(view.isa, SurfaceRow { sampler, offsets: &offsets, kind, row, depth, value });
            });
            Ok(())
        },
    )
}

/// How a slab is cut into equal parts no longer than a voxel's smallest side, an odd number of them: the length of a part
/// (mm), and the parts on each side of the one in the middle that can lie in the volume.
///
/// # Errors
/// [`ErrorKind::Settings`] for more than 65,536 voxels.
pub fn parts(slab: Option<Slab>, volume: &Volume) -> Result<(f64, i64)> {
    let (thickness, side) = (slab.map_or(0.0, |slab| slab.thickness), volume.smallest_side());
    if thickness > side * MOST_SAMPLES {
        let found = format!("{thickness} mm for voxels of {side:.3e} mm");
        let expected = format!("at most {MOST_SAMPLES} voxels");
        return Err(Error::new(ErrorKind::Settings, "slab thickness", found, expected));
    }
    let to_each_side = ((thickness / side - 1.0) / 2.0).ceil().max(0.0) as i64;
    let part = thickness / (2 * to_each_side + 1) as f64;
    // Farther from the cut surface than the volume is long there is nothing.
    let within = if to_each_side > 0 { (volume.longest_way() / part).ceil() as i64 } else { 0 };
    Ok((part, to_each_side.min(within)))
}

/// Where a slab is sampled (mm behind the cut surface): each of its parts in its middle. The cut surface itself comes
/// first.
fn offsets(slab: Option<Slab>, volume: &Volume) -> Result<Vec<f64>> {
    let (part, to_each_side) = parts(slab, volume)?;
    let beside = (1..=to_each_side).flat_map(|n| [-n as f64 * part, n as f64 * part]);
    Ok(std::iter::once(0.0).chain(beside).collect())
}

/// The volume in view space.
#[derive(Clone, Copy)]
struct Sampler<'a, T> {
    camera: &'a Camera,
    grid: Grid,
    index_from_view: IndexFromView,
    voxels: &'a [T],
}

/// Pixels in a row that are sampled together.
const RUN: usize = 8 * FAN;
type Run = [[f32; FAN]; RUN / FAN];

impl<T: Voxel> Sampler<'_, T> {
    /// The volume `behind` the depths of a run of pixels.
    #[inline(always)]
    fn sample(&self, i: usize, j: usize, depth: &Run, behind: f64) -> Run {
        let to = &self.index_from_view;
        let row = (to.origin + to.y * self.camera.view_y(j)).to_array();
        let mut index = [[[0.0; FAN]; 3]; RUN / FAN];
        for n in 0..RUN / FAN {
            for a in 0..3 {
                let (x_step, z_step) = (to.x[a], to.z[a]);
                for l in 0..FAN {
                    let z = f64::from(depth[n][l]) + behind;
                    index[n][a][l] = row[a] + x_step * self.camera.view_x(i + n * FAN + l) + z_step * z;
                }
            }
        }
        self.grid.trilinear_lanes(self.voxels, &index)
    }
}

struct SurfaceRow<'a, T> {
    sampler: Sampler<'a, T>,
    offsets: &'a [f64],
    kind: Option<SlabMode>,
    row: usize,
    depth: &'a [f32],
    value: &'a mut [f32],
}

impl<T: Voxel> Kernel for SurfaceRow<'_, T> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        for (n, (value, depth)) in self.value.chunks_mut(RUN).zip(self.depth.chunks(RUN)).enumerate() {
            let mut z = [[0.0; FAN]; RUN / FAN];
            z.as_flattened_mut()[..depth.len()].copy_from_slice(depth);
            let mut shown = self.sampler.sample(n * RUN, self.row, &z, 0.0);
            let mut count = [[1.0; FAN]; RUN / FAN];
            for behind in &self.offsets[1..] {
                let beside = self.sampler.sample(n * RUN, self.row, &z, *behind);
                for n in 0..RUN / FAN {
                    join(self.kind, &mut shown[n], &mut count[n], &beside[n]);
                }
            }
            let sums = shown.as_flattened().iter().zip(count.as_flattened());
            for (value, (sum, count)) in value.iter_mut().zip(sums) {
                *value = sum / count;
            }
        }
    }
}

/// Takes one more sample of a slab into what is shown; where there is no cut surface, or no sample, nothing changes.
#[inline(always)]
fn join(kind: Option<SlabMode>, shown: &mut [f32; FAN], count: &mut [f32; FAN], beside: &[f32; FAN]) {
    for l in 0..FAN {
        let (here, there) = (shown[l], beside[l]);
        let absent = here.is_nan() | there.is_nan();
        let joined = match kind {
            Some(SlabMode::Max) => larger(here, there),
            Some(SlabMode::Min) => smaller(here, there),
            _ => here + there,
        };
        shown[l] = if absent { here } else { joined };
        count[l] += if absent | (kind != Some(SlabMode::Mean)) { 0.0 } else { 1.0 };
    }
}
