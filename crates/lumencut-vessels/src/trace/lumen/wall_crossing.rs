//! Finds where a line crosses a thin dark sheet: a flap, or the wall of the vessel next to it. Sections cannot show that,
//! because they lie along the sheet. The method is our own.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::trace::lines::centerline::Centerline;
use crate::trace::lumen::directions::half_sphere;
use crate::trace::lumen::lumen_model::median_of;
use crate::trace::lumen::surroundings::Surroundings;
use crate::voxels::Voxels;
use lumencut_core::math::arc_length::arc_lengths;

/// Minimum fall of the mean in a sheet below the means on both sides: a fraction of the contrast, and spreads along the
/// line. On right lines of a stent graft it was 0.20 at most, of an MRA and of phantoms 0.09; across drawn flaps 0.28 (median).
const LEAST_FALL: f64 = 0.21;
const LEAST_SPREADS: f64 = 1.5;

/// The line must be darker there by this many spreads.
const LEAST_DIP: f64 = 1.0;

/// Sheets of this many directions are tried, unless the line runs along them (cosine below `LEAST_ACROSS`).
const SHEETS: u32 = 60;
const LEAST_ACROSS: f64 = 0.2;

/// Radius of a sheet, in radii of the lumen, and its limits (mm).
const SHEET_RADII: f64 = 0.4;
const SHEET_MM: [f64; 2] = [0.8, 2.5];

/// Distance of the places on both sides: voxels, or mm if larger.
const APART_VOXELS: f64 = 1.6;
const APART_MM: f64 = 1.2;

/// In the throat of a stenosis, the middle is brighter than the rim by more than this fraction of the fall.
const THROAT: f64 = 0.45;

/// The level of the lumen is the median up to this distance along the line (mm); the spread is that around a median of
/// fewer values.
const LEVEL_MM: f64 = 10.0;
const SPREAD_MM: f64 = 2.5;

/// A sheet is darkest on the line up to this distance (mm), and lies that far from the ends.
const DARKEST_MM: f64 = 1.5;

/// A place where a line crosses a sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallCrossing {
    /// Index of the point.
    pub at: usize,
    /// Mean values of the sides and of the sheet.
    pub levels: [f64; 2],
    lumen: f64,
}

/// The sheets that a line crosses, in its order.
pub fn wall_crossings(voxels: &Voxels, line: &Centerline) -> Vec<WallCrossing> {
    let along = Along::new(voxels, line);
    let mut found: Vec<WallCrossing> = along.dips().filter_map(|n| along.crossing(n)).collect();
    let fall = |crossing: &WallCrossing| crossing.levels[0] - crossing.levels[1];
    let Some(clearest) = found.iter().max_by(|a, b| fall(a).total_cmp(&fall(b))) else { return found };
    let tissue = Surroundings::of(voxels, &[line.points[clearest.at]]).tissue();
    found.retain(|crossing| fall(crossing) >= LEAST_FALL * (crossing.lumen - tissue));
    found
}

struct Along<'a, 'v> {
    voxels: &'a Voxels<'v>,
    line: &'a Centerline,
    lengths: Vec<f64>,
    values: Vec<f32>,
    /// Robust standard deviation of the values from those of their neighbours.
    spread: f64,
}

impl<'a, 'v> Along<'a, 'v> {
    fn new(voxels: &'a Voxels<'v>, line: &'a Centerline) -> Self {
        let values: Vec<f32> = line.points.iter().map(|point| voxels.at(*point)).collect();
        let mut along = Self { voxels, line, lengths: arc_lengths(&line.points), values, spread: 0.0 };
        let away = |n: usize| (f64::from(along.values[n]) - along.median(n, SPREAD_MM)).abs() as f32;
        along.spread = 1.4826 * median_of((0..line.points.len()).map(away).collect());
        along
    }

    fn within(&self, n: usize, reach: f64) -> std::ops::Range<usize> {
        let at = self.lengths[n];
        let first = self.lengths.partition_point(|length| *length < at - reach);
        first..self.lengths.partition_point(|length| *length <= at + reach)
    }

    fn median(&self, n: usize, reach: f64) -> f64 {
        median_of(self.values[self.within(n, reach)].to_vec())
    }

    fn smooth(&self, n: usize) -> f64 {
        let near = &self.values[n.saturating_sub(1)..(n + 2).min(self.values.len())];
        near.iter().map(|value| f64::from(*value)).sum::<f64>() / near.len() as f64
    }

    /// The points at which the line is darker than around.
    fn dips(&self) -> impl Iterator<Item = usize> {
        let end = self.lengths[self.lengths.len() - 1];
        let smooth: Vec<f64> = (0..self.values.len()).map(|n| self.smooth(n)).collect();
        (0..self.values.len()).filter(move |n| {
            let is_inside = self.lengths[*n] > DARKEST_MM && self.lengths[*n] < end - DARKEST_MM;
            is_inside
                && self.within(*n, DARKEST_MM).all(|m| smooth[m] >= smooth[*n])
                && self.median(*n, LEVEL_MM) - smooth[*n] >= LEAST_DIP * self.spread
        })
    }

    /// The clearest sheet through a point; None if no sheet is clear.
    fn crossing(&self, n: usize) -> Option<WallCrossing> {
        let points = &self.line.points;
        let along = (points[(n + 1).min(points.len() - 1)] - points[n.saturating_sub(1)]).normalize_or_zero();
        let lumen = self.median(n, LEVEL_MM);
        let sheet = Sheet {
            voxels: self.voxels,
            radius: (SHEET_RADII * self.line.radius[n]).clamp(SHEET_MM[0], SHEET_MM[1]),
            most: lumen,
        };
        let apart = APART_MM.max(APART_VOXELS * self.voxels.mean_side());
        let fall_across = |way: DVec3| {
            let [inner, outer] = sheet.means(points[n], way);
            let sides = [-apart, apart].map(|step| mean(sheet.means(points[n] + way * step, way)));
            let levels = [sides[0].min(sides[1]), mean([inner, outer])];
            let fall = levels[0] - levels[1];
            (inner - outer <= THROAT * fall).then_some(levels)
        };
        let ways = half_sphere(SHEETS).filter(|way| way.dot(along).abs() > LEAST_ACROSS);
        let fall = |levels: &[f64; 2]| levels[0] - levels[1];
        let levels = ways.filter_map(fall_across).max_by(|a, b| fall(a).total_cmp(&fall(b)))?;
        let is_clear = fall(&levels) > 0.0 && fall(&levels) >= LEAST_SPREADS * self.spread;
        is_clear.then_some(WallCrossing { at: n, levels, lumen })
    }
}

struct Sheet<'a, 'v> {
    voxels: &'a Voxels<'v>,
    radius: f64,
    /// Brighter values count as this one: stents and calcium make no dark sheet between them.
    most: f64,
}

impl Sheet<'_, '_> {
    /// Mean values of the middle and of the rim, across a direction.
    fn means(&self, center: DVec3, across: DVec3) -> [f64; 2] {
        let first = across.any_orthonormal_vector();
        let second = across.cross(first);
        let value = |place: DVec3| f64::from(self.voxels.at(place)).min(self.most);
        let ring = |radius: f64| {
            let turned = (0..6).map(|n| (TAU * f64::from(n) / 6.0).sin_cos());
            turned.map(|(sin, cos)| value(center + (first * cos + second * sin) * radius)).sum::<f64>()
        };
        [(value(center) + ring(0.5 * self.radius)) / 7.0, ring(self.radius) / 6.0]
    }
}

/// The mean over a sheet, of seven places in the middle and six at the rim.
fn mean([inner, outer]: [f64; 2]) -> f64 {
    (7.0 * inner + 6.0 * outer) / 13.0
}
