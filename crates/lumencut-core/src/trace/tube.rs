//! Whether a line is that of a tube, and how far.

use super::path::arc_lengths;
use super::refine::Centerline;

/// From this confidence on a point lies in a tube.
const SEEN: f64 = 0.35;

/// A tube is seen over at least so much (mm), and so many of its radii, or it is none.
const LEAST_LENGTH: f64 = 2.5;
const LEAST_RADII: f64 = 1.5;

/// A tube may be hidden over so much (mm), or so many of the larger radius beside, as where branches leave or calcium lies.
const HIDDEN: f64 = 3.0;
const HIDDEN_RADII: f64 = 2.0;

/// A branch is at least so long beyond what it leaves: in mm, and in its own radii.
const SHORTEST: f64 = 3.0;
const SHORTEST_RADII: f64 = 2.0;

/// The last point of the tube that a line begins with at point `from`; none where that is no tube.
pub fn sound(line: &Centerline, from: usize, smallest_radius: f64) -> Option<usize> {
    let lengths = arc_lengths(&line.points);
    let count = lengths.len();
    let (mut end, mut next) = (None, from);
    while next < count {
        let Some(first) = (next..count).find(|n| line.confidence[*n] >= SEEN) else { break };
        let behind = (first..count).find(|n| line.confidence[*n] < SEEN).unwrap_or(count);
        let last = behind - 1;
        let before = end.unwrap_or(from);
        let widest = line.radius[before].max(line.radius[first]);
        if lengths[first] - lengths[before] > HIDDEN.max(HIDDEN_RADII * widest) {
            break;
        }
        let median = median(&line.radius[first..=last]);
        if lengths[last] - lengths[first] >= LEAST_LENGTH.max(LEAST_RADII * median) {
            end = Some(last);
        }
        next = behind;
    }
    let end = (from..=end?).rev().find(|n| line.radius[*n] >= smallest_radius)?;
    let outside = lengths[end] - lengths[from];
    (outside >= SHORTEST.max(SHORTEST_RADII * median(&line.radius[from..=end]))).then_some(end)
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    sorted[sorted.len() / 2]
}
