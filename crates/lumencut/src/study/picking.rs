//! What a pixel of a view shows, and what lies at a world point.

use crate::positions::world_from_pixel;
use crate::vessel_views::radius_at;
use crate::windows;
use glam::{DVec2, DVec3};
use lumencut_core::camera::Camera;
use lumencut_core::math::arc_length::point_at;
use lumencut_core::pipeline::Request;
use lumencut_core::settings::Settings;
use lumencut_core::stages::{Image, ImageSet};
use lumencut_core::vessel_tree::Vessel;
use serde::Serialize;

use crate::study::failure::Result;
use crate::study::open_study::Study;
use crate::study::view::View;

/// How many pixels around one decide what it shows: as far as the depth filter and the leaps look.
const AROUND: usize = 8;
/// The share of the cut surface from which a pixel shows it rather than what lies around it.
const SHOWN: f32 = 0.5;
/// How far beside its wall a vessel is still meant by a click (mm), and how many pixels in a view from far away.
const BESIDE: f64 = 2.0;
const PIXELS_BESIDE: f64 = 4.0;

/// What a pixel shows.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Pick {
    /// The world point.
    pub point: [f64; 3],
    /// The volume there; none outside.
    pub value: Option<f32>,
    /// The vessel in or beside whose lumen it is; none in the tissue between vessels.
    pub vessel: Option<usize>,
    /// The place on the vessel that is nearest (mm).
    pub arc_length: Option<f64>,
}

impl Study {
    /// What the pixel (column, row) of a view shows: the cut surface, or the brightest place on its ray where a focus shows what lies
    /// around the vessels instead.
    ///
    /// # Errors
    /// Those of the view, and `volume` where nothing is open.
    pub fn pick(&mut self, view: &View, pixel: [f64; 2]) -> Result<Pick> {
        let [x, y] = pixel.map(|place| place.round());
        let point = world_from_pixel(&view.camera, [x, y], 0.0);
        let side = 2 * AROUND + 1;
        let camera = view.camera;
        let spacing = camera.pixel_spacing();
        let near = Camera::new(point, camera.direction(), camera.up(), [side, side], spacing)?;
        let settings = Settings { samples: 1, ..view.settings.clone() };
        let mut images = vec![Image::Depth, Image::Vessel, Image::Value];
        images.extend(settings.focus.map(|_| Image::Focus));
        let request = Request { images: ImageSet::of(&images), ..Request::new(&near, &settings) };
        let scene = self.content.scene()?;
        let frame = view.method.on_cpu(&mut self.cpu, &scene, &request)?;
        let middle = side * AROUND + AROUND;
        let shows_cut = frame.focus.get(middle).is_none_or(|[surface, _]| *surface >= SHOWN);
        let depth = frame.depth().get(middle).copied().unwrap_or_default();
        let point = point + camera.direction() * f64::from(depth);
        if !shows_cut {
            // Beside the scan there is no brightest place, and no vessel.
            return Ok(self.brightest(view, pixel).unwrap_or_else(|_| self.told(point, None)));
        }
        let vessel = frame.vessel.get(middle).and_then(|vessel| usize::try_from(*vessel).ok());
        let reach = BESIDE.max(PIXELS_BESIDE * spacing);
        let vessel =
            vessel.filter(|vessel| self.vessel(*vessel).is_ok_and(|vessel| is_near(vessel, point, reach)));
        Ok(self.told(point, vessel))
    }

    /// What lies at a world point; the vessel where one is given.
    fn told(&self, point: DVec3, vessel: Option<usize>) -> Pick {
        let arc_length = vessel
            .and_then(|vessel| self.vessel(vessel).ok())
            .map(|vessel| nearest_arc_length(vessel, point));
        Pick { point: point.to_array(), value: self.value(point), vessel, arc_length }
    }

    /// What lies at a world point, and the vessel in whose lumen it is.
    pub fn at(&self, point: [f64; 3]) -> Pick {
        let point = DVec3::from_array(point);
        let vessels = self.content.tree().map_or(&[][..], |tree| tree.tree().vessels());
        let inside = vessels.iter().position(|vessel| {
            let near = vessel.points().iter().zip(0..);
            near.into_iter().any(|(p, i): (&DVec3, usize)| p.distance(point) <= vessel.radius_or_zero(i))
        });
        self.told(point, inside)
    }

    fn value(&self, point: DVec3) -> Option<f32> {
        let volume = self.content.held.as_ref().and_then(|held| held.volume().ok())?;
        windows::sample(&volume, &[point]).first().copied().filter(|value| value.is_finite())
    }
}

/// Whether a point lies in the lumen of a vessel, or at most `reach` mm beside it.
fn is_near(vessel: &Vessel, point: DVec3, reach: f64) -> bool {
    let at = nearest_arc_length(vessel, point);
    point.distance(point_at(vessel.points(), vessel.arc_length(), at)) <= radius_at(vessel, at) + reach
}

/// The arc length (mm) on a vessel that is nearest to a point.
fn nearest_arc_length(vessel: &Vessel, point: DVec3) -> f64 {
    let (points, along) = (vessel.points(), vessel.arc_length());
    let mut best = DVec2::new(f64::MAX, 0.0);
    for (i, ends) in points.windows(2).enumerate() {
        let way = ends[1] - ends[0];
        let t = ((point - ends[0]).dot(way) / way.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let distance = point.distance(ends[0] + way * t);
        if distance < best.x {
            best = DVec2::new(distance, along[i] + t * (along[i + 1] - along[i]));
        }
    }
    best.y
}
