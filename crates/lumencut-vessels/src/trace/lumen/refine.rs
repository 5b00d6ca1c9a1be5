//! From a way through voxels to a centerline: cross-sections are fitted, the line moves to their middles and is smoothed.

use glam::DVec3;

use crate::trace::lines::centerline::Centerline;
use crate::trace::lines::directions::point_directions;
use crate::trace::lines::even_steps::in_even_steps;
use crate::trace::lines::frames::frames;
use crate::trace::lines::smoothing::smoothed_by_parabolas;
use crate::trace::lumen::cross_section::{LumenSection, Probe};
use crate::trace::lumen::lumen_model::LumenModel;
use crate::voxels::Voxels;
use lumencut_core::error::Result;
use lumencut_core::math::arc_length::arc_lengths;
use lumencut_core::stop::{Stop, go_on};
use rayon::prelude::*;

/// Points of the result are at most so far apart (mm).
pub const STEP: f64 = 0.5;

/// The rounds in which the line moves to the middle: how far its points are apart (mm), and with how many rays each looks.
const ROUNDS: [(f64, usize); 4] = [(1.0, 16), (1.0, 16), (STEP, 24), (STEP, 24)];

/// The width of the smoothing along the line (mm): as much as an average over 1 mm takes of noise.
const SMOOTHING: f64 = 1.5;

/// How far before and after a cross-section others are that should have about its radius (mm).
const BESIDE: f64 = 1.75;

/// A cross-section that is trusted less was not seen.
const LEAST_TRUST: f64 = 0.1;

/// Over how much of the line its middles must go on (mm).
const STRETCH: f64 = 2.0;

/// How much a point counts at which no lumen was seen.
const UNSEEN: f64 = 0.1;

/// The line in the middle of the lumen that a way runs through.
///
/// # Errors
/// [`lumencut_core::error::ErrorKind::Interrupted`].
pub fn refined(voxels: &Voxels, model: &LumenModel, way: &[DVec3], stop: Stop) -> Result<Centerline> {
    let points = in_even_steps(way, 2.0 * STEP);
    let line = Centerline { radius: vec![0.0; points.len()], confidence: vec![0.0; points.len()], points };
    in_rounds(voxels, model, line, &[0, 1, 2, 3], stop)
}

/// The line in the middle of the lumen near one whose radii are known: with half the work.
///
/// # Errors
/// [`lumencut_core::error::ErrorKind::Interrupted`].
pub fn refined_near(
    voxels: &Voxels,
    model: &LumenModel,
    line: &Centerline,
    stop: Stop,
) -> Result<Centerline> {
    in_rounds(voxels, model, line.clone(), &[1, 3], stop)
}

/// A line moved to the middle in some of the rounds.
fn in_rounds(
    voxels: &Voxels,
    model: &LumenModel,
    mut line: Centerline,
    rounds: &[usize],
    stop: Stop,
) -> Result<Centerline> {
    for &round in rounds {
        go_on(stop)?;
        let (step, rays) = ROUNDS[round];
        line = moved(&Probe { voxels, model, rays }, &line.resampled(step), round);
    }
    Ok(line.resampled(STEP))
}

/// The line one round nearer to the middle.
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
    // Where nothing was seen the line holds on to where it is, so that no end of what was seen swings out.
    let weights: Vec<f64> = trust.iter().map(|trust| trust.max(UNSEEN)).collect();
    let smooth = smoothed_by_parabolas(&lengths, &values, &weights, |i| SMOOTHING.max(wide * values[i][3]));
    let moved: Vec<DVec3> = smooth.iter().map(|v| DVec3::new(v[0], v[1], v[2])).collect();
    let radius: Vec<f64> = smooth.iter().map(|v| v[3].max(0.0)).collect();
    Centerline { points: moved, radius, confidence: trust }
}

/// The trust of the sections, none for those whose middles do not go on along the line: such a line would fold back, as it
/// does where a branch begins within a wider vessel.
fn unfolded(points: &[DVec3], sections: &[Option<LumenSection>], trust: &[f64], lengths: &[f64]) -> Vec<f64> {
    let mut left = trust.to_vec();
    for i in 0..points.len() {
        let j = lengths.partition_point(|length| *length < lengths[i] + STRETCH).min(points.len() - 1);
        let (Some(from), Some(to)) = (sections[i], sections[j]) else { continue };
        let way = points[j] - points[i];
        let progress = (to.center - from.center).dot(way) / way.length_squared().max(1e-12);
        if j > i && trust[i].min(trust[j]) > LEAST_TRUST && !(0.4..2.5).contains(&progress) {
            (left[i], left[j]) = (0.0, 0.0);
        }
    }
    left
}

/// How much a cross-section counts: little where its radius is far from those around it.
fn trust_of(section: &Option<LumenSection>, median: Option<f64>) -> f64 {
    let (Some(section), Some(median)) = (section, median) else { return 0.0 };
    let odd = (section.radius / median).ln() / 0.3;
    section.trust * (-odd * odd).exp()
}

/// The median radius of the sections around each, where any was seen well.
fn medians(sections: &[Option<LumenSection>], lengths: &[f64]) -> Vec<Option<f64>> {
    (0..sections.len())
        .map(|i| {
            let first = lengths.partition_point(|length| *length < lengths[i] - BESIDE);
            let end = lengths.partition_point(|length| *length <= lengths[i] + BESIDE);
            let around = &sections[first..end];
            let seen = around.iter().flatten().filter(|section| section.trust > LEAST_TRUST);
            let mut radii: Vec<f64> = seen.map(|section| section.radius).collect();
            radii.sort_unstable_by(f64::total_cmp);
            radii.get(radii.len() / 2).copied()
        })
        .collect()
}

/// The radius of each section that was seen well, and between them what lies between their radii.
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
