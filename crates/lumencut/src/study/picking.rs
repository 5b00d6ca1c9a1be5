//! Picking: finds what a pixel shows and what lies at a world point.

use crate::clicked_vessel::{is_clicked, nearest_arc_length};
use crate::cut_at::{CutAt, cut_at};
use crate::windows;
use glam::DVec3;
use serde::Serialize;

use crate::study::failure::Result;
use crate::study::open_study::Study;
use crate::study::view::View;

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub(crate) struct Pick {
    pub point: [f64; 3],
    /// The volume's value; none outside.
    pub value: Option<f32>,
    /// The vessel in whose lumen, or next to whose lumen, the point lies; none in tissue.
    pub vessel: Option<usize>,
    /// The arc length on the vessel nearest to the point (mm).
    pub arc_length: Option<f64>,
}

impl Study {
    /// What a pixel (column, row) shows: the cut surface, or the brightest place on the ray if the focus shows the surroundings.
    pub(crate) fn pick(&mut self, view: &View, pixel: [f64; 2]) -> Result<Pick> {
        let cut = self.cut_in(view, pixel)?;
        if !cut.is_shown {
            // Outside the scan there is neither a brightest place nor a vessel.
            let brightest = self.brightest_on_whole_ray(view, pixel);
            return Ok(brightest.unwrap_or_else(|_| self.pick_at(cut.point, None)));
        }
        let spacing = view.camera.pixel_spacing();
        let is_clicked =
            |vessel: &usize| self.vessel(*vessel).is_ok_and(|vessel| is_clicked(vessel, cut.point, spacing));
        Ok(self.pick_at(cut.point, cut.vessel.filter(is_clicked)))
    }

    /// The cut surface at a pixel (column, row).
    pub(super) fn cut_in(&mut self, view: &View, pixel: [f64; 2]) -> Result<CutAt> {
        let scene = self.content.scene()?;
        Ok(cut_at((&mut self.cpu, view.method), &scene, (&view.camera, &view.settings), pixel)?)
    }

    pub(super) fn pick_at(&self, point: DVec3, vessel: Option<usize>) -> Pick {
        let arc_length = vessel
            .and_then(|vessel| self.vessel(vessel).ok())
            .map(|vessel| nearest_arc_length(vessel, point));
        Pick { point: point.to_array(), value: self.value(point), vessel, arc_length }
    }

    pub(crate) fn at(&self, point: [f64; 3]) -> Pick {
        let point = DVec3::from_array(point);
        let vessels = self.content.tree().map_or(&[][..], |tree| tree.tree().vessels());
        let inside = vessels.iter().position(|vessel| {
            let near = vessel.points().iter().zip(0..);
            near.into_iter().any(|(p, i): (&DVec3, usize)| p.distance(point) <= vessel.radius_or_zero(i))
        });
        self.pick_at(point, inside)
    }

    fn value(&self, point: DVec3) -> Option<f32> {
        let volume = self.content.held.as_ref().and_then(|held| held.volume().ok())?;
        windows::sample(&volume, &[point]).first().copied().filter(|value| value.is_finite())
    }
}
