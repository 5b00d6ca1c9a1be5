//! What the page can ask of the study that is open, but for the turning view itself: all of it on the CPU.

use crate::views;
use glam::DVec3;
use lumencut_core::camera::Camera;
use lumencut_core::frame::Frame;
use lumencut_core::geometry::Geometry;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::Scene;
use lumencut_core::settings::{Settings, Window};
use lumencut_core::stages::{Image, ImageSet};
use lumencut_core::vessel_tree::Vessel;
use lumencut_core::with_voxels;
use lumencut_vessels::measure::cross_section::section_place;
use lumencut_vessels::trace::clicks::tracer::Tracer;
use lumencut_vessels::trace::find::found::Trees;

use crate::study::content::{Content, Report};
use crate::study::failure::{Failure, Result};
use crate::study::held_volume::{HeldMask, no_volume};
use crate::study::histogram::Histogram;
use crate::study::lines::Lines;
use crate::study::planes::Plane;
use crate::study::profiles::Profiles;
use crate::study::reformed::Reformed;
use crate::study::straightened::Laid;
use crate::study::view::{CameraMessage, View, ViewMessage};

/// A picture: RGBA in rows from the top, and its size.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Picture {
    /// Columns and rows.
    pub size: [usize; 2],
    /// A byte for each channel.
    #[cfg_attr(test, ts(type = "Bytes"))]
    pub bytes: Vec<u8>,
}

/// The study, and what its pictures keep from one to the next.
#[derive(Default)]
pub struct Study {
    /// What is open.
    pub content: Content,
    pub(crate) cpu: CpuRenderer,
    pub(crate) laid: Option<Laid>,
    pub(crate) reformed: Option<Reformed>,
    /// What was measured.
    pub(crate) profiles: Profiles,
    /// All lines of the study.
    pub(crate) lines: Lines,
    /// What is known of the volume from one tracing to the next, and the lines that it gave last.
    pub(crate) tracer: Tracer,
    pub(crate) traced: Vec<usize>,
    /// The vessels of the scan, once they were looked for.
    pub(crate) trees: Option<Trees>,
    /// The largest id that a vessel of the document was given.
    pub(crate) last_id: u32,
    /// A mask that is read to be traced.
    pub(crate) mask: Option<HeldMask>,
}

impl Study {
    /// What the renderers show.
    ///
    /// # Errors
    /// `volume` for an invalid grid.
    pub fn scene(&self) -> Result<Scene<'_>> {
        self.content.scene()
    }

    /// A view of what is open. Where no vessels are shown a focus counts for nothing: a page that asks for one may not know yet that
    /// the last vessel is gone.
    ///
    /// # Errors
    /// Those of [`ViewMessage::view`].
    pub fn view_of(&self, message: &ViewMessage) -> Result<View> {
        let mut view = message.view()?;
        if self.content.tree().is_none() {
            view.settings.focus = None;
        }
        Ok(view)
    }

    /// What a viewer must know of what is open: the volume's size, grid and windows, and the vessels with names and lengths.
    ///
    /// # Errors
    /// `volume` for values beyond all windows.
    pub(crate) fn report(&self) -> Result<Report> {
        self.content.report()
    }

    /// The camera of a named view that shows all of the study in `size` pixels.
    ///
    /// # Errors
    /// `camera` for another name, and where nothing is open.
    pub(crate) fn fitted(&self, view: &str, size: [usize; 2]) -> Result<CameraMessage> {
        let named = views::named(view)?;
        let camera = Camera::new(DVec3::ZERO, named.direction, named.up, size, 1.0)?;
        Ok(CameraMessage::from(&views::fitted(&camera, &self.content.outline()?)?))
    }

    /// How many voxels lie in each of `bins` equally wide ranges between the smallest and the largest that are looked at.
    ///
    /// # Errors
    /// `volume` where none is open.
    pub(crate) fn histogram(&self, bins: usize) -> Result<Histogram> {
        let held = self.content.held.as_ref().ok_or_else(no_volume)?;
        Ok(with_voxels!(held.stored.voxels(), voxels => Histogram::of(voxels, bins)))
    }

    /// The picture of a plane in a window.
    ///
    /// # Errors
    /// `camera` for a plane without pixels, `volume` where none is open.
    pub(crate) fn slice(&self, plane: &Plane, window: [f64; 2]) -> Result<Picture> {
        self.shown(plane.geometry()?, window)
    }

    /// The section across a vessel at an arc length (mm), or at the nearest end: the point on the vessel, and unit vectors to
    /// the right and downwards. Once the vessel is measured it is the nearest section that was.
    ///
    /// # Errors
    /// `vessel tree` for a vessel that there is not.
    pub(crate) fn across(&self, number: usize, at: f64) -> Result<[[f64; 3]; 3]> {
        let vessel = self.vessel(number)?;
        let length = vessel.arc_length().last().copied().unwrap_or(0.0);
        let line = self.content.named.as_ref().and_then(|named| named.lines.get(number));
        let profile = line.and_then(|line| self.profiles.any_of(*line));
        let place = section_place(vessel, at.clamp(0.0, length), profile)?;
        Ok([place.origin, place.axes[0], place.axes[1]].map(|vector| vector.to_array()))
    }

    pub(crate) fn vessel(&self, number: usize) -> Result<&Vessel> {
        let vessels = self.content.tree().map_or(&[][..], |tree| tree.tree().vessels());
        vessels.get(number).ok_or_else(|| {
            Failure::of_message("number of the vessel", &number, &format!("a number below {}", vessels.len()))
        })
    }

    pub(crate) fn shown(&self, geometry: Geometry, window: [f64; 2]) -> Result<Picture> {
        let size = geometry.size();
        let volume = self.scene()?.volume.ok_or_else(no_volume)?;
        let (camera, settings) = shown_flat(window)?;
        let request = Request { images: ImageSet::of(&[Image::Picture]), ..Request::new(&camera, &settings) };
        let frame = self.cpu.look(&volume, Frame::of(geometry), &request)?;
        Ok(Picture { size, bytes: frame.image.into_flattened() })
    }
}

/// The settings of a flat picture in a window, and a camera, which it does not ask for.
pub(crate) fn shown_flat([level, width]: [f64; 2]) -> Result<(Camera, Settings)> {
    let camera = Camera::new(DVec3::ZERO, DVec3::Y, DVec3::Z, [1, 1], 1.0)?;
    Ok((camera, Settings { window: Window { level, width }, context: None, ..Settings::default() }))
}
