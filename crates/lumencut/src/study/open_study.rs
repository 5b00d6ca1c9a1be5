//! What the page can ask of the study that is open, but for the turning view itself: all of it on the CPU.

use crate::feature_aggregation::{Feature, feature_aggregation};
use crate::positions::world_from_pixel;
use crate::views;
use crate::windows;
use glam::{DVec2, DVec3};
use lumencut_core::camera::Camera;
use lumencut_core::frame::Frame;
use lumencut_core::geometry::Geometry;
use lumencut_core::pipeline::{self, CpuRenderer, Request};
use lumencut_core::settings::{Settings, Window};
use lumencut_core::stages::{Image, ImageSet};
use lumencut_core::vessel_tree::Vessel;
use lumencut_core::with_voxels;
use lumencut_vessels::measure::cross_section::section_place;
use lumencut_vessels::trace::clicks::tracer::Tracer;
use serde::Serialize;

use crate::study::content::Content;
use crate::study::failure::{Failure, Result};
use crate::study::held_volume::HeldVolume;
use crate::study::histogram::Histogram;
use crate::study::lines::Lines;
use crate::study::planes::Plane;
use crate::study::profiles::Profiles;
use crate::study::straightened::{CprMessage, Laid};
use crate::study::view::{CameraMessage, View};

/// How many pixels around one decide what it shows: as far as the depth filter and the leaps look.
const AROUND: usize = 8;

/// A picture: RGBA in rows from the top, and its size.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Columns and rows.
    pub size: [usize; 2],
    /// A byte for each channel.
    pub bytes: Vec<u8>,
}

/// What a pixel shows.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Pick {
    /// The world point.
    pub point: [f64; 3],
    /// The volume there; none outside.
    pub value: Option<f32>,
    /// The vessel whose zone it is in.
    pub vessel: Option<usize>,
    /// The place on the vessel that is nearest (mm).
    pub arc_length: Option<f64>,
}

/// The study, and what its pictures keep from one to the next.
#[derive(Default)]
pub struct Study {
    /// What is open.
    pub content: Content,
    pub(crate) cpu: CpuRenderer,
    pub(crate) laid: Option<Laid>,
    /// What was measured.
    pub(crate) profiles: Profiles,
    /// All lines of the study.
    pub lines: Lines,
    /// What is known of the volume from one tracing to the next, and the lines that it gave last.
    pub(crate) tracer: Tracer,
    pub(crate) traced: Vec<usize>,
    /// A mask that is read to be traced.
    pub(crate) mask: Option<HeldVolume>,
}

impl Study {
    /// The camera of a named view that shows all of the study in `size` pixels.
    ///
    /// # Errors
    /// `camera` for another name, and where nothing is open.
    pub fn fitted(&self, view: &str, size: [usize; 2]) -> Result<CameraMessage> {
        let named = views::named(view)?;
        let camera = Camera::new(DVec3::ZERO, named.direction, named.up, size, 1.0)?;
        Ok(CameraMessage::from(&views::fitted(&camera, &self.content.outline()?)?))
    }

    /// What the pixel (column, row) of a view shows.
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
        let images = ImageSet::of(&[Image::Depth, Image::Vessel, Image::Value]);
        let request = Request { images, ..Request::new(&near, &settings) };
        let scene = self.content.scene()?;
        let frame = view.method.on_cpu(&mut self.cpu, &scene, &request)?;
        let middle = side * AROUND + AROUND;
        let depth = frame.depth().get(middle).copied().unwrap_or_default();
        let point = point + camera.direction() * f64::from(depth);
        let vessel = frame.vessel.get(middle).and_then(|vessel| usize::try_from(*vessel).ok());
        Ok(self.told(point, vessel))
    }

    /// What lies at a world point; the vessel where one is given.
    fn told(&self, point: DVec3, vessel: Option<usize>) -> Pick {
        let arc_length =
            vessel.and_then(|vessel| self.vessel(vessel).ok()).map(|vessel| nearest(vessel, point));
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

    /// How many voxels lie in each of `bins` equally wide ranges between the smallest and the largest that are looked at.
    ///
    /// # Errors
    /// `volume` where none is open.
    pub fn histogram(&self, bins: usize) -> Result<Histogram> {
        let held = self.content.held.as_ref().ok_or_else(no_volume)?;
        Ok(with_voxels!(held.stored.voxels(), voxels => Histogram::of(voxels, bins)))
    }

    /// The picture of a plane in a window.
    ///
    /// # Errors
    /// `camera` for a plane without pixels, `volume` where none is open.
    pub fn slice(&self, plane: &Plane, window: [f64; 2]) -> Result<Picture> {
        self.shown(plane.geometry()?, window)
    }

    /// The section across a vessel at an arc length (mm), or at the nearest end: the point on the vessel, and unit vectors to
    /// the right and downwards. Once the vessel is measured it is the nearest section that was.
    ///
    /// # Errors
    /// `vessel tree` for a vessel that there is not.
    pub fn across(&self, number: usize, at: f64) -> Result<[[f64; 3]; 3]> {
        let vessel = self.vessel(number)?;
        let length = vessel.arc_length().last().copied().unwrap_or(0.0);
        let line = self.content.named.as_ref().and_then(|named| named.lines.get(number));
        let profile = line.and_then(|line| self.profiles.any_of(*line));
        let place = section_place(vessel, at.clamp(0.0, length), profile)?;
        Ok([place.origin, place.axes[0], place.axes[1]].map(|vector| vector.to_array()))
    }

    /// The straightened CPR of a vessel in a window.
    ///
    /// # Errors
    /// `vessel tree` for a vessel that there is not, and those of the layout.
    pub fn straightened(&mut self, message: CprMessage, window: [f64; 2]) -> Result<Picture> {
        let laid = Laid::new(message, self.vessel(message.vessel)?, self.laid.as_ref())?;
        let picture = match message.feature {
            Some(feature) => self.aggregated(&laid, message.pixel_spacing, feature.into(), window)?,
            None => self.shown(Geometry::Curved(laid.cpr.curved()?), window)?,
        };
        self.laid = Some(laid);
        Ok(picture)
    }

    /// The layout of the CPR that was shown last.
    pub fn laid(&self) -> Option<&Laid> {
        self.laid.as_ref()
    }

    fn vessel(&self, number: usize) -> Result<&Vessel> {
        let vessels = self.content.tree().map_or(&[][..], |tree| tree.tree().vessels());
        vessels.get(number).ok_or_else(|| {
            Failure::of_message("number of the vessel", &number, &format!("a number below {}", vessels.len()))
        })
    }

    fn aggregated(&self, laid: &Laid, spacing: f64, feature: Feature, window: [f64; 2]) -> Result<Picture> {
        let volume = self.content.scene()?.volume.ok_or_else(no_volume)?;
        let (camera, settings) = shown_flat(window)?;
        let request = Request::new(&camera, &settings);
        let value = feature_aggregation(&volume, &laid.cpr, spacing, feature, &request)?;
        let size = laid.cpr.size();
        Ok(Picture { size, bytes: pipeline::picture(&value, size, &settings)?.into_flattened() })
    }

    fn shown(&self, geometry: Geometry, window: [f64; 2]) -> Result<Picture> {
        let size = geometry.size();
        let volume = self.content.scene()?.volume.ok_or_else(no_volume)?;
        let (camera, settings) = shown_flat(window)?;
        let request = Request { images: ImageSet::of(&[Image::Picture]), ..Request::new(&camera, &settings) };
        let frame = self.cpu.look(&volume, Frame::of(geometry), &request)?;
        Ok(Picture { size, bytes: frame.image.into_flattened() })
    }
}

/// The settings of a flat picture in a window, and a camera, which it does not ask for.
fn shown_flat([level, width]: [f64; 2]) -> Result<(Camera, Settings)> {
    let camera = Camera::new(DVec3::ZERO, DVec3::Y, DVec3::Z, [1, 1], 1.0)?;
    Ok((camera, Settings { window: Window { level, width }, context: None, ..Settings::default() }))
}

/// The error for a question that only a volume answers.
pub(crate) fn no_volume() -> Failure {
    Failure { kind: "volume", ..Failure::of_message("volume", &"none", "one that is open") }
}

/// The arc length (mm) on a vessel that is nearest to a point.
fn nearest(vessel: &Vessel, point: DVec3) -> f64 {
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
