//! Splits a run (line of a vessel) into sure and doubtful vessels if these parts are long enough.

use crate::trace::find::found::{FoundVessel, SURE};
use crate::trace::find::track::{Track, TrackDoubt};
use crate::trace::find::whole_vessels::centered::LinePoint;
use crate::trace::lines::centerline::Centerline;

/// Minimum length of a part that is split off: mm, and multiples of its largest radius.
const SHORTEST: f64 = 15.0;
const SHORTEST_RADII: f64 = 5.0;

pub(crate) fn vessels(tracks: &[Track], points: &[LinePoint], part: usize) -> Vec<FoundVessel> {
    let cuts = cuts(points);
    cuts.windows(2).map(|pair| vessel(tracks, &points[pair[0]..=pair[1]], part)).collect()
}

fn cuts(points: &[LinePoint]) -> Vec<usize> {
    let is_sure = |n: usize| points[n].confidence >= SURE;
    let mut cuts = vec![0];
    cuts.extend((1..points.len() - 1).filter(|n| is_sure(*n) != is_sure(n - 1)));
    cuts.push(points.len() - 1);
    // The shortest part is removed first, which merges its neighbours.
    while cuts.len() > 2 {
        let lack = |n: usize| {
            let stretch = &points[cuts[n]..=cuts[n + 1]];
            let widest = stretch.iter().map(|point| point.radius).fold(0.0, f64::max);
            length(stretch) / SHORTEST.max(SHORTEST_RADII * widest)
        };
        let shortest = (0..cuts.len() - 1).min_by(|a, b| lack(*a).total_cmp(&lack(*b)));
        let Some(shortest) = shortest.filter(|n| lack(*n) < 1.0) else { break };
        let (first, last) = (shortest.max(1), (shortest + 1).min(cuts.len() - 2));
        cuts.drain(first..=last);
    }
    cuts
}

fn vessel(tracks: &[Track], points: &[LinePoint], part: usize) -> FoundVessel {
    let confidence = mean_confidence(points);
    let line = Centerline {
        points: points.iter().map(|point| point.place).collect(),
        radius: points.iter().map(|point| point.radius).collect(),
        confidence: points.iter().map(|point| point.confidence).collect(),
    };
    let doubt = (confidence < SURE).then(|| worst_doubt(tracks, points));
    FoundVessel { line, part, confidence, doubt }
}

fn mean_confidence(points: &[LinePoint]) -> f64 {
    let sums = points.windows(2).fold([0.0, 0.0], |[sum, whole], pair| {
        let length = pair[0].place.distance(pair[1].place);
        [sum + length * f64::midpoint(pair[0].confidence, pair[1].confidence), whole + length]
    });
    if sums[1] > 0.0 { (sums[0] / sums[1]).min(1.0) } else { points[0].confidence }
}

/// Doubt of the least sure track; `Gap` if no track is doubtful.
fn worst_doubt(tracks: &[Track], points: &[LinePoint]) -> TrackDoubt {
    let doubtful = points.iter().map(|point| point.track).filter(|track| tracks[*track].doubt.is_some());
    let worst = doubtful.min_by(|a, b| {
        let [first, second] = [a, b].map(|track| tracks[*track].confidence);
        first.total_cmp(&second).then(a.cmp(b))
    });
    worst.and_then(|track| tracks[track].doubt).unwrap_or(TrackDoubt::Gap)
}

fn length(points: &[LinePoint]) -> f64 {
    points.windows(2).map(|pair| pair[0].place.distance(pair[1].place)).sum()
}
