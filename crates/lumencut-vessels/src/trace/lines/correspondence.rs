//! Finds corresponding points of two centerlines. Schaap et al., "Standardized evaluation methodology and reference
//! database for evaluating coronary artery centerline extraction algorithms", Medical Image Analysis 13(5), 2009,
//! doi:10.1016/j.media.2009.06.003. A connection joins one point of each line; the connections lead from both starts
//! to both ends. Each step advances one line by one point. Dynamic programming finds the smallest sum of lengths.

use glam::DVec3;

use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::stop::{Stop, go_on};

/// Maximum number of point pairs, which 32-bit machines can count. Each needs one bit, so all need 512 MiB.
const MOST_PAIRS: usize = usize::MAX >> (usize::BITS - 32);

const PAIRS_BETWEEN_STOPS: usize = 1 << 24;

/// Connections between two lines as pairs of point numbers, from the starts to the ends. Errors:
/// [`ErrorKind::VesselTree`] for a line without points or too many pairs; [`ErrorKind::Interrupted`].
pub fn correspondence(first: &[DVec3], second: &[DVec3], stop: Stop) -> Result<Vec<[usize; 2]>> {
    let (rows, columns) = (first.len(), second.len());
    if rows == 0 || columns == 0 || rows.saturating_mul(columns) > MOST_PAIRS {
        let found = format!("{rows} and {columns} points");
        let expected = format!("at least 1 point each, and at most {MOST_PAIRS} pairs of them");
        let error = Error::new(ErrorKind::VesselTree, "centerlines to compare", found, expected);
        return Err(error.mend("sample them at larger distances"));
    }
    let steps = cheapest_steps(first, second, stop)?;
    Ok(walked_back(&steps, rows, columns))
}

struct Steps {
    bits: Vec<u64>,
    columns: usize,
}

impl Steps {
    fn first_advanced(&self, row: usize, column: usize) -> bool {
        let place = row * self.columns + column;
        self.bits[place / 64] >> (place % 64) & 1 == 1
    }

    fn set(&mut self, row: usize, column: usize) {
        let place = row * self.columns + column;
        self.bits[place / 64] |= 1 << (place % 64);
    }
}

/// Finds the steps with the smallest sum; if two sums are equal, the first line advances.
fn cheapest_steps(first: &[DVec3], second: &[DVec3], stop: Stop) -> Result<Steps> {
    let columns = second.len();
    let mut steps = Steps { bits: vec![0; (first.len() * columns).div_ceil(64)], columns };
    let mut sums = vec![f64::INFINITY; columns];
    let rows_between_stops = (PAIRS_BETWEEN_STOPS / columns).max(1);
    for (row, point) in first.iter().enumerate() {
        if row % rows_between_stops == 0 {
            go_on(stop)?;
        }
        let mut before = if row == 0 { 0.0 } else { f64::INFINITY };
        for (column, other) in second.iter().enumerate() {
            let above = sums[column];
            if above <= before {
                steps.set(row, column);
                before = above;
            }
            before += point.distance(*other);
            sums[column] = before;
        }
    }
    Ok(steps)
}

fn walked_back(steps: &Steps, rows: usize, columns: usize) -> Vec<[usize; 2]> {
    let mut connections = Vec::with_capacity(rows + columns - 1);
    let (mut row, mut column) = (rows - 1, columns - 1);
    loop {
        connections.push([row, column]);
        if row > 0 && steps.first_advanced(row, column) {
            row -= 1;
        } else if column > 0 {
            column -= 1;
        } else {
            break;
        }
    }
    connections.reverse();
    connections
}
