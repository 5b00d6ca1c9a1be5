//! Splits point lists in which several lines follow each other without a separator.

use crate::centerlines::{Centerlines, Line};

/// Minimum length of a jump, as a multiple of the median step.
const JUMP: f64 = 20.0;
/// Minimum length of a jump relative to both neighbouring steps. A shorter jump only means sparse points.
const LOCAL_JUMP: f64 = 5.0;
/// Minimum number of points for which a median step is meaningful.
const FEWEST_POINTS: usize = 8;

impl Centerlines {
    /// Splits lines at jumps. Adds notes about the splits, and about long steps that are not jumps.
    pub(crate) fn parted_at_jumps(mut self) -> Self {
        let count = self.lines.len();
        let lines = std::mem::take(&mut self.lines);
        let mut kept = 0;
        for (list, line) in lines.into_iter().enumerate() {
            let ends = ends_at_jumps(&line, &mut kept);
            self.lines.extend(parted(line, list, ends));
        }
        let parts = self.lines.len();
        let kind = format!("steps longer than {JUMP} times the median");
        if parts > count {
            self.notes.push(format!("{count} point list(s) with {kind}: split into {parts} lines there"));
        }
        if kept > 0 {
            self.notes.push(format!("{kept} {kind} at an end or next to other long steps were not split"));
        }
        self
    }
}

/// For each part of the line, the index after its last point. `kept` counts long steps that are not jumps.
fn ends_at_jumps(line: &Line, kept: &mut usize) -> Vec<usize> {
    let whole = vec![line.points.len()];
    let steps: Vec<f64> = line.points.windows(2).map(|pair| pair[0].distance(pair[1])).collect();
    // Repeated points do not count as steps.
    let moved: Vec<usize> = (0..steps.len()).filter(|i| steps[*i] > 0.0).collect();
    if moved.len() < FEWEST_POINTS - 1 || !steps.iter().all(|step| step.is_finite()) {
        return whole;
    }
    let mut sorted: Vec<f64> = moved.iter().map(|i| steps[*i]).collect();
    let middle = sorted.len() / 2;
    let longest = JUMP * *sorted.select_nth_unstable_by(middle, f64::total_cmp).1;
    let long = |i: &usize| steps[moved[*i]] > longest;
    let is_jump = |i: &usize| {
        let beside = [i.checked_sub(1), Some(i + 1)].map(|i| i.and_then(|i| moved.get(i)));
        beside.iter().all(|at| at.is_some_and(|at| steps[moved[*i]] > LOCAL_JUMP * steps[*at]))
    };
    let (jumps, others): (Vec<usize>, Vec<usize>) = (0..moved.len()).filter(long).partition(is_jump);
    *kept += others.len();
    jumps.into_iter().map(|i| moved[i] + 1).chain(whole).collect()
}

fn parted(line: Line, list: usize, ends: Vec<usize>) -> Vec<Line> {
    if ends.len() == 1 {
        return vec![line];
    }
    let mut start = 0;
    let part = |end: usize| {
        let range = std::mem::replace(&mut start, end)..end;
        let points = line.points[range.clone()].to_vec();
        Line {
            points,
            radius: line.radius.as_ref().map(|radius| radius[range].to_vec()),
            group: line.group,
            name: line.name.clone(),
            list: Some(list),
            ..Line::default()
        }
    };
    ends.into_iter().map(part).collect()
}
