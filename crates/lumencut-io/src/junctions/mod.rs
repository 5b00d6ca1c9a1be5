//! Lines that repeat a trunk become vessels that meet at shared end points.
//!
//! Centerline tools write one line from the source to each outlet, so that the lines repeat their common
//! trunk; others write every segment as a line of its own. Here every stretch becomes one vessel, in five
//! steps:
//!
//! 1. *Weld* (`weld.rs`): points closer than 1/1000 of the median spacing are one point.
//! 2. *Segments* (`segments.rs`): where most lines are single segments, they are joined to chains.
//! 3. *Follow* (`follow.rs`): a line that begins or ends beside another line's end, without sharing points
//!    with it, and runs along it, takes that line's points as far as it stays within a tenth of the radius.
//!    For lines of one group, which their file says are one vessel, it is half the radius; where no radius is
//!    known, half the spacing and at most 0.5 mm. The stretch must be long: vessels that part at more than 6°
//!    are never merged.
//! 4. *Graph* (`graph.rs`): shared stretches are the same edges. A point is a junction where its edges do not
//!    pair off: three lines meet, one ends on another, or two end at each other. Lines that carry groups are
//!    cut at places that are no branchings; there they are joined. Two lines that cross at a point pair off
//!    and stay whole.
//! 5. Chains of edges between junctions are the vessels, in the order and direction of the lines they come
//!    from.
//!
//! Only step 3 moves points by more than the weld distance; a tree whose vessels meet at shared points stays
//! as it is.

mod follow;
mod graph;
mod ids;
mod segments;
mod weld;

use crate::centerlines::{Centerlines, Line};
use ids::{Id, MOST_POINTS};

/// Beyond this many lines step 3 is left out: it compares each line with all before it.
const MOST_LINES_TO_FOLLOW: usize = 1024;

/// A line as ids of welded points, with the radius at each.
struct Path {
    nodes: Vec<Id>,
    radius: Option<Vec<f64>>,
    group: Option<i64>,
    name: Option<String>,
}

impl Path {
    /// Drops nodes that equal the one before.
    fn drop_repeats(&mut self) {
        if let Some(radius) = &mut self.radius {
            let mut at = 0..self.nodes.len();
            radius.retain(|_| at.next().is_some_and(|i| i == 0 || self.nodes[i] != self.nodes[i - 1]));
        }
        self.nodes.dedup();
    }
}

/// The vessels that the lines (mm) of `centerlines` form, in place of the lines; end points that vessels share are
/// equal to the last bit. A note tells how many lines became how many vessels where that changed anything.
///
/// Lines that their file says are vessels already stay as they are.
///
/// Vessels keep the name of the first line they come from; several vessels may have one name.
#[must_use]
pub fn vessels(centerlines: Centerlines) -> Centerlines {
    if centerlines.joined {
        return centerlines;
    }
    let count = centerlines.lines.len();
    let spacing = median_spacing(&centerlines.lines);
    let points: usize = centerlines.lines.iter().map(|line| line.points.len()).sum();
    let too_many = (points > MOST_POINTS).then(|| format!("more than {MOST_POINTS} points"));
    let too_close = || "points closer together than a billionth of their coordinates".into();
    let reason = too_many.or_else(|| (!weld::resolves(&centerlines.lines, spacing)).then(too_close));
    if let Some(reason) = reason {
        let mut whole = centerlines;
        whole.notes.push(format!("{reason}: no lines were joined"));
        return whole;
    }
    let Centerlines { lines, mut notes, .. } = centerlines;
    let (points, paths) = weld::weld(lines, spacing);
    let mut paths = segments::join(&points, paths, &mut notes);
    let followed = if paths.len() <= MOST_LINES_TO_FOLLOW {
        let followed = follow::follow(&points, &mut paths, spacing);
        if !followed.whole {
            notes.push("lines near too many others were joined only at points that coincide".into());
        }
        followed.ends
    } else {
        notes
            .push(format!("of more than {MOST_LINES_TO_FOLLOW} lines only points that coincide were joined"));
        0
    };
    let vessels = graph::chains(&points, &paths);
    if vessels.len() != count || followed > 0 {
        notes
            .push(format!("{count} line(s) form {} vessel(s) that meet at shared end points", vessels.len()));
    }
    if followed > 0 {
        notes.push(format!("{followed} line end(s) that ran closely along another line were joined to it"));
    }
    Centerlines { lines: vessels, notes, ..centerlines }
}

/// The median distance between neighbouring points (mm).
fn median_spacing(lines: &[Line]) -> f64 {
    let mut steps = Vec::with_capacity(lines.iter().map(|line| line.points.len() - 1).sum());
    for line in lines {
        steps.extend(line.points.windows(2).map(|pair| pair[0].distance(pair[1])));
    }
    if steps.is_empty() {
        return 0.0;
    }
    let middle = steps.len() / 2;
    *steps.select_nth_unstable_by(middle, f64::total_cmp).1
}
