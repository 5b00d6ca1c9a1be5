//! Values along the shown vessels, for rims and network maps: from measured profiles, otherwise from radii.

use lumencut_core::settings::{RimValue, Settings};
use lumencut_vessels::measure::stenosis::Stenosis;
use serde::Serialize;

use crate::along_vessels::{Along, Legend, ValuesAlong};
use crate::profile_marks::Grade;
use crate::study::failure::{Failure, Result};
use crate::study::measure_messages::VesselMessage;
use crate::study::open_study::Study;
use crate::study::view::ViewMessage;

/// What colours mean: words, unit, the values of the first and the last colour, and colours at equal steps.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS), ts(rename = "Legend"))]
pub(crate) struct LegendMessage {
    words: &'static str,
    unit: &'static str,
    low: f64,
    high: f64,
    #[cfg_attr(test, ts(type = "Array<Vector>"))]
    colours: &'static [[u8; 3]],
}

impl From<Legend> for LegendMessage {
    fn from(Legend { words, unit, ends: [low, high], colours }: Legend) -> Self {
        Self { words, unit, low, high, colours: colours.table() }
    }
}

impl Study {
    /// The values of all shown vessels; `marked` are the measured ones with a reader's marks.
    pub(crate) fn along(&self, kind: RimValue, marked: &[VesselMessage]) -> Result<ValuesAlong> {
        let none = || Failure::of_message("vessels", &"none", "one or more");
        let named = self.content.named.as_ref().ok_or_else(none)?;
        let graded =
            named.lines.iter().map(|line| self.graded_on(*line, marked)).collect::<Result<Vec<_>>>()?;
        let vessels = named.leveled.tree().vessels().iter().zip(&named.lines).zip(&graded);
        let along = vessels.map(|((vessel, line), stenoses)| Along {
            vessel,
            profile: self.profiles.last_of(*line),
            stenoses,
        });
        Ok(ValuesAlong::new(kind, &along.collect::<Vec<_>>())?)
    }

    /// The values of the rim that settings choose.
    pub(crate) fn of_rim(
        &self,
        settings: &Settings,
        marked: &[VesselMessage],
    ) -> Result<Option<ValuesAlong>> {
        let Some(kind) = settings.rim else { return Ok(None) };
        Ok(Some(self.along(kind, marked)?.ranged([settings.rim_low, settings.rim_high])?))
    }

    fn graded_on(&self, line: usize, marked: &[VesselMessage]) -> Result<Vec<Stenosis>> {
        let Some(profile) = self.profiles.last_of(line) else { return Ok(Vec::new()) };
        let marks = marked.iter().filter(|vessel| vessel.line == line);
        let grades = marks.map(|vessel| Ok(vessel.marks.marked()?.grade(profile)));
        let grades = grades.collect::<Result<Vec<_>>>()?;
        Ok(grades.iter().flatten().filter_map(Grade::stenosis).cloned().collect())
    }

    /// What the colours of a view's rim mean. Fails with the reason if there is no rim.
    pub(crate) fn rim_legend(&self, message: &ViewMessage) -> Result<LegendMessage> {
        let none = || Failure::of_message("rim", &"none", "a rim of the cut surface");
        let along = self.of_rim(&message.view()?.settings, &message.vessels)?.ok_or_else(none)?;
        along.rim()?;
        Ok(along.legend.into())
    }
}
