//! Sorts the points of a centerline file along the vessel, if the order is unambiguous.

use glam::DVec3;
use lumencut_io::{Centerlines, Error, Line, Result};

use crate::line_doubts::{DoubtedLine, LineDoubt, found_order, order_doubts_of};
use crate::mends::OfCenterlines;

/// How the note about a reordered line ends.
pub const REORDERED: &str = "points were reordered";

/// Sorts the points of each line along the vessel, with their radii. Lines keep their direction; a note counts the
/// moved points. A list that was split into lines at long steps becomes one line again if its points form one. Fails
/// if the order is doubtful and no unambiguous one exists; the error does not yet name the file.
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

/// The doubt about a list that was split at long steps although its points form one line.
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

fn along_given(order: Vec<usize>) -> Vec<usize> {
    let reversed: Vec<usize> = order.iter().rev().copied().collect();
    if rising(&reversed) > rising(&order) { reversed } else { order }
}

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

/// Rejects a line of doubtful order; a gap is accepted.
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
