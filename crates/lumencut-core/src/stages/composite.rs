//! The picture: the cut surface with its silhouettes over the context over the background.

use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;

use super::{Image, Work};
use crate::error::Result;
use crate::math::accumulate::Rgba;
use crate::math::lanes::{FAN, Kernel, dispatch, smaller};
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

/// The parameters of the stage: the colours of one picture, 0 to 1.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct CompositeParameters {
    /// Where there is nothing to show.
    pub background: [f32; 4],
    /// Of the silhouettes; the last number is not used.
    pub line: [f32; 4],
    /// The values from black to white.
    pub grey: Ramp,
    /// The values from transparent to opaque.
    pub opacity: Ramp,
}

/// Writes the RGBA picture, with straight alpha, of the layers over the background.
///
/// # Errors
/// [`crate::error::ErrorKind::Interrupted`].
pub fn composite(
    work: &Work,
    parameters: &CompositeParameters,
    layers: &Layers,
    image: &mut [[u8; 4]],
) -> Result<()> {
    work.expect_whole(Image::Picture, image);
    work.expect_whole(Image::Value, layers.value);
    layers.strength.iter().for_each(|strength| work.expect_whole(Image::Strength, strength));
    layers.context.iter().for_each(|context| work.expect_whole(Image::Gathered, context));
    let chunk = work.tile_row();
    let absent = vec![0.0; if layers.strength.is_some() { 0 } else { chunk }];
    let empty = vec![[0.0; 4]; if layers.context.is_some() { 0 } else { chunk }];
    let rows = image.par_chunks_mut(chunk).zip(layers.value.par_chunks(chunk));
    rows.enumerate().try_for_each(|(row, (image, value))| {
        work.begin(image.len())?;
        let strength = layers.strength.map_or(&absent[..], |s| &s[row * chunk..][..value.len()]);
        let context = layers.context.map_or(&empty[..], |c| &c[row * chunk..][..value.len()]);
        dispatch(work.isa, PaintRows { paint: *parameters, value, strength, context, image });
        Ok(())
    })
}

/// Writes a layer of colours times opacity and opacity as RGBA with straight alpha.
///
/// # Errors
/// [`crate::error::ErrorKind::Interrupted`].
pub fn layer(work: &Work, colors: &[[f32; 4]], image: &mut [[u8; 4]]) -> Result<()> {
    work.expect_whole(Image::Gathered, colors);
    work.expect_whole(Image::Context, image);
    let chunk = work.tile_row();
    image.par_chunks_mut(chunk).zip(colors.par_chunks(chunk)).try_for_each(|(image, colors)| {
        work.begin(image.len())?;
        dispatch(work.isa, StraightRows { colors, image });
        Ok(())
    })
}

impl CompositeParameters {
    /// The colours that `settings` say.
    pub fn new(settings: &Settings) -> Self {
        let [red, green, blue] = settings.silhouette_color;
        let unit = |color: [u8; 4]| color.map(|c| f32::from(c) / 255.0);
        Self {
            background: unit(settings.background),
            line: unit([red, green, blue, 0]),
            grey: Ramp::grey(settings.window),
            opacity: Ramp::opacity(settings.opacity),
        }
    }

    /// The surface, grey with the silhouette's colour over it, over the context over the background. Where there is no
    /// value there is no surface. Colours times opacity, and opacity.
    #[inline(always)]
    fn pixels(&self, value: &[f32; FAN], strength: &[f32; FAN], context: &Rgba) -> Rgba {
        let mut pixels = [[0.0; FAN]; 4];
        for l in 0..FAN {
            let nothing = value[l].is_nan();
            let value = if nothing { 0.0 } else { value[l] };
            let grey = self.grey.at(value);
            let opacity = if nothing { 0.0 } else { self.opacity.at(value) };
            let through = 1.0 - opacity;
            let rest = (1.0 - context[3][l]) * self.background[3];
            for c in 0..3 {
                let surface = grey + (self.line[c] - grey) * strength[l];
                pixels[c][l] = surface * opacity + (context[c][l] + self.background[c] * rest) * through;
            }
            pixels[3][l] = opacity + (context[3][l] + rest) * through;
        }
        pixels
    }
}

/// RGBA with straight alpha of colours times opacity; without any opacity the colour is `behind`.
#[inline(always)]
fn straight(pixels: &Rgba, behind: [f32; 4]) -> [[u8; 4]; FAN] {
    let mut packed = [0; FAN];
    for l in 0..FAN {
        let alpha = pixels[3][l];
        let any = alpha > 0.0;
        let per_alpha = 255.0 / if any { alpha } else { 1.0 };
        packed[l] = byte(alpha * 255.0) << 24;
        for c in 0..3 {
            let color = pixels[c][l] * per_alpha;
            packed[l] |= byte(if any { color } else { behind[c] * 255.0 }) << (8 * c);
        }
    }
    packed.map(u32::to_le_bytes)
}

/// Sixteen pixels channel by channel; those beyond the end are nothing.
#[inline(always)]
fn channels(colors: &[[f32; 4]]) -> Rgba {
    let mut pixels = [[0.0; FAN]; 4];
    for (l, color) in colors.iter().enumerate() {
        for c in 0..4 {
            pixels[c][l] = color[c];
        }
    }
    pixels
}

/// Sixteen numbers; those beyond the end are 0.
#[inline(always)]
fn lanes(numbers: &[f32]) -> [f32; FAN] {
    let mut lanes = [0.0; FAN];
    lanes[..numbers.len()].copy_from_slice(numbers);
    lanes
}

/// The nearest whole number to a value from 0 to 255, as which a little more counts too. From 2²³ on, a float's last bit
/// counts ones: the sum's low byte is the number, without the checks of a conversion.
#[inline(always)]
fn byte(value: f32) -> u32 {
    (smaller(value, 255.0) + 8_388_608.0).to_bits() & 0xFF
}

struct PaintRows<'a> {
    paint: CompositeParameters,
    value: &'a [f32],
    strength: &'a [f32],
    context: &'a [[f32; 4]],
    image: &'a mut [[u8; 4]],
}

impl Kernel for PaintRows<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let layers = self.value.chunks(FAN).zip(self.strength.chunks(FAN)).zip(self.context.chunks(FAN));
        for (image, ((value, strength), context)) in self.image.chunks_mut(FAN).zip(layers) {
            // Most of a picture has no context.
            let behind = if context.as_flattened().iter().all(|c| *c == 0.0) {
                [[0.0; FAN]; 4]
            } else {
                channels(context)
            };
            let pixels = self.paint.pixels(&lanes(value), &lanes(&strength[..value.len()]), &behind);
            image.copy_from_slice(&straight(&pixels, self.paint.background)[..image.len()]);
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
        for (image, colors) in self.image.chunks_mut(FAN).zip(self.colors.chunks(FAN)) {
            if colors.as_flattened().iter().all(|c| *c == 0.0) {
                image.fill([0; 4]);
            } else {
                image.copy_from_slice(&straight(&channels(colors), [0.0; 4])[..image.len()]);
            }
        }
    }
}
