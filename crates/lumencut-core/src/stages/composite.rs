//! The picture: window, opacity and silhouettes over the background.

use rayon::prelude::*;

use super::View;
use crate::error::Result;
use crate::math::window::Ramp;
use crate::settings::Settings;

/// Writes the RGBA picture of the surface values; `strength` is the silhouettes', where they are drawn.
///
/// # Errors
/// [`crate::error::ErrorKind::Interrupted`].
pub fn composite(
    view: &View,
    value: &[f32],
    strength: Option<&[f32]>,
    settings: &Settings,
    image: &mut [[u8; 4]],
) -> Result<()> {
    let (grey, opacity) = (Ramp::grey(settings.window), Ramp::opacity(settings.opacity));
    let background = settings.background.map(f32::from);
    let line = settings.silhouette_color.map(f32::from);
    let chunk = view.tile_row();
    image.par_chunks_mut(chunk).zip(value.par_chunks(chunk)).enumerate().try_for_each(
        |(row, (image, value))| {
            view.go_on()?;
            for (n, (pixel, value)) in image.iter_mut().zip(value).enumerate() {
                let strength = strength.map_or(0.0, |s| s[row * chunk + n]);
                *pixel = if value.is_nan() {
                    settings.background
                } else {
                    blend(background, grey.at(*value) * 255.0, opacity.at(*value), line, strength)
                };
            }
            Ok(())
        },
    )
}

/// Grey with `opacity` over the background; the silhouette's colour over both, as opaque as the surface.
#[inline(always)]
fn blend(background: [f32; 4], grey: f32, opacity: f32, line: [f32; 3], strength: f32) -> [u8; 4] {
    let channel = |c: usize| {
        let surface = grey + (line[c] - grey) * strength;
        (background[c] + (surface - background[c]) * opacity + 0.5) as u8
    };
    let alpha = background[3] + (255.0 - background[3]) * opacity;
    [channel(0), channel(1), channel(2), (alpha + 0.5) as u8]
}
