//! The surface: the volume at the world point that each pixel's depth stands for (paper section 3.3.4).

use glam::DVec3;
use rayon::prelude::*;

use super::View;
use crate::camera::Camera;
use crate::error::Result;
use crate::math::lanes::{FAN, Kernel, ROWS, dispatch};
use crate::math::sampling::Grid;
use crate::volume::{Volume, Voxel};
use crate::with_voxels;

/// Writes the volume's value at the cut surface, NaN outside the volume.
///
/// # Errors
/// [`crate::error::ErrorKind::Interrupted`].
pub fn surface(view: &View, volume: &Volume, depth: &[f32], value: &mut [f32]) -> Result<()> {
    let grid = Grid::new(volume);
    let index_from_view = IndexFromView::new(volume, view.camera);
    let chunk = view.tile_row();
    value.par_chunks_mut(chunk).zip(depth.par_chunks(chunk)).enumerate().try_for_each(|(row, (value, depth))| {
        view.go_on()?;
        with_voxels!(volume.voxels(), voxels => {
            let first = row * ROWS;
            dispatch(view.isa, SurfaceRows { camera: view.camera, grid, index_from_view, voxels, first, depth, value });
        });
        Ok(())
    })
}

/// Continuous index as an affine map of view coordinates.
#[derive(Clone, Copy)]
struct IndexFromView {
    origin: DVec3,
    x: DVec3,
    y: DVec3,
    z: DVec3,
}

impl IndexFromView {
    fn new(volume: &Volume, camera: &Camera) -> Self {
        let index_from_world = volume.index_from_world();
        Self {
            origin: index_from_world.transform_point3(camera.center()),
            x: index_from_world.transform_vector3(camera.right()),
            y: index_from_world.transform_vector3(camera.up()),
            z: index_from_world.transform_vector3(camera.direction()),
        }
    }
}

struct SurfaceRows<'a, T: Voxel> {
    camera: &'a Camera,
    grid: Grid,
    index_from_view: IndexFromView,
    voxels: &'a [T],
    first: usize,
    depth: &'a [f32],
    value: &'a mut [f32],
}

impl<T: Voxel> Kernel for SurfaceRows<'_, T> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let width = self.camera.size()[0];
        let to = self.index_from_view;
        let rows = self.value.chunks_mut(width).zip(self.depth.chunks(width));
        for (j, (value, depth)) in (self.first..).zip(rows) {
            let row = (to.origin + to.y * self.camera.view_y(j)).to_array();
            for (n, (value, depth)) in value.chunks_mut(FAN).zip(depth.chunks(FAN)).enumerate() {
                let mut z = [0.0; FAN];
                z[..depth.len()].copy_from_slice(depth);
                let mut index = [[0.0; FAN]; 3];
                for a in 0..3 {
                    let (x_step, z_step) = (to.x[a], to.z[a]);
                    for l in 0..FAN {
                        index[a][l] =
                            row[a] + x_step * self.camera.view_x(n * FAN + l) + z_step * f64::from(z[l]);
                    }
                }
                let sampled = self.grid.trilinear_lanes(self.voxels, &index);
                value.copy_from_slice(&sampled[..value.len()]);
            }
        }
    }
}
