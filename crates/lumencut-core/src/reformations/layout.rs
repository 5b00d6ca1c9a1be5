//! The interface of reformations that lay vessels out as an image.

use glam::{DVec2, DVec3, Vec3};
use rayon::prelude::*;

use crate::camera::{MAX_PIXELS, MAX_SIZE};
use crate::error::{Error, ErrorKind, Mend, Result};
use crate::geometry::Curved;
use crate::stop::{Stop, filled, go_on};

/// An image with one world position per pixel. Image positions are column and row, with fractions; the centre of the
/// first pixel is (0, 0). World points are LPS, in mm.
pub trait Layout: Send + Sync {
    /// Width and height in pixels.
    fn size(&self) -> [usize; 2];

    /// The side of a pixel (mm).
    fn pixel_spacing(&self) -> f64;

    /// World position and slab direction of each pixel; a position that is not finite shows nothing.
    fn curved(&self, stop: Stop) -> Result<Curved>;

    /// Arc length (mm): one per row if rows run along one vessel, else per pixel; NaN if nothing is shown.
    fn arc_length(&self, stop: Stop) -> Result<Vec<f64>>;

    /// Whether each pixel is unreliable: the image runs backwards, or shows the same point elsewhere too.
    fn folded(&self, stop: Stop) -> Result<Vec<bool>>;

    /// The world point at an image position.
    fn world_from_pixel(&self, pixel: DVec2) -> DVec3;

    /// The image position of a world point.
    fn pixel_from_world(&self, point: DVec3) -> DVec2;
}

pub(super) fn by_rows<T: Clone + Send>(
    [width, height]: [usize; 2],
    nothing: T,
    stop: Stop,
    write: impl Fn(usize, &mut [T]) + Sync,
) -> Result<Vec<T>> {
    let mut image = filled(width * height, nothing, stop)?;
    image.par_chunks_mut(width).enumerate().try_for_each(|(row, pixels)| {
        go_on(stop)?;
        write(row, pixels);
        Ok(())
    })?;
    Ok(image)
}

/// Positions and slab directions, written row by row; a pixel that no row writes shows nothing.
pub(super) fn curved_by_rows(
    size: [usize; 2],
    stop: Stop,
    write: impl Fn(usize, &mut [DVec3], &mut [Vec3]) + Sync,
) -> Result<Curved> {
    let [width, height] = size;
    let mut position = filled(width * height, DVec3::NAN, stop)?;
    let mut direction = filled(width * height, Vec3::ZERO, stop)?;
    let rows = position.par_chunks_mut(width).zip(direction.par_chunks_mut(width));
    rows.enumerate().try_for_each(|(row, (position, direction))| {
        go_on(stop)?;
        write(row, position, direction);
        Ok(())
    })?;
    Curved::new(size, position, direction)
}

const WHOLE_PIXEL_TOLERANCE: f64 = 1e-9;

pub(super) fn whole_pixels(length: f64, pixel_spacing: f64) -> f64 {
    (length / pixel_spacing + WHOLE_PIXEL_TOLERANCE).floor()
}

/// Fails with [`ErrorKind::Camera`], about `subject`, for too many columns or rows.
pub(super) fn checked_size(subject: &str, size: [f64; 2]) -> Result<[usize; 2]> {
    let [width, height] = size;
    if width.max(height) > MAX_SIZE as f64 || width * height > MAX_PIXELS as f64 {
        let found = format!("{width} × {height} pixels");
        let expected = format!("at most {MAX_SIZE} along each side and {MAX_PIXELS} in all");
        let error = Error::new(ErrorKind::Camera, subject, found, expected);
        return Err(error.mended_by(Mend::FewerPixels));
    }
    Ok(size.map(|side| side as usize))
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;
    use crate::stop::NEVER;

    #[test]
    fn images_are_written_row_by_row_until_the_caller_asks_to_stop() {
        let image = by_rows([3, 4], 0, NEVER, |row, pixels| pixels.fill(row)).unwrap();
        assert_eq!(image, [0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3]);
        let asked = AtomicUsize::new(0);
        let soon = || asked.fetch_add(1, Ordering::Relaxed) > 5;
        let written = AtomicUsize::new(0);
        let count = |_: usize, _: &mut [DVec3], _: &mut [Vec3]| {
            written.fetch_add(1, Ordering::Relaxed);
        };
        let error = curved_by_rows([3, 1000], &soon, count).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Interrupted);
        // Both lists were filled before, and each filling asked once whether to stop.
        assert_eq!(written.into_inner(), 4);
    }
}
