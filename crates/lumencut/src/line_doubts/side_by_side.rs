//! Finds pairs of vessels that run side by side within one lumen.

use std::collections::BTreeMap;

use glam::DVec3;
use lumencut_core::math::arc_length::{arc_lengths, point_at};

use super::DoubtedLine;
use super::nearby::Nearby;

/// If a radius is unknown, lines nearer to each other than this (mm) are taken for one vessel.
const NEAR_MM: f64 = 0.5;
/// Lines nearer to each other than this fraction of the smaller radius are taken for one vessel.
const NEAR_RADII: f64 = 0.5;
const STEP_MM: f64 = 1.0;
const CHORD_SAMPLES: usize = 5;
const MAX_SAMPLES: f64 = 30_000.0;
/// At most this many neighbours of a sample are checked, to limit the work; no vessel is wide enough for more.
const MAX_NEIGHBOURS: usize = 200;
/// Shorter stretches side by side are ignored (mm).
const MIN_LENGTH_MM: f64 = 10.0;
/// Stretches of fewer radii are ignored too, since lines that join separate slowly.
const MIN_LENGTH_RADII: f64 = 6.0;

struct Spot {
    vessel: usize,
    radius: Option<f64>,
}

/// Pairs of vessels (the lower index first), and the length over which they run side by side (mm).
pub(super) fn side_by_side(lines: &[DoubtedLine]) -> Vec<(usize, usize, f64)> {
    if lines.len() < 2 {
        return Vec::new();
    }
    let (points, spots, step) = spots(lines);
    let nearby = Nearby::new(&points);
    let mut runs: BTreeMap<(usize, usize), Runs> = BTreeMap::new();
    for (n, spot) in spots.iter().enumerate() {
        let (mut others, mut count) = (BTreeMap::new(), 0);
        nearby.within(points[n], near(spot.radius, spot.radius).hypot(step), |m| {
            let other = &spots[m];
            let most = near(spot.radius, other.radius);
            if other.vessel != spot.vessel && distance_to_line(points[n], &points, &spots, m) <= most {
                others.entry(other.vessel).or_insert(smaller(spot.radius, other.radius).unwrap_or(0.0));
            }
            count += 1;
            count < MAX_NEIGHBOURS
        });
        for (other, radius) in others {
            runs.entry((spot.vessel, other)).or_default().add(n, radius);
        }
    }
    // Both vessels of a pair have stretches; the longer one counts.
    let mut pairs: BTreeMap<(usize, usize), f64> = BTreeMap::new();
    for ((a, b), runs) in runs {
        if let Some(length) = runs.longest(&points) {
            let most = pairs.entry((a.min(b), a.max(b))).or_default();
            *most = most.max(length);
        }
    }
    pairs.into_iter().map(|((a, b), length)| (a, b, length)).collect()
}

#[derive(Default)]
struct Runs {
    /// First and last sample of each stretch, and the largest radius on it.
    found: Vec<(usize, usize, f64)>,
}

impl Runs {
    fn add(&mut self, spot: usize, radius: f64) {
        match self.found.last_mut() {
            Some((_, end, largest)) if spot - *end <= 2 => (*end, *largest) = (spot, largest.max(radius)),
            _ => self.found.push((spot, spot, radius)),
        }
    }

    fn longest(&self, points: &[DVec3]) -> Option<f64> {
        let lengths = self.found.iter().map(|(from, to, radius)| (length(&points[*from..=*to]), radius));
        let long =
            lengths.filter(|(length, radius)| *length >= MIN_LENGTH_MM.max(MIN_LENGTH_RADII * **radius));
        long.map(|(length, _)| length).max_by(f64::total_cmp)
    }
}

fn length(points: &[DVec3]) -> f64 {
    let corners: Vec<DVec3> = points.iter().step_by(CHORD_SAMPLES).chain(points.last()).copied().collect();
    corners.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
}

fn spots(lines: &[DoubtedLine]) -> (Vec<DVec3>, Vec<Spot>, f64) {
    let along: Vec<Vec<f64>> = lines.iter().map(|line| arc_lengths(line.points)).collect();
    let length = |along: &Vec<f64>| along.last().copied().unwrap_or(0.0);
    let step = STEP_MM.max(along.iter().map(length).sum::<f64>() / MAX_SAMPLES);
    let (mut points, mut spots) = (Vec::new(), Vec::new());
    for (vessel, (line, along)) in lines.iter().zip(&along).enumerate() {
        if line.points.is_empty() {
            continue;
        }
        for n in 0..=(length(along) / step) as usize {
            let at = n as f64 * step;
            points.push(point_at(line.points, along, at));
            let next = along.partition_point(|one| *one < at).min(line.points.len() - 1);
            let radius = line.radius.and_then(|radius| radius.get(next)).copied();
            spots.push(Spot { vessel, radius: radius.filter(|radius| *radius > 0.0) });
        }
    }
    (points, spots, step)
}

fn near(one: Option<f64>, other: Option<f64>) -> f64 {
    smaller(one, other).map_or(NEAR_MM, |radius| NEAR_MM.min(radius).max(NEAR_RADII * radius))
}

fn smaller(one: Option<f64>, other: Option<f64>) -> Option<f64> {
    match (one, other) {
        (Some(one), Some(other)) => Some(one.min(other)),
        _ => one.or(other),
    }
}

/// The distance from a position to the polyline around sample `m`.
fn distance_to_line(place: DVec3, points: &[DVec3], spots: &[Spot], m: usize) -> f64 {
    let is_same = |other: usize| spots.get(other).is_some_and(|spot| spot.vessel == spots[m].vessel);
    let ends = [m.checked_sub(1), Some(m + 1)].into_iter().flatten().filter(|other| is_same(*other));
    let to_segment = |other: usize| {
        let (from, along) = (points[m], points[other] - points[m]);
        let part = ((place - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        if part.is_finite() { place.distance(from + along * part) } else { place.distance(from) }
    };
    ends.map(to_segment).fold(place.distance(points[m]), f64::min)
}
