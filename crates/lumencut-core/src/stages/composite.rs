//! The picture: window, opacity and silhouettes over the background.

use rayon::prelude::*;

use super::View;
use crate::error::Result;
use crate::math::lanes::{Kernel, dispatch};
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
    let paint = Paint {
        grey: Ramp::grey(settings.window),
        opacity: Ramp::opacity(settings.opacity),
        background: settings.background.map(f32::from),
        line: settings.silhouette_color.map(f32::from),
    };
    let (chunk, none) = (view.tile_row(), vec![0.0; if strength.is_some() { 0 } else { view.tile_row() }]);
    image.par_chunks_mut(chunk).zip(value.par_chunks(chunk)).enumerate().try_for_each(
        |(row, (image, value))| {
            view.go_on()?;
            let strength = strength.map_or(&none[..], |s| &s[row * chunk..][..value.len()]);
            dispatch(view.isa, PaintRows { paint, value, strength, image });
            Ok(())
        },
    )
}

/// The colours of one picture.
#[derive(Clone, Copy)]
struct Paint {
    grey: Ramp,
    opacity: Ramp,
    background: [f32; 4],
    line: [f32; 3],
}

impl Paint {
    /// Grey with its opacity over the background; the silhouette's colour over the grey, as opaque as the surface.
    /// Where there is no value there is only background.
    #[inline(always)]
    fn pixel(&self, value: f32, strength: f32) -> [u8; 4] {
        let nothing = value.is_nan();
        let value = if nothing { 0.0 } else { value };
        let grey = self.grey.at(value) * 255.0;
        let opacity = if nothing { 0.0 } else { self.opacity.at(value) };
        let channel = |c: usize| {
            let surface = grey + (self.line[c] - grey) * strength;
            byte(self.background[c] + (surface - self.background[c]) * opacity)
        };
        let alpha = byte(self.background[3] + (255.0 - self.background[3]) * opacity);
        (channel(0) | channel(1) << 8 | channel(2) << 16 | alpha << 24).to_le_bytes()
    }
}

/// The nearest whole number to a value from 0 to 255. From 2²³ on, a float's last bit counts ones: the sum's low
/// byte is the number, without the checks of a conversion.
#[inline(always)]
fn byte(value: f32) -> u32 {
    (value + 8_388_608.0).to_bits() & 0xFF
}

struct PaintRows<'a> {
    paint: Paint,
    value: &'a [f32],
    strength: &'a [f32],
    image: &'a mut [[u8; 4]],
}

impl Kernel for PaintRows<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        for ((pixel, value), strength) in self.image.iter_mut().zip(self.value).zip(self.strength) {
            *pixel = self.paint.pixel(*value, *strength);
        }
    }
}
