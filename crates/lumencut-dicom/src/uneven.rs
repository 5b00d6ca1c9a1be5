//! Handles uneven slice distances by an error, or on request by resampling to a regular grid. The slice distance of
//! the grid is the largest length of which all distances are multiples, if the grid then has at most four times as
//! many slices. In that case each slice keeps its position. Otherwise it is the smallest distance, within the same
//! limit.

use crate::error::{Error, Result};
use crate::mend::Mend;
use crate::slices::Slice;
use crate::spacing::{described, ends, median, tolerance};
use crate::wording::{counted, rounded};

/// Maximum number of slices of the grid, relative to that of the series.
const MAX_GRID_RATIO: usize = 4;
/// A distance that exceeds the neighbouring distances by this factor is a gap.
const GAP_RATIO: f64 = 3.0;
/// Tolerance for rounding of step counts and equal distances (mm).
const ROUNDING: f64 = 1e-6;

#[derive(Debug)]
pub(crate) struct Uneven<'s, 'a> {
    pub ordered: &'s [Slice<'a>],
    pub gaps: Vec<f64>,
}

impl Uneven<'_, '_> {
    pub(crate) fn refused(&self) -> Error {
        if let Err(error) = self.require_line() {
            return error;
        }
        let error = Error::new(self.found(), "one distance between all slices");
        match self.hole() {
            None => error.mended_by(Mend::ResampleSlices),
            Some(hole) => {
                let error = error.mend(format!("add the missing slices {hole}"));
                if self.is_mostly_measured() { error.mended_by(Mend::ResampleAndFill) } else { error }
            }
        }
    }

    /// Index of each slice on the grid. Rejects slices that do not lie on a straight line. Rejects gaps,
    /// unless they may be filled and most of the stack is measured.
    pub(crate) fn places(&self, fill_gaps: bool) -> Result<Vec<f64>> {
        self.require_line()?;
        if let Some(hole) = self.hole().filter(|_| !(fill_gaps && self.is_mostly_measured())) {
            let found = format!("{}, with a gap {hole}", self.found());
            let error = Error::new(found, "a series without gaps").mend("add the missing files");
            return Err(if fill_gaps { error } else { error.mended_by(Mend::FillGaps) });
        }
        if self.gaps.len() < 2 {
            return Ok(vec![0.0, 1.0]);
        }
        Ok(places_on_grid(&self.heights(), ends(&self.gaps).0))
    }

    pub(crate) fn note(&self, places: &[f64]) -> String {
        let last = places.last().copied().unwrap_or_default();
        let kept = places.iter().filter(|place| place.fract() == 0.0).count();
        let whole =
            if kept == places.len() { format!("all {kept}") } else { format!("{kept} of {}", places.len()) };
        let every = rounded(self.gaps.iter().sum::<f64>() / last, 4);
        format!(
            "{}: resampled to {} slices every {every} mm, linearly between neighbours; {whole} measured slices \
             keep their values; the largest gap is {}",
            self.found(),
            last as i64 + 1,
            self.gap(self.widest()),
        )
    }

    fn found(&self) -> String {
        format!("uneven slices at mixed distances ({})", described(&self.gaps))
    }

    /// Rejects slices that are shifted sideways, which resampling along the normal cannot correct.
    fn require_line(&self) -> Result<()> {
        let (heights, first) = (self.heights(), self.ordered[0].position);
        let way = self.ordered[self.ordered.len() - 1].position - first;
        let total = heights[heights.len() - 1];
        let off: Vec<f64> = (self.ordered.iter().zip(&heights))
            .map(|(one, height)| (one.position - (first + height / total * way)).length())
            .collect();
        let worst = largest(&off);
        let allowed = tolerance(median(&self.gaps));
        // NaN, which huge positions give, also counts as off the line.
        if off[worst] <= allowed {
            return Ok(());
        }
        let (name, by) = (self.ordered[worst].name(), rounded(off[worst], 3));
        let found = format!("uneven slices: {name} is {by} mm off the line through the others");
        Err(Error::new(found, format!("slices on a straight line within {} mm", rounded(allowed, 3))))
    }

    fn heights(&self) -> Vec<f64> {
        let mut height = 0.0;
        let above = self.gaps.iter().map(|gap| {
            height += gap;
            height
        });
        std::iter::once(0.0).chain(above).collect()
    }

    fn wide(&self) -> Vec<usize> {
        let beside = |n: Option<usize>| n.and_then(|n| self.gaps.get(n)).copied().unwrap_or_default();
        let is_wide =
            |&n: &usize| self.gaps[n] > GAP_RATIO * beside(n.checked_sub(1)).max(beside(Some(n + 1)));
        if self.gaps.len() > 1 { (0..self.gaps.len()).filter(is_wide).collect() } else { Vec::new() }
    }

    fn is_mostly_measured(&self) -> bool {
        let wide: f64 = self.wide().iter().map(|&n| self.gaps[n]).sum();
        wide < self.gaps.iter().sum::<f64>() / 2.0
    }

    fn hole(&self) -> Option<String> {
        let wide = self.wide();
        let first = self.gap(*wide.first()?);
        let others = wide.len() as i64 - 1;
        let more = if others > 0 { format!(" and {}", counted(others, "more gap")) } else { String::new() };
        Some(format!("of {first}{more}"))
    }

    fn widest(&self) -> usize {
        let widest = ends(&self.gaps).1;
        self.gaps.iter().position(|gap| gap + ROUNDING >= widest).unwrap_or_default()
    }

    fn gap(&self, n: usize) -> String {
        let (before, after) = (self.ordered[n].name(), self.ordered[n + 1].name());
        format!("{} mm between {before} and {after}", rounded(self.gaps[n], 4))
    }
}

fn largest(numbers: &[f64]) -> usize {
    let mut largest = 0;
    for (n, number) in numbers.iter().enumerate() {
        if number.total_cmp(&numbers[largest]).is_gt() {
            largest = n;
        }
    }
    largest
}

/// The index of each slice on an even grid from the first slice to the last; it may be fractional.
fn places_on_grid(heights: &[f64], smallest: f64) -> Vec<f64> {
    let (total, most) = (heights[heights.len() - 1], (MAX_GRID_RATIO * heights.len() - 1) as f64);
    let mut parts = 1.0;
    while parts <= most {
        let steps = (total * parts / smallest).round_ties_even();
        if steps > most {
            break;
        }
        let places: Vec<f64> =
            heights.iter().map(|height| (height / total * steps).round_ties_even()).collect();
        if holds(&places, heights, total / steps) {
            return places;
        }
        parts += 1.0;
    }
    let steps = most.min((total / smallest - ROUNDING).ceil());
    let whole_where_rounded = |place: f64| {
        let whole = place.round_ties_even();
        if (place - whole).abs() < ROUNDING { whole } else { place }
    };
    heights.iter().map(|height| whole_where_rounded(height / total * steps)).collect()
}

fn holds(places: &[f64], heights: &[f64], step: f64) -> bool {
    let is_there = |(place, height): (&f64, &f64)| (height - place * step).abs() <= tolerance(step);
    places.windows(2).all(|pair| pair[0] < pair[1]) && places.iter().zip(heights).all(is_there)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(gaps: &[f64]) -> Vec<f64> {
        let heights: Vec<f64> = (0..=gaps.len()).map(|n| gaps[..n].iter().sum()).collect();
        places_on_grid(&heights, ends(gaps).0)
    }

    #[test]
    fn a_common_distance_keeps_every_slice() {
        assert_eq!(grid(&[2.0, 2.0, 3.0]), [0.0, 2.0, 4.0, 7.0]);
        assert_eq!(grid(&[1.0, 1.0, 1.5]), [0.0, 2.0, 4.0, 7.0]);
    }

    #[test]
    fn without_one_it_is_the_smallest_or_four_times_as_many() {
        let places = grid(&[4.0, 4.0, 4.0, 3.1, 3.1]);
        assert_eq!((places[0], places[5]), (0.0, 6.0));
        assert!((places[1] - 6.0 * 4.0 / 18.2).abs() < 1e-12);
        let places = grid(&[4.0, 4.0, 1.0 / 7.0, 4.0]);
        assert_eq!(places[4], 19.0);
    }

    #[test]
    fn the_first_of_the_largest() {
        assert_eq!(largest(&[1.0, 3.0, 3.0]), 1);
        assert_eq!(largest(&[1.0, f64::NAN, f64::INFINITY]), 1);
    }
}
