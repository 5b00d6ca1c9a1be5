//! Smoothed centerlines: each vessel is averaged along its arc length by a Gaussian whose σ is a multiple of its
//! radius. The average is over the polyline, not its points, so their spacing does not matter. Beyond the ends of a
//! run between two fixed points the curve continues by point reflection, p(−s) = 2·p(0) − p(s). So these ends stay
//! fixed and straight runs stay straight.

use glam::DVec3;
use rayon::prelude::*;

use crate::math::position_map::PositionMap;
use crate::math::same_place::VESSEL_END;
use crate::vessel_tree::{MAX_COORDINATE, Vessel, VesselTree};

/// Number of box layers that approximate the Gaussian.
const LAYERS: usize = 16;

const CUT_OFF_SIGMAS: f64 = 4.0;

/// `tree` with centerlines smoothed by a Gaussian whose σ at each point is `radii` times the radius there. Ends,
/// points where another vessel ends, and points of unknown or zero radius stay bit-identical. Radii and the number
/// and order of points do not change.
pub fn smooth_centerlines(tree: &VesselTree, radii: f64) -> VesselTree {
    if radii <= 0.0 {
        return tree.clone();
    }
    let (ends, layers) = (ends_of(tree), gaussian());
    let smoothed = tree.vessels().par_iter().map(|vessel| smooth(vessel, radii, &ends, &layers));
    VesselTree::from_checked(smoothed.collect())
}

fn smooth(vessel: &Vessel, radii: f64, ends: &PositionMap<()>, layers: &[Layer]) -> Vessel {
    let Some(radius) = vessel.radius() else { return vessel.clone() };
    let (points, last) = (vessel.points(), vessel.points().len() - 1);
    let mut smoothed = points.to_vec();
    let mut start = 0;
    for end in (1..=last).filter(|&i| i == last || ends.at(points[i]).is_some()) {
        let stretch = FixedRun::new(&points[start..=end]);
        for i in start + 1..end {
            let sigma = radii * radius[i];
            // With σ below `VESSEL_END`, the point does not move.
            if sigma >= VESSEL_END {
                smoothed[i] = stretch.mean(i - start, sigma, layers);
            }
        }
        start = end;
    }
    Vessel::from_checked(smoothed, Some(radius.to_vec()))
}

/// One of the boxes that add up to the Gaussian with σ = 1: `height` high from −`reach` to `reach`.
#[derive(Clone, Copy, Debug)]
struct Layer {
    reach: f64,
    height: f64,
}

/// The Gaussian as a sum of boxes, with an integral of 1 and a variance of 1.
fn gaussian() -> [Layer; LAYERS] {
    let step = CUT_OFF_SIGMAS / LAYERS as f64;
    // The density in the middle of each step; beyond the last one it is 0.
    let density = |k: usize| if k < LAYERS { (-0.5 * ((k as f64 + 0.5) * step).powi(2)).exp() } else { 0.0 };
    let layers: [Layer; LAYERS] =
        std::array::from_fn(|k| Layer { reach: (k + 1) as f64 * step, height: density(k) - density(k + 1) });
    let integral: f64 = layers.iter().map(|l| 2.0 * l.reach * l.height).sum();
    let variance: f64 = layers.iter().map(|l| 2.0 * l.reach.powi(3) / 3.0 * l.height).sum::<f64>() / integral;
    let scale = variance.sqrt();
    layers.map(|l| Layer { reach: l.reach / scale, height: l.height * scale / integral })
}

/// A polyline between two fixed points, as its chord and the offset from the chord.
struct FixedRun<'a> {
    points: &'a [DVec3],
    arc: Vec<f64>,
    /// The offset of each point from the point of the chord at the same share of the length.
    offset: Vec<DVec3>,
    /// Half of the change of the offset along each segment (per mm).
    half_slope: Vec<DVec3>,
    /// The integral of the offset from the start to each point, over arc length.
    integral: Vec<DVec3>,
}

impl<'a> FixedRun<'a> {
    fn new(points: &'a [DVec3]) -> Self {
        let count = points.len();
        let (zeros, mut arc) = (vec![DVec3::ZERO; count], vec![0.0; count]);
        // Arc length is summed from the run's start, with the same bits as for a vessel that begins here.
        for i in 1..count {
            arc[i] = arc[i - 1] + points[i].distance(points[i - 1]);
        }
        let mut made = Self { points, arc, offset: Vec::new(), half_slope: zeros.clone(), integral: zeros };
        made.offset = (0..count).map(|i| points[i] - made.chord(i)).collect();
        for i in 1..count {
            let (length, [from, to]) = (made.arc[i] - made.arc[i - 1], [made.offset[i - 1], made.offset[i]]);
            if length > 0.0 {
                made.half_slope[i - 1] = (to - from) / (2.0 * length);
            }
            made.integral[i] = made.integral[i - 1] + (from + to) * (0.5 * length);
        }
        made
    }

    fn length(&self) -> f64 {
        self.arc[self.arc.len() - 1]
    }

    fn chord(&self, i: usize) -> DVec3 {
        let share = if self.length() > 0.0 { self.arc[i] / self.length() } else { 0.0 };
        self.points[0].lerp(self.points[self.points.len() - 1], share)
    }

    /// The mean around point `i`: the chord's point, as layers are symmetric, plus the mean of the offset.
    fn mean(&self, i: usize, sigma: f64, layers: &[Layer]) -> DVec3 {
        if self.length() <= 0.0 {
            return self.points[i];
        }
        let (s, mut before, mut after) = (self.arc[i], i - 1, i);
        let mut mean = DVec3::ZERO;
        for layer in layers {
            let reach = layer.reach * sigma;
            let there = self.integral_to(s + reach, &mut after) - self.integral_to(s - reach, &mut before);
            mean += there * (layer.height / sigma);
        }
        let bound = DVec3::splat(MAX_COORDINATE);
        (self.chord(i) + mean).clamp(-bound, bound)
    }

    /// The integral of the offset from the start to arc length `s`, symmetric about both ends by reflection.
    /// The search for the segment starts at `segment`, which becomes the segment found.
    fn integral_to(&self, s: f64, segment: &mut usize) -> DVec3 {
        let s = folded(s, self.length());
        *segment = self.segment(s, *segment);
        let (j, along) = (*segment, s - self.arc[*segment]);
        self.integral[j] + (self.offset[j] + self.half_slope[j] * along) * along
    }

    /// The segment that contains arc length `s`, found from segment `near` by doubling steps.
    fn segment(&self, s: f64, near: usize) -> usize {
        let arc = &self.arc;
        let (mut low, mut high, mut step) = (near, near + 1, 1);
        while arc[low] > s {
            (high, low, step) = (low, low.saturating_sub(step), 2 * step);
        }
        while arc[high] < s {
            (low, high, step) = (high, (high + step).min(arc.len() - 1), 2 * step);
        }
        low + arc[low + 1..high].partition_point(|a| *a <= s)
    }
}

/// Reflects `s` at 0 and at `length`.
fn folded(s: f64, length: f64) -> f64 {
    let (s, turn) = (s.abs(), 2.0 * length);
    let s = if s > turn { s % turn } else { s };
    s.min(turn - s)
}

fn ends_of(tree: &VesselTree) -> PositionMap<()> {
    let mut ends = PositionMap::new(VESSEL_END);
    for points in tree.vessels().iter().map(Vessel::points) {
        for end in [points[0], points[points.len() - 1]] {
            ends.add(end, &());
        }
    }
    ends
}
