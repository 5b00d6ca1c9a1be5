//! The lumen in a plane across the line: its wall on each ray, and the circle that fits best.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::trace::lumen::lumen_model::LumenModel;
use crate::voxels::Voxels;

/// The value outside the wall is searched up to this distance beyond it (mm).
const OUTSIDE: f64 = 1.5;

/// Maximum radius of a lumen (mm).
pub(crate) const WIDEST: f64 = 45.0;

/// Smaller eigenvalue of the directions' covariance if only two sides show a wall, and if three quarters show one.
const TWO_SIDED: f64 = 0.25;
const ROUND: f64 = 0.38;

/// Minimum fraction of the rays that must meet a wall.
const LEAST_SEEN: f64 = 0.375;

/// The lumen in a plane around a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LumenSection {
    /// Centre (mm, LPS).
    pub center: DVec3,
    /// Radius (mm).
    pub radius: f64,
    /// Quality of the section, 0 to 1.
    pub(crate) trust: f64,
    /// Median of the values near the centre.
    pub value: f64,
    /// Fraction of the wall that is brighter than the lumen, as at bone and stents.
    pub bright: f64,
}

/// The volume and the lumen model with which cross-sections are fitted.
pub struct Probe<'a, 'v> {
    /// The volume in which sections are fitted.
    pub voxels: &'a Voxels<'v>,
    /// The values of lumen and tissue.
    pub model: &'a LumenModel,
    /// Number of rays of a section.
    pub rays: usize,
    /// Fraction of the contrast by which values fall at a wall.
    pub fall: f64,
}

/// Fall of the values at the wall of a lumen in tissue.
pub const HALF: f64 = 0.5;

impl Probe<'_, '_> {
    /// Lumen around `center` in the plane spanned by two directions; `guess` is its approximate radius (mm).
    pub fn look(&self, center: DVec3, across: [DVec3; 2], guess: Option<f64>) -> Option<LumenSection> {
        let step = self.step(guess);
        let lumen = self.local_lumen(center, across, guess)?;
        let reach = guess.map_or(WIDEST, |radius| (2.5 * radius + 2.0).min(WIDEST));
        let (mut wall, mut bright) = (Vec::with_capacity(self.rays), 0);
        for n in 0..self.rays {
            let (sin, cos) = (TAU * n as f64 / self.rays as f64).sin_cos();
            let direction = across[0] * cos + across[1] * sin;
            if let Some((length, is_bright)) = self.wall(center, direction, lumen, step, reach) {
                wall.push([length * cos, length * sin]);
                bright += usize::from(is_bright);
            }
        }
        let seen = wall.len() as f64 / self.rays as f64;
        if seen < LEAST_SEEN {
            return None;
        }
        let circle = Circle::around(&wall);
        let roughness = circle.spread / circle.radius;
        let trust = seen * (-(roughness / 0.25).powi(2)).exp() * circle.roundness(&wall);
        let [x, y] = circle.center;
        let is_odd = !(trust > 0.0 && circle.radius > 0.0) || x.hypot(y) > reach;
        (!is_odd).then(|| LumenSection {
            center: center + across[0] * x + across[1] * y,
            radius: circle.radius,
            trust,
            value: lumen,
            bright: bright as f64 / wall.len() as f64,
        })
    }

    /// Wall-to-wall distance along a direction (mm), up to `reach` mm on each side; None if a wall is missing.
    pub fn chord(&self, place: DVec3, direction: DVec3, reach: f64) -> Option<f64> {
        let lumen = f64::from(self.voxels.at(place));
        let side = |way| self.wall(place, way, lumen, self.step(None), reach).map(|(length, _)| length);
        Some(side(direction)? + side(-direction)?)
    }

    fn step(&self, guess: Option<f64>) -> f64 {
        let fine = 0.3 * self.voxels.smallest_side;
        guess.map_or(fine.max(0.15), |radius| fine.max(radius / 40.0)).clamp(0.03, 0.5)
    }

    /// Lumen value around `center`; None if `center` is not in lumen.
    fn local_lumen(&self, center: DVec3, across: [DVec3; 2], guess: Option<f64>) -> Option<f64> {
        let near = guess.map_or(0.0, |radius| 0.35 * radius).max(0.35 * self.voxels.smallest_side);
        let mut values = vec![self.voxels.at(center)];
        for n in 0..16 {
            let (sin, cos) = (TAU * f64::from(n) / 8.0).sin_cos();
            let length = if n < 8 { near } else { 0.5 * near };
            values.push(self.voxels.at(center + (across[0] * cos + across[1] * sin) * length));
        }
        values.sort_unstable_by(f32::total_cmp);
        let median = values[values.len() / 2];
        let is_lumen = f64::from(median) > self.model.tissue + 0.35 * self.model.contrast()
            && self.model.membership(median) > 0.3;
        is_lumen.then_some(f64::from(median))
    }

    /// Distance to the wall, and whether the outside is brighter. The wall is midway between the values of
    /// lumen and outside.
    fn wall(
        &self,
        center: DVec3,
        direction: DVec3,
        lumen: f64,
        step: f64,
        reach: f64,
    ) -> Option<(f64, bool)> {
        let start = self.voxels.index_from_world.transform_point3(center);
        let stride = self.voxels.index_from_world.transform_vector3(direction) * step;
        let mut ray = Ray::new(self.voxels, start, stride);
        let contrast = lumen - self.model.tissue;
        let dark = lumen - self.fall * contrast;
        let bright = lumen + (0.5 * contrast).max(4.0 * self.model.noise);
        // Two samples outside the range mean that the ray has left the lumen. NaN (outside the volume) counts
        // as outside.
        let leaves = |v: f64| !(v >= dark && v <= bright);
        let last = (reach / step) as usize;
        let out = (1..=last).find(|n| leaves(ray.value(*n)) && leaves(ray.value(n - 1)))? - 1;
        let edge = ray.value(out);
        if edge.is_nan() {
            return None;
        }
        let beyond = out + (OUTSIDE / step).ceil() as usize;
        let is_dark = edge < dark;
        let outside = ray.extreme(out, beyond, is_dark);
        let half = f64::midpoint(lumen, outside);
        let is_out = |v: f64| if is_dark { v < half } else { v > half };
        // Finds the last sample inside the lumen and the first one outside.
        let mut n = (0..=out).rev().find(|n| !is_out(ray.value(*n)))?;
        while n < beyond && !is_out(ray.value(n + 1)) {
            n += 1;
        }
        let (inside, outside) = (ray.value(n), ray.value(n + 1));
        let share =
            if outside == inside { 0.5 } else { ((half - inside) / (outside - inside)).clamp(0.0, 1.0) };
        share.is_finite().then_some(((n as f64 + share) * step, !is_dark))
    }
}

struct Circle {
    center: [f64; 2],
    radius: f64,
    /// Robust standard deviation of the distances of the points to the circle.
    spread: f64,
}

impl Circle {
    /// Circle fitted with Tukey's weights, so that a branch or a neighbour does not shift it.
    fn around(points: &[[f64; 2]]) -> Self {
        let count = points.len() as f64;
        let mean = [0, 1].map(|a| points.iter().map(|p| p[a]).sum::<f64>() / count);
        let mut lengths: Vec<f64> = points.iter().map(|p| (p[0] - mean[0]).hypot(p[1] - mean[1])).collect();
        lengths.sort_unstable_by(f64::total_cmp);
        let mut circle = Self { center: mean, radius: lengths[lengths.len() / 2], spread: 0.0 };
        for _ in 0..8 {
            circle.spread = circle.spread_of(points);
            circle.step(points);
        }
        circle
    }

    fn miss(&self, p: [f64; 2]) -> f64 {
        (p[0] - self.center[0]).hypot(p[1] - self.center[1]) - self.radius
    }

    fn spread_of(&self, points: &[[f64; 2]]) -> f64 {
        let mut away: Vec<f64> = points.iter().map(|p| self.miss(*p).abs()).collect();
        away.sort_unstable_by(f64::total_cmp);
        1.4826 * away[away.len() / 2]
    }

    /// Degree (0 to 1) to which wall points lie on all sides. A vessel that is cut lengthwise shows only two sides.
    fn roundness(&self, points: &[[f64; 2]]) -> f64 {
        let [mut xx, mut xy, mut yy, mut all] = [0.0; 4];
        for p in points {
            let weight = self.weight(self.miss(*p));
            let (x, y) = (p[0] - self.center[0], p[1] - self.center[1]);
            let share = weight / (x * x + y * y).max(1e-12);
            xx += share * x * x;
            xy += share * x * y;
            yy += share * y * y;
            all += weight;
        }
        let least = 0.5 * (xx + yy - (xx - yy).hypot(2.0 * xy)) / all.max(1e-12);
        ((least - TWO_SIDED) / (ROUND - TWO_SIDED)).clamp(0.0, 1.0)
    }

    fn weight(&self, miss: f64) -> f64 {
        let scale = 4.0 * self.spread.max(0.03 * self.radius).max(1e-6);
        let share = (miss / scale).abs().min(1.0);
        (1.0 - share * share).powi(2)
    }

    fn step(&mut self, points: &[[f64; 2]]) {
        let (mut matrix, mut right) = (glam::DMat3::ZERO, DVec3::ZERO);
        for p in points {
            let miss = self.miss(*p);
            let weight = self.weight(miss);
            let length = (miss + self.radius).max(1e-9);
            let slope = DVec3::new((p[0] - self.center[0]) / length, (p[1] - self.center[1]) / length, 1.0);
            matrix += glam::DMat3::from_cols(slope * slope.x, slope * slope.y, slope * slope.z) * weight;
            right += slope * (miss * weight);
        }
        if matrix.determinant() > 1e-9 {
            let change = matrix.inverse() * right;
            self.center[0] += change.x;
            self.center[1] += change.y;
            self.radius += change.z;
        }
    }
}

/// Values along a ray, sampled on demand.
pub(crate) struct Ray<'a, 'v> {
    voxels: &'a Voxels<'v>,
    start: DVec3,
    stride: DVec3,
    values: Vec<f32>,
}

impl<'a, 'v> Ray<'a, 'v> {
    /// `start` and `stride` are in voxel index coordinates.
    pub(crate) fn new(voxels: &'a Voxels<'v>, start: DVec3, stride: DVec3) -> Self {
        Self { voxels, start, stride, values: Vec::with_capacity(64) }
    }

    pub(crate) fn value(&mut self, n: usize) -> f64 {
        while n >= self.values.len() {
            self.voxels.along(self.start, self.stride, &mut self.values);
        }
        f64::from(self.values[n])
    }

    pub(crate) fn extreme(&mut self, first: usize, last: usize, is_dark: bool) -> f64 {
        self.value(last);
        let finite = self.values[first..=last].iter().map(|v| f64::from(*v)).filter(|v| v.is_finite());
        if is_dark { finite.fold(f64::MAX, f64::min) } else { finite.fold(f64::MIN, f64::max) }
    }
}
