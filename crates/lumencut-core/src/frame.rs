//! The result of a rendering: one image per quantity, row 0 on top.

use crate::geometry::Geometry;
use crate::stages::depth::Blend;
use crate::stages::focus::Shares;
use crate::stages::{Image, ImageSet};

/// The time that one stage took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timing {
    /// Name of the stage and of its module.
    pub stage: &'static str,
    /// Wall time (ms).
    pub milliseconds: f64,
}

/// The images of one view: `width × height` entries in rows from the top; a missing image is empty.
#[derive(Clone, Debug)]
pub struct Frame {
    /// The position of every pixel, with the depth of the cut surface.
    pub geometry: Geometry,
    /// RGBA.
    pub image: Vec<[u8; 4]>,
    /// Id of the vessel that each pixel belongs to.
    pub vessel: Vec<i32>,
    /// Cost, level and kind of piece of the depth before its filter; empty in views that show the volume.
    pub blend: Vec<Blend>,
    /// Bits that mark depth jumps between neighbouring pixels ([`crate::stages::leap`]).
    pub leap: Vec<u32>,
    /// Shares of cut surface and silhouettes shown ([`crate::stages::focus`]); empty if all is shown.
    pub focus: Vec<Shares>,
    /// Colour and share of the rim around the vessels ([`crate::stages::rim`]); empty without one.
    pub rim: Vec<[u8; 4]>,
    /// Distance to the nearest centerline in the image plane (mm).
    pub distance: Vec<f32>,
    /// The volume at the cut surface, NaN outside the volume.
    pub value: Vec<f32>,
    /// The context alone: RGBA, straight alpha, transparent in pixels that need none; empty without a context.
    pub context: Vec<[u8; 4]>,
    /// For reformations: whether other points of the vessel share the pixel. Otherwise empty.
    pub folded: Vec<bool>,
    /// The time of each stage, in the order in which they ran.
    pub timings: Vec<Timing>,
}

impl Frame {
    /// A frame that has positions but no images yet.
    pub fn of(geometry: Geometry) -> Self {
        Self {
            geometry,
            image: Vec::new(),
            vessel: Vec::new(),
            blend: Vec::new(),
            leap: Vec::new(),
            focus: Vec::new(),
            rim: Vec::new(),
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

    /// Depth of the cut surface (mm); empty if there is none.
    pub fn depth(&self) -> &[f32] {
        self.geometry.depth()
    }

    /// Adds the times of further stages; times of the same stage are summed.
    pub fn count(&mut self, timings: &[Timing]) {
        for more in timings {
            match self.timings.iter_mut().find(|known| known.stage == more.stage) {
                Some(known) => known.milliseconds += more.milliseconds,
                None => self.timings.push(*more),
            }
        }
    }

    /// The images that the frame has.
    pub fn images(&self) -> ImageSet {
        let present = [
            (Image::Picture, !self.image.is_empty()),
            (Image::Depth, !self.depth().is_empty()),
            (Image::Vessel, !self.vessel.is_empty()),
            (Image::Blend, !self.blend.is_empty()),
            (Image::Leap, !self.leap.is_empty()),
            (Image::Focus, !self.focus.is_empty()),
            (Image::Rim, !self.rim.is_empty()),
            (Image::Distance, !self.distance.is_empty()),
            (Image::Value, !self.value.is_empty()),
            (Image::Context, !self.context.is_empty()),
        ];
        let there = present.into_iter().filter(|(_, is_there)| *is_there);
        there.fold(ImageSet::of(&[]), |images, (image, _)| images.and(ImageSet::of(&[image])))
    }

    /// Makes the picture transparent in pixels without a value, for any background.
    #[must_use]
    pub fn transparent_outside(mut self) -> Self {
        clear_outside(&mut self.image, &self.value);
        self
    }

    /// Drops the images that are not in `wanted`.
    #[must_use]
    pub fn keeping(mut self, wanted: ImageSet) -> Self {
        fn keep<T>(pixels: &mut Vec<T>, is_wanted: bool) {
            if !is_wanted {
                *pixels = Vec::new();
            }
        }
        keep(&mut self.image, wanted.has(Image::Picture));
        keep(&mut self.vessel, wanted.has(Image::Vessel));
        keep(&mut self.blend, wanted.has(Image::Blend));
        keep(&mut self.leap, wanted.has(Image::Leap));
        keep(&mut self.focus, wanted.has(Image::Focus));
        keep(&mut self.rim, wanted.has(Image::Rim));
        keep(&mut self.distance, wanted.has(Image::Distance));
        keep(&mut self.value, wanted.has(Image::Value));
        keep(&mut self.context, wanted.has(Image::Context));
        if let Geometry::Orthographic { depth, .. } = &mut self.geometry {
            keep(depth, wanted.has(Image::Depth));
        }
        self
    }
}

pub(crate) fn clear_outside(image: &mut [[u8; 4]], value: &[f32]) {
    let outside = image.iter_mut().zip(value).filter(|(_, value)| value.is_nan());
    outside.for_each(|(pixel, _)| *pixel = [0; 4]);
}
