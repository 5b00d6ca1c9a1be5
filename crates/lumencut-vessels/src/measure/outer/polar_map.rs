//! Values around a point of a section, by direction and distance.

use std::f64::consts::TAU;

use glam::DVec2;

use crate::measure::section::SectionPlane;
use crate::measure::section::rays::{RAYS, direction};
use crate::voxels::Voxels;

/// Distance of the samples on a ray, in units of [`Voxels::sampling_side`].
const STEP: f64 = 0.4;

/// Weights of the planes one voxel before, at, and behind the section.
pub(crate) const PLANES: [(f64, f64); 3] = [(-1.0, 0.25), (0.0, 0.5), (1.0, 0.25)];

/// Standard deviation of the smoothing along a ray (blur widths; at least this many samples), and across rays (mm; at
/// most this many rays).
const ALONG: (f64, f64) = (0.35, 0.5);
const ACROSS: (f64, f64) = (1.2, 6.0);

/// Values on [`RAYS`] rays.
#[derive(Clone, Debug)]
pub(crate) struct PolarMap {
    /// Distance of the samples (mm).
    pub step: f64,
    /// Number of samples of a ray.
    pub count: usize,
    values: Vec<f64>,
}

impl PolarMap {
    /// Reads the values within `reach` mm around `center`. Those above `most`, and those outside the volume, become `most`.
    pub(crate) fn read(
        voxels: &Voxels,
        place: &SectionPlane,
        (center, reach): (DVec2, f64),
        most: f64,
    ) -> Self {
        let step = STEP * voxels.sampling_side;
        let count = (reach / step).ceil() as usize + 1;
        let mut values = vec![0.0; RAYS * count];
        let mut read = Vec::with_capacity(count + 16);
        for (ray, row) in values.chunks_exact_mut(count).enumerate() {
            let stride = place.point(direction(ray)) - place.origin;
            let stride = voxels.index_from_world.transform_vector3(stride * step);
            for (plane, weight) in PLANES {
                let start = place.point(center) + place.normal * (plane * voxels.sampling_side);
                let start = voxels.index_from_world.transform_point3(start);
                read.clear();
                while read.len() < count {
                    voxels.along(start, stride, &mut read);
                }
                for (sum, value) in row.iter_mut().zip(&read) {
                    let value = f64::from(*value);
                    *sum += weight * if value < most { value } else { most };
                }
            }
        }
        Self { step, count, values }
    }

    /// The values of a ray.
    pub(crate) fn ray(&self, ray: usize) -> &[f64] {
        &self.values[ray * self.count..][..self.count]
    }

    /// The map smoothed for a blur of `width` mm, and the standard deviation of the smoothing along rays (mm).
    pub(crate) fn smoothed(&self, width: f64) -> (Self, f64) {
        let deviation = (ALONG.0 * width / self.step).max(ALONG.1);
        let mut along = self.clone();
        for (ray, row) in along.values.chunks_exact_mut(self.count).enumerate() {
            let last = self.count as i32 - 1;
            let value = |n: i32| self.ray(ray)[n.clamp(0, last) as usize];
            smooth(row, deviation, value);
        }
        let mut both = along.clone();
        let mut column = vec![0.0; RAYS];
        for n in 0..self.count {
            let apart = (n.max(1) as f64 * self.step) * TAU / RAYS as f64;
            let value = |ray: i32| along.values[ray.rem_euclid(RAYS as i32) as usize * self.count + n];
            smooth(&mut column, (ACROSS.0 / apart).min(ACROSS.1), value);
            for (ray, value) in column.iter().enumerate() {
                both.values[ray * self.count + n] = *value;
            }
        }
        (both, deviation * self.step)
    }
}

/// Fills `smoothed` with the values smoothed by a Gaussian (standard deviation in samples).
fn smooth(smoothed: &mut [f64], deviation: f64, value: impl Fn(i32) -> f64) {
    let reach = (3.0 * deviation).ceil() as i32;
    let weights: Vec<f64> =
        (-reach..=reach).map(|n| (-0.5 * (f64::from(n) / deviation).powi(2)).exp()).collect();
    let all: f64 = weights.iter().sum();
    for (n, place) in smoothed.iter_mut().enumerate() {
        let sum: f64 =
            weights.iter().enumerate().map(|(m, weight)| weight * value(n as i32 + m as i32 - reach)).sum();
        *place = sum / all;
    }
}
