//! The surface: the volume at the world point where each pixel looks (paper section 3.3.4).

use bytemuck::{Pod, Zeroable};
use glam::DAffine3;
use rayon::prelude::*;

use super::{Image, Work};
use crate::camera::Camera;
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::{Curved, Geometry};
use crate::math::lanes::{FAN, Kernel, dispatch, larger, smaller};
use crate::math::ray::{IndexFromView, MOST_SAMPLES};
use crate::math::sampling::Grid;
use crate::settings::{Slab, SlabMode};
use crate::volume::{Volume, Voxel};
use crate::with_voxels;

/// What a slab shows, as a number that shaders know: the mean, the largest or the smallest of its samples.
pub const MEAN: u32 = 0;
#[allow(missing_docs)]
pub const LARGEST: u32 = 1;
#[allow(missing_docs)]
pub const SMALLEST: u32 = 2;

/// The parameters of the stage: a slab is cut into equal parts no longer than a voxel's smallest side, an odd number of
/// them, and each is sampled in its middle.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct SurfaceParameters {
    /// The length of a part (mm).
    pub part: f32,
    /// The parts on each side of the one in the middle that can lie in the volume.
    pub beside: u32,
    /// What is shown: [`MEAN`], [`LARGEST`] or [`SMALLEST`].
    pub mode: u32,
    /// Fills the structure as the shaders' rules of layout want it.
    pub padding: u32,
    /// The length of a part with all digits that the CPU computes with (mm).
    pub exact_part: f64,
}

impl SurfaceParameters {
    /// The parameters for a slab through `volume`, or for the cut surface alone.
    ///
    /// # Errors
    /// [`ErrorKind::Settings`] for a slab of more than 65,536 voxels.
    pub fn new(slab: Option<Slab>, volume: &Volume) -> Result<Self> {
        let (thickness, side) = (slab.map_or(0.0, |slab| slab.thickness), volume.smallest_side());
        if thickness > side * MOST_SAMPLES {
            let found = format!("{thickness} mm for voxels of {side:.3e} mm");
            let expected = format!("at most {MOST_SAMPLES} voxels");
            return Err(Error::new(ErrorKind::Settings, "slab thickness", found, expected));
        }
        let to_each_side = ((thickness / side - 1.0) / 2.0).ceil().max(0.0) as i64;
        let exact_part = thickness / (2 * to_each_side + 1) as f64;
        // Farther from the cut surface than the volume is long there is nothing.
        let within = if to_each_side > 0 { (volume.longest_way() / exact_part).ceil() as i64 } else { 0 };
        let mode = match slab.map(|slab| slab.mode) {
            Some(SlabMode::Max) => LARGEST,
            Some(SlabMode::Min) => SMALLEST,
            Some(SlabMode::Mean) | None => MEAN,
        };
        let beside = to_each_side.min(within) as u32;
        Ok(Self { part: exact_part as f32, beside, mode, padding: 0, exact_part })
    }

    /// Where a slab is sampled besides the cut surface itself (mm behind it).
    fn offsets(&self) -> Vec<f64> {
        (1..=i64::from(self.beside))
            .flat_map(|n| [-n as f64, n as f64])
            .map(|n| n * self.exact_part)
            .collect()
    }
}

/// Writes the volume's value where each pixel looks, NaN outside the volume; with a slab the largest, mean or smallest of
/// the values within it, as far as it lies in the volume.
///
/// # Errors
/// [`ErrorKind::Interrupted`].
pub fn surface(
    work: &Work,
    geometry: &Geometry,
    volume: &Volume,
    parameters: &SurfaceParameters,
    value: &mut [f32],
) -> Result<()> {
    work.expect_whole(Image::Value, value);
    let slab = SlabSamples { offsets: &parameters.offsets(), mode: parameters.mode };
    with_voxels!(volume.voxels(), voxels => {
        let voxels = GridVoxels { grid: Grid::new(volume), voxels };
        match geometry {
            Geometry::Orthographic { camera, depth } => {
                work.expect_whole(Image::Depth, depth);
                let index_from_view = IndexFromView::new(volume, camera);
                fill(work, &OrthographicPlaces { camera, depth, index_from_view, voxels }, &slab, value)
            }
            Geometry::Curved(curved) => {
                let index_from_world = volume.index_from_world();
                fill(work, &CurvedPlaces { curved, index_from_world, voxels }, &slab, value)
            }
        }
    })
}

/// Fills the values row by row: slabs can take their time.
fn fill(work: &Work, places: &impl Places, slab: &SlabSamples, value: &mut [f32]) -> Result<()> {
    value.par_chunks_mut(work.size[0]).enumerate().try_for_each(|(row, value)| {
        work.begin(value.len())?;
        dispatch(work.isa, SurfaceRow { places, slab, row, value });
        Ok(())
    })
}

/// Where a slab is sampled besides the cut surface itself (mm behind it), and what is shown of the samples.
#[derive(Clone, Copy)]
struct SlabSamples<'a> {
    offsets: &'a [f64],
    mode: u32,
}

/// Pixels in a row that are sampled together.
const RUN: usize = 8 * FAN;
type Run = [[f32; FAN]; RUN / FAN];
/// Continuous indices of a run of pixels, axis by axis.
type Indices = [[[f64; FAN]; 3]; RUN / FAN];

/// Where the pixels of a geometry lie in the volume.
trait Places: Sync {
    /// The volume `behind` (mm) the places of the run of pixels that begins at (`i`, `j`); those beyond the image mean
    /// nothing.
    fn sample(&self, i: usize, j: usize, behind: f64) -> Run;
}

/// The voxels of a volume and the grid they lie on.
#[derive(Clone, Copy)]
struct GridVoxels<'a, T> {
    grid: Grid,
    voxels: &'a [T],
}

/// The points where a camera's rays meet the cut surface.
struct OrthographicPlaces<'a, T> {
    camera: &'a Camera,
    depth: &'a [f32],
    index_from_view: IndexFromView,
    voxels: GridVoxels<'a, T>,
}

impl<T: Voxel> Places for OrthographicPlaces<'_, T> {
    #[inline(always)]
    fn sample(&self, i: usize, j: usize, behind: f64) -> Run {
        let (to, width) = (&self.index_from_view, self.camera.size()[0]);
        let depths = &self.depth[j * width..][i..width.min(i + RUN)];
        let mut depth: Run = [[0.0; FAN]; RUN / FAN];
        depth.as_flattened_mut()[..depths.len()].copy_from_slice(depths);
        let row = (to.origin + to.y * self.camera.view_y(j)).to_array();
        let mut index: Indices = [[[0.0; FAN]; 3]; RUN / FAN];
        for n in 0..RUN / FAN {
            for a in 0..3 {
                let (x_step, z_step) = (to.x[a], to.z[a]);
                for l in 0..FAN {
                    let z = f64::from(depth[n][l]) + behind;
                    index[n][a][l] = row[a] + x_step * self.camera.view_x(i + n * FAN + l) + z_step * z;
                }
            }
        }
        self.voxels.grid.trilinear_lanes(self.voxels.voxels, &index)
    }
}

/// A world point of its own for every pixel.
struct CurvedPlaces<'a, T> {
    curved: &'a Curved,
    index_from_world: DAffine3,
    voxels: GridVoxels<'a, T>,
}

impl<T: Voxel> Places for CurvedPlaces<'_, T> {
    #[inline(always)]
    fn sample(&self, i: usize, j: usize, behind: f64) -> Run {
        let width = self.curved.size()[0];
        let pixels = j * width + i..j * width + width.min(i + RUN);
        let points = self.curved.position()[pixels.clone()].iter().zip(&self.curved.slab_direction()[pixels]);
        let mut index: Indices = [[[NOWHERE; FAN]; 3]; RUN / FAN];
        for (l, (point, direction)) in points.enumerate() {
            let place = self.index_from_world.transform_point3(*point + direction.as_dvec3() * behind);
            if place.is_finite() {
                for a in 0..3 {
                    index[l / FAN][a][l % FAN] = place[a];
                }
            }
        }
        self.voxels.grid.trilinear_lanes(self.voxels.voxels, &index)
    }
}

/// An index outside every volume.
const NOWHERE: f64 = -1e9;

struct SurfaceRow<'a, P> {
    places: &'a P,
    slab: &'a SlabSamples<'a>,
    row: usize,
    value: &'a mut [f32],
}

impl<P: Places> Kernel for SurfaceRow<'_, P> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        for (n, value) in self.value.chunks_mut(RUN).enumerate() {
            let mut shown = self.places.sample(n * RUN, self.row, 0.0);
            let mut count = [[1.0; FAN]; RUN / FAN];
            for behind in self.slab.offsets {
                let beside = self.places.sample(n * RUN, self.row, *behind);
                for n in 0..RUN / FAN {
                    join(self.slab.mode, &mut shown[n], &mut count[n], &beside[n]);
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
fn join(mode: u32, shown: &mut [f32; FAN], count: &mut [f32; FAN], beside: &[f32; FAN]) {
    for l in 0..FAN {
        let (here, there) = (shown[l], beside[l]);
        let absent = here.is_nan() | there.is_nan();
        let joined = match mode {
            LARGEST => larger(here, there),
            SMALLEST => smaller(here, there),
            _ => here + there,
        };
        shown[l] = if absent { here } else { joined };
        count[l] += if absent | (mode != MEAN) { 0.0 } else { 1.0 };
    }
}
