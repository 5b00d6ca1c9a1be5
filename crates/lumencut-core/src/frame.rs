//! What a rendering leaves behind, pixel by pixel, row 0 on top.

use crate::camera::Camera;

/// How long one stage took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timing {
    /// The stage's name, the same as its room's.
    pub stage: &'static str,
    /// Wall time (ms).
    pub milliseconds: f64,
}

/// The images of one view; every buffer has `width × height` entries in rows from the top.
#[derive(Clone, Debug)]
pub struct Frame {
    /// The view.
    pub camera: Camera,
    /// RGBA.
    pub image: Vec<[u8; 4]>,
    /// Depth of the cut surface (mm).
    pub depth: Vec<f32>,
    /// Id of the vessel whose influence zone the pixel is in.
    pub vessel: Vec<i32>,
    /// Projected distance to the nearest centerline (mm).
    pub distance: Vec<f32>,
    /// The volume at the cut surface, NaN outside the volume.
    pub value: Vec<f32>,
    /// The context alone, RGBA with straight alpha; transparent where none was needed, empty without a context.
    pub context: Vec<[u8; 4]>,
    /// How long each stage took, in the order they ran.
    pub timings: Vec<Timing>,
}

impl Frame {
    /// A frame of `camera` with `pixels` pixels of depth, vessel and distance, still zero; the others have none yet.
    pub(crate) fn empty(camera: Camera, pixels: usize) -> Self {
        Self {
            camera,
            image: Vec::new(),
            depth: vec![0.0; pixels],
            vessel: vec![0; pixels],
            distance: vec![0.0; pixels],
            value: Vec::new(),
            context: Vec::new(),
            timings: Vec::new(),
        }
    }
}
