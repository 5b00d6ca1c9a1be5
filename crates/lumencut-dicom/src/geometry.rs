//! The geometry of a series: one affine for the stack, including shear, or an error with the reason. Tolerances: 1e-3
//! per cosine, and 0.1 % of the spacing. A slice may be 0.01 mm or 1 % of the slice distance (the larger) away from
//! an evenly spaced line, unless the caller allows resampling.

use glam::DVec3;

use crate::directions::Directions;
use crate::error::{Error, Result};
use crate::faults::{is_mostly_missing, refuse_gaps, require_alike};
use crate::headers::Unlike;
use crate::keyword::Keyword;
use crate::phases::refuse_interleaved;
use crate::shared_places::one_per_place;
use crate::slices::{Pair, Slice};
use crate::spacing::{has_run, median, tolerance};
use crate::uneven::Uneven;
use crate::wording::rounded;

/// Neighbouring slices farther apart than this many usual distances have a gap between them.
const GAP_FROM: f64 = 1.5;
/// Maximum slice distance, in usual distances. Damaged headers may state any position.
const MAX_STEPS: f64 = 1e9;
/// Tilts below this (degrees) are treated as no tilt.
const MIN_TILT_DEGREES: f64 = 0.1;

#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Mending {
    /// Whether missing slices are interpolated instead of rejected.
    pub fill_gaps: bool,
    /// Whether uneven slices are put on a regular grid.
    pub resample_slices: bool,
}

#[derive(Debug)]
pub(crate) struct Stack<'a> {
    pub slices: Vec<Slice<'a>>,
    /// Index k of each slice; it is fractional only if slices are resampled.
    pub places: Vec<f64>,
    pub origin: DVec3,
    pub steps: [DVec3; 3],
    pub is_resampled: bool,
    /// Pairs of slices at one position: one that is read, and one that is skipped.
    pub repeats: Vec<Pair<'a>>,
}

impl Stack<'_> {
    pub(crate) fn size(&self) -> [i64; 3] {
        let [columns, rows] = self.slices[0].size;
        [columns, rows, self.places[self.places.len() - 1] as i64 + 1]
    }

    /// Indices k that have no slice.
    pub(crate) fn missing(&self) -> Vec<i64> {
        let mut measured = self.places.iter().filter(|place| place.fract() == 0.0).peekable();
        let is_missing = |&k: &i64| measured.next_if(|place| **place == k as f64).is_none();
        (0..self.size()[2]).filter(is_missing).collect()
    }
}

/// Sorts slices along their normal, and computes the affine. `unlike` are pairs of frames whose values the
/// caller found to differ.
pub(crate) fn stacked<'a>(
    mut slices: Vec<Slice<'a>>,
    mending: Mending,
    unlike: &[Unlike],
    notes: &mut Vec<String>,
) -> Result<Stack<'a>> {
    require_alike(&slices)?;
    let Some(normal) = slices.first().map(Slice::normal) else {
        return Err(Error::new("no slices", "a stack of slices"));
    };
    // Slices at the same position are ordered by name.
    let height = |one: &Slice| one.position.dot(normal);
    slices.sort_by_cached_key(Slice::name);
    slices.sort_by(|a, b| height(a).total_cmp(&height(b)));
    let (mut slices, repeats) = one_per_place(slices, unlike, notes)?;
    correct_directions(&mut slices, notes);
    let (places, step, is_resampled) =
        if slices.len() > 1 { on_a_line(&slices, mending, notes)? } else { alone(&slices[0], notes)? };
    let first = &slices[0];
    let Directions { along_i, along_j, .. } = first.directions;
    let steps = [along_i * first.spacing[0], along_j * first.spacing[1], step];
    let origin = first.position;
    Ok(Stack { slices, places, origin, steps, is_resampled, repeats })
}

/// Gives all slices the same rounded directions, perpendicular to their line if rounding allows it.
fn correct_directions(slices: &mut [Slice], notes: &mut Vec<String>) {
    let [first, .., last] = slices else { return note_correction(slices, notes) };
    if !first.directions.is_rounded {
        return;
    }
    let tilt = first.image.number(first.frame, Keyword::GantryDetectorTilt).ok().flatten();
    let line = (last.position - first.position).try_normalize();
    let line = line.filter(|_| tilt.is_none_or(|tilt| tilt.abs() <= MIN_TILT_DEGREES));
    let directions = first.directions.along(line);
    slices.iter_mut().for_each(|one| one.directions = directions);
    note_correction(slices, notes);
}

fn note_correction(slices: &[Slice], notes: &mut Vec<String>) {
    if let Some(first) = slices.first().filter(|one| one.directions.is_rounded) {
        let by = rounded(first.directions.correction(), 2);
        notes.push(format!(
            "ImageOrientationPatient is rounded: cosines are changed by up to {by} to be orthonormal"
        ));
    }
}

/// Index of each slice, the vector from one index to the next, and whether slices are resampled.
type Places = (Vec<f64>, DVec3, bool);

fn on_a_line(ordered: &[Slice], mending: Mending, notes: &mut Vec<String>) -> Result<Places> {
    let normal = ordered[0].normal();
    let heights: Vec<f64> = ordered.iter().map(|one| one.position.dot(normal)).collect();
    let gaps: Vec<f64> = heights.windows(2).map(|pair| pair[1] - pair[0]).collect();
    refuse_interleaved(ordered)?;
    let steps = steps(&gaps);
    let places = summed(&steps);
    let step = step(ordered, &places);
    if is_line(ordered, &places, step) && !has_run(&steps) {
        if !mending.fill_gaps || is_mostly_missing(ordered, &steps) {
            refuse_gaps(ordered, &gaps, &steps)?;
        }
        note_tilt(ordered, &places, step, notes)?;
        return Ok((places, step, false));
    }
    let uneven = Uneven { ordered, gaps };
    if !mending.resample_slices {
        return Err(uneven.refused());
    }
    let places = uneven.places(mending.fill_gaps)?;
    let step = self::step(ordered, &places);
    note_tilt(ordered, &places, step, notes)?;
    notes.push(uneven.note(&places));
    Ok((places, step, true))
}

/// Distances divided by the usual distance, as integers; 1 if there is no gap.
fn steps(gaps: &[f64]) -> Vec<i64> {
    let usual = median(gaps);
    let step = |&gap: &f64| {
        if gap > GAP_FROM * usual { (gap / usual).round_ties_even().min(MAX_STEPS) } else { 1.0 }
    };
    gaps.iter().map(|gap| step(gap) as i64).collect()
}

fn summed(steps: &[i64]) -> Vec<f64> {
    let mut place = 0;
    let after = steps.iter().map(|step| {
        place += step;
        place as f64
    });
    std::iter::once(0.0).chain(after).collect()
}

fn step(ordered: &[Slice], places: &[f64]) -> DVec3 {
    let last = ordered.len() - 1;
    (ordered[last].position - ordered[0].position) / places[last]
}

fn is_line(ordered: &[Slice], places: &[f64], step: DVec3) -> bool {
    let (origin, allowed) = (ordered[0].position, tolerance(step.length()));
    let mut pairs = ordered.iter().zip(places);
    pairs.all(|(one, place)| (one.position - origin - *place * step).length() <= allowed)
}

fn alone(only: &Slice, notes: &mut Vec<String>) -> Result<Places> {
    for keyword in [Keyword::SpacingBetweenSlices, Keyword::SliceThickness] {
        let stated = only.image.number(only.frame, keyword)?;
        if let Some(thickness) = stated.filter(|thickness| thickness.is_finite() && *thickness > 0.0) {
            let (name, words) = (keyword.name(), only.get(keyword));
            notes.push(format!("a single slice: {name} {words} mm is used as its thickness"));
            return Ok((vec![0.0], thickness * only.normal(), false));
        }
    }
    let error = Error::new("a single slice without SliceThickness", "a stack of slices");
    Err(error.of(only.image.file))
}

/// Adds a note if the stack is sheared by a gantry tilt, or if its positions do not show a stated tilt.
fn note_tilt(ordered: &[Slice], places: &[f64], step: DVec3, notes: &mut Vec<String>) -> Result<()> {
    let normal = ordered[0].normal();
    let along = step.dot(normal);
    let drift = (step - along * normal).length();
    let stated = ordered[0].image.number(ordered[0].frame, Keyword::GantryDetectorTilt)?;
    if drift * places[places.len() - 1] > tolerance(step.length()) {
        let angle = drift.atan2(along).to_degrees();
        notes.push(format!("the stack is sheared by {angle:.2} degrees (gantry tilt): kept, not resampled"));
    } else if let Some(tilt) = stated.filter(|tilt| tilt.abs() > MIN_TILT_DEGREES) {
        let tilt = rounded(tilt, 6);
        notes.push(format!(
            "GantryDetectorTilt is {tilt} degrees, but the positions show no tilt: positions are used"
        ));
    }
    Ok(())
}
