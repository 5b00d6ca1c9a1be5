//! Finds stents whose struts only brighten the wall: the lumen seems 2 to 10 % too wide. The values at the wall resemble
//! those one and two periods of the stent away, and not those half a period away. Noise, fat and plaque do not repeat.
//! Thinner struts than show in each direction show in the mean of all, as their rings are closed.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use crate::measure::fit::sections::{Bench, Section, UNMODELLED_WIDTHS, center};
use crate::measure::section::SectionPlane;
use crate::measure::section::flags::{BRANCH, CALCIUM, LEFT_OUT, METAL, NEIGHBOR};
use crate::measure::section::rays::{RAYS, Rays};
use lumencut_core::math::statistics::median;

const OTHER_RIM: u32 = LEFT_OUT | BRANCH | CALCIUM | METAL | NEIGHBOR;

/// Periods of the struts of stents along the vessel (mm).
const PERIODS: [f64; 2] = [1.9, 6.0];

/// Half of the length (mm) over which walls are smoothed, values are compared, and sections are flagged.
const SMOOTHED: f64 = 2.5;
const COMPARED: f64 = 9.0;
const FLAGGED: f64 = 6.0;

/// Maximum distance between sections, and maximum voxel side (mm), also as a fraction of the point spread: larger voxels
/// hide struts, and repeat themselves.
const STEP: f64 = 0.6;
const SIDE: (f64, f64) = (0.8, 1.1);

/// Where the lumen widens by more than this factor within the smoothed length, the rim is not judged: stents are even.
const EVEN: f64 = 1.35;

/// Struts lie just outside of the lumen (mm); the noise is read within it, at this fraction of the radius.
const OUTSIDE: f64 = 0.05;
const WITHIN: f64 = 0.4;

/// Noise of every scan at least (fraction of the contrast): without noise, a narrowing would repeat more than it.
const LEAST_NOISE: f64 = 0.012;

/// Minimum covariance between periods, and minimum variance, in variances of the noise.
const REPEATS: f64 = 0.75;
const UNEVEN: f64 = 1.7;

/// The same for the mean of all directions, in variances of its noise, and minimum share of its variance that repeats.
const RING_REPEATS: (f64, f64) = (4.5, 0.5);

/// Length (voxel sides) over which noise at the wall is shared; more values around it than this do not lower the noise of
/// their mean, as voxels themselves repeat along a wide vessel.
const SHARED: (f64, f64) = (1.7, 12.0);

/// Larger values, in standard deviations of the noise, count as this one: a single calcification does not repeat.
const LARGEST: f64 = 2.5;

/// Values (fractions of the contrast) in each direction of each section; NaN where the rim cannot be judged.
type Rings<const N: usize = RAYS> = Vec<[f64; N]>;

/// Flags sections within thin struts, which are measured only as well as those within thick ones.
pub(crate) fn flag_struts(bench: &Bench, places: &[SectionPlane], sections: &mut [Section]) {
    let side = bench.rays.voxels.sampling_side;
    if side > SIDE.0 || side > SIDE.1 * bench.fwhm {
        return;
    }
    let found = has_struts(&bench.rays, places, sections);
    for ((section, place), _) in sections.iter_mut().zip(places).zip(found).filter(|(_, has)| *has) {
        lies_in_metal(bench, place, section);
    }
}

/// Flags a section, and increases its uncertainty by that of sections whose struts are clear.
pub(super) fn lies_in_metal(bench: &Bench, place: &SectionPlane, section: &mut Section) {
    section.flags |= METAL;
    if let Some(fit) = &mut section.fit {
        let unsure = UNMODELLED_WIDTHS * bench.blur.width(place);
        fit.parts.surroundings = fit.parts.surroundings.hypot(unsure);
        fit.uncertainty = fit.parts.total();
    }
}

fn has_struts(rays: &Rays, places: &[SectionPlane], sections: &[Section]) -> Vec<bool> {
    let none = vec![false; places.len()];
    let [Some(first), Some(last)] = [places.first(), places.last()] else { return none };
    let step = (last.at - first.at) / (places.len().max(2) - 1) as f64;
    if rays.scale.contrast < 0.0 || step > STEP || step <= 0.0 {
        return none;
    }
    let count = |mm: f64| (mm / step).round() as usize;
    let walls = walls(places, sections, count(SMOOTHED));
    let [rim, core] = [(1.0, OUTSIDE), (WITHIN, 0.0)].map(|(share, more)| {
        let rings = places.iter().zip(&walls).map(|(place, wall)| {
            std::array::from_fn(|ray| {
                let Some((center, wall)) = wall else { return f64::NAN };
                let radius = wall[ray].length();
                rays.at(place, *center + wall[ray] * (share + more / radius))
            })
        });
        without_trend(&rings.collect(), count(SMOOTHED))
    });
    let Some(deviation) = deviation(&core).map(|found| found.max(LEAST_NOISE)) else { return none };
    let (noise, largest) = (deviation.powi(2), LARGEST * deviation);
    let rim: Rings = rim.into_iter().map(|ring| ring.map(|value| value.clamp(-largest, largest))).collect();
    let (means, of_mean) = (ring_means(&rim), noise / patches(&walls, SHARED.0 * rays.voxels.sampling_side));
    let repeats: Vec<bool> = (0..places.len())
        .map(|n| {
            let around = n.saturating_sub(count(COMPARED))..(n + count(COMPARED) + 1).min(places.len());
            let variance = covariance(&rim, around.clone(), 0).unwrap_or(0.0);
            let variance_of_mean = covariance(&means, around.clone(), 0).unwrap_or(f64::INFINITY);
            let ring = repetition(&means, around.clone(), PERIODS.map(count));
            let is_uneven = variance > UNEVEN * noise;
            is_uneven && repetition(&rim, around, PERIODS.map(count)) > REPEATS * noise
                || ring > (RING_REPEATS.0 * of_mean).max(RING_REPEATS.1 * variance_of_mean)
        })
        .collect();
    let reach = count(FLAGGED);
    let near = |n: usize| n.saturating_sub(reach)..(n + reach + 1).min(repeats.len());
    (0..places.len()).map(|n| repeats[near(n)].iter().any(|repeats| *repeats)).collect()
}

/// Centre of each section, and the wall from it in each direction (mm): medians over neighbouring sections.
fn walls(places: &[SectionPlane], sections: &[Section], reach: usize) -> Vec<Option<(DVec2, [DVec2; RAYS])>> {
    let is_judged = |n: &usize| {
        let section = &sections[*n];
        section.flags & OTHER_RIM == 0 && section.contour.len() == RAYS && section.fit.is_some()
    };
    let middle = |mut values: Vec<f64>| median(&mut values).unwrap_or(f64::NAN);
    (0..places.len())
        .map(|n| {
            let window = n.saturating_sub(reach)..(n + reach + 1).min(places.len());
            let near: Vec<usize> = window.clone().filter(is_judged).collect();
            if !near.contains(&n) || !is_even(&sections[window]) {
                return None;
            }
            let centers = near.iter().filter_map(|m| Some(center(&places[*m], sections[*m].fit.as_ref()?)));
            let [x, y, _] =
                places[n].coordinates(centers.sum::<DVec3>() / near.len() as f64 - places[n].origin);
            let own = center(&places[n], sections[n].fit.as_ref()?);
            let wall = std::array::from_fn(|ray| {
                let length = |m: &usize| {
                    let fit = sections[*m].fit.as_ref()?;
                    Some(sections[*m].contour[ray].distance(center(&places[*m], fit)))
                };
                let [right, down, _] = places[n].coordinates(sections[n].contour[ray] - own);
                let lengths = near.iter().filter_map(length).collect();
                DVec2::new(right, down).normalize_or_zero() * middle(lengths)
            });
            Some((DVec2::new(x, y), wall))
        })
        .collect()
}

/// The mean of all directions; NaN where most of them cannot be judged.
fn ring_means(rings: &Rings) -> Rings<1> {
    let mean = |ring: &[f64; RAYS]| {
        let finite: Vec<f64> = ring.iter().copied().filter(|value| value.is_finite()).collect();
        let is_ring = 2 * finite.len() > RAYS;
        [if is_ring { finite.iter().sum::<f64>() / finite.len() as f64 } else { f64::NAN }]
    };
    rings.iter().map(mean).collect()
}

/// How many values around the wall have noise of their own; it is shared over `shared` mm.
fn patches(walls: &[Option<(DVec2, [DVec2; RAYS])>], shared: f64) -> f64 {
    let radius = |wall: &[DVec2; RAYS]| wall.iter().map(|end| end.length()).sum::<f64>() / RAYS as f64;
    let mut radii: Vec<f64> = walls.iter().flatten().map(|(_, wall)| radius(wall)).collect();
    (TAU * median(&mut radii).unwrap_or(0.0) / shared).clamp(1.0, SHARED.1)
}

fn is_even(sections: &[Section]) -> bool {
    let radii = || sections.iter().filter_map(|section| Some(section.fit.as_ref()?.ellipse.mean));
    radii().fold(0.0, f64::max) <= EVEN * radii().fold(f64::INFINITY, f64::min)
}

/// Standard deviation of the values by their median, which a few outliers do not change; None if there are too few.
fn deviation(rings: &Rings) -> Option<f64> {
    let all = rings.iter().flatten().filter(|value| value.is_finite());
    let mut all: Vec<f64> = all.map(|value| value.abs()).collect();
    let is_enough = all.len() >= 8 * RAYS;
    median(&mut all).filter(|_| is_enough).map(|middle| 1.4826 * middle)
}

fn without_trend(rings: &Rings, reach: usize) -> Rings {
    (0..rings.len())
        .map(|n| {
            let near = &rings[n.saturating_sub(reach)..(n + reach + 1).min(rings.len())];
            std::array::from_fn(|ray| {
                let (mut sum, mut count) = (0.0, 0.0);
                for ring in near.iter().filter(|ring| ring[ray].is_finite()) {
                    (sum, count) = (sum + ring[ray], count + 1.0);
                }
                rings[n][ray] - sum / count
            })
        })
        .collect()
}

/// How much more the values of sections a period apart have in common than those half a period apart.
fn repetition<const N: usize>(
    rim: &Rings<N>,
    around: std::ops::Range<usize>,
    [shortest, longest]: [usize; 2],
) -> f64 {
    let last = (2 * longest + 1).min(around.len().saturating_sub(8));
    let shared: Vec<f64> =
        (0..=last).map(|apart| covariance(rim, around.clone(), apart).unwrap_or(0.0)).collect();
    let at = |apart: usize| shared.get(apart).copied().unwrap_or(0.0);
    (shortest..=longest)
        .map(|period| {
            let twice = (2 * period - 1..=2 * period + 1).map(at).fold(0.0, f64::max);
            let between = at(period / 2).max(at(period + period / 2)).max(0.0);
            f64::midpoint(at(period), twice) - between
        })
        .fold(0.0, f64::max)
}

/// Mean product of values `apart` sections from each other; None if there are too few.
fn covariance<const N: usize>(rings: &Rings<N>, around: std::ops::Range<usize>, apart: usize) -> Option<f64> {
    let (mut sum, mut count) = (0.0, 0usize);
    for n in around.start..around.end.saturating_sub(apart) {
        for ray in 0..N {
            let product = rings[n][ray] * rings[n + apart][ray];
            if product.is_finite() {
                (sum, count) = (sum + product, count + 1);
            }
        }
    }
    (count >= 8 * N).then(|| sum / count as f64)
}
