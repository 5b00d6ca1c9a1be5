//! The border of a layer of soft tissue around the lumen: on each ray, values fall from the level of the layer to that
//! of fat or lung. A closed path joins the rays, since on some of them muscle or another organ touches the layer.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use super::closed_path::closed_path;
use super::found::{Outer, OuterWall};
use super::outline::{area_and_middle, corners_at, exits, solidity};
use super::polar_map::PolarMap;
use crate::measure::section::SectionPlane;
use crate::measure::section::blur::variance_of;
use crate::measure::section::rays::{RAYS, direction};
use crate::voxels::Voxels;
use lumencut_core::math::statistics::median;

/// Level of fat before it is read (HU), and the range in which it lies.
const FAT: f64 = -95.0;
const FAT_RANGE: [f64; 2] = [-110.0, -60.0];

/// The layer is not brighter than its level plus this fraction of the contrast between lumen and layer.
const LAYER: f64 = 0.4;

/// The level found in a section differs from the expected one by at most this many standard deviations.
const EXPECTED: f64 = 2.0;

/// The border is searched up to this distance beyond the lumen, and from the centre (mm).
const REACH_MM: (f64, f64) = (40.0, 65.0);

/// Cost of a squared change of the distance between rays (per mm²), first from the centre of the lumen, which may lie
/// off the centre of the layer, then from that of the border.
const CHANGE: [f64; 4] = [0.1, 0.5, 1.5, 1.5];

/// Length (mm, or blur widths if larger) on both sides of the border on which it shows.
const SIDES: (f64, f64) = (1.5, 1.5);

/// Cost per mm of fat between lumen and border, and its maximum length (mm).
const FAT_COST: (f64, f64) = (0.25, 6.0);

/// The border lies at least this far beyond the lumen (mm).
const BEYOND_MM: f64 = 0.5;

/// A crossing lies at most this far from the path (mm).
const NEAR_MM: f64 = 2.5;

/// The level behind the border is read over this length (mm), a blur width away from it.
const BEHIND_MM: f64 = 2.0;

/// A border shows on a ray if its strength (0 to 1) exceeds this.
const SEEN: f64 = 0.45;

/// A layer is thick from this many mm, or blur widths if larger, on at least this fraction of the rays.
const THICK: (f64, f64, f64) = (2.25, 1.2, 0.5);

/// Minimum fraction of rays that show the border, and maximum number of neighbouring ones that do not.
const LEAST_SEEN: f64 = 0.6;
const LARGEST_GAP: usize = RAYS / 4;

/// Minimum [`solidity`]: the outline of a lumen with a layer has no dents where fat parts two structures.
const SOLID: f64 = 0.94;

/// Standard deviation of the radius by the levels (blur widths), and on rays that do not show the border (mm, and as a
/// fraction of the radius).
const LEVEL_ERROR: f64 = 0.08;
const GAP_ERROR: (f64, f64) = (0.5, 0.06);

/// Neighbouring rays share noise.
const SHARED_RAYS: f64 = 4.0;

/// Levels of lumen, layer and fat (HU).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Levels {
    lumen: f64,
    layer: f64,
    /// Range in which the level of the layer may lie.
    range: [f64; 2],
    fat: f64,
}

impl Levels {
    pub(crate) fn of(lumen: f64, [layer, deviation]: [f64; 2]) -> Self {
        Self { lumen, layer, range: [layer - EXPECTED * deviation, layer + EXPECTED * deviation], fat: FAT }
    }

    /// Value half way between layer and fat.
    fn half(&self) -> f64 {
        f64::midpoint(self.layer, self.fat)
    }

    fn is_layer(&self, value: f64) -> bool {
        value > self.half() && value < self.layer + LAYER * (self.lumen - self.layer)
    }
}

/// The search for a layer in one section.
#[derive(Clone, Copy)]
pub(crate) struct Layer<'a, 'v> {
    pub voxels: &'a Voxels<'v>,
    pub place: &'a SectionPlane,
    pub levels: Levels,
    /// FWHM of the blur in the section (mm).
    pub width: f64,
}

/// The border as one round found it.
struct Round {
    center: DVec2,
    /// Distances of the lumen and of the border from the centre (mm).
    inner: Vec<f64>,
    radii: Vec<f64>,
    is_seen: Vec<bool>,
    is_thick: Vec<bool>,
}

impl Layer<'_, '_> {
    /// The outer wall around a lumen; its absence with the reason otherwise.
    pub(crate) fn outer(mut self, contour: &[DVec3]) -> Result<Outer, OuterWall> {
        let flat = |point: &DVec3| {
            let [x, y, _] = self.place.coordinates(*point - self.place.origin);
            DVec2::new(x, y)
        };
        let lumen: Vec<DVec2> = contour.iter().map(flat).collect();
        let (_, mut center) = area_and_middle(&lumen).ok_or(OuterWall::NotCounted)?;
        if !self.may_be_thick(&lumen, center) {
            return Err(OuterWall::Thin);
        }
        let mut found = None;
        for change in CHANGE {
            let round = self.round(&lumen, center, change);
            (_, center) =
                area_and_middle(&corners_at(round.center, &round.radii)).ok_or(OuterWall::Hidden)?;
            found = Some(round);
        }
        self.judged(&found.ok_or(OuterWall::Hidden)?)
    }

    /// Thickness (mm) from which a layer is thick.
    fn thick(&self) -> f64 {
        THICK.0.max(THICK.1 * self.width)
    }

    /// Whether values at the distance of a thick layer let one expect it, which saves the search in other sections.
    fn may_be_thick(&self, lumen: &[DVec2], center: DVec2) -> bool {
        let exits = exits(lumen, center);
        let is_layer = |ray: usize| {
            let at = |beyond: f64| {
                let point = center + direction(ray) * (exits[ray] + beyond);
                f64::from(self.voxels.at(self.place.point(point)))
            };
            let step = 0.25 * self.thick();
            let mean = (0..3).map(|n| at(self.thick() - f64::from(n) * step)).sum::<f64>() / 3.0;
            mean > self.levels.half()
        };
        (0..RAYS).filter(|ray| is_layer(*ray)).count() as f64 >= THICK.2 * RAYS as f64
    }

    fn round(&mut self, lumen: &[DVec2], center: DVec2, change: f64) -> Round {
        let inner = exits(lumen, center);
        let reach = inner.iter().copied().fold(0.0, f64::max) + REACH_MM.0;
        let map = PolarMap::read(self.voxels, self.place, (center, reach.min(REACH_MM.1)), self.levels.lumen);
        let (smooth, smoothing) = map.smoothed(self.width);
        let strengths: Vec<Strength> =
            (0..RAYS).map(|ray| self.strength(smooth.ray(ray), inner[ray], map.step)).collect();
        let costs: Vec<f64> = strengths.iter().flat_map(|one| one.costs.iter().copied()).collect();
        let path = closed_path(&costs, map.count, change * map.step * map.step);
        let edge = |ray: usize| {
            (strengths[ray].seen[path[ray]] > SEEN).then_some(())?;
            let crossing = self.crossing(smooth.ray(ray), path[ray], map.step)?;
            Some(self.without_lumen(crossing, inner[ray], smoothing))
        };
        let edges: Vec<Option<f64>> = (0..RAYS).map(edge).collect();
        let drawn: Vec<f64> = path.iter().map(|n| *n as f64 * map.step).collect();
        let radii = filled(&edges, &drawn);
        let of_layer = |ray: usize| {
            let values = smooth.ray(ray).iter().enumerate();
            let within = values.filter(|(n, _)| (inner[ray]..radii[ray]).contains(&(*n as f64 * map.step)));
            within.filter(|(_, value)| self.levels.is_layer(**value)).count() as f64 * map.step
        };
        let is_thick = |ray: usize| {
            let layer = of_layer(ray) + 0.5 * self.width;
            layer.min(radii[ray] - inner[ray]) >= self.thick()
        };
        let is_thick = (0..RAYS).map(is_thick).collect();
        self.levels.layer = self.level(&map, &inner, &radii);
        self.levels.fat = self.fat(&map, &edges);
        Round { center, inner, radii, is_seen: edges.iter().map(Option::is_some).collect(), is_thick }
    }

    /// How clearly each sample of a ray shows the border, and its cost.
    fn strength(&self, values: &[f64], inner: f64, step: f64) -> Strength {
        let half = self.levels.half();
        // 1 in the layer and in anything brighter, -1 in fat.
        let signs: Vec<f64> = values
            .iter()
            .map(|value| ((value - half) / (0.5 * (self.levels.layer - self.levels.fat))).clamp(-1.0, 1.0))
            .collect();
        let mut sums = vec![0.0];
        for sign in &signs {
            sums.push(sums[sums.len() - 1] + sign);
        }
        let side = (SIDES.0.max(SIDES.1 * self.width) / step).round().max(1.0) as usize;
        let mean = |from: usize, to: usize| (sums[to] - sums[from]) / (to - from).max(1) as f64;
        let mut fat = 0.0;
        let mut strength = Strength { seen: Vec::new(), costs: Vec::new() };
        for n in 0..values.len() {
            let beyond = n as f64 * step - inner;
            if signs[n] < 0.0 && beyond > 0.7 * self.width {
                fat += step;
            }
            let edge = mean(n.saturating_sub(side), n) - mean(n, (n + side).min(values.len()));
            let edge = (0.5 * edge).clamp(0.0, 1.0);
            let crossed = FAT_COST.0 * f64::min(fat, FAT_COST.1);
            strength.seen.push(edge - crossed);
            strength.costs.push(if beyond < BEYOND_MM { FAT_COST.1 } else { crossed - edge });
        }
        strength
    }

    /// Distance (mm) at which a ray falls half way to the level that it has behind the border, near sample `at`.
    fn crossing(&self, values: &[f64], at: usize, step: f64) -> Option<f64> {
        let samples = |mm: f64| (mm / step).round() as usize;
        let behind = (at + samples(self.width)).min(values.len())
            ..(at + samples(self.width + BEHIND_MM) + 1).min(values.len());
        // Lung is darker than fat, so half way lies farther out.
        let outside = median(&mut values[behind].to_vec())?.min(self.levels.fat);
        let half = f64::midpoint(self.levels.layer, outside);
        let near = at.saturating_sub(samples(NEAR_MM)).max(1)..(at + samples(NEAR_MM)).min(values.len());
        let falls = near.filter(|n| values[n - 1] >= half && values[*n] < half);
        let n = falls.min_by_key(|n| n.abs_diff(at))?;
        Some(step * (n as f64 - (half - values[n]) / (values[n - 1] - values[n])))
    }

    /// Corrects a crossing for the blur of the lumen, which lifts the values at a thin part of the layer.
    fn without_lumen(&self, crossing: f64, inner: f64, smoothing: f64) -> f64 {
        let deviation = variance_of(self.width).sqrt().hypot(smoothing);
        let lifted = (self.levels.lumen - self.levels.layer) * within((inner - crossing) / deviation);
        let half = 0.5 * (self.levels.layer - self.levels.fat);
        let (mut low, mut high) = (inner.min(crossing), crossing);
        for _ in 0..24 {
            let middle = f64::midpoint(low, high);
            let value = 2.0 * half * within((middle - crossing) / deviation) + lifted;
            if value > half { high = middle } else { low = middle }
        }
        high
    }

    /// The level of the layer, from its values away from lumen and border.
    fn level(&self, map: &PolarMap, inner: &[f64], radii: &[f64]) -> f64 {
        let mut values = Vec::new();
        for ray in 0..RAYS {
            let within = inner[ray] + 1.5 * self.width..radii[ray] - self.width;
            let found = map.ray(ray).iter().enumerate();
            let found = found.filter(|(n, _)| within.contains(&(*n as f64 * map.step)));
            values.extend(found.map(|(_, value)| *value).filter(|value| self.levels.is_layer(*value)));
        }
        let found = median(&mut values).unwrap_or(self.levels.layer);
        found.clamp(self.levels.range[0], self.levels.range[1])
    }

    /// The level of what lies behind the border on the rays that show it.
    fn fat(&self, map: &PolarMap, edges: &[Option<f64>]) -> f64 {
        let mut values = Vec::new();
        for (ray, edge) in edges.iter().enumerate() {
            let Some(edge) = edge else { continue };
            let behind = edge + self.width..edge + self.width + BEHIND_MM;
            let found = map.ray(ray).iter().enumerate();
            values.extend(
                found.filter(|(n, _)| behind.contains(&(*n as f64 * map.step))).map(|(_, value)| *value),
            );
        }
        median(&mut values).unwrap_or(FAT).clamp(FAT_RANGE[0], FAT_RANGE[1])
    }

    fn judged(&self, round: &Round) -> Result<Outer, OuterWall> {
        let Round { center, radii, is_seen, .. } = round;
        let share =
            |is: &dyn Fn(usize) -> bool| (0..RAYS).filter(|ray| is(*ray)).count() as f64 / RAYS as f64;
        let seen = share(&|ray| is_seen[ray]);
        if seen < LEAST_SEEN || largest_gap(is_seen) > LARGEST_GAP {
            return Err(OuterWall::Hidden);
        }
        if share(&|ray| round.is_thick[ray]) < THICK.2 {
            return Err(OuterWall::Thin);
        }
        let corners = corners_at(*center, radii);
        let encloses = (0..RAYS).all(|ray| radii[ray] >= round.inner[ray]);
        if solidity(&corners) < SOLID || !encloses {
            return Err(OuterWall::Hidden);
        }
        let (area, _) = area_and_middle(&corners).ok_or(OuterWall::Hidden)?;
        let diameter = 2.0 * (area / PI).sqrt();
        let gap = (1.0 - seen) * (GAP_ERROR.0 + GAP_ERROR.1 * 0.5 * diameter);
        let noise = jitter(radii) * (SHARED_RAYS / RAYS as f64).sqrt();
        let unsure = 2.0 * (LEVEL_ERROR * self.width).hypot(gap).hypot(noise);
        let contour = corners.iter().map(|corner| self.place.point(*corner)).collect();
        Ok(Outer { found: OuterWall::Seen, contour, diameter: [diameter, unsure] })
    }
}

/// The samples of a ray: how clearly they show the border, and their cost.
struct Strength {
    seen: Vec<f64>,
    costs: Vec<f64>,
}

/// The fraction of a blurred step that lies within the border, `away` standard deviations outwards. The cubic in the
/// hyperbolic tangent is exact to 0.0003 (Page 1977, doi:10.2307/2346872).
fn within(away: f64) -> f64 {
    0.5 * (1.0 + (0.797_884_56 * (away + 0.044_715 * away.powi(3))).tanh())
}

/// The edges; those missing lie between the nearest ones, or where `drawn` has them if all are missing.
fn filled(edges: &[Option<f64>], drawn: &[f64]) -> Vec<f64> {
    let count = edges.len();
    let nearest = |ray: usize, back: bool| {
        let at = |steps: usize| if back { (ray + count - steps) % count } else { (ray + steps) % count };
        (0..count).find_map(|steps| edges[at(steps)].map(|edge| (steps as f64, edge)))
    };
    let one = |ray: usize| {
        let (Some((before, a)), Some((after, b))) = (nearest(ray, true), nearest(ray, false)) else {
            return drawn[ray];
        };
        if before + after == 0.0 { a } else { (a * after + b * before) / (before + after) }
    };
    (0..count).map(one).collect()
}

/// Root mean square of the distances from the mean of the neighbours (mm).
fn jitter(radii: &[f64]) -> f64 {
    let count = radii.len();
    let off = |n: usize| radii[n] - 0.5 * (radii[(n + 1) % count] + radii[(n + count - 1) % count]);
    ((0..count).map(|n| off(n).powi(2)).sum::<f64>() / count as f64).sqrt()
}

/// Largest number of neighbouring rays that are not seen.
fn largest_gap(is_seen: &[bool]) -> usize {
    let twice = is_seen.iter().chain(is_seen);
    let (mut gap, mut largest) = (0, 0);
    for is in twice {
        gap = if *is { 0 } else { gap + 1 };
        largest = largest.max(gap);
    }
    largest.min(is_seen.len())
}
