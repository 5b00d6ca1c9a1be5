//! Compares a measured line with a profile that was measured in another scan.

use lumencut_core::stop::Stop;
use lumencut_vessels::measure::comparison::compare;
use serde::{Deserialize, Serialize};

use crate::comparison::Compared;
use crate::profile_record::ProfileRecord;
use crate::report::comparison::comparison_html;
use crate::study::failure::Result;
use crate::study::open_study::Study;

#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct ComparisonRequest {
    pub line: usize,
    /// What the vessel is called.
    pub vessel: String,
    /// The record of the profile in the later scan.
    pub later: String,
    /// What the earlier and the later scan are called.
    pub scans: [String; 2],
    /// Places that belong together (arc lengths on both vessels, mm); none matches the vessels by shape.
    pub pairs: Vec<[f64; 2]>,
    /// Doubts of the page about the scans.
    pub doubts: Vec<String>,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Comparison"))]
pub(crate) struct ComparisonMessage {
    /// What changed, in sentences.
    pub lines: Vec<String>,
    /// Arc length of each section (mm), and the arc length on the other vessel; null beyond its ends.
    #[cfg_attr(test, ts(type = "Array<[number, number | null]>"))]
    pub places: Vec<[f64; 2]>,
    /// The report as HTML.
    pub report: String,
}

impl Study {
    /// Compares a line of this scan, the earlier one, with a profile of a later scan.
    pub(crate) fn compared(&mut self, request: &ComparisonRequest, stop: Stop) -> Result<ComparisonMessage> {
        let (later, _) = ProfileRecord::read(&request.later)?.profile()?;
        let comparison = compare(self.measured(request.line, stop)?, &later, &request.pairs)?;
        let compared = Compared {
            vessel: request.vessel.clone(),
            scans: request.scans.clone(),
            comparison: &comparison,
            doubts: request.doubts.clone(),
        };
        Ok(ComparisonMessage {
            lines: compared.lines(),
            places: comparison.places.iter().map(|place| place.at).collect(),
            report: comparison_html(std::slice::from_ref(&compared)),
        })
    }
}
