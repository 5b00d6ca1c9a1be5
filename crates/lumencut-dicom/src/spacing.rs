//! Computes distances between slices, with tolerances for their positions.

use crate::wording::rounded;

/// Tolerance of positions: in mm, or as a share of the slice distance. The larger one is used.
const MILLIMETRE: f64 = 0.01;
const OF_STEP: f64 = 0.01;
/// Slices closer than this (mm) are at one position.
pub(crate) const ONE_PLACE: f64 = 0.01;
/// If this many successive distances are equally wide, they are assumed to be intended.
const INTENDED_RUN: usize = 3;
const MAX_LISTED: usize = 4;

pub(crate) fn tolerance(step: f64) -> f64 {
    MILLIMETRE.max(OF_STEP * step)
}

/// The median; NaN if any number is NaN.
pub(crate) fn median(numbers: &[f64]) -> f64 {
    let mut sorted = numbers.to_vec();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    match sorted.last() {
        Some(last) if last.is_nan() => f64::NAN,
        Some(_) if sorted.len() % 2 == 1 => sorted[middle],
        Some(_) => f64::midpoint(sorted[middle - 1], sorted[middle]),
        None => f64::NAN,
    }
}

pub(crate) fn ends(numbers: &[f64]) -> (f64, f64) {
    numbers.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &n| (low.min(n), high.max(n)))
}

/// Whether equal wide steps follow each other, as in a part that was scanned more coarsely.
pub(crate) fn has_run(steps: &[i64]) -> bool {
    steps.windows(INTENDED_RUN).any(|run| run[0] > 1 && run.iter().all(|step| *step == run[0]))
}

pub(crate) fn left_out(every: &[f64], part: &[f64]) -> (usize, usize) {
    let (every, own) = (places(every), places(part));
    let has = |place: f64| {
        let after = own.partition_point(|one| *one < place - ONE_PLACE);
        own.get(after).is_some_and(|one| *one < place + ONE_PLACE)
    };
    (every.iter().filter(|&&place| !has(place)).count(), every.len())
}

fn places(heights: &[f64]) -> Vec<f64> {
    let mut sorted = heights.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.dedup_by(|next, kept| *next - *kept < ONE_PLACE);
    sorted
}

pub(crate) fn described(gaps: &[f64]) -> String {
    let allowed = tolerance(median(gaps));
    let mut groups: Vec<(f64, usize)> = Vec::new();
    for &gap in gaps {
        match groups.iter_mut().find(|(first, _)| (gap - first).abs() <= allowed) {
            Some((_, count)) => *count += 1,
            None => groups.push((gap, 1)),
        }
        if groups.len() > MAX_LISTED {
            let (smallest, largest) = ends(gaps);
            return format!("{} to {} mm", rounded(smallest, 4), rounded(largest, 4));
        }
    }
    let words = groups.iter().map(|&(gap, count)| format!("{count} of {} mm", rounded(gap, 4)));
    words.collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_of_numbers() {
        assert_eq!(median(&[3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(&[4.0, 1.0, 2.0, 3.0]), 2.5);
        assert!(median(&[1.0, f64::NAN, 2.0]).is_nan());
    }

    #[test]
    fn places_that_a_part_lacks_are_left_out() {
        let every: Vec<f64> = (0..40).map(|k| f64::from(2 * k)).collect();
        assert_eq!(left_out(&every, &every[..21]), (19, 40));
        assert_eq!(left_out(&every, &every), (0, 40));
        let holed: Vec<f64> = every.iter().copied().filter(|place| *place != 20.0).collect();
        assert_eq!(left_out(&every, &holed), (1, 40));
        let even: Vec<f64> = every.iter().copied().step_by(2).collect();
        assert_eq!(left_out(&every, &even), (20, 40));
        assert_eq!(left_out(&every, &[4.0]), (39, 40));
    }

    #[test]
    fn runs_are_wide_steps_of_one_length() {
        assert!(has_run(&[1, 5, 5, 5, 1]));
        assert!(!has_run(&[1, 1, 1, 1, 5, 5]));
        assert!(!has_run(&[2, 3, 2, 3]));
    }

    #[test]
    fn distances_are_told_in_their_order() {
        assert_eq!(described(&[4.0, 4.01, 1.08, 7.0, 4.0]), "3 of 4 mm, 1 of 1.08 mm, 1 of 7 mm");
        assert_eq!(described(&[2.0, 2.2, 2.5, 2.9, 3.4, 4.0]), "2 to 4 mm");
    }
}
