//! Transfer functions prepared for rays: colour and opacity of an intensity in the context.

use super::blocks::{HUGE, Range};
use super::lanes::{FAN, larger, smaller};
use crate::settings::{ControlPoint, TransferFunction};

/// Opacity below which nothing is seen: even across a body it changes far less than one grey value.
pub const INVISIBLE: f32 = 1e-6;

/// The part of a transfer function between two control points: what it adds to colour and opacity.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rise {
    /// The intensity at which the rise begins.
    pub start: f32,
    /// Share of the rise that one unit of intensity completes.
    pub per_intensity: f32,
    pub color: [f32; 3],
    pub opacity: f32,
}

impl Rise {
    fn between(from: ControlPoint, to: ControlPoint) -> Self {
        let span = to.intensity - from.intensity;
        let step = f64::EPSILON.max(from.intensity.abs() * 1e-9);
        Self {
            start: from.intensity as f32,
            per_intensity: (1.0 / span.max(step)) as f32,
            color: std::array::from_fn(|c| (f32::from(to.color[c]) - f32::from(from.color[c])) / 255.0),
            opacity: (to.opacity - from.opacity) as f32,
        }
    }

    /// The intensity from which on the rise is complete; for a step, the number just above its start.
    fn end(&self) -> f32 {
        larger(self.start.next_up(), self.start + 1.0 / self.per_intensity)
    }

    #[inline(always)]
    fn share(&self, intensity: f32) -> f32 {
        smaller(larger((intensity - self.start) * self.per_intensity, 0.0), 1.0)
    }
}

#[derive(Clone, Debug)]
pub struct Colors {
    color: [f32; 3],
    opacity: f32,
    rises: Vec<Rise>,
    last: f32,
    transparent: Vec<Range>,
}

impl Colors {
    pub fn new(function: &TransferFunction) -> Self {
        let points = &function.points;
        Self {
            color: points[0].color.map(|c| f32::from(c) / 255.0),
            opacity: points[0].opacity as f32,
            rises: points.windows(2).map(|pair| Rise::between(pair[0], pair[1])).collect(),
            last: points[points.len() - 1].intensity as f32,
            transparent: transparent(points),
        }
    }

    pub fn first(&self) -> ([f32; 3], f32) {
        (self.color, self.opacity)
    }

    pub(crate) fn rises(&self) -> &[Rise] {
        &self.rises
    }

    pub fn gaps(&self) -> &[Range] {
        &self.transparent
    }

    /// The intensity above which the colour no longer changes.
    #[inline(always)]
    pub fn last(&self) -> f32 {
        self.last
    }

    #[inline(always)]
    pub(crate) fn is_transparent(&self, range: Range) -> bool {
        self.transparent.iter().any(|gap| range.low >= gap.low && range.high <= gap.high)
    }

    /// The intensity up to which everything is transparent.
    pub(crate) fn first_visible(&self) -> f32 {
        self.transparent.first().filter(|gap| gap.low <= -HUGE).map_or(-HUGE, |gap| gap.high)
    }

    /// The opacity of one millimetre at sixteen intensities.
    #[inline(always)]
    pub fn opacity(&self, intensity: &[f32; FAN]) -> [f32; FAN] {
        let mut opacity = [self.opacity; FAN];
        for rise in &self.rises {
            for l in 0..FAN {
                opacity[l] += rise.opacity * rise.share(intensity[l]);
            }
        }
        for l in 0..FAN {
            opacity[l] = if opacity[l] > INVISIBLE { smaller(opacity[l], 1.0) } else { 0.0 };
        }
        opacity
    }

    /// The colours of sixteen intensities, channel by channel, 0 to 1.
    #[inline(always)]
    pub fn color(&self, intensity: &[f32; FAN]) -> [[f32; FAN]; 3] {
        let mut color = self.color.map(|c| [c; FAN]);
        for rise in &self.rises {
            for l in 0..FAN {
                let share = rise.share(intensity[l]);
                for c in 0..3 {
                    color[c][l] += rise.color[c] * share;
                }
            }
        }
        color
    }
}

fn transparent(points: &[ControlPoint]) -> Vec<Range> {
    let mut ranges = Vec::new();
    let mut low = Some(-HUGE).filter(|_| points[0].opacity == 0.0);
    for pair in points.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        match low {
            Some(start) if to.opacity > 0.0 => {
                ranges.push(Range { low: start, high: from.intensity as f32 });
                low = None;
            }
            None if to.opacity == 0.0 => {
                low = Some(larger(Rise::between(from, to).end(), to.intensity as f32));
            }
            _ => {}
        }
    }
    ranges.extend(low.map(|low| Range { low, high: HUGE }));
    ranges
}
