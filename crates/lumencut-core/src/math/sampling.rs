//! Trilinear sampling of the volume at continuous indices, in the volume's own precision.

use glam::DVec3;

use super::lanes::FAN;
use crate::volume::{Real, Volume, Voxel};

/// The grid of a volume, ready to find the voxels around a continuous index.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    /// The last index along (i, j, k).
    last: [f64; 3],
    /// The last index that has a neighbour above it, and the distance in elements to that neighbour; both 0
    /// along an axis with one voxel.
    low: [usize; 3],
    step: [usize; 3],
    strides: [usize; 3],
}

impl Grid {
    /// The grid of `volume`.
    pub fn new(volume: &Volume) -> Self {
        let (size, strides) = (volume.size(), volume.strides());
        Self {
            last: size.map(|n| (n - 1) as f64),
            low: size.map(|n| n.saturating_sub(2)),
            step: std::array::from_fn(|a| if size[a] > 1 { strides[a] } else { 0 }),
            strides,
        }
    }

    /// The voxels' value at continuous index `p`: NaN more than half a voxel beyond the outermost centres,
    /// the outermost voxels' within that half voxel.
    pub fn trilinear<T: Voxel>(&self, voxels: &[T], p: DVec3) -> f32 {
        self.trilinear_lanes(voxels, &p.to_array().map(|c| [c; FAN]))[0]
    }

    /// [`Grid::trilinear`] at sixteen indices, given axis by axis.
    #[inline(always)]
    pub fn trilinear_lanes<T: Voxel>(&self, voxels: &[T], p: &[[f64; FAN]; 3]) -> [f32; FAN] {
        let mut offset = [0; FAN];
        let mut weight = [[0.0; FAN]; 3];
        let mut outside = [false; FAN];
        for a in 0..3 {
            let (last, low, stride) = (self.last[a], self.low[a] as i32, self.strides[a]);
            for l in 0..FAN {
                let c = p[a][l];
                outside[l] |= (c < -0.5) | (c > last + 0.5);
                let c = if c > 0.0 { c } else { 0.0 };
                let c = if c < last { c } else { last };
                let floor = (c as i32).min(low);
                weight[a][l] = c - f64::from(floor);
                offset[l] += floor as usize * stride;
            }
        }
        let corners = self.corners(voxels, &offset);
        let mut value = [0.0; FAN];
        for l in 0..FAN {
            let [wi, wj, wk] = [0, 1, 2].map(|a| T::Real::from_weight(weight[a][l]));
            let line = |c: usize| corners[c][l] + (corners[c + 1][l] - corners[c][l]) * wi;
            let plane = |c: usize| line(c) + (line(c + 2) - line(c)) * wj;
            let (near, far) = (plane(0), plane(4));
            let inside = (near + (far - near) * wk).to_f32();
            value[l] = if outside[l] { f32::NAN } else { inside };
        }
        value
    }

    /// The eight voxels around each of sixteen indices, i fastest.
    #[inline(always)]
    fn corners<T: Voxel>(&self, voxels: &[T], offset: &[usize; FAN]) -> [[T::Real; FAN]; 8] {
        let [si, sj, sk] = self.step;
        let steps = [0, si, sj, si + sj, sk, si + sk, sj + sk, si + sj + sk];
        let mut corners = [[T::Real::from_weight(0.0); FAN]; 8];
        for l in 0..FAN {
            for (corner, step) in corners.iter_mut().zip(steps) {
                corner[l] = voxels[offset[l] + step].real();
            }
        }
        corners
    }
}
