//! Trilinear sampling of the volume at continuous indices, in the volume's own precision.

use glam::DVec3;

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
    #[inline(always)]
    pub fn trilinear<T: Voxel>(&self, voxels: &[T], p: DVec3) -> f32 {
        let p = p.to_array();
        let mut offset = 0;
        let mut weight = [0.0; 3];
        let mut inside = true;
        for a in 0..3 {
            inside &= (p[a] >= -0.5) & (p[a] <= self.last[a] + 0.5);
            let clamped = p[a].max(0.0).min(self.last[a]);
            let low = (clamped as usize).min(self.low[a]);
            weight[a] = clamped - low as f64;
            offset += low * self.strides[a];
        }
        if !inside {
            return f32::NAN;
        }
        let [wi, wj, wk] = weight.map(T::Real::from_weight);
        let [si, sj, sk] = self.step;
        let line = |o: usize| {
            let (near, far) = (voxels[o].real(), voxels[o + si].real());
            near + (far - near) * wi
        };
        let plane = |o: usize| {
            let (near, far) = (line(o), line(o + sj));
            near + (far - near) * wj
        };
        let (near, far) = (plane(offset), plane(offset + sk));
        (near + (far - near) * wk).to_f32()
    }
}
