//! The images of a view on the GPU, one number or vector per pixel; they are kept while the size stays.

use wgpu::Buffer;

use crate::device::Device;

/// The images of a view.
#[derive(Debug)]
pub(crate) struct Images {
    pub size: [usize; 2],
    pub distance: Buffer,
    /// The depth before and after the filter.
    pub unfiltered: Buffer,
    pub depth: Buffer,
    pub vessel: Buffer,
}

impl Images {
    /// Images for views of this size.
    pub fn new(device: &Device, size: [usize; 2]) -> Self {
        let number = |label| device.image(label, size[0] * size[1], 4);
        Self {
            size,
            distance: number("distance"),
            unfiltered: number("unfiltered depth"),
            depth: number("depth"),
            vessel: number("vessel"),
        }
    }

    /// The number of pixels.
    pub fn pixels(&self) -> usize {
        self.size[0] * self.size[1]
    }
}
