//! Contours that a reader draws by hand, in place of the automatic contours of a vessel's sections.

use glam::{DVec2, DVec3};
use lumencut_core::error::{Error, ErrorKind};
use lumencut_core::stop::Stop;
use lumencut_vessels::measure::profile::by_hand::{Outline, RADII_MM};
use lumencut_vessels::measure::profile::{CONTOUR_POINTS, Profile};
use serde::Serialize;

use crate::study::document::WorldPoint;
use crate::study::failure::Result;
use crate::study::open_study::Study;

/// A contour drawn by hand, in mm: arc length of its section, centre (to the right and down in the section), and distances from the
/// centre at equal angles.
pub(crate) type Contour = Vec<f64>;

/// A contour while it is drawn, with its numbers.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct DrawnContour {
    /// Arc length of the section; centre; radii (mm).
    pub(crate) contour: Contour,
    pub(crate) points: Vec<WorldPoint>,
    /// Diameter of the circle of the same area (mm).
    pub(crate) diameter: f64,
    pub(crate) shortest: f64,
    pub(crate) longest: f64,
    /// Area (mm²).
    pub(crate) area: f64,
}

/// Contours on a vessel of this length (mm).
pub(crate) fn drawn_outlines(contours: &[Contour], length: f64) -> Result<Vec<Outline>> {
    let mut outlines = Vec::new();
    for contour in contours {
        outlines.push(outline(contour, length)?);
    }
    Ok(outlines)
}

fn outline(contour: &[f64], length: f64) -> Result<Outline> {
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

fn numbers(outline: &Outline) -> Contour {
    let head = [outline.at, outline.center.x, outline.center.y];
    head.into_iter().chain(outline.radii).collect()
}

impl Study {
    /// The contour of the section nearest to an arc length (mm) after a pull to a point; without one, as it is.
    pub(crate) fn drawn_contour(
        &mut self,
        line: usize,
        at: f64,
        (contour, to): (Option<Contour>, Option<WorldPoint>),
        stop: Stop,
    ) -> Result<DrawnContour> {
        let profile = self.measured(line, stop)?;
        let n = profile.nearest_section(at);
        let begun = contour.map(|contour| outline(&contour, profile.length())).transpose()?;
        let begun = begun.unwrap_or_else(|| profile.outline(n));
        let place = profile.place(n);
        let drawn = to.map_or_else(|| begun.clone(), |to| begun.pulled(&place, DVec3::from_array(to)));
        Ok(DrawnContour::of(profile, n, &drawn))
    }
}

impl DrawnContour {
    fn of(profile: &Profile, n: usize, outline: &Outline) -> Self {
        let points = outline.points(&profile.place(n)).into_iter().map(|point| point.to_array());
        let points: Vec<WorldPoint> = points.collect();
        let ellipse = outline.ellipse();
        let [shortest, longest] = ellipse.semi_axes().map(|axis| 2.0 * axis);
        Self {
            contour: numbers(outline),
            points,
            diameter: 2.0 * (ellipse.area() / std::f64::consts::PI).sqrt(),
            area: ellipse.area(),
            shortest,
            longest,
        }
    }
}

#[cfg(test)]
#[path = "tests/contours.rs"]
mod tests;
