//! Lists of points that hold several lines one behind the other, with nothing between them.

use crate::centerlines::{Centerlines, Line};

/// A step this many times as long as the median leads to the next line: no vessel runs there.
const JUMP: f64 = 20.0;
/// Fewer points do not tell what step is usual.
const FEWEST_POINTS: usize = 8;

impl Centerlines {
    /// Parts every line where it jumps, and notes it.
    pub(crate) fn parted_at_jumps(mut self) -> Self {
        let count = self.lines.len();
        let lines = std::mem::take(&mut self.lines);
        self.lines = lines.into_iter().flat_map(parted).collect();
        let parts = self.lines.len();
        if parts > count {
            let kind = format!("steps more than {JUMP} times as long as the usual one");
            self.notes
                .push(format!("{count} list(s) of points with {kind}: parted into {parts} lines there"));
        }
        self
    }
}

fn parted(line: Line) -> Vec<Line> {
    let steps: Vec<f64> = line.points.windows(2).map(|pair| pair[0].distance(pair[1])).collect();
    let mut moved: Vec<f64> = steps.iter().copied().filter(|step| *step > 0.0).collect();
    if moved.len() < FEWEST_POINTS - 1 || !moved.iter().all(|step| step.is_finite()) {
        return vec![line];
    }
    let middle = moved.len() / 2;
    let longest = JUMP * *moved.select_nth_unstable_by(middle, f64::total_cmp).1;
    let mut ends: Vec<usize> = (0..steps.len()).filter(|i| steps[*i] > longest).map(|i| i + 1).collect();
    ends.push(line.points.len());
    let mut start = 0;
    let part = |end: usize| {
        let range = std::mem::replace(&mut start, end)..end;
        let points = line.points[range.clone()].to_vec();
        Line {
            points,
            radius: line.radius.as_ref().map(|radius| radius[range].to_vec()),
            group: line.group,
            name: line.name.clone(),
        }
    };
    ends.into_iter().map(part).collect()
}
