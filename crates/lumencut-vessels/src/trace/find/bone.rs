//! Separates vessels from bone, marrow and organs by the raw voxels along tracks (centerlines of tubes). Tracked bone
//! is mostly a plate: its cross-section is elongated, and so are those of the tracks around it. Round bone contains
//! uneven marrow. Both make a track doubtful, and so does being wide and paler than vessels.

pub(crate) mod neighbourhood;
pub(crate) mod raw_section;

use rayon::prelude::*;

use crate::trace::find::bone::neighbourhood::beside;
use crate::trace::find::bone::raw_section::RawSection;
use crate::trace::find::confidence::ramp;
use crate::trace::find::progress::{Stage, Stages};
use crate::trace::find::quantiles::{median, quantile};
use crate::trace::find::scan::Scan;
use crate::trace::find::track::{Track, TrackDoubt, TrackPoint};
use crate::trace::find::vessel_level::{Readings, vessel_level};
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

/// A track's elongation is this quantile of its sections: junctions and touching veins lengthen single ones.
const ELONGATION_SHARE: f64 = 0.3;

/// Weights of a track and its neighbours in their mean elongation: the length, at most `LONGEST` mm, and for
/// the track itself `ITSELF` times as much. Tracks with less confidence than `LEAST_COUNTED` are ignored.
const LONGEST: f64 = 40.0;
const ITSELF: f64 = 2.0;
const LEAST_COUNTED: f64 = 0.3;

/// Neighbours raise an elongation e to at most 1.5 + 2 (e - 1), so that round arteries next to bone are kept.
const NEIGHBOURS: [f64; 2] = [1.5, 2.0];

/// For `ELONGATED` and `UNEVEN`: value at which the doubt starts, and increase of the value that adds 1 to
/// the doubt. Each doubt is limited to `MOST_DOUBT`.
const ELONGATED: [f64; 2] = [1.2, 0.7];
const UNEVEN: [f64; 2] = [0.14, 0.10];
const MOST_DOUBT: f64 = 3.0;

/// Sums of both doubts at which confidence starts to fall, and at which it reaches 0.
const DOUBTS: [f64; 2] = [1.2, 1.7];

/// An organ is darker than vessels by these fractions of the contrast (possibly, certainly), and its radius
/// is at least `WIDE_MM`. From the radius of a vertebra on, smaller fractions suffice.
const PALE: [f64; 2] = [0.45, 0.55];
const WIDE_MM: f64 = 5.0;
const PALE_AND_VERY_WIDE: [f64; 2] = [0.2, 0.3];
const VERY_WIDE: f64 = 14.0;

/// Fractions of good sections at which a wide track counts as interrupted, and as uninterrupted; noise does not hide
/// the walls of a wide lumen. `BROAD` is the range of radii (voxels) over which a track becomes wide.
const UNBROKEN: [f64; 2] = [0.75, 0.95];
const BROAD: [f64; 2] = [2.5, 5.5];

/// The confidence of organs, and of marrow inside compact bone, is multiplied by this.
const LEFT: f64 = 0.15;

/// A flat track that otherwise looks like a large vessel may be the false lumen of a dissection. It keeps
/// this confidence if its previous confidence, its length and its radius (mm) reach the limits.
const FLAT_LUMEN_LEFT: f64 = 0.35;
const FLAT_LUMEN: f64 = 0.85;
const FLAT_LUMEN_LENGTH: f64 = 40.0;
const FLAT_LUMEN_RADIUS: f64 = 3.0;

/// Tracks that are even and as bright as vessels are excused, because bone is hardly ever both. The excuse starts at
/// the first value and is full at the second: spread, level difference (fractions of the contrast), radius (voxels).
const EVEN: [f64; 2] = [0.10, 0.06];
const ALIKE: [f64; 2] = [0.18, 0.10];
const SEEN: [f64; 2] = [2.0, 4.0];

/// Above this radius (mm), a track must also be round to be excused: bodies of even tissue are not round.
const ROUND: f64 = 7.0;
const ELONGATED_BODY: [f64; 2] = [1.9, 1.5];

/// Limits of the tracks that are used to refine the vessel level.
const LUMEN_CONFIDENCE: f64 = 0.85;
const LUMEN_ELONGATION: f64 = 1.25;
const LUMEN_SPREAD: f64 = 0.1;

/// Fraction of the doubts (except shortness) that are ignored for an even track as bright as vessels.
const EXCUSED: f64 = 0.5;

/// Tracks with less confidence than this are dropped.
const MIN_CONFIDENCE: f64 = 0.05;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shape {
    level: f64,
    /// Ratio of the longest diameter to the shortest, both at half of the lumen's contrast.
    pub(crate) elongation: f64,
    /// Spread of the values inside the track, as a fraction of the vessel contrast.
    spread: f64,
    is_marrow: bool,
}

#[cfg(test)]
impl Shape {
    pub fn even(elongation: f64) -> Self {
        Self { level: 300.0, elongation, spread: 0.0, is_marrow: false }
    }
}

/// Shape of each track; None if none of its sections is visible.
pub(crate) fn shapes(
    scan: &Scan,
    tracks: &[Track],
    stop: Stop,
    stages: Stages,
) -> Result<Vec<Option<Shape>>> {
    let pieces = stages.stage(Stage::Judgement, tracks.len());
    let of_track = |track| {
        let shape = shape(scan, track, stop)?;
        pieces.done(1);
        Ok(shape)
    };
    tracks.par_iter().map(of_track).collect()
}

/// The level of the vessels: that of sure, round, even tracks if possible, because the first estimate includes bone.
pub(crate) fn readings(scan: &Scan, tracks: &[Track], shapes: &[Option<Shape>]) -> Readings {
    let first = [scan.level, scan.contrast];
    let Some(second) = lumen_level(scan, tracks, shapes) else {
        return Readings { usual: first, other: None };
    };
    Readings::of(first, second, &in_voxels(scan, tracks.iter()), scan.noise)
}

fn lumen_level(scan: &Scan, tracks: &[Track], shapes: &[Option<Shape>]) -> Option<[f64; 2]> {
    let is_lumen = |track: &Track, shape: &Shape| {
        let is_even = !shape.is_marrow && shape.spread <= LUMEN_SPREAD;
        track.confidence >= LUMEN_CONFIDENCE && shape.elongation <= LUMEN_ELONGATION && is_even
    };
    let with_shape = tracks.iter().zip(shapes).filter_map(|(track, shape)| Some((track, shape.as_ref()?)));
    let lumens = with_shape.filter(|(track, shape)| is_lumen(track, shape)).map(|(track, _)| track);
    vessel_level(&in_voxels(scan, lumens), scan.noise).map(|found| found.level)
}

/// The points of tracks, in voxels instead of mm.
fn in_voxels<'t>(scan: &Scan, tracks: impl Iterator<Item = &'t Track>) -> Vec<Vec<TrackPoint>> {
    let point = |point: &TrackPoint| TrackPoint {
        place: point.place / scan.side,
        radius: point.radius / scan.side,
        ..*point
    };
    tracks.map(|track| track.points.iter().map(point).collect()).collect()
}

pub(crate) fn judged(
    scan: &Scan,
    tracks: Vec<Track>,
    shapes: &[Option<Shape>],
    stop: Stop,
) -> Result<Vec<Track>> {
    let counts: Vec<bool> =
        tracks.iter().zip(shapes).map(|(t, s)| s.is_some() && t.confidence >= LEAST_COUNTED).collect();
    let neighbours = beside(&tracks, &counts, stop)?;
    let elongations: Vec<f64> = (0..tracks.len())
        .map(|number| elongation_around(&tracks, shapes, number, &neighbours[number]))
        .collect();
    let judged = tracks.into_iter().zip(shapes).zip(elongations).map(|((mut track, shape), elongation)| {
        if let Some(shape) = shape {
            let most = NEIGHBOURS[0] + NEIGHBOURS[1] * (shape.elongation - 1.0);
            judge(scan, &mut track, Shape { elongation: elongation.min(most), ..*shape });
        }
        track
    });
    Ok(judged.collect())
}

pub(crate) fn left(tracks: Vec<Track>) -> Vec<Track> {
    tracks.into_iter().filter(|track| track.confidence >= MIN_CONFIDENCE).collect()
}

fn shape(scan: &Scan, track: &Track, stop: Stop) -> Result<Option<Shape>> {
    let section = |point| {
        go_on(stop)?;
        Ok(RawSection::at(scan, point))
    };
    let seen = track.points.par_iter().filter(|point| point.is_good).map(section);
    let sections: Vec<RawSection> = seen.collect::<Result<Vec<_>>>()?.into_iter().flatten().collect();
    let values = |of: fn(&RawSection) -> f64| sections.iter().map(of).collect::<Vec<f64>>();
    let marrow = sections.iter().filter(|section| section.is_marrow).count();
    Ok(median(&mut values(|section| section.level)).map(|level| Shape {
        level,
        elongation: quantile(&mut values(|section| section.elongation), ELONGATION_SHARE).unwrap_or(1.0),
        spread: median(&mut values(|section| section.spread)).unwrap_or(0.0),
        is_marrow: 2 * marrow > sections.len(),
    }))
}

fn elongation_around(tracks: &[Track], shapes: &[Option<Shape>], number: usize, beside: &[usize]) -> f64 {
    let with_weight = |n: usize, times: f64| {
        let shape = shapes[n]?;
        let weight = times * tracks[n].length().min(LONGEST);
        Some([weight * shape.elongation, weight])
    };
    let all = std::iter::once((number, ITSELF)).chain(beside.iter().map(|n| (*n, 1.0)));
    let weighted = all.filter_map(|(n, times)| with_weight(n, times));
    let [sum, weights] = weighted.fold([0.0, 0.0], |[a, b], [c, d]| [a + c, b + d]);
    if weights > 0.0 { sum / weights } else { 1.0 }
}

fn judge(scan: &Scan, track: &mut Track, shape: Shape) {
    let by = |value: f64, [from, over]: [f64; 2]| ((value - from) / over).clamp(0.0, MOST_DOUBT);
    let inside = lumen_inside(scan, track, &shape);
    let [flat, uneven] = [by(shape.elongation, ELONGATED) * (1.0 - inside), by(shape.spread, UNEVEN)];
    let lost = ((flat + uneven - DOUBTS[0]) / (DOUBTS[1] - DOUBTS[0])).clamp(0.0, 1.0);
    let limits = [(VERY_WIDE, PALE_AND_VERY_WIDE), (WIDE_MM, PALE)];
    let limits = limits.into_iter().find(|(radius, _)| track.radius() > *radius);
    let pale = limits
        .map_or(0.0, |(_, limits)| ramp((scan.level - shape.level) / scan.contrast, limits[0], limits[1]));
    if lost > 0.0 {
        track.doubt = Some(if flat >= uneven { TrackDoubt::Flat } else { TrackDoubt::Uneven });
    }
    if shape.is_marrow || pale > 0.0 {
        track.doubt = Some(if pale > 0.0 { TrackDoubt::PaleAndWide } else { TrackDoubt::Uneven });
        track.confidence *= if shape.is_marrow { LEFT } else { 1.0 - pale * (1.0 - LEFT) };
    }
    let whole = 1.0 - broken(scan, track) * (1.0 - LEFT);
    if whole < track.confidence && lost == 0.0 {
        track.doubt = Some(TrackDoubt::Open);
    }
    track.confidence *= whole;
    let excused = if track.doubt == Some(TrackDoubt::Short) { 0.0 } else { EXCUSED * inside };
    track.confidence = track.confidence.powf(1.0 - excused);
    let is_lumen = track.confidence >= FLAT_LUMEN
        && uneven == 0.0
        && track.radius() >= FLAT_LUMEN_RADIUS
        && track.length() >= FLAT_LUMEN_LENGTH;
    track.confidence = (track.confidence * (1.0 - lost)).max(if is_lumen { FLAT_LUMEN_LEFT } else { 0.0 });
}

/// Degree (0 to 1) to which a wide track is interrupted. A spine is not a tube between its vertebrae.
fn broken(scan: &Scan, track: &Track) -> f64 {
    let good = track.points.iter().filter(|point| point.is_good).count() as f64 / track.points.len() as f64;
    ramp(-good, -UNBROKEN[1], -UNBROKEN[0]) * ramp(track.radius() / scan.side, BROAD[0], BROAD[1])
}

/// Degree (0 to 1) to which the inside looks like a vessel: even, as bright as vessels, and wide enough.
fn lumen_inside(scan: &Scan, track: &Track, shape: &Shape) -> f64 {
    if shape.is_marrow || track.doubt == Some(TrackDoubt::Faint) {
        return 0.0;
    }
    let ramp = |value: f64, [none, whole]: [f64; 2]| ramp(value, none, whole);
    let away = (shape.level - scan.level).abs() / scan.contrast;
    let round = if track.radius() > ROUND { ramp(shape.elongation, ELONGATED_BODY) } else { 1.0 };
    round * ramp(shape.spread, EVEN) * ramp(away, ALIKE) * ramp(track.radius() / scan.side, SEEN)
}

#[cfg(test)]
#[path = "bone/tests/bone.rs"]
mod tests;
