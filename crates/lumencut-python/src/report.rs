//! The report of measured vessels, with pictures from Python.

use lumencut::report::pictures::REPORT_PIXELS;
use lumencut::report::{self, Lengths, Plan, ReportMark, Shown, Stated, Strip, VesselPage};
use pyo3::prelude::*;

use crate::errors::to_python;
use crate::measuring::Profile;
use crate::profile_files::{MeasuredParts, Options, row};

/// Name, arc length (mm), and whether it is suggested.
type PlaceParts = (String, f64, bool);

fn marks(places: &[PlaceParts]) -> Vec<ReportMark> {
    let mark = |(name, at, is_suggestion): &PlaceParts| ReportMark {
        name: name.clone(),
        at: *at,
        is_suggestion: *is_suggestion,
        is_confirmed: false,
    };
    places.iter().map(mark).collect()
}

/// A vessel with its places, straightened picture (base64 PNG, size, mm) and section pictures.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct PageParts {
    measured: MeasuredParts,
    places: Vec<PlaceParts>,
    strip: (String, [usize; 2], f64),
    sections: Vec<String>,
}

/// Width and pixel side of the straightened vessel (mm), and arc lengths of the sections.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn report_plan(profile: &Profile, places: Vec<PlaceParts>) -> (f64, f64, Vec<f64>) {
    let Plan { width, spacing, places, .. } = report::plan(&profile.0, &marks(&places), REPORT_PIXELS);
    (width, spacing, places.iter().map(|place| place.at).collect())
}

fn page(parts: &PageParts) -> VesselPage<'_> {
    let (picture, size, spacing) = parts.strip.clone();
    VesselPage {
        measured: row(&parts.measured),
        marks: marks(&parts.places),
        lengths: Lengths::default(),
        view: None,
        strip: Some(Strip { picture, size, spacing }),
        sections: parts.sections.clone(),
    }
}

/// The report as HTML, from the measuring request, the window (level and width), and the pages.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn report_html(options: Options, window: [f64; 2], pages: Vec<PageParts>) -> PyResult<String> {
    let shown = Shown {
        scan: None,
        saved: None,
        stated: Stated { has_units: true, has_orientation: true },
        asked: options.into(),
        window,
        settings: Vec::new(),
    };
    let vessels: Vec<VesselPage> = pages.iter().map(page).collect();
    report::html(&shown, &vessels).map_err(to_python)
}
