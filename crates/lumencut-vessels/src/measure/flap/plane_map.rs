//! Values in the plane of a section, on a square grid around the centerline.

use glam::DVec2;

use crate::measure::outer::polar_map::PLANES;
use crate::measure::section::SectionPlane;
use crate::voxels::Voxels;

/// A square of `count` × `count` values; the middle one lies on the centerline.
#[derive(Clone, Debug)]
pub(crate) struct PlaneMap {
    /// Distance of neighbouring values (mm).
    pub step: f64,
    pub count: usize,
    pub values: Vec<f64>,
    /// Which values lie outside the volume.
    is_outside: Vec<bool>,
}

impl PlaneMap {
    /// Reads the values up to `reach` mm from the centerline, `step` mm apart. Those above `most`, and those outside the
    /// volume, become `most`.
    pub(crate) fn read(voxels: &Voxels, place: &SectionPlane, [reach, step]: [f64; 2], most: f64) -> Self {
        let half = (reach / step).ceil() as usize;
        let count = 2 * half + 1;
        let mut map = Self::empty(step, count);
        let stride = voxels.index_from_world.transform_vector3(place.axes[0] * step);
        let mut read = Vec::with_capacity(count + 16);
        for j in 0..count {
            let first = place.point(map.place(j * count));
            for (plane, weight) in PLANES {
                let start = first + place.normal * (plane * voxels.sampling_side);
                read.clear();
                while read.len() < count {
                    voxels.along(voxels.index_from_world.transform_point3(start), stride, &mut read);
                }
                for (n, value) in (j * count..).zip(&read[..count]) {
                    let value = f64::from(*value);
                    map.values[n] += weight * if value < most { value } else { most };
                    map.is_outside[n] |= value.is_nan();
                }
            }
        }
        map
    }

    pub(super) fn empty(step: f64, count: usize) -> Self {
        Self { step, count, values: vec![0.0; count * count], is_outside: vec![false; count * count] }
    }

    /// Coordinates in the plane (mm) of value number `n`.
    pub(crate) fn place(&self, n: usize) -> DVec2 {
        let half = (self.count / 2) as f64;
        DVec2::new((n % self.count) as f64 - half, (n / self.count) as f64 - half) * self.step
    }

    /// Number of the value nearest to a place (mm); None outside the map.
    pub(crate) fn nearest(&self, place: DVec2) -> Option<usize> {
        let at = (place / self.step).round() + DVec2::splat((self.count / 2) as f64);
        let is_inside = |x: f64| x >= 0.0 && x < self.count as f64;
        (is_inside(at.x) && is_inside(at.y)).then(|| at.y as usize * self.count + at.x as usize)
    }

    /// Whether a place (mm) lies in the map and in the volume.
    pub(crate) fn holds(&self, place: DVec2) -> bool {
        self.nearest(place).is_some_and(|n| !self.is_outside[n])
    }

    /// Value at a place (mm), interpolated; at the border that of the border.
    pub(crate) fn at(&self, place: DVec2) -> f64 {
        let last = self.count as f64 - 1.001;
        let at = (place / self.step + DVec2::splat((self.count / 2) as f64))
            .clamp(DVec2::ZERO, DVec2::splat(last));
        let (low, share) = (at.floor(), at.fract());
        let n = low.y as usize * self.count + low.x as usize;
        let row = |n: usize| self.values[n] * (1.0 - share.x) + self.values[n + 1] * share.x;
        row(n) * (1.0 - share.y) + row(n + self.count) * share.y
    }

    /// The map smoothed by a Gaussian with this standard deviation (mm).
    pub(crate) fn smoothed(&self, deviation: f64) -> Self {
        let deviation = deviation / self.step;
        let reach = (3.0 * deviation).ceil() as isize;
        let weights: Vec<f64> =
            (-reach..=reach).map(|n| (-0.5 * (n as f64 / deviation).powi(2)).exp()).collect();
        let all: f64 = weights.iter().sum();
        let last = self.count as isize - 1;
        let pass = |values: &[f64], along: usize, across: usize| -> Vec<f64> {
            let mut smooth = vec![0.0; values.len()];
            for line in 0..self.count {
                for n in 0..self.count {
                    let value = |m: usize| {
                        let k = (n as isize + m as isize - reach).clamp(0, last) as usize;
                        values[line * across + k * along]
                    };
                    let sum: f64 = weights.iter().enumerate().map(|(m, weight)| weight * value(m)).sum();
                    smooth[line * across + n * along] = sum / all;
                }
            }
            smooth
        };
        let rows = pass(&self.values, 1, self.count);
        Self { values: pass(&rows, self.count, 1), ..self.clone() }
    }

    /// The largest second derivative in any direction (per mm²): positive along dark sheets; 0 at the border.
    pub(crate) fn sheets(&self) -> Vec<f64> {
        let count = self.count;
        let mut found = vec![0.0; count * count];
        for j in 1..count - 1 {
            for i in 1..count - 1 {
                let at = |x: usize, y: usize| self.values[(j + y - 1) * count + i + x - 1];
                let middle = 2.0 * at(1, 1);
                let (xx, yy) = (at(0, 1) + at(2, 1) - middle, at(1, 0) + at(1, 2) - middle);
                let xy = 0.25 * (at(0, 0) + at(2, 2) - at(0, 2) - at(2, 0));
                found[j * count + i] =
                    (0.5 * (xx + yy) + (0.5 * (xx - yy)).hypot(xy)) / (self.step * self.step);
            }
        }
        found
    }
}
