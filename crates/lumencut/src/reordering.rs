//! Points of a centerline file put into their order along the vessel, where it is found without doubt.

use glam::DVec3;
use lumencut_io::{Centerlines, Error, Line, Result};

use crate::line_doubts::{DoubtedLine, LineDoubt, found_order, order_doubts_of};
use crate::mends::OfCenterlines;

/// How the note ends that says of a line that its points were moved.
pub const REORDERED: &str = "points were reordered";

/// The lines of a file with their points in the order along the vessel; radii keep to their points, and each line keeps the
/// direction that is nearest to the given order. A note says how many points were moved.
///
/// Lists of points that were parted at long steps become one line again where their points form one.
///
/// # Errors
/// Without the file's name, where the order of a line is doubtful and no other is found without doubt.
pub fn in_order(mut lines: Centerlines) -> Result<Centerlines> {
    let given = std::mem::take(&mut lines.lines);
    for (number, line) in rejoined(&given).into_iter().enumerate() {
        let order = found_order(&line.points).map(along_given);
        match order {
            Some(order) => {
                let moved = order.len() - rising(&order).max(1);
                if moved > 0 {
                    let called = line.name.clone().unwrap_or_else(|| format!("line {number}"));
                    let count = order.len();
                    lines.notes.push(format!("{called}: {moved} of {count} {REORDERED}"));
                }
                lines.lines.push(sorted(line, &order));
            }
            None => {
                refuse_doubtful(number, &line)?;
                lines.lines.push(line);
            }
        }
    }
    Ok(lines)
}

/// What is doubtful where a list of points was parted at long steps, although its points form one line in another order.
pub fn parted_doubt(lines: &Centerlines) -> Option<LineDoubt> {
    let joined = rejoined(&lines.lines);
    let vessel = (0..joined.len()).find(|n| joined[*n].points.len() != lines.lines[*n].points.len())?;
    let parts = lines.lines.len() - joined.len() + 1;
    Some(LineDoubt {
        vessel,
        other: None,
        kind: "order",
        found: format!(
            "a list of points was split into {parts} lines at long steps: perhaps it is one line in the wrong order"
        ),
        advice: "sort its points along the vessel",
        mend: Some(OfCenterlines::Reorder.into()),
    })
}

/// The lines, of which those that one list of points was parted into are one where its points form one line.
fn rejoined(lines: &[Line]) -> Vec<Line> {
    let mut joined: Vec<Line> = Vec::with_capacity(lines.len());
    let mut from = 0;
    while from < lines.len() {
        let list = lines[from].list;
        let count =
            lines[from..].iter().take_while(|line| list.is_some() && line.list == list).count().max(1);
        let parts = &lines[from..from + count];
        let whole = (count > 1).then(|| one_of(parts)).filter(|line| found_order(&line.points).is_some());
        match whole {
            Some(line) => joined.push(line),
            None => joined.extend(parts.iter().cloned()),
        }
        from += count;
    }
    joined
}

/// Several lines as one.
fn one_of(parts: &[Line]) -> Line {
    let has_radius = parts.iter().all(|line| line.radius.is_some());
    Line {
        points: parts.iter().flat_map(|line| line.points.iter().copied()).collect(),
        radius: has_radius
            .then(|| parts.iter().flat_map(|line| line.radius.iter().flatten()).copied().collect()),
        list: None,
        ..parts[0].clone()
    }
}

/// An order or its reverse, whichever leaves more points as they were given.
fn along_given(order: Vec<usize>) -> Vec<usize> {
    let reversed: Vec<usize> = order.iter().rev().copied().collect();
    if rising(&reversed) > rising(&order) { reversed } else { order }
}

/// The length of the longest series of rising numbers in their order.
fn rising(numbers: &[usize]) -> usize {
    let mut lowest_ends: Vec<usize> = Vec::new();
    for number in numbers {
        let place = lowest_ends.partition_point(|end| end < number);
        match lowest_ends.get_mut(place) {
            Some(end) => *end = *number,
            None => lowest_ends.push(*number),
        }
    }
    lowest_ends.len()
}

fn sorted(line: Line, order: &[usize]) -> Line {
    let values = |values: Vec<f64>| order.iter().map(|n| values[*n]).collect();
    let points: Vec<DVec3> = order.iter().map(|n| line.points[*n]).collect();
    Line { points, radius: line.radius.map(values), confidence: line.confidence.map(values), ..line }
}

/// Refuses a line whose order is doubtful; one with a gap alone may be in order.
fn refuse_doubtful(number: usize, line: &Line) -> Result<()> {
    let name = line.name.as_deref().unwrap_or_default();
    let looked_at = DoubtedLine { points: &line.points, radius: None, name };
    let doubt = order_doubts_of(&[looked_at]).into_iter().find(|doubt| doubt.kind != "gap");
    let Some(doubt) = doubt else { return Ok(()) };
    let subject =
        if name.is_empty() { format!("points of line {number}") } else { format!("points of {name}") };
    let expected = "points along one line, each nearest to its neighbours";
    let error = Error::new(subject, format!("no unambiguous order: {}", doubt.found), expected);
    Err(error.mend(doubt.advice))
}

#[cfg(test)]
#[path = "tests/reordering.rs"]
mod tests;
