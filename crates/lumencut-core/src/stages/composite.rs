//! The picture: the cut surface with its silhouettes over the context over the background.

use rayon::prelude::*;

use super::View;
use crate::error::Result;
use crate::math::lanes::{Kernel, dispatch, smaller};
use crate::math::window::Ramp;
use crate::settings::Settings;

/// What a picture is made of, from the front to the back.
#[derive(Clone, Copy, Debug)]
pub struct Layers<'a> {
    /// The volume at the cut surface, NaN where it shows nothing.
    pub value: &'a [f32],
    /// Strength of the silhouettes, where they are drawn.
    pub strength: Option<&'a [f32]>,
    /// The context, colours times opacity and opacity, where there is one.
    pub context: Option<&'a [[f32; 4]]>,
}

/// Writes the RGBA picture, with straight alpha, of the layers over the background.
///
/// # Errors
/// [`crate::error::ErrorKind::Interrupted`].
pub fn composite(view: &View, layers: &Layers, settings: &Settings, image: &mut [[u8; 4]]) -> Result<()> {
    let paint = Paint {
        grey: Ramp::grey(settings.window),
        opacity: Ramp::opacity(settings.opacity),
        background: settings.background.map(|c| f32::from(c) / 255.0),
        line: settings.silhouette_color.map(|c| f32::from(c) / 255.0),
    };
    let chunk = view.tile_row();
    let absent = vec![0.0; if layers.strength.is_some() { 0 } else { chunk }];
    let empty = vec![[0.0; 4]; if layers.context.is_some() { 0 } else { chunk }];
    let rows = image.par_chunks_mut(chunk).zip(layers.value.par_chunks(chunk));
    rows.enumerate().try_for_each(|(row, (image, value))| {
        view.go_on()?;
        let strength = layers.strength.map_or(&absent[..], |s| &s[row * chunk..][..value.len()]);
        let context = layers.context.map_or(&empty[..], |c| &c[row * chunk..][..value.len()]);
        dispatch(view.isa, PaintRows { paint, value, strength, context, image });
        Ok(())
    })
}

/// Writes a layer of colours times opacity and opacity as RGBA with straight alpha.
///
/// # Errors
/// [`crate::error::ErrorKind::Interrupted`].
pub fn layer(view: &View, colors: &[[f32; 4]], image: &mut [[u8; 4]]) -> Result<()> {
    let chunk = view.tile_row();
    image.par_chunks_mut(chunk).zip(colors.par_chunks(chunk)).try_for_each(|(image, colors)| {
        view.go_on()?;
        dispatch(view.isa, StraightRows { colors, image });
        Ok(())
    })
}

/// The colours of one picture, 0 to 1.
#[derive(Clone, Copy)]
struct Paint {
    grey: Ramp,
    opacity: Ramp,
    background: [f32; 4],
    line: [f32; 3],
}

impl Paint {
    /// The surface, grey with the silhouette's colour over it, over the context over the background. Where there is no
    /// value there is no surface.
    #[inline(always)]
    fn pixel(&self, value: f32, strength: f32, context: [f32; 4]) -> [u8; 4] {
        let nothing = value.is_nan();
        let value = if nothing { 0.0 } else { value };
        let grey = self.grey.at(value);
        let opacity = if nothing { 0.0 } else { self.opacity.at(value) };
        let through = 1.0 - opacity;
        let rest = (1.0 - context[3]) * self.background[3];
        let channel = |c: usize| {
            let surface = grey + (self.line[c] - grey) * strength;
            surface * opacity + (context[c] + self.background[c] * rest) * through
        };
        let alpha = opacity + (context[3] + rest) * through;
        straight([channel(0), channel(1), channel(2)], alpha, self.background)
    }
}

/// RGBA with straight alpha of colours times opacity; without any opacity the colour is `behind`.
#[inline(always)]
fn straight(color: [f32; 3], alpha: f32, behind: [f32; 4]) -> [u8; 4] {
    let any = alpha > 0.0;
    let per_alpha = 255.0 / if any { alpha } else { 1.0 };
    let [r, g, b] = [0, 1, 2].map(|c| byte(if any { color[c] * per_alpha } else { behind[c] * 255.0 }));
    (r | g << 8 | b << 16 | byte(alpha * 255.0) << 24).to_le_bytes()
}

/// The nearest whole number to a value from 0 to 255, as which a little more counts too. From 2²³ on, a float's last bit
/// counts ones: the sum's low byte is the number, without the checks of a conversion.
#[inline(always)]
fn byte(value: f32) -> u32 {
    (smaller(value, 255.0) + 8_388_608.0).to_bits() & 0xFF
}

struct PaintRows<'a> {
    paint: Paint,
    value: &'a [f32],
    strength: &'a [f32],
    context: &'a [[f32; 4]],
    image: &'a mut [[u8; 4]],
}

impl Kernel for PaintRows<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let layers = self.value.iter().zip(self.strength).zip(self.context);
        for (pixel, ((value, strength), context)) in self.image.iter_mut().zip(layers) {
            *pixel = self.paint.pixel(*value, *strength, *context);
        }
    }
}

struct StraightRows<'a> {
    colors: &'a [[f32; 4]],
    image: &'a mut [[u8; 4]],
}

impl Kernel for StraightRows<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        for (pixel, [r, g, b, alpha]) in self.image.iter_mut().zip(self.colors) {
            *pixel = straight([*r, *g, *b], *alpha, [0.0; 4]);
        }
    }
}
