//! The rays of a view: their position in the volume and the wanted part of each.

use glam::DVec3;

use super::lanes::FAN;
use super::sampling::Grid;
use crate::camera::Camera;
use crate::volume::Volume;

/// The start of a ray that crosses the entire volume (depth in mm).
pub const WHOLE: f32 = -1e9;
/// The start of a ray that is not needed.
pub const NONE: f32 = 1e9;
/// A depth beyond [`WHOLE`] and [`NONE`].
pub const NEVER: f64 = 2e9;

/// A direction that moves by less than this along an axis (voxels per mm) counts as perpendicular to it.
pub const PARALLEL: f64 = 1e-9;
/// The chord of a pixel without a ray.
pub(crate) const NO_CHORD: [f64; 2] = [NONE as f64, -(NONE as f64)];

/// The continuous index of a position in view coordinates: an affine map.
#[derive(Clone, Copy, Debug)]
pub struct IndexFromView {
    pub origin: DVec3,
    /// Change of the index per mm to the right, upwards, and away from the viewer.
    pub x: DVec3,
    pub y: DVec3,
    pub z: DVec3,
}

impl IndexFromView {
    pub fn new(volume: &Volume, camera: &Camera) -> Self {
        let index_from_world = volume.index_from_world();
        Self {
            origin: index_from_world.transform_point3(camera.center()),
            x: index_from_world.transform_vector3(camera.right()),
            y: index_from_world.transform_vector3(camera.up()),
            z: index_from_world.transform_vector3(camera.direction()),
        }
    }

    /// Length of a ray per voxel (mm), along the axis on which it crosses the most voxels.
    pub fn voxel(&self) -> f64 {
        1.0 / self.z.abs().max_element()
    }
}

/// Side of the square that one ray of a preview serves (pixels).
pub const PREVIEW_SIDE: usize = 6;

/// The rays of a raster: one through each of its pixels.
#[derive(Clone, Copy, Debug)]
pub struct RayGrid {
    pub size: [usize; 2],
    /// View x and y of the first ray (mm).
    pub first: [f64; 2],
    /// Change of view x per column and of view y per row (mm).
    pub next: [f64; 2],
}

impl RayGrid {
    pub fn fine(camera: &Camera) -> Self {
        let s = camera.pixel_spacing();
        Self { size: camera.size(), first: [camera.view_x(0), camera.view_y(0)], next: [s, -s] }
    }

    /// One ray through the middle of each square of a preview.
    pub fn coarse(camera: &Camera) -> Self {
        let (fine, side) = (Self::fine(camera), PREVIEW_SIDE as f64);
        let first = std::array::from_fn(|a| fine.first[a] + fine.next[a] * (side - 1.0) / 2.0);
        Self { size: Self::squares(fine.size), first, next: fine.next.map(|s| side * s) }
    }

    /// Columns and rows of the squares of a preview.
    pub fn squares(size: [usize; 2]) -> [usize; 2] {
        size.map(|n| n.div_ceil(PREVIEW_SIDE))
    }
}

/// Sixteen rays: index at depth 0, change of the index with depth, and the wanted depths.
#[derive(Clone, Debug)]
pub struct Lines {
    pub foot: [[f64; FAN]; 3],
    /// Change of the index per mm of depth.
    pub toward: [[f64; FAN]; 3],
    /// The first depth (mm); above `far` if there is no ray.
    pub near: [f64; FAN],
    pub far: [f64; FAN],
}

impl Lines {
    /// The rays through sixteen pixels (columns, rows) between the two depths of `chord` (mm).
    #[inline(always)]
    pub(crate) fn of_pixels(
        to: &IndexFromView,
        rays: &RayGrid,
        pixels: &[Option<[usize; 2]>; FAN],
        chord: impl Fn([usize; 2]) -> [f64; 2],
    ) -> Self {
        let (mut place, [mut near, mut far]) = ([[0.0; FAN]; 2], NO_CHORD.map(|end| [end; FAN]));
        for (l, pixel) in pixels.iter().enumerate() {
            if let Some([i, j]) = *pixel {
                place[0][l] = rays.first[0] + i as f64 * rays.next[0];
                place[1][l] = rays.first[1] + j as f64 * rays.next[1];
                [near[l], far[l]] = chord([i, j]);
            }
        }
        Self::of_view(to, &place, [near, far])
    }

    #[inline(always)]
    fn of_view(to: &IndexFromView, [x, y]: &[[f64; FAN]; 2], [near, far]: [[f64; FAN]; 2]) -> Self {
        let mut lines = Self { foot: [[0.0; FAN]; 3], toward: [[0.0; FAN]; 3], near, far };
        for a in 0..3 {
            for l in 0..FAN {
                lines.foot[a][l] = to.origin[a] + to.x[a] * x[l] + to.y[a] * y[l];
                lines.toward[a][l] = to.z[a];
            }
        }
        lines
    }

    #[inline(always)]
    pub(crate) fn clip(&mut self, grid: &Grid) {
        let last = grid.last();
        for a in 0..3 {
            for l in 0..FAN {
                let (o, toward) = (self.foot[a][l], self.toward[a][l]);
                let parallel = toward.abs() < PARALLEL;
                let per_voxel = 1.0 / if parallel { 1.0 } else { toward };
                let (one, other) = ((-0.5 - o) * per_voxel, (last[a] + 0.5 - o) * per_voxel);
                let (enter, leave) = if one < other { (one, other) } else { (other, one) };
                let outside = (o < -0.5) | (o > last[a] + 0.5);
                let enter = if parallel { if outside { NEVER } else { -NEVER } } else { enter };
                let leave = if parallel { NEVER } else { leave };
                self.near[l] = if enter > self.near[l] { enter } else { self.near[l] };
                self.far[l] = if leave < self.far[l] { leave } else { self.far[l] };
            }
        }
    }
}
