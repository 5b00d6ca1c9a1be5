//! Scan parameters that affect measurements.

use serde::Serialize;

use crate::keyword::Keyword;
use crate::series::Series;
use crate::slices::Slice;
use crate::value::Value;
use crate::wording::{line, rounded};

const DIGITS: usize = 6;

/// How a scan was made, without patient data. Values are None if not stated or not equal in all slices.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Scan {
    /// Number of the series.
    pub series_number: Option<String>,
    /// Description of the series.
    pub series_description: Option<String>,
    /// Phases of heart, contrast medium and series, as stated.
    pub phase: Option<String>,
    /// Slice thickness (mm).
    pub slice_thickness_mm: Option<f64>,
    /// Reconstruction kernel.
    pub kernel: Option<String>,
}

impl Scan {
    pub(crate) fn of(series: &Series, slices: &[Slice]) -> Self {
        let thickness = common(slices, Keyword::SliceThickness).and_then(Value::number);
        Self {
            series_number: Some(series.number()).filter(|text| !text.is_empty()),
            series_description: Some(series.description()).filter(|text| !text.is_empty()),
            phase: phase(slices),
            slice_thickness_mm: thickness.filter(|mm| mm.is_finite() && *mm > 0.0),
            kernel: common(slices, Keyword::ConvolutionKernel).and_then(text),
        }
    }
}

fn phase(slices: &[Slice]) -> Option<String> {
    let stated = |keyword: Keyword| common(slices, keyword).and_then(text);
    let number = |keyword: Keyword| {
        let number = common(slices, keyword).and_then(Value::number).filter(|number| number.is_finite());
        number.map(|number| rounded(number, DIGITS))
    };
    let heart = number(Keyword::NominalPercentageOfCardiacPhase)
        .map(|percent| format!("{percent} % of the cardiac cycle"))
        .or_else(|| {
            number(Keyword::NominalCardiacTriggerDelayTime).map(|ms| format!("{ms} ms after the R wave"))
        })
        .or_else(|| number(Keyword::TriggerTime).map(|ms| format!("trigger time {ms} ms")));
    let contrast = stated(Keyword::ContrastBolusAgentPhase)
        .map(|phase| format!("contrast phase {}", phase.to_ascii_lowercase().replace('_', " ")));
    let position = stated(Keyword::TemporalPositionIdentifier)
        .or_else(|| stated(Keyword::TemporalPositionIndex))
        .map(|number| format!("temporal position {number}"));
    let all: Vec<String> = [heart, contrast, position].into_iter().flatten().collect();
    (!all.is_empty()).then(|| all.join(", "))
}

fn common<'a>(slices: &[Slice<'a>], keyword: Keyword) -> Option<&'a Value> {
    let first = slices.first()?.get(keyword);
    slices.iter().all(|one| one.get(keyword) == first).then_some(first)
}

fn text(value: &Value) -> Option<String> {
    let plain = |value: &Value| !value.is_empty() && !matches!(value, Value::Odd | Value::List(_));
    let parts: Vec<String> =
        value.all().iter().filter(|one| plain(one)).map(|one| line(&one.to_string())).collect();
    Some(parts.join(", ")).filter(|text| !text.is_empty())
}
