//! Describes a series, and whether it may be an angiography.

use crate::geometry::{Mending, stacked};
use crate::image::Image;
use crate::report::Report;
use crate::series::Series;
use crate::wording::counted;

const MODALITIES: [&str; 3] = ["CT", "MR", "XA"];
const FEWEST_SLICES: i64 = 3;

pub(crate) fn described(series: &Series) -> Report {
    let odd = why_no_angiography(series);
    let mut report = Report {
        number: series.number(),
        uid: series.uid.clone(),
        description: series.description(),
        modality: series.modality(),
        images: series.image_count(),
        size: None,
        spacing: None,
        can_be_volume: odd.is_empty(),
        trouble: odd,
    };
    // A stack with gaps is described as a volume with missing slices.
    let mending = Mending { fill_gaps: true, resample_slices: false };
    let placed = series.slices(&[], &mut Vec::new());
    match placed.and_then(|placed| stacked(placed.slices, mending, &[], &mut Vec::new())) {
        Ok(stack) => {
            let spacing = stack.steps.map(glam::DVec3::length);
            report.size = Some(stack.size());
            report.spacing = Some(spacing).filter(|steps| steps.iter().all(|step| step.is_finite()));
            let missing = stack.missing().len() as i64;
            if report.can_be_volume && missing > 0 {
                report.trouble = counted(missing, "missing slice");
            } else if report.can_be_volume && !stack.repeats.is_empty() {
                let repeats = counted(stack.repeats.len() as i64, "slice");
                report.trouble = format!("{repeats} at positions of others");
            }
        }
        Err(error) if report.can_be_volume => report.trouble = error.found,
        Err(_) => {}
    }
    report
}

/// Why a series is certainly no angiography. Empty if it may be one, even if reading needs a remedy.
fn why_no_angiography(series: &Series) -> String {
    let (first, modality) = (&series.images[0], series.modality());
    if !MODALITIES.contains(&modality.as_str()) {
        let stated = if modality.is_empty() { "not stated" } else { &modality };
        return format!("modality {stated}");
    }
    if first.kind.contains("Segmentation") {
        return "a segmentation".to_owned();
    }
    if first.kind.contains("Secondary Capture") || first.samples != 1 {
        return "screenshots".to_owned();
    }
    if series.images.iter().all(|image| image.is_localizer(0)) {
        return "a localiser".to_owned();
    }
    if series.image_count() < FEWEST_SLICES {
        return format!("fewer than {FEWEST_SLICES} images");
    }
    if !series.images.iter().any(Image::has_positions) {
        return "no positions".to_owned();
    }
    String::new()
}
