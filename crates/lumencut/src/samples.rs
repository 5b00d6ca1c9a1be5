//! Supersampling: makes views at several positions within a pixel, and averages their pictures.

use lumencut_core::camera::Camera;
use lumencut_core::error::Result;

use crate::views::panned;

/// Views at `samples` × `samples` even positions within a pixel, row by row. They are shifted in their plane, so depths stay valid.
pub(crate) fn sub_views(camera: &Camera, samples: usize) -> Result<Vec<Camera>> {
    offsets(camera, samples)
        .into_iter()
        .map(|offset| match offset {
            [0.0, 0.0] => Ok(*camera),
            [right, up] => panned(camera, right, up),
        })
        .collect()
}

/// Offsets (mm to the right and upwards) of `samples` × `samples` even positions from the middle of a pixel, row by row.
pub(crate) fn offsets(camera: &Camera, samples: usize) -> Vec<[f64; 2]> {
    let offset = |n: usize| ((n as f64 + 0.5) / samples as f64 - 0.5) * camera.pixel_spacing();
    (0..samples).flat_map(|j| (0..samples).map(move |i| [offset(i), -offset(j)])).collect()
}

pub(crate) struct Mean {
    /// For each pixel, the sums of the colours weighted by opacity, and the sum of the opacities.
    sums: Vec<[u32; 4]>,
    pictures: u32,
}

impl Mean {
    /// An empty mean for this number of pixels.
    pub(crate) fn of(pixels: usize) -> Self {
        Self { sums: vec![[0; 4]; pixels], pictures: 0 }
    }

    pub(crate) fn add(&mut self, picture: &[[u8; 4]]) {
        assert_eq!(picture.len(), self.sums.len(), "pixels of a sample");
        for (sum, pixel) in self.sums.iter_mut().zip(picture) {
            let [red, green, blue, alpha] = pixel.map(u32::from);
            for (sum, part) in sum.iter_mut().zip([red * alpha, green * alpha, blue * alpha, alpha]) {
                *sum += part;
            }
        }
        self.pictures += 1;
    }

    /// RGBA, not premultiplied by opacity; black if fully transparent.
    pub(crate) fn pixels(&self) -> Vec<[u8; 4]> {
        let pixel = |&[red, green, blue, alpha]: &[u32; 4]| {
            let color = [red, green, blue].map(|sum| rounded(sum, alpha));
            [color[0], color[1], color[2], rounded(alpha, self.pictures)]
        };
        self.sums.iter().map(pixel).collect()
    }
}

/// A rounded quotient of at most 255; 0 for division by 0.
fn rounded(sum: u32, count: u32) -> u8 {
    if count == 0 { 0 } else { ((2 * sum + count) / (2 * count)).min(255) as u8 }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    fn camera() -> Camera {
        Camera::new(DVec3::new(3.0, -2.0, 7.0), DVec3::Y, DVec3::Z, [8, 6], 0.6).expect("a view")
    }

    #[test]
    fn sub_views_lie_evenly_around_the_view() {
        for samples in 1..=4 {
            let views = sub_views(&camera(), samples).expect("views");
            assert_eq!(views.len(), samples * samples);
            let mean = views.iter().map(Camera::center).sum::<DVec3>() / views.len() as f64;
            assert!((mean - camera().center()).length() < 1e-12);
            for view in &views {
                let place = camera().view_from_world(view.center());
                assert!(place.x.abs() < 0.3 && place.y.abs() < 0.3 && place.z.abs() < 1e-12, "{place}");
            }
            assert_eq!(views.contains(&camera()), samples % 2 == 1, "{samples} samples");
        }
        // The views lie row by row from the top left, a third of a pixel apart.
        let views = sub_views(&camera(), 3).expect("views");
        let first = camera().view_from_world(views[0].center());
        assert!((first - DVec3::new(-0.2, 0.2, 0.0)).length() < 1e-12, "{first}");
    }

    #[test]
    fn colours_count_as_much_as_they_are_opaque() {
        let mut mean = Mean::of(4);
        mean.add(&[[200, 0, 10, 255], [9, 9, 9, 0], [10, 20, 30, 255], [255, 255, 255, 255]]);
        mean.add(&[[0, 100, 20, 85], [99, 0, 0, 0], [11, 20, 30, 255], [255, 255, 255, 255]]);
        // (200·255 + 0·85)/340 = 150, 100·85/340 = 25, (10·255 + 20·85)/340 = 12.5.
        let expected = [[150, 25, 13, 170], [0, 0, 0, 0], [11, 20, 30, 255], [255, 255, 255, 255]];
        assert_eq!(mean.pixels(), expected);
    }
}
