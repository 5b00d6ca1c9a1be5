//! The open study and its basic questions. Only the 3D view can use a GPU.

use crate::views;
use glam::DVec3;
use lumencut_core::camera::Camera;
use lumencut_core::frame::Frame;
use lumencut_core::geometry::Geometry;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::Scene;
use lumencut_core::settings::{Settings, Slab, Window};
use lumencut_core::stages::{Image, ImageSet};
use lumencut_core::vessel_tree::Vessel;
use lumencut_core::with_voxels;
use lumencut_vessels::measure::profile::cross_section::section_place;
use lumencut_vessels::trace::clicks::tracer::Tracer;
use lumencut_vessels::trace::find::found::Trees;

use crate::study::content::{Content, Report};
use crate::study::failure::{Failure, Result};
use crate::study::held_volume::{HeldMask, no_volume};
use crate::study::histogram::Histogram;
use crate::study::hung::hung;
use crate::study::lines::Lines;
use crate::study::planes::Plane;
use crate::study::profiles::Profiles;
use crate::study::reformations::Reformed;
use crate::study::straightened::Laid;
use crate::study::view::{CameraMessage, View, ViewMessage};

/// RGBA in rows from the top.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Picture {
    /// Columns and rows.
    pub size: [usize; 2],
    /// One byte per channel.
    #[cfg_attr(test, ts(type = "Bytes"))]
    pub bytes: Vec<u8>,
}

/// The open study and its caches.
#[derive(Default)]
pub struct Study {
    /// The volume and tree.
    pub content: Content,
    pub(crate) cpu: CpuRenderer,
    pub(crate) laid: Option<Laid>,
    pub(crate) reformed: Option<Reformed>,
    pub(crate) profiles: Profiles,
    pub(crate) lines: Lines,
    /// The data of the volume that are kept between tracings, and the last lines.
    pub(crate) tracer: Tracer,
    pub(crate) traced: Vec<usize>,
    /// The vessels of the scan; None until they are searched for.
    pub(crate) trees: Option<Trees>,
    pub(crate) last_id: u32,
    pub(crate) mask: Option<HeldMask>,
}

impl Study {
    /// The open volume and vessels as the scene that renderers need. Fails with an error of kind `volume` for an
    /// invalid grid.
    pub fn scene(&self) -> Result<Scene<'_>> {
        self.content.scene()
    }

    /// Checks a view. Without shown vessels its focus is ignored, since the page may not yet know that the last vessel is gone.
    /// A rim without values is ignored too; `rim_legend` returns the reason.
    pub fn view_of(&self, message: &ViewMessage) -> Result<View> {
        let mut view = message.view()?;
        if self.content.tree().is_none() {
            view.settings.focus = None;
        }
        let along = self.of_rim(&view.settings, &message.vessels).ok().flatten();
        view.rim = along.and_then(|along| along.rim().ok());
        view.settings.rim = view.settings.rim.filter(|_| view.rim.is_some());
        Ok(view)
    }

    pub(crate) fn report(&self) -> Result<Report> {
        self.content.report()
    }

    pub(crate) fn fitted(&self, view: &str, size: [usize; 2]) -> Result<CameraMessage> {
        let named = views::named(view)?;
        let camera = Camera::new(DVec3::ZERO, named.direction, named.up, size, 1.0)?;
        Ok(CameraMessage::from(&views::fitted(&camera, &self.content.outline()?)?))
    }

    /// The number of voxels in each of `bins` value ranges of equal width.
    pub(crate) fn histogram(&self, bins: usize) -> Result<Histogram> {
        let held = self.content.held.as_ref().ok_or_else(no_volume)?;
        Ok(with_voxels!(held.stored.voxels(), voxels => Histogram::of(voxels, bins)))
    }

    pub(crate) fn slice(&self, plane: &Plane, window: [f64; 2]) -> Result<Picture> {
        self.shown(plane.geometry()?, (window, plane.slab()?))
    }

    /// The section at an arc length (mm), clamped to the ends: centre and unit vectors right and down. If the vessel was measured,
    /// it is the nearest measured section.
    pub(crate) fn across(&self, number: usize, at: f64) -> Result<[[f64; 3]; 3]> {
        let vessel = self.vessel(number)?;
        let length = vessel.arc_length().last().copied().unwrap_or(0.0);
        let line = self.content.named.as_ref().and_then(|named| named.lines.get(number));
        let profile = line.and_then(|line| self.profiles.any_of(*line));
        let place = section_place(vessel, at.clamp(0.0, length), profile)?;
        let [right, down] = hung(place.normal);
        Ok([place.origin, right, down].map(|vector| vector.to_array()))
    }

    pub(crate) fn vessel(&self, number: usize) -> Result<&Vessel> {
        let vessels = self.content.tree().map_or(&[][..], |tree| tree.tree().vessels());
        vessels.get(number).ok_or_else(|| {
            Failure::of_message("number of the vessel", &number, &format!("a number below {}", vessels.len()))
        })
    }

    pub(crate) fn shown(
        &self,
        geometry: Geometry,
        (window, slab): ([f64; 2], Option<Slab>),
    ) -> Result<Picture> {
        let size = geometry.size();
        let volume = self.scene()?.volume.ok_or_else(no_volume)?;
        let (camera, flat) = shown_flat(window)?;
        let settings = Settings { slab, ..flat };
        let request = Request { images: ImageSet::of(&[Image::Picture]), ..Request::new(&camera, &settings) };
        let frame = self.cpu.look(&volume, Frame::of(geometry), &request)?;
        Ok(Picture { size, bytes: frame.image.into_flattened() })
    }
}

pub(crate) fn shown_flat([level, width]: [f64; 2]) -> Result<(Camera, Settings)> {
    let camera = Camera::new(DVec3::ZERO, DVec3::Y, DVec3::Z, [1, 1], 1.0)?;
    Ok((camera, Settings { window: Window { level, width }, context: None, ..Settings::default() }))
}
