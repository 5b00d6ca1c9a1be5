//! Texts for common grades of stenoses, with their source.

use super::{Method, Stenosis};
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::named::Named;

/// A vessel territory for which grades are defined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Territory {
    /// Internal carotid artery.
    Carotid,
    /// Coronary artery.
    Coronary,
}

impl Named for Territory {
    const NAMES: &'static [(&'static str, Self)] =
        &[("carotid", Self::Carotid), ("coronary", Self::Coronary)];
}

impl Stenosis {
    /// Grade of the stenosis, with its source. Errors: [`ErrorKind::Measuring`] for a method without grades.
    pub fn group(&self, territory: Territory) -> Result<String> {
        if self.method != Method::Nascet {
            let found = format!("'{}'", self.method.name());
            let expected = "'nascet', because the groups refer to a normal diameter";
            return Err(Error::new(ErrorKind::Measuring, "method of the stenosis", found, expected));
        }
        // The grades are defined for integer percentages.
        let percent = self.percent.round();
        Ok(match territory {
            Territory::Carotid => carotid(percent),
            Territory::Coronary => coronary(percent),
        })
    }
}

fn carotid(percent: f64) -> String {
    let group = match percent {
        p if p < 50.0 => "below 50 %",
        p if p < 70.0 => "50 to 69 %",
        _ => "70 to 99 %",
    };
    format!("{group} (groups of NASCET, N Engl J Med 1998; 339:1415)")
}

fn coronary(percent: f64) -> String {
    let group = match percent {
        p if p < 1.0 => "0 %: CAD-RADS 0",
        p if p < 25.0 => "1 to 24 %: CAD-RADS 1",
        p if p < 50.0 => "25 to 49 %: CAD-RADS 2",
        p if p < 70.0 => "50 to 69 %: CAD-RADS 3",
        p if p < 100.0 => "70 to 99 %: CAD-RADS 4",
        _ => "100 %: CAD-RADS 5",
    };
    format!("{group} (this lesion alone; CAD-RADS 2.0, Cury et al. 2022, doi:10.1016/j.jcct.2022.07.002)")
}
