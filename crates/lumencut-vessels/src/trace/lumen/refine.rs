//! Refines a path of voxels to a centerline: fits cross-sections, moves points to their centres, and smooths.

use glam::DVec3;

use crate::trace::lines::centerline::Centerline;
use crate::trace::lines::directions::frames;
use crate::trace::lines::directions::point_directions;
use crate::trace::lines::even_steps::in_even_steps;
use crate::trace::lines::smoothing::smoothed_by_parabolas;
use crate::trace::lumen::cross_section::{HALF, LumenSection, Probe};
use crate::trace::lumen::lumen_model::LumenModel;
use crate::voxels::Voxels;
use lumencut_core::error::Result;
use lumencut_core::math::arc_length::arc_lengths;
use lumencut_core::stop::{Stop, go_on};
use rayon::prelude::*;

/// Maximum distance between points of the result (mm).
pub const STEP: f64 = 0.5;

/// Distance between points (mm) and number of rays per section, in each round.
const ROUNDS: [(f64, usize); 4] = [(1.0, 16), (1.0, 16), (STEP, 24), (STEP, 24)];

/// Width of the smoothing (mm). It reduces noise as much as a mean over 1 mm.
const SMOOTHING: f64 = 1.5;

/// Neighbouring sections within this distance (mm) should have a similar radius.
const RADIUS_WINDOW_MM: f64 = 1.75;

/// Sections of lower quality (`trust`) are ignored.
const LEAST_TRUST: f64 = 0.1;

/// Over this distance along the line (mm), centres must advance.
const ADVANCE_WINDOW_MM: f64 = 2.0;

/// Weight of points whose section is not visible.
const UNSEEN: f64 = 0.1;

/// Centres a path in the lumen that contains it.
pub fn refined(voxels: &Voxels, model: &LumenModel, way: &[DVec3], stop: Stop) -> Result<Centerline> {
    refined_by(&Probe { voxels, model, rays: 0, fall: HALF }, way, stop)
}

/// As [`refined`], with the fall of values at a wall that a probe states; its number of rays is not used.
pub(crate) fn refined_by(probe: &Probe, way: &[DVec3], stop: Stop) -> Result<Centerline> {
    let points = in_even_steps(way, 2.0 * STEP);
    let line = Centerline { radius: vec![0.0; points.len()], confidence: vec![0.0; points.len()], points };
    in_rounds(probe, line, &[0, 1, 2, 3], stop)
}

/// Centres a line whose radii are known, with only half of the rounds.
pub(crate) fn refined_near(
    voxels: &Voxels,
    model: &LumenModel,
    line: &Centerline,
    stop: Stop,
) -> Result<Centerline> {
    in_rounds(&Probe { voxels, model, rays: 0, fall: HALF }, line.clone(), &[1, 3], stop)
}

fn in_rounds(probe: &Probe, mut line: Centerline, rounds: &[usize], stop: Stop) -> Result<Centerline> {
    for &round in rounds {
        go_on(stop)?;
        let (step, rays) = ROUNDS[round];
        line = moved(&Probe { rays, ..*probe }, &line.resampled(step), round);
    }
    Ok(line.resampled(STEP))
}

fn moved(probe: &Probe, line: &Centerline, round: usize) -> Centerline {
    let points = &line.points;
    let lengths = arc_lengths(points);
    let reach = if round == 0 { 3.0 } else { 1.5 };
    let across = frames(points, &point_directions(points, reach));
    let sections: Vec<Option<LumenSection>> = (0..points.len())
        .into_par_iter()
        .map(|i| {
            let guess = line.radius.get(i).copied().filter(|radius| *radius > 0.0);
            probe.look(points[i], across[i], guess)
        })
        .collect();
    let medians = medians(&sections, &lengths);
    let trust: Vec<f64> =
        sections.iter().zip(&medians).map(|(section, median)| trust_of(section, *median)).collect();
    let trust = unfolded(points, &sections, &trust, &lengths);
    let radii = filled(&sections, &trust, &lengths);
    let values: Vec<[f64; 4]> = (0..points.len())
        .map(|i| {
            let center =
                sections[i].filter(|_| trust[i] > LEAST_TRUST).map_or(points[i], |section| section.center);
            [center.x, center.y, center.z, radii[i]]
        })
        .collect();
    let wide = if round == 0 { 0.5 } else { 0.15 };
    // Points without a section keep some weight, so that the ends of visible parts do not swing out.
    let weights: Vec<f64> = trust.iter().map(|trust| trust.max(UNSEEN)).collect();
    let smooth = smoothed_by_parabolas(&lengths, &values, &weights, |i| SMOOTHING.max(wide * values[i][3]));
    let moved: Vec<DVec3> = smooth.iter().map(|v| DVec3::new(v[0], v[1], v[2])).collect();
    let radius: Vec<f64> = smooth.iter().map(|v| v[3].max(0.0)).collect();
    Centerline { points: moved, radius, confidence: trust }
}

/// Rejects sections whose centres do not advance along the line, because the line would fold back, as at a branch.
fn unfolded(points: &[DVec3], sections: &[Option<LumenSection>], trust: &[f64], lengths: &[f64]) -> Vec<f64> {
    let mut left = trust.to_vec();
    for i in 0..points.len() {
        let j =
            lengths.partition_point(|length| *length < lengths[i] + ADVANCE_WINDOW_MM).min(points.len() - 1);
        let (Some(from), Some(to)) = (sections[i], sections[j]) else { continue };
        let way = points[j] - points[i];
        let progress = (to.center - from.center).dot(way) / way.length_squared().max(1e-12);
        if j > i && trust[i].min(trust[j]) > LEAST_TRUST && !(0.4..2.5).contains(&progress) {
            (left[i], left[j]) = (0.0, 0.0);
        }
    }
    left
}

/// Quality of a section. It is reduced if the radius differs from the median of the neighbours.
fn trust_of(section: &Option<LumenSection>, median: Option<f64>) -> f64 {
    let (Some(section), Some(median)) = (section, median) else { return 0.0 };
    let odd = (section.radius / median).ln() / 0.3;
    section.trust * (-odd * odd).exp()
}

fn medians(sections: &[Option<LumenSection>], lengths: &[f64]) -> Vec<Option<f64>> {
    (0..sections.len())
        .map(|i| {
            let first = lengths.partition_point(|length| *length < lengths[i] - RADIUS_WINDOW_MM);
            let end = lengths.partition_point(|length| *length <= lengths[i] + RADIUS_WINDOW_MM);
            let around = &sections[first..end];
            let seen = around.iter().flatten().filter(|section| section.trust > LEAST_TRUST);
            let mut radii: Vec<f64> = seen.map(|section| section.radius).collect();
            radii.sort_unstable_by(f64::total_cmp);
            radii.get(radii.len() / 2).copied()
        })
        .collect()
}

fn filled(sections: &[Option<LumenSection>], trust: &[f64], lengths: &[f64]) -> Vec<f64> {
    let seen: Vec<(f64, f64)> = (0..sections.len())
        .filter(|i| trust[*i] > LEAST_TRUST)
        .filter_map(|i| sections[i].map(|section| (lengths[i], section.radius)))
        .collect();
    lengths
        .iter()
        .map(|length| {
            let after = seen.partition_point(|(at, _)| at < length);
            match (after.checked_sub(1).and_then(|n| seen.get(n)), seen.get(after)) {
                (Some((a, low)), Some((b, high))) => low + (high - low) * ((length - a) / (b - a).max(1e-9)),
                (Some((_, radius)), None) | (None, Some((_, radius))) => *radius,
                (None, None) => 0.0,
            }
        })
        .collect()
}
