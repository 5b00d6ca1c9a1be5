//! The surface stage: samples the volume at the world position of each pixel (paper section 3.3.4).

use bytemuck::{Pod, Zeroable};
use glam::DAffine3;
use rayon::prelude::*;

use super::along_rays::{AlongRays, RaySource, ViewRays, along_rays};
use super::{Image, Work};
use crate::camera::Camera;
use crate::error::Result;
use crate::geometry::{Curved, Geometry};
use crate::math::blocks::Blocks;
use crate::math::lanes::{FAN, Kernel, dispatch};
use crate::math::ray_lines::{IndexFromView, Lines, NO_CHORD, RayGrid};
use crate::math::reduce::Reduction;
use crate::math::sampling::Grid;
use crate::settings::Slab;
use crate::volume::{Volume, Voxel};
use crate::with_voxels;

#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct SurfaceParameters {
    /// Half the thickness of the slab (mm); 0 without one.
    pub half: f32,
    /// Which value of the slab is shown: the code of a [`Reduction`].
    pub mode: u32,
    /// Smallest number of parts per mm of a view ray: one per voxel along its main axis.
    pub per_step: f32,
    pub padding: u32,
}

impl SurfaceParameters {
    /// The parameters for a slab, or for a cut surface without one, in a view with `voxel` mm between voxels.
    pub fn new(slab: Option<Slab>, voxel: f64) -> Self {
        let mode = slab.map_or(Reduction::Mean, |slab| Reduction::of(slab.mode)).code();
        let half = slab.map_or(0.0, |slab| slab.thickness / 2.0) as f32;
        Self { half, mode, per_step: (1.0 / voxel) as f32, padding: 0 }
    }
}

#[derive(Clone, Copy)]
pub struct SurfaceScene<'a> {
    pub geometry: &'a Geometry,
    pub volume: &'a Volume<'a>,
    /// Blocks that a slab can skip; `None` reads everything, with the same result.
    pub blocks: Option<&'a Blocks>,
    pub slab: Option<Slab>,
}

/// Writes the volume's value at each pixel's position, NaN outside the volume. With a slab, writes the
/// largest, mean or smallest value in the slab's part within the volume.
pub fn surface(work: &Work, scene: &SurfaceScene, value: &mut [f32]) -> Result<()> {
    work.expect_whole(Image::Value, value);
    thin(work, scene, value)?;
    let Some(slab) = scene.slab else { return Ok(()) };
    let mut thick = vec![f32::NAN; value.len()];
    thicken(work, scene, slab, value, &mut thick)?;
    value.par_iter_mut().zip(&thick).for_each(|(value, thick)| {
        // A slab is shown only if there is a value at the cut surface.
        *value = if value.is_nan() || thick.is_nan() { *value } else { *thick };
    });
    Ok(())
}

fn thin(work: &Work, &SurfaceScene { geometry, volume, .. }: &SurfaceScene, value: &mut [f32]) -> Result<()> {
    with_voxels!(volume.voxels(), voxels => {
        let voxels = GridVoxels { grid: Grid::new(volume), voxels };
        match geometry {
            Geometry::Orthographic { camera, depth } => {
                work.expect_whole(Image::Depth, depth);
                let index_from_view = IndexFromView::new(volume, camera);
                fill(work, &OrthographicPixels { camera, depth, index_from_view, voxels }, value)
            }
            Geometry::Curved(curved) => {
                let index_from_world = volume.index_from_world();
                fill(work, &CurvedPixels { curved, index_from_world, voxels }, value)
            }
        }
    })
}

fn thicken(work: &Work, scene: &SurfaceScene, slab: Slab, value: &[f32], thick: &mut [f32]) -> Result<()> {
    let (half, volume) = (slab.thickness / 2.0, scene.volume);
    let reduction = Reduction::of(slab.mode);
    let limit = reduction.no_limit();
    let along =
        |step: f64| AlongRays { size: work.size, volume, blocks: scene.blocks, reduction, limit, step };
    match scene.geometry {
        Geometry::Orthographic { camera, depth } => {
            let to = IndexFromView::new(volume, camera);
            let chord = |p: usize| match value[p] {
                value if value.is_nan() => NO_CHORD,
                _ => [f64::from(depth[p]) - half, f64::from(depth[p]) + half],
            };
            let source = ViewRays { to, rays: RayGrid::fine(camera), chord };
            along_rays(work, &along(to.voxel()), &source, thick)
        }
        Geometry::Curved(curved) => {
            let source = CurvedRays { curved, index_from_world: volume.index_from_world(), value, half };
            along_rays(work, &along(volume.smallest_side()), &source, thick)
        }
    }
}

struct CurvedRays<'a> {
    curved: &'a Curved,
    index_from_world: DAffine3,
    value: &'a [f32],
    half: f64,
}

impl RaySource for CurvedRays<'_> {
    fn lines(&self, pixels: &[Option<[usize; 2]>; FAN]) -> Lines {
        let [near, far] = NO_CHORD.map(|end| [end; FAN]);
        let mut lines = Lines { foot: [[0.0; FAN]; 3], toward: [[0.0; FAN]; 3], near, far };
        for (l, pixel) in pixels.iter().enumerate() {
            let Some([i, j]) = *pixel else { continue };
            let p = j * self.curved.size()[0] + i;
            if self.value[p].is_nan() {
                continue;
            }
            let foot = self.index_from_world.transform_point3(self.curved.position()[p]);
            let toward = self.index_from_world.transform_vector3(self.curved.slab_direction()[p].as_dvec3());
            for a in 0..3 {
                (lines.foot[a][l], lines.toward[a][l]) = (foot[a], toward[a]);
            }
            (lines.near[l], lines.far[l]) = (-self.half, self.half);
        }
        lines
    }
}

fn fill(work: &Work, places: &impl PixelPositions, value: &mut [f32]) -> Result<()> {
    value.par_chunks_mut(work.size[0]).enumerate().try_for_each(|(row, value)| {
        work.begin(value.len())?;
        dispatch(work.isa, SurfaceRow { places, row, value });
        Ok(())
    })
}

/// Number of pixels of a row that are sampled together.
const PIXELS_TOGETHER: usize = 8 * FAN;
type Run = [[f32; FAN]; PIXELS_TOGETHER / FAN];
/// Continuous indices of a run of pixels, axis by axis.
type Indices = [[[f64; FAN]; 3]; PIXELS_TOGETHER / FAN];

trait PixelPositions: Sync {
    /// The volume at the run of pixels that begins at (`i`, `j`); entries beyond the image are arbitrary.
    fn sample(&self, i: usize, j: usize) -> Run;
}

#[derive(Clone, Copy)]
struct GridVoxels<'a, T> {
    grid: Grid,
    voxels: &'a [T],
}

struct OrthographicPixels<'a, T> {
    camera: &'a Camera,
    depth: &'a [f32],
    index_from_view: IndexFromView,
    voxels: GridVoxels<'a, T>,
}

impl<T: Voxel> PixelPositions for OrthographicPixels<'_, T> {
    #[inline(always)]
    fn sample(&self, i: usize, j: usize) -> Run {
        let (to, width) = (&self.index_from_view, self.camera.size()[0]);
        let depths = &self.depth[j * width..][i..width.min(i + PIXELS_TOGETHER)];
        let mut depth: Run = [[0.0; FAN]; PIXELS_TOGETHER / FAN];
        depth.as_flattened_mut()[..depths.len()].copy_from_slice(depths);
        let row = (to.origin + to.y * self.camera.view_y(j)).to_array();
        let mut index: Indices = [[[0.0; FAN]; 3]; PIXELS_TOGETHER / FAN];
        for n in 0..PIXELS_TOGETHER / FAN {
            for a in 0..3 {
                let (x_step, z_step) = (to.x[a], to.z[a]);
                for l in 0..FAN {
                    let z = f64::from(depth[n][l]);
                    index[n][a][l] = row[a] + x_step * self.camera.view_x(i + n * FAN + l) + z_step * z;
                }
            }
        }
        self.voxels.grid.trilinear_lanes(self.voxels.voxels, &index)
    }
}

struct CurvedPixels<'a, T> {
    curved: &'a Curved,
    index_from_world: DAffine3,
    voxels: GridVoxels<'a, T>,
}

impl<T: Voxel> PixelPositions for CurvedPixels<'_, T> {
    #[inline(always)]
    fn sample(&self, i: usize, j: usize) -> Run {
        let width = self.curved.size()[0];
        let pixels = j * width + i..j * width + width.min(i + PIXELS_TOGETHER);
        let mut index: Indices = [[[NOWHERE; FAN]; 3]; PIXELS_TOGETHER / FAN];
        for (l, point) in self.curved.position()[pixels].iter().enumerate() {
            let place = self.index_from_world.transform_point3(*point);
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
    row: usize,
    value: &'a mut [f32],
}

impl<P: PixelPositions> Kernel for SurfaceRow<'_, P> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        for (n, value) in self.value.chunks_mut(PIXELS_TOGETHER).enumerate() {
            let shown = self.places.sample(n * PIXELS_TOGETHER, self.row);
            value.copy_from_slice(&shown.as_flattened()[..value.len()]);
        }
    }
}
