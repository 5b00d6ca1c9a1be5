//! Converts between pixels and the world. Pixels (i, j) count from the top left; the centre of a pixel is at (i, j). World points
//! are in mm (LPS).

use glam::DVec3;
use lumencut_core::camera::Camera;

/// The world point seen at the pixel (i, j), which may be fractional, at `depth` (mm).
pub(crate) fn world_from_pixel(camera: &Camera, [i, j]: [f64; 2], depth: f64) -> DVec3 {
    let [width, height] = camera.size().map(|n| n as f64);
    let x = (i + 0.5 - width / 2.0) * camera.pixel_spacing();
    let y = (height / 2.0 - j - 0.5) * camera.pixel_spacing();
    let plane = x * camera.right() + y * camera.up();
    camera.center() + plane + depth * camera.direction()
}

/// The world point of each pixel, row by row from the top, for the depths `depth` (mm).
pub fn positions<'a>(camera: &'a Camera, depth: &'a [f32]) -> impl Iterator<Item = DVec3> + 'a {
    let rows = depth.chunks(camera.size()[0]).enumerate();
    rows.flat_map(move |(j, row)| {
        let place = move |(i, depth): (usize, &f32)| {
            world_from_pixel(camera, [i as f64, j as f64], f64::from(*depth))
        };
        row.iter().enumerate().map(place)
    })
}

/// A position in a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelPlace {
    /// Column and row; they may be fractional or lie outside the picture.
    pub pixel: [f64; 2],
    /// Depth (mm): it grows away from the viewer and is 0 at the camera's center.
    pub depth: f64,
}

/// The pixel of a world point.
pub(crate) fn pixel_from_world(camera: &Camera, point: DVec3) -> PixelPlace {
    let [width, height] = camera.size().map(|n| n as f64);
    let view = camera.view_from_world(point);
    let i = view.x / camera.pixel_spacing() + width / 2.0 - 0.5;
    let j = height / 2.0 - 0.5 - view.y / camera.pixel_spacing();
    PixelPlace { pixel: [i, j], depth: view.z }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn front() -> Camera {
        Camera::new(DVec3::new(10.0, 20.0, 30.0), DVec3::Y, DVec3::Z, [4, 3], 2.0).unwrap()
    }

    #[test]
    fn the_first_pixel_is_at_the_top_left() {
        assert_eq!(world_from_pixel(&front(), [0.0, 0.0], 0.0), DVec3::new(7.0, 20.0, 32.0));
        assert_eq!(world_from_pixel(&front(), [3.0, 2.0], 5.0), DVec3::new(13.0, 25.0, 28.0));
        assert_eq!(world_from_pixel(&front(), [1.5, 1.0], -1.0), DVec3::new(10.0, 19.0, 30.0));
    }

    #[test]
    fn positions_go_row_by_row() {
        let depth: Vec<f32> = (0..12u8).map(f32::from).collect();
        let found: Vec<DVec3> = positions(&front(), &depth).collect();
        assert_eq!(found.len(), 12);
        assert_eq!(found[0], DVec3::new(7.0, 20.0, 32.0));
        assert_eq!(found[1], DVec3::new(9.0, 21.0, 32.0));
        assert_eq!(found[4], DVec3::new(7.0, 24.0, 30.0));
        assert_eq!(found[11], DVec3::new(13.0, 31.0, 28.0));
    }

    #[test]
    fn the_way_to_the_world_leads_back() {
        let camera = Camera::new(
            DVec3::new(3.0, -4.0, 5.0),
            DVec3::new(0.3, 0.9, -0.2),
            DVec3::new(0.1, 0.0, 1.0),
            [60, 40],
            0.7,
        );
        let camera = camera.unwrap();
        for (pixel, depth) in [([0.0, 0.0], 0.0), ([59.0, 39.0], 12.5), ([-7.25, 80.5], -300.0)] {
            let found = pixel_from_world(&camera, world_from_pixel(&camera, pixel, depth));
            let errors = [found.pixel[0] - pixel[0], found.pixel[1] - pixel[1], found.depth - depth];
            assert!(errors.iter().all(|error| error.abs() < 1e-9), "{errors:?}");
        }
    }
}
