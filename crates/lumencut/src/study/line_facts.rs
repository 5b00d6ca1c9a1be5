//! Facts by which users sort and clean up vessels: length, calibre, connected part and parent.

use lumencut_core::math::arc_length::arc_lengths;
use lumencut_core::math::statistics::median;
use serde::Serialize;

use crate::parts::{parents, parts};
use crate::study::failure::Result;
use crate::study::lines::Line;
use crate::study::open_study::Study;

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct LineFacts {
    pub line: usize,
    pub length: f64,
    /// Median diameter (mm); null if no radius is known.
    pub(crate) calibre: Option<f64>,
    /// Index of the connected part that contains the line; 0 is the longest part.
    pub part: usize,
    /// The line from which this line branches; null for the widest line of a part.
    pub parent: Option<usize>,
    /// The name that the rules suggest; null if they are not sure.
    pub(crate) suggested_name: Option<String>,
    /// Whether the line seems to be a vein or part of the heart.
    pub(crate) is_vein_or_heart: bool,
}

/// The length of a line (mm).
pub(super) fn length_of(line: &Line) -> f64 {
    arc_lengths(&line.points).last().copied().unwrap_or_default()
}

impl Study {
    /// Facts about lines, in order; only these lines count for the connected parts.
    pub(crate) fn line_facts(&mut self, numbers: &[usize]) -> Result<Vec<LineFacts>> {
        let lines = numbers.iter().map(|number| self.lines.get(*number)).collect::<Result<Vec<_>>>()?;
        let points: Vec<_> = lines.iter().map(|line| &line.points[..]).collect();
        let mut part_of = vec![0; lines.len()];
        for (rank, part) in parts(&points).into_iter().enumerate() {
            part.into_iter().for_each(|line| part_of[line] = rank);
        }
        let widths: Vec<Option<f64>> = lines.iter().map(|line| calibre(line)).collect();
        let parents = parents(&points, &widths);
        let radii: Vec<_> = lines.iter().map(|line| line.known_radius()).collect();
        let tubes: Vec<_> =
            points.iter().zip(&radii).map(|(line, radius)| (*line, radius.as_deref())).collect();
        let suggested = self.content.names_for(&tubes);
        let suggested = self.content.known_names.keep(numbers, suggested);
        let fact = |n: usize| LineFacts {
            line: numbers[n],
            length: length_of(&lines[n]),
            calibre: widths[n],
            part: part_of[n],
            parent: parents[n].map(|parent| numbers[parent]),
            suggested_name: suggested[n].name.clone(),
            is_vein_or_heart: suggested[n].is_vein_or_heart,
        };
        Ok((0..lines.len()).map(fact).collect())
    }
}

/// Median diameter (mm).
fn calibre(line: &Line) -> Option<f64> {
    let mut known: Vec<f64> = line.radius.iter().flatten().copied().filter(|radius| *radius > 0.0).collect();
    median(&mut known).map(|radius| 2.0 * radius)
}
