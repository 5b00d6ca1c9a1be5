//! The images of one view in the making, on the CPU.

use crate::camera::Camera;
use crate::frame::{Frame, Timing};
use crate::geometry::Geometry;
use crate::stages::depth::{Blend, Foot, Sheet};
use crate::stages::focus::Shares;

/// The images by their names in the table of stages; a missing image is empty.
#[derive(Debug, Default)]
#[allow(missing_docs)]
pub struct Images {
    pub distance: Vec<f32>,
    pub unfiltered_depth: Vec<f32>,
    pub depth: Vec<f32>,
    pub vessel: Vec<i32>,
    pub sheet: Vec<Sheet>,
    pub blend: Vec<Blend>,
    pub foot: Vec<Foot>,
    pub leap: Vec<u32>,
    pub focus: Vec<Shares>,
    pub rim: Vec<[u8; 4]>,
    pub value: Vec<f32>,
    pub strength: Vec<f32>,
    pub start: Vec<f32>,
    pub gathered: Vec<[f32; 4]>,
    pub context: Vec<[u8; 4]>,
    pub picture: Vec<[u8; 4]>,
}

impl Images {
    /// A frame of the cut surface. Without a filter, its depth is the unfiltered one.
    pub(super) fn into_cut_surface(self, camera: Camera, timings: Vec<Timing>) -> Frame {
        let depth = if self.depth.is_empty() { self.unfiltered_depth } else { self.depth };
        let geometry = Geometry::Orthographic { camera, depth };
        let Self { vessel, blend, leap, focus, rim, distance, .. } = self;
        Frame { vessel, blend, leap, focus, rim, distance, timings, ..Frame::of(geometry) }
    }

    pub(super) fn into_frame(self, mut frame: Frame, timings: Vec<Timing>) -> Frame {
        frame.timings.extend(timings);
        Frame { value: self.value, context: self.context, image: self.picture, ..frame }
    }
}
