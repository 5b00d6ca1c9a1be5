//! Connected components, found by runs of cells along rows: cavities in the lumen, and pieces of lumen.

use crate::trace::skeleton::foreground::{BACKGROUND, Foreground, LUMEN};
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

struct Run {
    start: u32,
    end: u32,
    parent: u32,
}

struct Runs {
    runs: Vec<Run>,
    /// Index of the first run of each row; last, the number of runs.
    first_of_row: Vec<u32>,
}

/// Fills background that no faces connect to the outside; returns the number of cavities and of their cells.
pub(crate) fn fill_cavities(foreground: &mut Foreground, stop: Stop) -> Result<[usize; 2]> {
    let mut runs = Runs::of(foreground, BACKGROUND, 0, stop)?;
    // The border is background, so the first run of cells belongs to the outside.
    let outside = runs.root(0);
    let (mut cavities, mut cells) = (0, 0);
    for row in 0..runs.first_of_row.len() - 1 {
        for number in runs.first_of_row[row]..runs.first_of_row[row + 1] {
            let root = runs.root(number);
            if root == outside {
                continue;
            }
            cavities += usize::from(root == number);
            let Run { start, end, .. } = runs.runs[number as usize];
            let place = row * foreground.size[0];
            foreground.cells[place + start as usize..place + end as usize].fill(LUMEN);
            cells += (end - start) as usize;
        }
    }
    Ok([cavities, cells])
}

/// Number of the 26-connected components of lumen.
pub(crate) fn pieces(foreground: &Foreground, stop: Stop) -> Result<usize> {
    let mut runs = Runs::of(foreground, LUMEN, 1, stop)?;
    Ok((0..runs.runs.len() as u32).filter(|&number| runs.root(number) == number).count())
}

impl Runs {
    /// With a `reach` of 0, cells are connected by faces; with 1, also by edges and corners.
    fn of(foreground: &Foreground, value: u8, reach: u32, stop: Stop) -> Result<Self> {
        let [_, nj, nk] = foreground.size;
        let mut all = Self { runs: Vec::new(), first_of_row: vec![0] };
        for row in 0..nj * nk {
            if row % 4096 == 0 {
                go_on(stop)?;
            }
            all.add_row(&foreground.cells[foreground.row(row)], value);
            let (j, k) = (row % nj, row / nj);
            if j > 0 {
                all.join(row - 1, row, reach);
            }
            if k > 0 {
                for other in j.saturating_sub(reach as usize)..=(j + reach as usize).min(nj - 1) {
                    all.join((k - 1) * nj + other, row, reach);
                }
            }
        }
        Ok(all)
    }

    fn add_row(&mut self, cells: &[u8], value: u8) {
        let mut start = 0;
        while let Some(skipped) = cells[start..].iter().position(|&cell| cell == value) {
            start += skipped;
            let length = cells[start..].iter().position(|&cell| cell != value);
            let end = length.map_or(cells.len(), |length| start + length);
            let parent = self.runs.len() as u32;
            self.runs.push(Run { start: start as u32, end: end as u32, parent });
            start = end;
        }
        self.first_of_row.push(self.runs.len() as u32);
    }

    fn join(&mut self, before: usize, row: usize, reach: u32) {
        let (mut a, end_a) = (self.first_of_row[before], self.first_of_row[before + 1]);
        let (mut b, end_b) = (self.first_of_row[row], self.first_of_row[row + 1]);
        while a < end_a && b < end_b {
            let (one, other) = (&self.runs[a as usize], &self.runs[b as usize]);
            let touch = one.start < other.end + reach && other.start < one.end + reach;
            let one_ends_first = one.end < other.end;
            if touch {
                let (one, other) = (self.root(a), self.root(b));
                self.runs[one.max(other) as usize].parent = one.min(other);
            }
            if one_ends_first { a += 1 } else { b += 1 }
        }
    }

    fn root(&mut self, number: u32) -> u32 {
        let mut root = number;
        while self.runs[root as usize].parent != root {
            let parent = self.runs[root as usize].parent;
            self.runs[root as usize].parent = self.runs[parent as usize].parent;
            root = self.runs[root as usize].parent;
        }
        root
    }
}
