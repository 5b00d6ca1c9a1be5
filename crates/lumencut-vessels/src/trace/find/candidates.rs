//! Finds candidates: positions where both the gradient flux and a cross-section look like a tube.

use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;

use crate::trace::find::flux::{FluxOf, HALO, RADII, Responses, gains};
use crate::trace::find::progress::{Stage, Stages};
use crate::trace::find::pyramid::{Level, Pyramid};
use crate::trace::find::section::{Section, across};
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

/// Number of voxels along each axis of a tile.
const TILE: [usize; 3] = [64, 24, 24];

/// Minimum response of a candidate: a multiple of the noise, and a fraction of the vessel contrast.
const NOISES: f64 = 3.5;
const OF_CONTRAST: f64 = 0.15;

/// Minimum contrast of a candidate's section: a multiple of the noise, and a fraction of the vessel contrast.
const SECTION_NOISES: f64 = 3.0;
const SECTION_OF_CONTRAST: f64 = 0.2;

/// Limits of a section: minimum closure (fraction of rays with a wall about one radius away), minimum
/// fraction of contrasting rays, and range of its radius relative to the flux radius.
const LEAST_CLOSURE: f64 = 0.65;
const LEAST_CONTRAST_SHARE: f64 = 0.6;
const RADIUS_RATIO: [f64; 2] = [0.5, 1.9];

/// Maximum shift from a candidate to its section's centre (radii); the second for tubes wider than two voxels.
const MOST_SHIFT: f64 = 1.0;
const MOST_WIDE_SHIFT: f64 = 1.5;
const WIDE_RADIUS: f64 = 2.0;

/// Number of centring rounds; minimum radius (finest-level voxels).
const ROUNDS: usize = 3;
const LEAST_RADIUS: f64 = 0.5;

/// Candidates are searched up to this distance from a position (radii).
const SEARCH_RADII: f64 = 2.0;

/// Noise is estimated from the local spread of the brightest samples. A low quantile of the spread is used,
/// because higher ones contain edges. For white noise, the value of this quantile is known.
const NOISE_SAMPLES: usize = 60_000;
const BRIGHTEST: f64 = 0.4;
const EVENEST: f64 = 0.15;
const EVENEST_OF_NOISE: f64 = 0.855;

/// A position that may lie in a tube. Lengths are in finest-level voxels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Candidate {
    pub place: DVec3,
    pub direction: DVec3,
    pub radius: f64,
    /// Response of the flux, which is a contrast in the unit of the volume.
    pub(crate) response: f64,
    /// Radius of the ball whose flux has that response.
    pub(crate) flux_radius: f64,
    /// Fraction of rays with a wall about one radius away, and fraction of rays that lose half of the contrast.
    pub closure: f64,
    pub(crate) contrast_share: f64,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Floors {
    pub noise: f64,
    /// Contrast of vessels; the first pass assumes a fraction of the value range.
    pub contrast: f64,
}

impl Floors {
    pub(crate) fn of_section(&self) -> f64 {
        (SECTION_NOISES * self.noise).max(SECTION_OF_CONTRAST * self.contrast)
    }
}

pub(crate) fn candidates(
    pyramid: &Pyramid,
    levels_examined: &Range<usize>,
    floors: &Floors,
    stop: Stop,
    stages: Stages,
) -> Result<Vec<Candidate>> {
    let mut found = Vec::new();
    let all = levels_examined.clone().map(|number| tiles(pyramid.levels[number].size).len()).sum();
    let pieces = stages.stage(Stage::Candidates, all);
    for number in levels_examined.clone() {
        let level = &pyramid.levels[number];
        let limits = limits(level, number, levels_examined, floors);
        let of_level: Vec<Vec<Candidate>> = tiles(level.size)
            .into_par_iter()
            .map(|tile| {
                go_on(stop)?;
                pieces.done(1);
                let seen = peaks(level, tile, &limits);
                Ok(seen
                    .into_iter()
                    .filter_map(|peak| judged(pyramid, levels_examined, peak, floors))
                    .collect())
            })
            .collect::<Result<_>>()?;
        found.extend(of_level.into_iter().flatten());
    }
    Ok(in_order(found, floors))
}

/// Candidates within two radii of a position (finest-level voxels).
pub(crate) fn candidates_near(
    pyramid: &Pyramid,
    levels_examined: &Range<usize>,
    floors: &Floors,
    place: DVec3,
) -> Vec<Candidate> {
    let of_level = |number: usize| {
        let level = &pyramid.levels[number];
        let limits = limits(level, number, levels_examined, floors);
        let voxel = (place / level.side).round().to_array().map(|c| c.max(0.0) as usize);
        let first = std::array::from_fn(|a| voxel[a].saturating_sub(TILE[a] / 2));
        let seen =
            if (0..3).all(|a| first[a] < level.size[a]) { peaks(level, first, &limits) } else { Vec::new() };
        seen.into_iter().filter_map(|peak| judged(pyramid, levels_examined, peak, floors)).collect::<Vec<_>>()
    };
    let found = levels_examined.clone().flat_map(of_level);
    in_order(found.filter(|c| c.place.distance(place) <= SEARCH_RADII * c.radius.max(1.0)).collect(), floors)
}

fn in_order(mut candidates: Vec<Candidate>, floors: &Floors) -> Vec<Candidate> {
    let promise = |c: &Candidate| c.response.min(floors.contrast) * c.flux_radius.sqrt();
    candidates.sort_by(|a, b| promise(b).total_cmp(&promise(a)));
    candidates
}

/// The ball radii used on a level, each with the factor and the threshold of its response.
fn limits(
    level: &Level,
    number: usize,
    levels_examined: &Range<usize>,
    floors: &Floors,
) -> Vec<(usize, f32, f32)> {
    let (first, last) = (levels_examined.start, levels_examined.end - 1);
    let radii: &[usize] = match () {
        () if number == first && number == last => &[0, 1, 2, 3],
        () if number == first => &[0, 1, 2],
        () if number == last => &[1, 2, 3],
        () => &[1, 2],
    };
    let noise = if number == first { floors.noise } else { noise(level) };
    let limit = |&radius: &usize| {
        let gain = gains()[radius];
        let least = (NOISES * noise * f64::from(gain.noise)).max(OF_CONTRAST * floors.contrast);
        // The smallest possible response is one quantization step.
        (radius, gain.factor, (least as f32 / level.unit).max(1.0))
    };
    radii.iter().map(limit).collect()
}

pub(crate) fn noise(level: &Level) -> f64 {
    let [nx, ny, nz] = level.size;
    if level.size.iter().any(|n| *n < 3) {
        return 0.0;
    }
    let inner = (nx - 2) * (ny - 2) * (nz - 2);
    let step = inner.div_ceil(NOISE_SAMPLES) | 1;
    let mut samples: Vec<(f64, f64)> = (0..inner)
        .into_par_iter()
        .step_by(step)
        .map(|n| {
            let (i, j, k) = (n % (nx - 2), n / (nx - 2) % (ny - 2), n / ((nx - 2) * (ny - 2)));
            let rows = (0..9).map(|row| i + (j + row % 3) * nx + (k + row / 3) * nx * ny);
            let around =
                rows.flat_map(|start| &level.voxels[start..start + 3]).map(|value| f64::from(*value));
            let [sum, squares] = around.fold([0.0, 0.0], |[sum, squares], v| [sum + v, squares + v * v]);
            (sum / 27.0, ((squares - sum * sum / 27.0).max(0.0) / 26.0).sqrt())
        })
        .collect();
    // Voxels clamped to the lowest value would hide the noise.
    samples.retain(|sample| sample.0 > 0.5);
    if samples.is_empty() {
        return 0.0;
    }
    let darker = ((1.0 - BRIGHTEST) * samples.len() as f64) as usize;
    samples.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut spread: Vec<f64> = samples[darker..].iter().map(|sample| sample.1).collect();
    let even = ((spread.len() - 1) as f64 * EVENEST) as usize;
    *spread.select_nth_unstable_by(even, f64::total_cmp).1 / EVENEST_OF_NOISE * f64::from(level.unit)
}

fn tiles(size: [usize; 3]) -> Vec<[usize; 3]> {
    let counts: [usize; 3] = std::array::from_fn(|a| size[a].div_ceil(TILE[a]));
    (0..counts.iter().product())
        .map(|n| {
            let tile = [n % counts[0], n / counts[0] % counts[1], n / (counts[0] * counts[1])];
            std::array::from_fn(|a| tile[a] * TILE[a])
        })
        .collect()
}

/// Voxels of a tile whose response is the greatest across the direction of their tube.
fn peaks(level: &Level, first: [usize; 3], radii: &[(usize, f32, f32)]) -> Vec<Candidate> {
    let size: [usize; 3] = std::array::from_fn(|a| TILE[a].min(level.size[a] - first[a]));
    let least = radii.iter().map(|(_, _, least)| *least).fold(f32::MAX, f32::min);
    let Some(values) = values(level, first, size.map(|n| n + 2 * HALO), least) else { return Vec::new() };
    let responses = FluxOf { values, size: size.map(|n| n + 2 * HALO), radii }.responses();
    let mut found = Vec::new();
    for k in 0..size[2] {
        for j in 0..size[1] {
            for i in 0..size[0] {
                // The responses include a border of one voxel around the tile.
                let voxel = [i + 1, j + 1, k + 1];
                let number = responses.number(voxel);
                if responses.strongest[number] <= 0.0 {
                    continue;
                }
                let direction = DVec3::from_array(responses.direction(voxel));
                if is_peak(&responses, voxel, direction) {
                    let place = [first[0] + i, first[1] + j, first[2] + k].map(|n| n as f64 * level.side);
                    let radius = RADII[usize::from(responses.radius[number])] * level.side;
                    let response = f64::from(responses.strongest[number] * level.unit);
                    let place = DVec3::from_array(place);
                    found.push(Candidate {
                        place,
                        direction,
                        radius,
                        response,
                        flux_radius: radius,
                        closure: 0.0,
                        contrast_share: 0.0,
                    });
                }
            }
        }
    }
    found
}

/// Values of a tile, extended at the edge of the volume; None if their range is below `least`.
fn values(level: &Level, first: [usize; 3], size: [usize; 3], least: f32) -> Option<Vec<f32>> {
    let [nx, ny, nz] = level.size;
    let at = |n: usize, first: usize, count: usize| (first + n).saturating_sub(HALO).min(count - 1);
    let mut values = Vec::with_capacity(size.iter().product());
    let (mut low, mut high) = (u16::MAX, 0);
    for k in 0..size[2] {
        for j in 0..size[1] {
            let row = (at(j, first[1], ny) + at(k, first[2], nz) * ny) * nx;
            for i in 0..size[0] {
                let value = level.voxels[row + at(i, first[0], nx)];
                (low, high) = (low.min(value), high.max(value));
                values.push(f32::from(value));
            }
        }
    }
    (f32::from(high.saturating_sub(low)) >= least).then_some(values)
}

/// Whether a voxel has the greatest response across the direction of its tube; of equal voxels, the first one has.
fn is_peak(responses: &Responses, voxel: [usize; 3], direction: DVec3) -> bool {
    let own = responses.number(voxel);
    let strength = responses.strongest[own];
    let plane = across(direction);
    (0..8).all(|n| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(n) / 8.0).sin_cos();
        let step = (plane[0] * cos + plane[1] * sin).round();
        let beside = std::array::from_fn(|a| (voxel[a] as f64 + step[a]) as usize);
        let number = responses.number(beside);
        let other = responses.strongest[number];
        number == own || strength > other || (strength == other && own < number)
    })
}

fn judged(
    pyramid: &Pyramid,
    levels_examined: &Range<usize>,
    peak: Candidate,
    floors: &Floors,
) -> Option<Candidate> {
    let most = if peak.radius >= WIDE_RADIUS { MOST_WIDE_SHIFT } else { MOST_SHIFT } * peak.radius;
    let look = |place: DVec3, radius: f64| {
        Section::look(pyramid.level_for(radius, levels_examined), place, peak.direction, radius)
    };
    let (mut place, mut radius) = (peak.place, peak.radius);
    let mut section = look(place, radius);
    for _ in 1..ROUNDS {
        place += section.shift;
        radius = section.radius.max(LEAST_RADIUS);
        if place.distance(peak.place) >= most {
            return None;
        }
        section = look(place, radius);
    }
    let is_tube = section.closure > LEAST_CLOSURE
        && section.contrast_share > LEAST_CONTRAST_SHARE
        && section.contrast > floors.of_section()
        && (RADIUS_RATIO[0]..RADIUS_RATIO[1]).contains(&(section.radius / peak.radius));
    let Section { closure, contrast_share, .. } = section;
    is_tube.then(|| Candidate {
        place: place + section.shift,
        radius: section.radius,
        closure,
        contrast_share,
        ..peak
    })
}

#[cfg(test)]
#[path = "tests/candidates.rs"]
mod tests;
