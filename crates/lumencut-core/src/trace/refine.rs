//! From a way through voxels to a centerline: cross-sections are fitted, the line moves to their middles and is smoothed.

use glam::DVec3;

use super::cross_section::{CrossSection, Probe};
use super::path::{arc_lengths, directions, frames, resampled, resampled_values, smoothed};
use crate::error::Result;
use crate::stop::{Stop, go_on};
use rayon::prelude::*;

/// Points of the result are at most so far apart (mm).
pub const STEP: f64 = 0.5;

/// How often the line moves to the middle.
const ROUNDS: usize = 4;

/// The width of the smoothing along the line (mm): as much as an average over 1 mm takes of noise.
const SMOOTHING: f64 = 1.5;

/// A centerline, and what is known at each of its points.
#[derive(Clone, Debug, PartialEq)]
pub struct Centerline {
    /// The points (mm, LPS).
    pub points: Vec<DVec3>,
    /// The radius of the lumen (mm).
    pub radius: Vec<f64>,
    /// How sure the point is, 0 to 1.
    pub confidence: Vec<f64>,
}

/// The line in the middle of the lumen that a way runs through.
///
/// # Errors
/// [`crate::error::ErrorKind::Interrupted`].
pub fn refined(probe: &Probe, way: &[DVec3], stop: Stop) -> Result<Centerline> {
    let mut line = Centerline {
        points: resampled(&resampled(way, 2.0 * STEP), STEP),
        radius: Vec::new(),
        confidence: Vec::new(),
    };
    for round in 0..ROUNDS {
        go_on(stop)?;
        line = moved(probe, &line, round);
    }
    Ok(line)
}

/// The line one round nearer to the middle.
fn moved(probe: &Probe, line: &Centerline, round: usize) -> Centerline {
    let points = &line.points;
    let lengths = arc_lengths(points);
    let reach = if round == 0 { 3.0 } else { 1.5 };
    let across = frames(points, &directions(points, reach));
    let sections: Vec<Option<CrossSection>> = (0..points.len())
        .into_par_iter()
        .map(|i| {
            let guess = line.radius.get(i).copied().filter(|radius| *radius > 0.0);
            probe.look(points[i], across[i], guess)
        })
        .collect();
    let radii = medians(&sections, 7);
    let trust: Vec<f64> = sections.iter().zip(&radii).map(|(section, median)| trust_of(section, *median)).collect();
    let values: Vec<[f64; 4]> = (0..points.len())
        .map(|i| {
            let (center, radius) = match sections[i] {
                Some(section) if trust[i] > 0.0 => (section.center, section.radius),
                _ => (points[i], radii[i].unwrap_or(0.0)),
            };
            [center.x, center.y, center.z, radius]
        })
        .collect();
    let wide = if round == 0 { 0.5 } else { 0.15 };
    let smooth = smoothed(&lengths, &values, &trust, |i| SMOOTHING.max(wide * values[i][3]));
    let moved: Vec<DVec3> = smooth.iter().map(|v| DVec3::new(v[0], v[1], v[2])).collect();
    let radius: Vec<f64> = smooth.iter().map(|v| v[3].max(0.0)).collect();
    Centerline {
        points: resampled(&moved, STEP),
        radius: resampled_values(&moved, &radius, STEP),
        confidence: resampled_values(&moved, &trust, STEP),
    }
}

/// How much a cross-section counts: little where its radius is far from those around it.
fn trust_of(section: &Option<CrossSection>, median: Option<f64>) -> f64 {
    let (Some(section), Some(median)) = (section, median) else { return 0.0 };
    let odd = (section.radius / median).ln() / 0.3;
    section.trust * (-odd * odd).exp()
}

/// The median radius of the sections around each, where any was seen.
fn medians(sections: &[Option<CrossSection>], reach: usize) -> Vec<Option<f64>> {
    (0..sections.len())
        .map(|i| {
            let around = &sections[i.saturating_sub(reach)..(i + reach + 1).min(sections.len())];
            let mut radii: Vec<f64> = around.iter().flatten().map(|section| section.radius).collect();
            radii.sort_unstable_by(f64::total_cmp);
            radii.get(radii.len() / 2).copied()
        })
        .collect()
}
