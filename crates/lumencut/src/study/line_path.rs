//! Joins several connected lines into one path.

use lumencut_core::error::{Error, ErrorKind, Result};

use crate::study::line_edits::{Knot, MEETING, followed, knots, with_knots};
use crate::study::lines::Line;
use crate::text::rounded;

/// Where two lines are nearest: a point index on each line (at least one of them is an end), and the distance (mm).
#[derive(Clone, Copy, Debug, PartialEq)]
struct Meeting {
    on: [usize; 2],
    apart: f64,
}

/// A path through lines in order, whichever way each line runs. If a line is met between its ends, the path follows
/// it from or to that point. The path starts at the first line's first point. If it enters the last line between its
/// ends, it ends at that line's first point. Errors name the lines by `words`. Fails with an error of kind `vessel
/// tree` if neighbours are farther apart than `MEETING`.
pub fn path(lines: &[Line], words: &[String]) -> Result<Line> {
    let all: Vec<Vec<Knot>> = lines.iter().map(knots).collect();
    let mut joined: Vec<Knot> = Vec::new();
    let mut entry = None;
    for (n, line) in all.iter().enumerate() {
        let last = line.len() - 1;
        let (exit, next) = match all.get(n + 1) {
            None => (entry.map_or(last, |entry| if entry == 0 { last } else { 0 }), None),
            Some(other) => {
                let Meeting { on: [exit, next], apart } = meeting(line, other, entry);
                if apart > MEETING {
                    return Err(gap([&words[n], &words[n + 1]], apart));
                }
                (exit, Some(next))
            }
        };
        let start = entry.unwrap_or(if exit == 0 { last } else { 0 });
        let stretch = stretch(line, start, exit);
        joined = if joined.is_empty() { stretch } else { followed(joined, &stretch) };
        entry = next;
    }
    let known = |is_known: fn(&Line) -> bool| lines.iter().all(is_known);
    let like = Line {
        points: Vec::new(),
        radius: known(|line| line.radius.is_some()).then(Vec::new),
        confidence: known(|line| line.confidence.is_some()).then(Vec::new),
        bridged: known(|line| line.bridged.is_some()).then(Vec::new),
        by_hand: lines.iter().any(|line| line.by_hand.is_some()).then(Vec::new),
    };
    Ok(with_knots(&joined, &like))
}

/// The points at which the path leaves `line`, which it entered at `entry` (if any), for the other line. It tries end to end, then
/// any point to the other's end, then its own end to any point. The first meeting that is near enough is used, else the nearest.
fn meeting(line: &[Knot], other: &[Knot], entry: Option<usize>) -> Meeting {
    let last = line.len() - 1;
    // A line that was entered at one end is followed to its other end.
    let ends = match entry {
        Some(0) => vec![last],
        Some(entry) if entry == last => vec![0],
        _ => vec![last, 0],
    };
    let other_ends = [0, other.len() - 1];
    let points: Vec<usize> = (0..=last).filter(|n| Some(*n) != entry).collect();
    let other_points: Vec<usize> = (0..other.len()).collect();
    let ways = [
        nearest(line, other, &ends, &other_ends),
        nearest(line, other, &points, &other_ends),
        nearest(line, other, &ends, &other_points),
    ];
    let nearest = |a: Meeting, b: Meeting| if b.apart < a.apart { b } else { a };
    ways.into_iter()
        .find(|way| way.apart <= MEETING)
        .unwrap_or_else(|| ways.into_iter().fold(ways[0], nearest))
}

/// The nearest pair of the given points; of equal pairs, the first.
fn nearest(line: &[Knot], other: &[Knot], points: &[usize], other_points: &[usize]) -> Meeting {
    let pairs = points.iter().flat_map(|a| other_points.iter().map(|b| [*a, *b]));
    let meetings = pairs.map(|[a, b]| Meeting { on: [a, b], apart: line[a].point.distance(other[b].point) });
    let none = Meeting { on: [points[0], other_points[0]], apart: f64::INFINITY };
    meetings.fold(none, |best, one| if one.apart < best.apart { one } else { best })
}

fn stretch(line: &[Knot], from: usize, to: usize) -> Vec<Knot> {
    let mut knots = line[from.min(to)..=from.max(to)].to_vec();
    if to < from {
        knots.reverse();
    }
    knots
}

fn gap([one, other]: [&String; 2], apart: f64) -> Error {
    let found = format!("a gap of {} mm between {one} and {other}", rounded(apart, 4));
    let expected = format!("vessels in order along the path, each at most {MEETING} mm from the next");
    Error::new(ErrorKind::VesselTree, "path through the tree", found, expected)
}
