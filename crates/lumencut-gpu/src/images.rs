//! The images of a view on the GPU, one number or vector per pixel; they are kept while the size stays.

use lumencut_core::error::Result;
use wgpu::Buffer;

use crate::device::Device;

/// The images of a view.
#[derive(Debug)]
pub(crate) struct Images {
    pub size: [usize; 2],
    pub distance: Buffer,
    /// The depth before the filter.
    pub unfiltered: Buffer,
    pub depth: Buffer,
    pub vessel: Buffer,
    pub value: Buffer,
    /// The slope that silhouettes are made of.
    pub raised: Buffer,
    pub strength: Buffer,
    /// Where the rays of the context start.
    pub start: Buffer,
    /// Colours times opacity, and opacity.
    pub context: Buffer,
    /// The context and the picture, RGBA.
    pub layer: Buffer,
    pub image: Buffer,
}

/// The bytes of a pixel in the largest image.
const MOST_BYTES: usize = size_of::<[f32; 4]>();

impl Images {
    /// Images for views of this size.
    ///
    /// # Errors
    /// [`lumencut_core::error::ErrorKind::Device`] for more pixels than the GPU's buffers hold.
    pub fn new(device: &Device, size: [usize; 2]) -> Result<Self> {
        let pixels = size[0] * size[1];
        let most = device.limits.max_storage_buffer_binding_size as usize / MOST_BYTES;
        if pixels > most {
            let found = format!("{} × {} pixels", size[0], size[1]);
            return Err(device.too_large("size of the camera", found, &format!("{most} pixels")));
        }
        let number = |label| device.image(label, pixels, 4);
        Ok(Self {
            size,
            distance: number("distance"),
            unfiltered: number("unfiltered depth"),
            depth: number("depth"),
            vessel: number("vessel"),
            value: number("value"),
            raised: number("raised slope"),
            strength: number("strength"),
            start: number("start of the rays"),
            context: device.image("context", pixels, MOST_BYTES),
            layer: number("context layer"),
            image: number("image"),
        })
    }

    /// The number of pixels.
    pub fn pixels(&self) -> usize {
        self.size[0] * self.size[1]
    }
}
