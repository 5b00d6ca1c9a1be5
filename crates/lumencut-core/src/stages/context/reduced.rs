//! Maximum, minimum and average intensity projection: one value for each ray, and its colour.

use rayon::prelude::*;

use super::plan::Surroundings;
use crate::error::Result;
use crate::math::accumulate::opaque;
use crate::math::lanes::FAN;
use crate::math::ray::NONE;
use crate::math::ray_lines::{IndexFromView, RayGrid};
use crate::math::reduce::Reduction;
use crate::math::transfer::Colors;
use crate::math::window::Ramp;
use crate::settings::Context;
use crate::stages::Work;
use crate::stages::along_rays::{AlongRays, ViewRays, along_rays};

pub(super) fn reduce_raster(
    work: &Work,
    &Surroundings { camera, volume, blocks }: &Surroundings,
    (context, reduction): (&Context, Reduction),
    rays: &RayGrid,
    start: &[f32],
    pixels: &mut [[f32; 4]],
) -> Result<()> {
    let (colors, window) = (Colors::new(&context.transfer), Ramp::grey(context.window));
    // Values beyond the last control point, or below the black end of the window, do not change the colour.
    let limit = match reduction {
        Reduction::Largest => colors.last(),
        Reduction::Smallest => window.zero(),
        Reduction::Mean => reduction.no_limit(),
    };
    let to = IndexFromView::new(volume, camera);
    let chord = |p: usize| [f64::from(start[p]), f64::from(NONE)];
    let source = ViewRays { to, rays: *rays, chord };
    let along = AlongRays { size: rays.size, volume, blocks, reduction, limit, step: source.to.voxel() };
    let mut values = vec![0.0; start.len()];
    along_rays(work, &along, &source, &mut values)?;
    pixels.par_chunks_mut(FAN).zip(values.par_chunks(FAN)).for_each(|(pixels, values)| {
        let mut value = [0.0; FAN];
        value[..values.len()].copy_from_slice(values);
        let found = value.map(|value| !value.is_nan());
        let color = match reduction {
            Reduction::Largest => colors.color(&value),
            Reduction::Smallest | Reduction::Mean => [value.map(|value| window.at(value)); 3],
        };
        let gathered = opaque(color, &found);
        for (l, pixel) in pixels.iter_mut().enumerate() {
            *pixel = gathered.map(|channel| channel[l]);
        }
    });
    Ok(())
}
