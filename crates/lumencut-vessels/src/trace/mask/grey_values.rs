//! Refines the vessels of a mask by the grey values of a scan, because a mask is accurate only to half a voxel.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::trace::lines::centerline::Centerline;
use crate::trace::lines::directions::frames;
use crate::trace::lines::directions::point_directions;
use crate::trace::lumen::lumen_model::{LumenModel, quantile, tissue_level};
use crate::trace::lumen::refine::refined;
use crate::voxels::Voxels;
use lumencut_core::error::Result;
use lumencut_core::math::arc_length::arc_lengths;
use lumencut_core::stop::Stop;

/// Tissue is sampled between these distances beyond the wall of the mask (mm; voxels if those are larger).
const TISSUE: [f64; 2] = [1.0, 4.0];

/// Number of directions, and number of distances, in which tissue is sampled.
const DIRECTIONS: usize = 12;
const DISTANCES: usize = 3;

/// Length of the window along the vessel (mm) over which the lumen values are averaged by their median.
const WINDOW_MM: f64 = 5.0;

/// Minimum contrast, in standard deviations of the noise in the lumen.
const LEAST_CONTRAST: f64 = 2.0;

/// Minimum fraction of the points at which the lumen must be visible.
const LEAST_SEEN: f64 = 0.5;

/// Grey values in which the lumen of a mask is visible.
pub struct GreyValues<'a, 'v> {
    /// The volume with grey values.
    pub voxels: &'a Voxels<'v>,
    /// Called often; returns whether to stop.
    pub stop: Stop<'a>,
}

impl GreyValues<'_, '_> {
    /// Refines a vessel (mm, LPS); None if the volume does not show it.
    pub fn refined(&self, points: &[DVec3], radius: &[f64]) -> Result<Option<Centerline>> {
        let Some(model) = self.model(points, radius) else { return Ok(None) };
        let line = refined(self.voxels, &model, points, self.stop)?;
        let seen = line.confidence.iter().filter(|confidence| **confidence > 0.0).count();
        let is_seen = seen as f64 >= LEAST_SEEN * line.points.len() as f64;
        let widest = radius.iter().copied().fold(self.voxels.smallest_side, f64::max);
        let is_here = line
            .points
            .iter()
            .all(|place| points.iter().any(|point| point.distance_squared(*place) <= widest * widest));
        let has_radius = line.radius.iter().all(|radius| *radius > 0.0);
        Ok((is_seen && is_here && has_radius).then_some(line))
    }

    /// Lumen model along the vessel; None if the lumen has no contrast.
    fn model(&self, points: &[DVec3], radius: &[f64]) -> Option<LumenModel> {
        let lumen: Vec<(f64, f32)> = arc_lengths(points)
            .into_iter()
            .zip(points.iter().map(|point| self.voxels.at(*point)))
            .filter(|(_, value)| value.is_finite())
            .collect();
        let medians = medians(&lumen);
        let mut tissue = self.tissue(points, radius);
        tissue.sort_unstable_by(f32::total_cmp);
        if tissue.is_empty() || lumen.is_empty() {
            return None;
        }
        let mut away: Vec<f32> =
            lumen.iter().zip(&medians).map(|((_, value), median)| (value - median).abs()).collect();
        away.sort_unstable_by(f32::total_cmp);
        let of = |pick: fn(f64, f64) -> f64| medians.iter().map(|median| f64::from(*median)).reduce(pick);
        let model = LumenModel {
            tissue: tissue_level(
                &tissue,
                &medians.iter().map(|median| f64::from(*median)).collect::<Vec<_>>(),
            ),
            low: of(f64::min)?,
            high: of(f64::max)?,
            noise: 1.4826 * quantile(&away, 0.5),
            is_hounsfield: false,
            polarity: self.voxels.polarity,
        };
        (model.contrast() > LEAST_CONTRAST * model.noise && model.contrast() > 0.0).then_some(model)
    }

    fn tissue(&self, points: &[DVec3], radius: &[f64]) -> Vec<f32> {
        let across = frames(points, &point_directions(points, 1.5));
        let [near, far] = TISSUE.map(|distance| distance.max(distance * self.voxels.smallest_side));
        let mut values = Vec::new();
        for ((point, radius), [u, v]) in points.iter().zip(radius).zip(across) {
            for n in 0..DIRECTIONS * DISTANCES {
                let (sine, cosine) = (TAU * (n % DIRECTIONS) as f64 / DIRECTIONS as f64).sin_cos();
                let share = (n / DIRECTIONS) as f64 / (DISTANCES - 1) as f64;
                let away = radius + near + share * (far - near);
                values.push(self.voxels.at(*point + (u * cosine + v * sine) * away));
            }
        }
        values.retain(|value| value.is_finite());
        values
    }
}

fn medians(values: &[(f64, f32)]) -> Vec<f32> {
    let median = |&(at, _): &(f64, f32)| {
        let first = values.partition_point(|(length, _)| *length < at - WINDOW_MM / 2.0);
        let end = values.partition_point(|(length, _)| *length <= at + WINDOW_MM / 2.0);
        let mut around: Vec<f32> = values[first..end].iter().map(|(_, value)| *value).collect();
        around.sort_unstable_by(f32::total_cmp);
        around[around.len() / 2]
    };
    values.iter().map(median).collect()
}
