//! The position of the parts of an untangled tree in the image, and the size of the image.

use glam::DVec2;

use super::growth::Part;
use super::hull::Disc;
use crate::camera::Camera;
use crate::error::Result;
use crate::reformations::layout::checked_size;

/// Distance between the hulls of parts that are not connected (mm), if the image is wide enough.
const PART_GAP_MM: f64 = 10.0;

/// Roots in the image (mm): as the camera sees them, but moved right until clear of hulls to their left.
pub(super) fn roots(parts: &[Part], hulls: &[Vec<Disc>], camera: &Camera, width: f64) -> Vec<DVec2> {
    let mut roots: Vec<DVec2> =
        parts.iter().map(|part| camera.view_from_world(part.root).truncate()).collect();
    let mut order: Vec<usize> = (0..parts.len()).collect();
    order.sort_by(|a, b| roots[*a].x.total_cmp(&roots[*b].x));
    let mut right = f64::NEG_INFINITY;
    for n in order {
        let [low, high] = hulls[n].iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], disc| {
            [low.min(disc.center.x - disc.radius), high.max(disc.center.x + disc.radius)]
        });
        roots[n].x = roots[n].x.max(right - low);
        right = roots[n].x + high + PART_GAP_MM.min(width);
    }
    roots
}

/// The centre of the first pixel (mm), and the width and height of all that is shown (mm).
pub(super) fn extent(places: &[Vec<DVec2>], width: f64) -> (DVec2, DVec2) {
    let all = places.iter().flatten();
    let (low, high) = all.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), place| {
        (low.min(*place), high.max(*place))
    });
    (DVec2::new(low.x - width, high.y + width), high - low + 2.0 * width)
}

pub(super) fn size_of(extent: DVec2, pixel_spacing: f64) -> Result<[usize; 2]> {
    let pixels = extent / pixel_spacing;
    checked_size("size of the untangled CPR", pixels.to_array().map(|length| length.ceil() + 1.0))
}
