//! Contours that a reader draws by hand, in place of the automatic contours of a vessel's sections.

use glam::DVec3;
use lumencut_core::stop::Stop;
use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::profile::by_hand::Outline;
use serde::Serialize;

use crate::study::document::WorldPoint;
use crate::study::failure::Result;
use crate::study::open_study::Study;
use crate::study::outlines::{Contour, outline};

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
