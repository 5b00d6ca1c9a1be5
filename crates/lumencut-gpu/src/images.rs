//! The images of a view on the GPU, one number or vector per pixel. They are kept until the size changes.

use lumencut_core::error::Result;
use lumencut_core::math::ray_lines::RayGrid;
use lumencut_core::stages::Image;
use wgpu::Buffer;

use crate::device::Device;

/// The images by their names in the table of stages.
#[derive(Debug)]
pub(crate) struct Images {
    pub size: [usize; 2],
    pub distance: Buffer,
    pub unfiltered_depth: Buffer,
    pub depth: Buffer,
    pub vessel: Buffer,
    pub sheet: Buffer,
    pub before: Buffer,
    pub leap: Buffer,
    pub focus: Buffer,
    pub rim: Buffer,
    pub value: Buffer,
    /// First the depth filtered along columns only (within zones), later the slopes that give the silhouettes.
    pub raised: Buffer,
    pub strength: Buffer,
    pub start: Buffer,
    pub gathered: Buffer,
    /// Colour and start of the ray of each square of a preview.
    pub squares: Buffer,
    pub context: Buffer,
    pub picture: Buffer,
}

const MAX_PIXEL_BYTES: usize = size_of::<[f32; 4]>();

impl Images {
    pub(crate) fn new(device: &Device, size: [usize; 2]) -> Result<Self> {
        let pixels = size[0] * size[1];
        let most = device.limits.max_storage_buffer_binding_size as usize / MAX_PIXEL_BYTES;
        if pixels > most {
            let found = format!("{} × {} pixels", size[0], size[1]);
            return Err(device.too_large("size of the camera", found, &format!("{most} pixels")));
        }
        let number = |label| device.image(label, pixels, 4);
        Ok(Self {
            size,
            distance: number("distance"),
            unfiltered_depth: number("unfiltered depth"),
            depth: number("depth"),
            vessel: number("vessel"),
            sheet: device.image("sheet", pixels, MAX_PIXEL_BYTES),
            before: number("before"),
            leap: number("leap"),
            focus: device.image("focus", pixels, MAX_PIXEL_BYTES),
            rim: number("rim"),
            value: number("value"),
            raised: number("raised slope"),
            strength: number("strength"),
            start: number("start"),
            gathered: device.image("gathered", pixels, MAX_PIXEL_BYTES),
            squares: device.image("squares", RayGrid::squares(size).iter().product(), 2 * MAX_PIXEL_BYTES),
            context: number("context"),
            picture: number("picture"),
        })
    }

    /// The buffer of an image. If no filter runs, the depth is the unfiltered depth.
    pub(crate) fn buffer(&self, image: Image, has_filter: bool) -> &Buffer {
        match image {
            Image::Distance => &self.distance,
            Image::UnfilteredDepth if has_filter => &self.unfiltered_depth,
            Image::UnfilteredDepth | Image::Depth => &self.depth,
            Image::Vessel => &self.vessel,
            Image::Sheet => &self.sheet,
            // Never needed at the same time, see `Stage::has_blend` and `Stage::has_foot`.
            Image::Blend | Image::Foot | Image::Gathered => &self.gathered,
            Image::Before => &self.before,
            Image::Leap => &self.leap,
            Image::Focus => &self.focus,
            Image::Rim => &self.rim,
            Image::Value => &self.value,
            Image::Strength => &self.strength,
            Image::Start => &self.start,
            Image::Context => &self.context,
            Image::Picture => &self.picture,
        }
    }

    pub(crate) fn pixels(&self) -> usize {
        self.size[0] * self.size[1]
    }
}
