//! What a rendering leaves behind, pixel by pixel, row 0 on top.

use crate::geometry::Geometry;
use crate::stages::focus::Shares;
use crate::stages::{Image, ImageSet};

/// How long one stage took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timing {
    /// The stage's name, the same as its room's.
    pub stage: &'static str,
    /// Wall time (ms).
    pub milliseconds: f64,
}

/// The images of one view; every buffer has `width × height` entries in rows from the top, or none where the view does
/// not have the image.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Where the pixels look, with the depth of the cut surface.
    pub geometry: Geometry,
    /// RGBA.
    pub image: Vec<[u8; 4]>,
    /// Id of the vessel whose influence zone the pixel is in.
    pub vessel: Vec<i32>,
    /// Where the cut surface leaps ([`crate::stages::leap`]).
    pub leap: Vec<u32>,
    /// How much of the cut surface and of its silhouettes each pixel shows ([`crate::stages::focus`]); empty where all of both is
    /// shown.
    pub focus: Vec<Shares>,
    /// Projected distance to the nearest centerline (mm).
    pub distance: Vec<f32>,
    /// The volume at the cut surface, NaN outside the volume.
    pub value: Vec<f32>,
    /// The context alone, RGBA with straight alpha; transparent where none was needed, empty without a context.
    pub context: Vec<[u8; 4]>,
    /// Whether other points of the vessel share the pixel's place, by a reformation; empty by others.
    pub folded: Vec<bool>,
    /// How long each stage took, in the order they ran.
    pub timings: Vec<Timing>,
}

impl Frame {
    /// A frame that so far knows only where it looks.
    pub fn of(geometry: Geometry) -> Self {
        Self {
            geometry,
            image: Vec::new(),
            vessel: Vec::new(),
            leap: Vec::new(),
            focus: Vec::new(),
            distance: Vec::new(),
            value: Vec::new(),
            context: Vec::new(),
            folded: Vec::new(),
            timings: Vec::new(),
        }
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [usize; 2] {
        self.geometry.size()
    }

    /// Depth of the cut surface (mm); empty where there is none.
    pub fn depth(&self) -> &[f32] {
        self.geometry.depth()
    }

    /// Counts the time of stages that ran once more, each to its own.
    pub fn count(&mut self, timings: &[Timing]) {
        for more in timings {
            match self.timings.iter_mut().find(|known| known.stage == more.stage) {
                Some(known) => known.milliseconds += more.milliseconds,
                None => self.timings.push(*more),
            }
        }
    }

    /// The images that it has.
    pub fn images(&self) -> ImageSet {
        let present = [
            (Image::Picture, !self.image.is_empty()),
            (Image::Depth, !self.depth().is_empty()),
            (Image::Vessel, !self.vessel.is_empty()),
            (Image::Leap, !self.leap.is_empty()),
            (Image::Focus, !self.focus.is_empty()),
            (Image::Distance, !self.distance.is_empty()),
            (Image::Value, !self.value.is_empty()),
            (Image::Context, !self.context.is_empty()),
        ];
        let there = present.into_iter().filter(|(_, is_there)| *is_there);
        there.fold(ImageSet::of(&[]), |images, (image, _)| images.and(ImageSet::of(&[image])))
    }

    /// The same frame whose picture is transparent where it has no value, whatever the background.
    #[must_use]
    pub fn transparent_outside(mut self) -> Self {
        clear_outside(&mut self.image, &self.value);
        self
    }

    /// The same frame with those of its images that are among `wanted`.
    #[must_use]
    pub fn keeping(mut self, wanted: ImageSet) -> Self {
        fn keep<T>(pixels: &mut Vec<T>, is_wanted: bool) {
            if !is_wanted {
                *pixels = Vec::new();
            }
        }
        keep(&mut self.image, wanted.has(Image::Picture));
        keep(&mut self.vessel, wanted.has(Image::Vessel));
        keep(&mut self.leap, wanted.has(Image::Leap));
        keep(&mut self.focus, wanted.has(Image::Focus));
        keep(&mut self.distance, wanted.has(Image::Distance));
        keep(&mut self.value, wanted.has(Image::Value));
        keep(&mut self.context, wanted.has(Image::Context));
        if let Geometry::Orthographic { depth, .. } = &mut self.geometry {
            keep(depth, wanted.has(Image::Depth));
        }
        self
    }
}

/// Makes the pixels of a picture transparent where there is no value.
pub fn clear_outside(image: &mut [[u8; 4]], value: &[f32]) {
    let outside = image.iter_mut().zip(value).filter(|(_, value)| value.is_nan());
    outside.for_each(|(pixel, _)| *pixel = [0; 4]);
}
