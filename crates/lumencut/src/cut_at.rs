//! What a pixel of a view shows of the cut surface.

use glam::DVec3;
use lumencut_core::camera::Camera;
use lumencut_core::error::Result;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::Scene;
use lumencut_core::settings::Settings;
use lumencut_core::stages::{Image, ImageSet};

use crate::method::Method;
use crate::positions::world_from_pixel;

/// How many pixels around one decide what it shows: as far as the depth filter and the leaps look.
const AROUND: usize = 8;
/// The share of the cut surface from which a pixel shows it rather than what lies around it.
const SHOWN: f32 = 0.5;

/// The cut surface in a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CutAt {
    /// The world point.
    pub point: DVec3,
    /// The vessel to whose zone it belongs.
    pub vessel: Option<usize>,
    /// Whether the pixel shows it: a focus shows what lies around the vessels instead.
    pub is_shown: bool,
}

/// The cut surface in the pixel (column, row) of a view.
///
/// # Errors
/// Those of the view.
pub fn cut_at(
    (cpu, method): (&mut CpuRenderer, Method),
    scene: &Scene,
    (camera, settings): (&Camera, &Settings),
    pixel: [f64; 2],
) -> Result<CutAt> {
    let [x, y] = pixel.map(f64::round);
    let point = world_from_pixel(camera, [x, y], 0.0);
    let side = 2 * AROUND + 1;
    let near = Camera::new(point, camera.direction(), camera.up(), [side, side], camera.pixel_spacing())?;
    let settings = Settings { samples: 1, ..settings.clone() };
    let mut images = vec![Image::Depth, Image::Vessel, Image::Value];
    images.extend(settings.focus.map(|_| Image::Focus));
    let request = Request { images: ImageSet::of(&images), ..Request::new(&near, &settings) };
    let frame = method.on_cpu(cpu, scene, &request)?;
    let middle = side * AROUND + AROUND;
    let depth = frame.depth().get(middle).copied().unwrap_or_default();
    Ok(CutAt {
        point: point + camera.direction() * f64::from(depth),
        vessel: frame.vessel.get(middle).and_then(|vessel| usize::try_from(*vessel).ok()),
        is_shown: frame.focus.get(middle).is_none_or(|[surface, _]| *surface >= SHOWN),
    })
}
