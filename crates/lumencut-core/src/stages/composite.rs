//! The picture: in front the cut surface with its silhouettes, behind it the context, then the background.

use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;

use super::focus::{ALL_SHOWN, Shares};
use super::{Image, Work};
use crate::error::Result;
use crate::math::lanes::{Kernel, dispatch, larger, smaller};
use crate::math::window::Ramp;
use crate::settings::Settings;

/// Brightness (0 black to 1 white) between which the rim fades: struts and calcium are brighter.
pub const RIM_FADES: [f32; 2] = [0.80, 0.92];

/// The layers of a picture, from the front to the back.
#[derive(Clone, Copy, Debug)]
pub struct Layers<'a> {
    /// The value of the volume at the cut surface; NaN if the surface shows nothing.
    pub value: &'a [f32],
    /// Strength of the silhouettes, if they are drawn.
    pub strength: Option<&'a [f32]>,
    /// Shares of the surface and its silhouettes that are shown, 0 to 1; `None` if both are fully shown.
    pub focus: Option<&'a [Shares]>,
    /// Colour and share of the rim, if it is drawn.
    pub rim: Option<&'a [[u8; 4]]>,
    /// The context, premultiplied colours and opacity.
    pub context: Option<&'a [[f32; 4]]>,
}

#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct CompositeParameters {
    pub background: [f32; 4],
    pub line: [f32; 3],
    /// Factor on the colours of the context.
    pub context: f32,
    pub grey: Ramp,
    pub opacity: Ramp,
}

/// Writes the RGBA picture, with straight alpha, of the layers over the background.
pub fn composite(
    work: &Work,
    parameters: &CompositeParameters,
    layers: &Layers,
    image: &mut [[u8; 4]],
) -> Result<()> {
    work.expect_whole(Image::Picture, image);
    work.expect_whole(Image::Value, layers.value);
    layers.strength.iter().for_each(|strength| work.expect_whole(Image::Strength, strength));
    layers.focus.iter().for_each(|focus| work.expect_whole(Image::Focus, focus));
    layers.rim.iter().for_each(|rim| work.expect_whole(Image::Rim, rim));
    layers.context.iter().for_each(|context| work.expect_whole(Image::Gathered, context));
    let chunk = work.tile_row();
    // Arrays that replace missing layers.
    let absent = vec![0.0; if layers.strength.is_some() { 0 } else { chunk }];
    let whole = vec![ALL_SHOWN; if layers.focus.is_some() { 0 } else { chunk }];
    let empty = vec![[0.0; 4]; if layers.context.is_some() { 0 } else { chunk }];
    let rows = image.par_chunks_mut(chunk).zip(layers.value.par_chunks(chunk));
    rows.enumerate().try_for_each(|(row, (image, value))| {
        work.begin(image.len())?;
        let strength = part(layers.strength, &absent, row * chunk, value.len());
        let focus = part(layers.focus, &whole, row * chunk, value.len());
        let context = part(layers.context, &empty, row * chunk, value.len());
        let (paint, rim) =
            (*parameters, layers.rim.map_or(&[][..], |rim| &rim[row * chunk..][..value.len()]));
        dispatch(work.isa, PaintRows { paint, value, strength, focus, rim, context, image });
        Ok(())
    })
}

fn part<'a, T>(layer: Option<&'a [T]>, instead: &'a [T], first: usize, count: usize) -> &'a [T] {
    layer.map_or_else(|| &instead[..count], |layer| &layer[first..][..count])
}

/// Writes premultiplied colours and opacity as RGBA with straight alpha into a transparent image.
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
    pub fn new(settings: &Settings) -> Self {
        let unit = |color: &u8| f32::from(*color) / 255.0;
        let strength = settings.context.as_ref().map_or(1.0, |context| context.strength);
        Self {
            background: settings.background.each_ref().map(unit),
            line: settings.silhouette_color.each_ref().map(unit),
            context: strength as f32,
            grey: Ramp::grey(settings.window),
            opacity: Ramp::opacity(settings.opacity),
        }
    }

    /// The surface and its silhouettes, each by its share, over context and background.
    #[inline(always)]
    fn pixel(&self, value: f32, strength: f32, shares: Shares, context: [f32; 4]) -> [f32; 4] {
        let grey = self.grey.at(shown(value)) * (1.0 - shares[3]);
        self.painted(value, [grey; 3], (strength, shares), context)
    }

    /// As [`Self::pixel`], with the rim on the grey surface, below the silhouettes.
    #[inline(always)]
    fn rimmed(&self, value: f32, rim: [u8; 4], line: (f32, Shares), context: [f32; 4]) -> [f32; 4] {
        let grey = self.grey.at(shown(value)) * (1.0 - line.1[3]);
        let [dark, bright] = RIM_FADES;
        let x = smaller(larger((grey - dark) / (bright - dark), 0.0), 1.0);
        let share = f32::from(rim[3]) / 255.0 * (1.0 - x * x * (3.0 - 2.0 * x));
        let surface = [0, 1, 2].map(|c| grey + (f32::from(rim[c]) / 255.0 - grey) * share);
        self.painted(value, surface, line, context)
    }

    #[inline(always)]
    fn painted(
        &self,
        value: f32,
        surface: [f32; 3],
        (strength, [share, lines, around, _]): (f32, Shares),
        context: [f32; 4],
    ) -> [f32; 4] {
        let nothing = value.is_nan();
        let value = shown(value);
        let opacity = if nothing { 0.0 } else { self.opacity.at(value) * share };
        let (through, strength) = (1.0 - opacity, strength * (share * lines));
        let rest = (1.0 - context[3]) * self.background[3];
        let mut pixel = [0.0; 4];
        for c in 0..3 {
            let color = surface[c] + (self.line[c] - surface[c]) * strength;
            let behind = context[c] * self.context * around;
            pixel[c] = color * opacity + (behind + self.background[c] * rest) * through;
        }
        pixel[3] = opacity + (context[3] + rest) * through;
        pixel
    }
}

/// A value that can be mapped to grey.
#[inline(always)]
fn shown(value: f32) -> f32 {
    if value.is_nan() { 0.0 } else { value }
}

/// RGBA with straight alpha of a premultiplied colour; with opacity 0 the colour is `behind`.
#[inline(always)]
fn straight(pixel: [f32; 4], behind: [f32; 4]) -> [u8; 4] {
    let alpha = pixel[3];
    let any = alpha > 0.0;
    let per_alpha = 255.0 / if any { alpha } else { 1.0 };
    let mut packed = byte(alpha * 255.0) << 24;
    for c in 0..3 {
        let color = pixel[c] * per_alpha;
        packed |= byte(if any { color } else { behind[c] * 255.0 }) << (8 * c);
    }
    packed.to_le_bytes()
}

/// The nearest integer to a value of at most a little over 255. Adding 2²³ rounds the value and leaves the
/// integer in the last byte; a conversion would add checks.
#[inline(always)]
fn byte(value: f32) -> u32 {
    (smaller(value, 255.0) + 8_388_608.0).to_bits() & 0xFF
}

/// Number of pixels that are tested together for any context.
const PIXELS_TOGETHER: usize = 64;

#[inline(always)]
fn is_nothing(colors: &[[f32; 4]]) -> bool {
    // The fold has no early exit, so that it vectorises.
    colors.as_flattened().iter().fold(0, |bits, channel| bits | channel.to_bits()) == 0
}

struct PaintRows<'a> {
    paint: CompositeParameters,
    value: &'a [f32],
    strength: &'a [f32],
    focus: &'a [Shares],
    /// Empty without a rim.
    rim: &'a [[u8; 4]],
    context: &'a [[f32; 4]],
    image: &'a mut [[u8; 4]],
}

impl Kernel for PaintRows<'_> {
    type Output = ();

    /// Plain loops over pixels, which vectorise at any width.
    #[inline(always)]
    fn run(self) {
        if !self.rim.is_empty() {
            return self.run_with_rim();
        }
        let Self { paint, value, strength, focus, context, image, .. } = self;
        let runs = value
            .chunks(PIXELS_TOGETHER)
            .zip(strength.chunks(PIXELS_TOGETHER))
            .zip(focus.chunks(PIXELS_TOGETHER))
            .zip(context.chunks(PIXELS_TOGETHER));
        for (image, (((value, strength), focus), context)) in image.chunks_mut(PIXELS_TOGETHER).zip(runs) {
            let pixels = image.iter_mut().zip(value).zip(strength).zip(focus);
            if is_nothing(context) {
                for (((image, value), strength), share) in pixels {
                    *image = straight(paint.pixel(*value, *strength, *share, [0.0; 4]), paint.background);
                }
            } else {
                for ((((image, value), strength), share), context) in pixels.zip(context) {
                    *image = straight(paint.pixel(*value, *strength, *share, *context), paint.background);
                }
            }
        }
    }
}

impl PaintRows<'_> {
    #[inline(always)]
    fn run_with_rim(self) {
        let Self { paint, value, strength, focus, rim, context, image } = self;
        let pixels = image.iter_mut().zip(value).zip(strength).zip(focus).zip(rim).zip(context);
        for (((((image, value), strength), share), rim), context) in pixels {
            let painted = paint.rimmed(*value, *rim, (*strength, *share), *context);
            *image = straight(painted, paint.background);
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
        for (image, colors) in self.image.chunks_mut(PIXELS_TOGETHER).zip(self.colors.chunks(PIXELS_TOGETHER))
        {
            // Most of a picture has no context, and pages that are never written cost no memory.
            if !is_nothing(colors) {
                for (image, color) in image.iter_mut().zip(colors) {
                    *image = straight(*color, [0.0; 4]);
                }
            }
        }
    }
}
