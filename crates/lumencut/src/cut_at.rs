//! Finds what a pixel of a view shows of the cut surface.

use glam::DVec3;
use lumencut_core::camera::Camera;
use lumencut_core::error::Result;
use lumencut_core::pipeline::{CpuRenderer, Request};
use lumencut_core::scene::Scene;
use lumencut_core::settings::Settings;
use lumencut_core::stages::{Image, ImageSet};

use crate::method::Method;
use crate::positions::world_from_pixel;

/// Pixels up to this distance (pixels) affect a pixel, through the depth filter and the detection of jumps.
const NEIGHBOURHOOD_PX: usize = 8;
/// A pixel shows the cut surface if its opacity is at least this.
const MIN_OPACITY: f32 = 0.5;

/// What a pixel shows of the cut surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CutAt {
    /// The world point (LPS, mm).
    pub point: DVec3,
    /// The vessel to whose part of the cut surface the pixel belongs.
    pub vessel: Option<usize>,
    /// False if the focus shows the surroundings here.
    pub is_shown: bool,
}

/// The cut surface at a pixel (column, row) of a view.
pub fn cut_at(
    (cpu, method): (&mut CpuRenderer, Method),
    scene: &Scene,
    (camera, settings): (&Camera, &Settings),
    pixel: [f64; 2],
) -> Result<CutAt> {
    let [x, y] = pixel.map(f64::round);
    let point = world_from_pixel(camera, [x, y], 0.0);
    let side = 2 * NEIGHBOURHOOD_PX + 1;
    let near = Camera::new(point, camera.direction(), camera.up(), [side, side], camera.pixel_spacing())?;
    let settings = Settings { samples: 1, ..settings.clone() };
    let mut images = vec![Image::Depth, Image::Vessel, Image::Value];
    images.extend(settings.focus.map(|_| Image::Focus));
    let request = Request { images: ImageSet::of(&images), ..Request::new(&near, &settings) };
    let frame = method.on_cpu(cpu, scene, &request)?;
    let middle = side * NEIGHBOURHOOD_PX + NEIGHBOURHOOD_PX;
    let depth = frame.depth().get(middle).copied().unwrap_or_default();
    Ok(CutAt {
        point: point + camera.direction() * f64::from(depth),
        vessel: frame.vessel.get(middle).and_then(|vessel| usize::try_from(*vessel).ok()),
        is_shown: frame.focus.get(middle).is_none_or(|[surface, ..]| *surface >= MIN_OPACITY),
    })
}
