//! Prepares the data that the rays of a view need.

use crate::camera::Camera;
use crate::error::{Error, ErrorKind, Result};
use crate::math::accumulate::Palette;
use crate::math::blocks::Blocks;
use crate::math::context_parameters::{BlockLayout, ContextParameters};
use crate::math::light::Shading;
use crate::math::ray::{MAX_SAMPLES, Rays};
use crate::math::transfer::Colors;
use crate::settings::{Context, Settings};
use crate::volume::Volume;

/// The volume around the cut surface, in a view.
#[derive(Clone, Copy)]
pub struct Surroundings<'a> {
    pub camera: &'a Camera,
    pub volume: &'a Volume<'a>,
    /// Blocks to skip; `None` samples everything, with the same result.
    pub blocks: Option<&'a Blocks>,
}

/// Rounds up to four digits.
fn rounded_up(number: f64) -> f64 {
    let scale = 10f64.powf(3.0 - number.log10().floor());
    (number * scale).ceil() / scale
}

/// The default step: half a voxel's side, because colours and opacities rise within a voxel; in a preview, whose rays are
/// further apart, two sides.
fn default_step(volume: &Volume, settings: &Context) -> f64 {
    volume.smallest_side() * if settings.preview { 2.0 } else { 0.5 }
}

/// The longest distance between samples (mm). Fails with `Settings` for rays of more than 65,536 samples.
pub fn step(volume: &Volume, settings: &Context) -> Result<f64> {
    let longest = volume.longest_way();
    let step = settings.step.unwrap_or_else(|| default_step(volume, settings).max(longest / MAX_SAMPLES));
    if longest > MAX_SAMPLES * step {
        let found = format!("{step} mm for a volume {longest:.4} mm across");
        let expected = format!("at least {} mm", rounded_up(longest / MAX_SAMPLES));
        return Err(Error::new(ErrorKind::Settings, "context_step", found, expected));
    }
    Ok(step)
}

pub(super) struct Plan<'a> {
    pub volume: &'a Volume<'a>,
    pub blocks: Option<&'a Blocks>,
    pub rays: Rays,
    pub palette: Palette,
    pub shading: Option<Shading>,
}

impl<'a> Plan<'a> {
    pub(super) fn new(
        &Surroundings { camera, volume, blocks }: &Surroundings<'a>,
        settings: &Settings,
        context: &Context,
    ) -> Result<Self> {
        let (step, colors) = (step(volume, context)?, Colors::new(&context.transfer));
        // The layout stays empty, because the CPU finds blocks through `Blocks`.
        let parameters = ContextParameters::new(settings, context, &colors, step, &BlockLayout::default());
        Ok(Self {
            volume,
            blocks,
            rays: Rays::new(volume, camera, step),
            palette: Palette { colors, parameters },
            shading: context.shading.then_some(Shading { noise: parameters.noise }),
        })
    }
}
