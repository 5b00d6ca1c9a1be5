//! Turns lines that repeat a trunk into vessels that meet at common end points.
//!
//! Some programs write one line per outlet, each with the trunk; others write every segment. Five steps make
//! each stretch one vessel:
//!
//! 1. *Weld* (`weld.rs`): points closer than 1/1000 of the median spacing become one point.
//! 2. *Segments* (`segments.rs`): if most lines are single segments, they are joined to chains.
//! 3. *Follow* (`follow.rs`): a line that runs along another without shared points takes its points. It
//!    must be within a tenth of the radius (half of it in a group; without radius half the spacing, at most
//!    0.5 mm), over a long stretch: vessels that diverge by more than 6° are never merged.
//! 4. *Graph* (`graph.rs`): lines share the edges of shared stretches. A point is a junction unless all
//!    its edges form pairs that continue each other, as where lines cross. Lines of a group, which are also
//!    cut at other places, are joined there.
//! 5. Chains between junctions are the vessels, in the order and direction of their lines.
//!
//! Only step 3 moves points by more than the distance of step 1. A tree whose vessels already meet at shared
//! points stays unchanged.

mod follow;
mod graph;
mod ids;
mod segments;
mod weld;

use crate::centerlines::{Centerlines, Line};
use ids::{Id, MOST_POINTS};

/// With more lines than this, step 3 is skipped, because it compares all pairs of lines.
const MOST_LINES_TO_FOLLOW: usize = 1024;

struct Path {
    nodes: Vec<Id>,
    radius: Option<Vec<f64>>,
    group: Option<i64>,
    name: Option<String>,
}

impl Path {
    fn drop_repeats(&mut self) {
        if let Some(radius) = &mut self.radius {
            let mut at = 0..self.nodes.len();
            radius.retain(|_| at.next().is_some_and(|i| i == 0 || self.nodes[i] != self.nodes[i - 1]));
        }
        self.nodes.dedup();
    }
}

/// Vessels that the lines (mm) form, with bit-identical end points where they meet, and a note of each change. Lines
/// that the file marks as vessels stay unchanged. A vessel has the name of its first line, so names may repeat.
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
            notes.push("lines near too many others were joined only at coincident points".into());
        }
        followed.ends
    } else {
        notes.push(format!("more than {MOST_LINES_TO_FOLLOW} lines: only coincident points were joined"));
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
