//! The position of each pixel found by a reformation, and the frame for `look`, which shows the volume there.

use crate::error::{Error, ErrorKind, Result};
use crate::frame::Frame;
use crate::geometry::Geometry;
use crate::math::lanes::{ABSENT, FAR, Isa};
use crate::math::projection::Level;
use crate::pipeline::Request;
use crate::stages::depth::Sheet;
use crate::stages::leap::{LeapParameters, leap};
use crate::stages::{Stage, Work};

/// The vessel id of pixels that show no vessel.
pub const NO_VESSEL: i32 = -1;

#[derive(Clone, Copy, Debug)]
pub(super) struct PixelContent {
    pub depth: f32,
    pub vessel: i32,
    /// Slopes and radius, as the stage `leap` reads them.
    pub sheet: Sheet,
    /// Whether other points of the vessel share the pixel.
    pub is_folded: bool,
}

impl PixelContent {
    /// A pixel without a vessel: its depth lies beyond every volume, and silhouettes ignore its borders.
    pub(super) const NOTHING: Self =
        Self { depth: FAR, vessel: NO_VESSEL, sheet: [0.0, 0.0, -ABSENT, 0.0], is_folded: false };
}

pub(super) struct Found {
    pub depth: Vec<f32>,
    pub vessel: Vec<i32>,
    pub sheet: Vec<Sheet>,
    pub folded: Vec<bool>,
}

impl Found {
    pub(super) fn nothing(pixels: usize) -> Self {
        let PixelContent { depth, vessel, sheet, is_folded } = PixelContent::NOTHING;
        Self {
            depth: vec![depth; pixels],
            vessel: vec![vessel; pixels],
            sheet: vec![sheet; pixels],
            folded: vec![is_folded; pixels],
        }
    }

    pub(super) fn into_frame(self, request: &Request) -> Result<Frame> {
        let &Request { camera, settings, images, .. } = request;
        let mut leaps = Vec::new();
        if Stage::of_cut_surface(settings, images).contains(&Stage::Leap) {
            leaps = vec![0; self.depth.len()];
            let places = (&self.depth[..], &self.vessel[..]);
            leap(&work(request), &LeapParameters::new(camera), places, &self.sheet, &mut leaps)?;
        }
        let geometry = Geometry::Orthographic { camera: *camera, depth: self.depth };
        Ok(Frame { vessel: self.vessel, leap: leaps, folded: self.folded, ..Frame::of(geometry) })
    }
}

pub(super) fn work<'a>(request: &Request<'a>) -> Work<'a> {
    let &Request { camera, stop, .. } = request;
    Work { size: camera.size(), isa: Isa::widest(), stop, progress: None }
}

/// Rejects vessels of no length, which have no direction.
pub(super) fn expect_lengths(level: &Level) -> Result<()> {
    let Some(id) = level.first_slot.windows(2).position(|ends| ends[1] - ends[0] < 2) else { return Ok(()) };
    let found = "all points within 0.001 mm of each other";
    let expected = "a vessel with a length";
    Err(Error::new(ErrorKind::VesselTree, format!("vessel {id} of the tree"), found, expected)
        .mend("leave this vessel out"))
}
