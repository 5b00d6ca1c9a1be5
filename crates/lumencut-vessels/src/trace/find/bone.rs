//! Bone, marrow and organs among the tracks, told from vessels on the raw voxels.
//!
//! Tracked bone is mostly a plate: its cross-section at half level is long, and so are those of the tracks around. What is
//! round bone is uneven inside, by its marrow. Both make a track doubtful, as do wide tracks that are paler than vessels.

pub mod neighbourhood;
pub mod raw_section;

use rayon::prelude::*;

use crate::trace::find::bone::neighbourhood::beside;
use crate::trace::find::bone::raw_section::RawSection;
use crate::trace::find::quantiles::{median, quantile};
use crate::trace::find::scan::Scan;
use crate::trace::find::track::{Track, TrackDoubt};
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

/// The share of a track's sections that are less elongated than the track: a low one, as junctions and veins that touch lengthen
/// single sections.
const ELONGATION_SHARE: f64 = 0.3;

/// A track counts in its neighbourhood by its length, up to so much (mm), and doubly for itself; others count from this confidence
/// on.
const LONGEST: f64 = 40.0;
const ITSELF: f64 = 2.0;
const LEAST_COUNTED: f64 = 0.3;

/// Flat neighbours make a track no more elongated than this, and so many times what it is itself beyond 1: an artery passes beside
/// and through bone.
const NEIGHBOURS: [f64; 2] = [1.5, 2.0];

/// Doubts by elongation and by spread begin at the first value and are whole after the second one more; each is at most the third.
const ELONGATED: [f64; 2] = [1.2, 0.7];
const UNEVEN: [f64; 2] = [0.14, 0.10];
const MOST_DOUBT: f64 = 3.0;

/// From the first doubt on a track loses confidence, from the second one on nothing is left.
const DOUBTS: [f64; 2] = [1.2, 1.7];

/// An organ is paler than the vessels by this part of their contrast, and has at least this radius (mm).
const PALE: f64 = 0.6;
const WIDE: f64 = 5.0;

/// How much confidence is left to an organ, and to marrow in a cortex.
const LEFT: f64 = 0.15;

/// A flat track that is otherwise the tube of a large vessel may be a lumen beside another one, as in a dissection: it keeps so much
/// confidence and remains doubtful. Before it is judged it has at least this confidence, length and radius (mm), and it is even inside.
const FLAT_LUMEN_LEFT: f64 = 0.35;
const FLAT_LUMEN: f64 = 0.85;
const FLAT_LUMEN_LENGTH: f64 = 40.0;
const FLAT_LUMEN_RADIUS: f64 = 3.0;

/// A track with less confidence is left out.
const LEAST: f64 = 0.05;

/// What the raw voxels show of a track.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Shape {
    level: f64,
    elongation: f64,
    spread: f64,
    is_marrow: bool,
}

/// The tracks with the confidence that is left to each, without those to which none is.
///
/// # Errors
/// [`lumencut_core::error::ErrorKind::Interrupted`].
pub fn judged(scan: &Scan, tracks: Vec<Track>, stop: Stop) -> Result<Vec<Track>> {
    let shapes: Vec<Option<Shape>> =
        tracks.par_iter().map(|track| shape(scan, track, stop)).collect::<Result<_>>()?;
    let counts: Vec<bool> =
        tracks.iter().zip(&shapes).map(|(t, s)| s.is_some() && t.confidence >= LEAST_COUNTED).collect();
    let neighbours = beside(&tracks, &counts, stop)?;
    let elongations: Vec<f64> = (0..tracks.len())
        .map(|number| elongation_around(&tracks, &shapes, number, &neighbours[number]))
        .collect();
    let judged = tracks.into_iter().zip(shapes).zip(elongations).map(|((mut track, shape), elongation)| {
        if let Some(shape) = shape {
            let most = NEIGHBOURS[0] + NEIGHBOURS[1] * (shape.elongation - 1.0);
            judge(scan, &mut track, Shape { elongation: elongation.min(most), ..shape });
        }
        track
    });
    Ok(judged.filter(|track| track.confidence >= LEAST).collect())
}

/// What the raw voxels show of a track; none where no section of it can be seen.
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

/// The mean elongation of a track and those beside it.
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

/// Takes from a track the confidence that it has not as a vessel.
fn judge(scan: &Scan, track: &mut Track, shape: Shape) {
    let by = |value: f64, [from, over]: [f64; 2]| ((value - from) / over).clamp(0.0, MOST_DOUBT);
    let [flat, uneven] = [by(shape.elongation, ELONGATED), by(shape.spread, UNEVEN)];
    let lost = ((flat + uneven - DOUBTS[0]) / (DOUBTS[1] - DOUBTS[0])).clamp(0.0, 1.0);
    let is_pale = (scan.level - shape.level) / scan.contrast > PALE && track.radius() > WIDE;
    if lost > 0.0 {
        track.doubt = Some(if flat >= uneven { TrackDoubt::Flat } else { TrackDoubt::Uneven });
    }
    if shape.is_marrow || is_pale {
        track.doubt = Some(if is_pale { TrackDoubt::PaleAndWide } else { TrackDoubt::Uneven });
        track.confidence *= LEFT;
    }
    let is_lumen = track.confidence >= FLAT_LUMEN
        && uneven == 0.0
        && track.radius() >= FLAT_LUMEN_RADIUS
        && track.length() >= FLAT_LUMEN_LENGTH;
    track.confidence = (track.confidence * (1.0 - lost)).max(if is_lumen { FLAT_LUMEN_LEFT } else { 0.0 });
}

#[cfg(test)]
#[path = "bone/tests/bone.rs"]
mod tests;
