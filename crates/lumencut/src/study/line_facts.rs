//! What a reader tidies vessels by: how long and how wide each one is, which hang together, and which one hangs on which.

use lumencut_core::math::arc_length::arc_lengths;
use lumencut_core::math::statistics::median;
use serde::Serialize;

use crate::parts::{parents, parts};
use crate::study::failure::Result;
use crate::study::lines::Line;
use crate::study::open_study::Study;

/// What is known of a line among others.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct LineFacts {
    /// The number of the line.
    pub line: usize,
    /// mm
    pub length: f64,
    /// The median diameter of its points (mm); null where no radius is known.
    pub(crate) calibre: Option<f64>,
    /// Which of the parts that hang together it belongs to; 0 is the longest.
    pub part: usize,
    /// The line among them that it hangs on, as a branch on its trunk; null for the widest line of a part.
    pub parent: Option<usize>,
}

impl Study {
    /// What is known of lines, in their order; parts are those of these lines alone.
    ///
    /// # Errors
    /// `vessel tree` for the number of no line.
    pub(crate) fn line_facts(&self, numbers: &[usize]) -> Result<Vec<LineFacts>> {
        let lines = numbers.iter().map(|number| self.lines.get(*number)).collect::<Result<Vec<_>>>()?;
        let points: Vec<_> = lines.iter().map(|line| &line.points[..]).collect();
        let mut part_of = vec![0; lines.len()];
        for (rank, part) in parts(&points).into_iter().enumerate() {
            part.into_iter().for_each(|line| part_of[line] = rank);
        }
        let widths: Vec<Option<f64>> = lines.iter().map(|line| calibre(line)).collect();
        let parents = parents(&points, &widths);
        let fact = |n: usize| LineFacts {
            line: numbers[n],
            length: arc_lengths(&lines[n].points).last().copied().unwrap_or_default(),
            calibre: widths[n],
            part: part_of[n],
            parent: parents[n].map(|parent| numbers[parent]),
        };
        Ok((0..lines.len()).map(fact).collect())
    }
}

/// The median diameter of a line (mm), where it has one.
fn calibre(line: &Line) -> Option<f64> {
    let mut known: Vec<f64> = line.radius.iter().flatten().copied().filter(|radius| *radius > 0.0).collect();
    median(&mut known).map(|radius| 2.0 * radius)
}
