//! Separates phases whose slices have the same positions.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

use crate::error::{Error, Result};
use crate::keyword::Keyword;
use crate::mend::Mend;
use crate::slices::{Pair, Slice};
use crate::spacing;
use crate::value::Value;
use crate::wording::{MENTIONED, counted, listed, quoted, shown};

/// Attributes that may distinguish phases, the most reliable first.
const PHASE_KEYWORDS: [Keyword; 17] = [
    Keyword::TemporalPositionIdentifier,
    Keyword::TemporalPositionIndex,
    Keyword::NominalPercentageOfCardiacPhase,
    Keyword::NominalCardiacTriggerDelayTime,
    Keyword::TriggerTime,
    Keyword::EchoNumbers,
    Keyword::EchoTime,
    Keyword::EffectiveEchoTime,
    Keyword::StackID,
    Keyword::ConvolutionKernel,
    Keyword::AcquisitionNumber,
    Keyword::FrameAcquisitionNumber,
    Keyword::ImageType,
    Keyword::FrameType,
    Keyword::AcquisitionTime,
    Keyword::FrameAcquisitionDateTime,
    Keyword::ContentTime,
];
const MOST_PHASES: usize = 40;

/// Attributes with a single value in each phase. The acquisition number is not among them, because 2D MR may
/// acquire odd slices first, so that it alternates within a phase.
const WHOLE_PHASE: [Keyword; 3] = [
    Keyword::TemporalPositionIdentifier,
    Keyword::TemporalPositionIndex,
    Keyword::NominalPercentageOfCardiacPhase,
];

pub(crate) fn distinguishing(pairs: &[Pair]) -> Option<Keyword> {
    let differs = |keyword| move |pair: &Pair| value_text(&pair.0, keyword) != value_text(&pair.1, keyword);
    PHASE_KEYWORDS.into_iter().find(|&keyword| pairs.iter().all(differs(keyword)))
}

pub(crate) fn mixed(ordered: &[Slice], keyword: Keyword) -> String {
    let mixed = if keyword == Keyword::ConvolutionKernel { "kernels" } else { "phases" };
    format!("{} differs ({}): mixed {mixed}", keyword.name(), values_of(ordered, keyword))
}

/// Slices of one phase, selected by the first attribute that has this value in some slices, but not in all.
pub(crate) fn of_phase<'a>(
    slices: &[Slice<'a>],
    phase: &str,
    notes: &mut Vec<String>,
) -> Result<Vec<Slice<'a>>> {
    for keyword in PHASE_KEYWORDS {
        let is_of = |one: &&Slice| is_called(one.get(keyword), phase);
        let count = slices.iter().filter(is_of).count();
        if 0 < count && count < slices.len() {
            let own: Vec<Slice> = slices.iter().filter(is_of).cloned().collect();
            note_left_out(slices, &own, phase, notes);
            return Ok(own);
        }
    }
    let separates = |&keyword: &Keyword| {
        let values: BTreeSet<String> = slices.iter().map(|one| value_text(one, keyword)).collect();
        1 < values.len() && values.len() < slices.len()
    };
    let is = |keyword: Keyword| format!("{} is {}", keyword.name(), values_of(slices, keyword));
    let attributes: Vec<String> =
        PHASE_KEYWORDS.into_iter().filter(separates).map(is).take(MENTIONED).collect();
    let attributes = if attributes.is_empty() {
        "no attribute distinguishes phases".to_owned()
    } else {
        attributes.join("; ")
    };
    let found = format!("no phase {}: {attributes}", quoted(phase));
    Err(Error::new(found, "an attribute value of some slices"))
}

fn note_left_out(every: &[Slice], own: &[Slice], phase: &str, notes: &mut Vec<String>) {
    let Some(normal) = own.first().map(Slice::normal) else { return };
    let heights = |slices: &[Slice]| slices.iter().map(|one| one.position.dot(normal)).collect::<Vec<f64>>();
    let (count, places) = spacing::left_out(&heights(every), &heights(own));
    if count > 0 {
        notes.push(format!("phase {} lacks {count} of {places} positions", shown(phase)));
    }
}

pub(crate) fn refuse_interleaved(ordered: &[Slice]) -> Result<()> {
    for keyword in WHOLE_PHASE {
        let values: Vec<String> = ordered.iter().map(|one| value_text(one, keyword)).collect();
        let changes = values.windows(2).filter(|pair| pair[0] != pair[1]).count();
        let different = values.iter().collect::<BTreeSet<_>>().len();
        if different > 1 && changes >= different {
            let counts = values_of(ordered, keyword);
            let found = format!("slices that alternate between phases: {} is {counts}", keyword.name());
            let error = Error::new(found, "one phase");
            return Err(error.mended_by(choice(ordered, keyword)));
        }
    }
    Ok(())
}

pub(crate) fn value_text(one: &Slice, keyword: Keyword) -> String {
    one.get(keyword).to_string()
}

pub(crate) fn choice(slices: &[Slice], keyword: Keyword) -> Mend {
    let different: BTreeSet<String> = slices.iter().map(|one| value_text(one, keyword)).collect();
    let mut values: Vec<String> = different.into_iter().collect();
    if values.len() > MOST_PHASES || values.iter().any(|value| shown(value) != *value) {
        return Mend::Phase(Vec::new());
    }
    values.sort_by(|a, b| in_order(a, b));
    Mend::Phase(values)
}

/// Order of values: numbers by size, then other texts.
pub(crate) fn in_order(one: &str, other: &str) -> Ordering {
    let number = |value: &str| value.parse().unwrap_or(f64::INFINITY);
    number(one).total_cmp(&number(other)).then_with(|| one.cmp(other))
}

pub(crate) fn values_of(slices: &[Slice], keyword: Keyword) -> String {
    let mut counts = BTreeMap::new();
    for one in slices {
        *counts.entry(value_text(one, keyword)).or_insert(0) += 1;
    }
    let counts =
        counts.iter().map(|(value, &count)| format!("{} in {}", shown(value), counted(count, "slice")));
    listed(&counts.collect::<Vec<_>>())
}

/// Whether a value means this phase; 400 also means 400.0, as text or number.
fn is_called(value: &Value, phase: &str) -> bool {
    let meant: Option<f64> = phase.trim().parse().ok();
    value.to_string() == phase || meant.is_some_and(|number| value.number() == Some(number))
}
