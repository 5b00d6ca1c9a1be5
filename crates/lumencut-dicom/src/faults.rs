//! Errors for slices that do not form one stack. The errors name these slices.

use crate::directions::ROUNDING;
use crate::error::{Error, Result};
use crate::mend::Mend;
use crate::slices::Slice;
use crate::spacing::median;
use crate::wording::{bracketed, counted, listed, rounded};

/// Maximum relative difference of spacings.
const RELATIVE: f64 = 1e-3;
/// Maximum difference of cosines that are not rounded.
const COSINE: f64 = 1e-3;

pub(crate) fn require_alike(slices: &[Slice]) -> Result<()> {
    let size = |one: &Slice| one.size.map(|length| length as f64).to_vec();
    let along_i = |one: &Slice| one.directions.along_i.to_array().to_vec();
    let along_j = |one: &Slice| one.directions.along_j.to_array().to_vec();
    let are_rounded = slices.iter().any(|one| one.directions.is_rounded);
    let allowed = if are_rounded { ROUNDING } else { COSINE };
    alike(slices, "size", size, |a, b| a == b)?;
    alike(slices, "spacing", |one| one.spacing.to_vec(), |a, b| (a - b).abs() <= RELATIVE * b)?;
    alike(slices, "orientation", along_i, |a, b| (a - b).abs() < allowed)?;
    alike(slices, "orientation", along_j, |a, b| (a - b).abs() < allowed)
}

fn alike(
    slices: &[Slice],
    what: &str,
    value: impl Fn(&Slice) -> Vec<f64>,
    same: impl Fn(f64, f64) -> bool,
) -> Result<()> {
    let Some(first) = slices.first() else { return Ok(()) };
    let expected = value(first);
    let is_odd = |one: &&Slice| !value(one).iter().zip(&expected).all(|(&a, &b)| same(a, b));
    let odd: Vec<&Slice> = slices.iter().filter(is_odd).collect();
    let Some(other) = odd.first() else { return Ok(()) };
    let names: Vec<String> = odd.iter().map(|one| one.name()).collect();
    let found = format!(
        "slices of different {what}: {} in {} and {} more, {} in {}",
        bracketed(&expected),
        first.name(),
        slices.len() - odd.len() - 1,
        bracketed(&value(other)),
        listed(&names),
    );
    let error = Error::new(found, "one stack of equal slices");
    Err(error.mend("move the others to a separate folder"))
}

/// Rejects a stack with gaps; `steps` are distances divided by the usual distance.
pub(crate) fn refuse_gaps(ordered: &[Slice], gaps: &[f64], steps: &[i64]) -> Result<()> {
    let missing: i64 = steps.iter().map(|step| step - 1).sum();
    if missing == 0 {
        return Ok(());
    }
    let holes = (0..steps.len()).filter(|&n| steps[n] > 1).map(|n| {
        let (before, after) = (&ordered[n], &ordered[n + 1]);
        let apart = format!("{} mm apart at {}", rounded(gaps[n], 4), bracketed(&before.position.to_array()));
        format!("{} between {} and {} ({apart})", steps[n] - 1, before.name(), after.name())
    });
    let found = format!("{}: {}", counted(missing, "missing slice"), listed(&holes.collect::<Vec<_>>()));
    let error = Error::new(found, format!("slices every {} mm", rounded(median(gaps), 4)));
    let error = error.mend("add the missing files");
    Err(if is_mostly_missing(ordered, steps) { error } else { error.mended_by(Mend::FillGaps) })
}

/// Whether more slices are missing than present. If so, interpolation is not offered.
pub(crate) fn is_mostly_missing(ordered: &[Slice], steps: &[i64]) -> bool {
    steps.iter().map(|step| step - 1).sum::<i64>() > ordered.len() as i64
}
