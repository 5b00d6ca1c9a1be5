//! Accumulates the samples of rays from near to far: colours and opacities.

use super::blocks::{HUGE, Range};
use super::context_parameters::ContextParameters;
use super::lanes::{FAN, larger, smaller, smallest};
use super::thickness::of_thickness;
use super::transfer::Colors;

/// Once a ray is this opaque, only a sample brighter than all before can change its pixel by half a grey value.
pub const OPAQUE: f32 = 1.0 - 1.0 / 1024.0;

/// Premultiplied colours and opacity of sixteen pixels, channel by channel, 0 to 1.
pub(crate) type Rgba = [[f32; FAN]; 4];

#[derive(Clone, Copy, Debug)]
pub(crate) struct Samples<'a> {
    pub value: &'a [f32; FAN],
    /// 1 if the ray has this sample, else 0; a number instead of `bool`, so that the code vectorises.
    pub present: &'a [f32; FAN],
    /// Length of the ray (mm) that each sample represents.
    pub thickness: &'a [f32; FAN],
}

/// Light on sixteen samples; evaluated only if one of them is visible.
pub(crate) trait Light {
    /// The factor by which the light multiplies each colour, and the light that is added.
    fn shade(&self) -> [[f32; FAN]; 2];
}

#[derive(Clone, Debug)]
pub(crate) struct Palette {
    pub colors: Colors,
    pub parameters: ContextParameters,
}

/// DVR, MIDA, MIP, and blends of them (Bruckner and Gröller 2009, doi:10.1111/j.1467-8659.2009.01474.x).
#[derive(Clone, Debug)]
pub(crate) struct Blend<'a> {
    palette: &'a Palette,
    /// 1 + min(γ, 0), with γ as in `ContextMode::Blend`: how much a brighter sample weakens those before it.
    push: f32,
    /// max(γ, 0): the share of the maximum intensity projection in the finished pixel.
    mix: f32,
    color: [[f32; FAN]; 3],
    opacity: [f32; FAN],
    most: [f32; FAN],
    brightest: Brightest<'a>,
}

impl<'a> Blend<'a> {
    /// Rays that are not `active` take no samples.
    #[inline(always)]
    pub(crate) fn new(palette: &'a Palette, active: &[bool; FAN]) -> Self {
        // Transparent samples matter only until the first visible sample, which is brighter than all of them.
        let most = palette.parameters.most;
        Self {
            palette,
            push: palette.parameters.push,
            mix: palette.parameters.mix,
            color: [[0.0; FAN]; 3],
            opacity: active.map(|active| if active { 0.0 } else { 1.0 }),
            most: active.map(|active| if active { most } else { 1.0 }),
            brightest: Brightest::new(palette, active),
        }
    }

    #[inline(always)]
    pub(crate) fn ignores(&self, range: Range) -> bool {
        let unseen = smallest(&self.opacity) >= OPAQUE || self.palette.colors.is_transparent(range);
        unseen
            && (self.push == 0.0 || self.palette.parameters.window.at(range.high) <= smallest(&self.most))
            && (self.mix == 0.0 || self.brightest.ignores(range))
    }

    #[inline(always)]
    pub(crate) fn add(&mut self, samples: &Samples, light: &impl Light) {
        let mut own = self.palette.colors.opacity(samples.value);
        let mut keep = [1.0; FAN];
        let mut any = 0;
        for l in 0..FAN {
            let intensity = self.palette.parameters.window.at(samples.value[l]) * samples.present[l];
            let push = larger(intensity - self.most[l], 0.0) * self.push;
            let seen = if self.opacity[l] < OPAQUE { samples.present[l] } else { 0.0 };
            let seen = if push > 0.0 { samples.present[l] } else { seen };
            keep[l] = 1.0 - push;
            own[l] *= seen;
            any |= own[l].to_bits();
            self.most[l] = larger(self.most[l], intensity);
        }
        if self.mix > 0.0 {
            self.brightest.add(samples);
        }
        for l in 0..FAN {
            self.opacity[l] *= keep[l];
            for channel in &mut self.color {
                channel[l] *= keep[l];
            }
        }
        if any == 0 {
            return;
        }
        let own = of_thickness(&own, samples.thickness);
        let (color, [lit, shine]) = (self.palette.colors.color(samples.value), light.shade());
        for l in 0..FAN {
            let share = (1.0 - self.opacity[l]) * own[l];
            for (sum, color) in self.color.iter_mut().zip(&color) {
                sum[l] += share * smaller(color[l] * lit[l] + shine[l], 1.0);
            }
            self.opacity[l] += share;
        }
    }

    #[inline(always)]
    pub(crate) fn finish(&self) -> Rgba {
        let brightest = self.brightest.finish();
        let mut pixels = [self.color[0], self.color[1], self.color[2], self.opacity];
        for (c, channel) in pixels.iter_mut().enumerate() {
            for l in 0..FAN {
                let mixed = channel[l] + (brightest[c][l] - channel[l]) * self.mix;
                channel[l] = if self.brightest.active[l] { mixed } else { 0.0 };
            }
        }
        pixels
    }
}

/// The largest sample of each ray so far; a blend with γ > 0 moves towards its colour.
#[derive(Clone, Debug)]
struct Brightest<'a> {
    colors: &'a Colors,
    active: [bool; FAN],
    best: [f32; FAN],
}

impl<'a> Brightest<'a> {
    #[inline(always)]
    fn new(palette: &'a Palette, active: &[bool; FAN]) -> Self {
        let best = active.map(|active| if active { -HUGE } else { HUGE });
        Self { colors: &palette.colors, active: *active, best }
    }

    #[inline(always)]
    fn ignores(&self, range: Range) -> bool {
        // The colour is constant beyond the last control point.
        smaller(range.high, self.colors.last()) <= smallest(&self.best)
    }

    #[inline(always)]
    fn add(&mut self, samples: &Samples) {
        for l in 0..FAN {
            let value = smaller(samples.value[l], self.colors.last());
            let value = if samples.present[l] > 0.0 { value } else { -HUGE };
            self.best[l] = larger(self.best[l], value);
        }
    }

    #[inline(always)]
    fn finish(&self) -> Rgba {
        let mut found = [false; FAN];
        for l in 0..FAN {
            found[l] = self.active[l] & (self.best[l] > -HUGE);
        }
        opaque(self.colors.color(&self.best), &found)
    }
}

#[inline(always)]
pub(crate) fn opaque(color: [[f32; FAN]; 3], found: &[bool; FAN]) -> Rgba {
    let mut pixels = [color[0], color[1], color[2], [1.0; FAN]];
    for channel in &mut pixels {
        for l in 0..FAN {
            channel[l] = if found[l] { channel[l] } else { 0.0 };
        }
    }
    pixels
}
