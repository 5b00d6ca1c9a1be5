//! Contours drawn by hand as sessions store them, and the outlines that they stand for.

use glam::DVec2;
use lumencut_core::error::{Error, ErrorKind};
use lumencut_vessels::measure::profile::CONTOUR_POINTS;
use lumencut_vessels::measure::profile::by_hand::{Outline, RADII_MM};

use crate::study::failure::Result;

/// A contour drawn by hand, in mm: arc length of its section, centre (to the right and down in the section), and distances from the
/// centre at equal angles.
pub(crate) type Contour = Vec<f64>;

/// Contours on a vessel of this length (mm).
pub(crate) fn drawn_outlines(contours: &[Contour], length: f64) -> Result<Vec<Outline>> {
    let mut outlines = Vec::new();
    for contour in contours {
        outlines.push(outline(contour, length)?);
    }
    Ok(outlines)
}

pub(crate) fn outline(contour: &[f64], length: f64) -> Result<Outline> {
    let wrong = |found: String, expected: String| {
        Err(Error::new(ErrorKind::Measuring, "contour by hand", found, expected).into())
    };
    let [least, most] = RADII_MM;
    let (Some((at, [right, down])), Some(radii)) = (head(contour), contour.last_chunk::<CONTOUR_POINTS>())
    else {
        return wrong(format!("{} numbers", contour.len()), format!("{} numbers", 3 + CONTOUR_POINTS));
    };
    if !(0.0..=length).contains(&at) {
        return wrong(format!("{at} mm"), format!("an arc length from 0 to {length:.1} mm"));
    }
    let off = [right, down].into_iter().find(|offset| !(-most..=most).contains(offset));
    if let Some(odd) = radii.iter().copied().find(|radius| !(least..=most).contains(radius)).or(off) {
        return wrong(format!("{odd} mm"), format!("radii from {least} to {most} mm near the vessel"));
    }
    Ok(Outline { at, center: DVec2::new(right, down), radii: *radii })
}

/// Arc length and centre; None for a wrong number of numbers.
fn head(contour: &[f64]) -> Option<(f64, [f64; 2])> {
    match contour {
        [at, right, down, radii @ ..] if radii.len() == CONTOUR_POINTS => Some((*at, [*right, *down])),
        _ => None,
    }
}
