//! Lines at depth jumps (leaps): each is drawn on one side of its leap, and never in a lumen that continues.

use crate::math::lanes::FAN;
use crate::math::leaps::{DOWNWARDS, LEAPS, LINE_DOWNWARDS, LINE_TO_THE_RIGHT, LUMEN, TO_THE_RIGHT};

/// A pixel, or a step between two: columns to the right, rows downwards.
type PixelStep = [isize; 2];

const STEPS: [PixelStep; 4] = [[1, 0], [-1, 0], [0, 1], [0, -1]];

pub(super) struct LeapLines<'a> {
    leap: &'a [u32],
    /// The values on the surface, NaN if it shows nothing; empty if all of it counts as shown.
    value: &'a [f32],
    size: PixelStep,
    /// Width of a line (pixels), at least 1.
    line_width: f32,
    /// The largest share of a pixel that a line covers.
    most: f32,
    /// The largest distance (pixels) between a depth jump and a pixel that the jump's line can cover.
    reach: isize,
}

struct Border {
    is_leap: bool,
    has_line: bool,
}

impl<'a> LeapLines<'a> {
    pub(super) fn new(leap: &'a [u32], value: &'a [f32], width: usize, line_width: f32) -> Self {
        let size = [width as isize, (leap.len() / width) as isize];
        let most = line_width.min(1.0);
        // A line narrower than a pixel is drawn one pixel wide, but fainter.
        let line_width = line_width.max(1.0);
        Self { leap, value, size, line_width, most, reach: line_width.ceil() as isize }
    }

    pub(super) fn fill_row(&self, row: usize, strength: &mut [f32]) {
        for (n, strength) in strength.chunks_mut(FAN).enumerate() {
            let [i, j] = [(n * FAN) as isize, row as isize];
            if !self.has_leaps_near(i, j) {
                strength.fill(0.0);
                continue;
            }
            for (l, strength) in (0..).zip(strength) {
                *strength = self.cover([i + l, j]);
            }
        }
    }

    /// The share of a pixel that lines cover.
    pub(super) fn cover(&self, here: PixelStep) -> f32 {
        if self.is_lumen(here) { self.cover_of_lumen(here) } else { self.cover_beside_lumen(here) }
    }

    /// Whether the line of any depth jump can reach the sixteen pixels of row `j` from column `i` on.
    fn has_leaps_near(&self, i: isize, j: isize) -> bool {
        let [width, height] = self.size;
        let columns = (i - self.reach).max(0)..(i + FAN as isize + self.reach).min(width);
        let mut rows = (j - self.reach).max(0)..(j + self.reach + 1).min(height);
        rows.any(|j| {
            let row = &self.leap[(j * width + columns.start) as usize..(j * width + columns.end) as usize];
            row.iter().fold(0, |all, bits| all | bits) & LEAPS != 0
        })
    }

    /// Lines cover a lumen only next to a leap to another lumen, in the row or column that crosses the leap.
    fn cover_of_lumen(&self, here: PixelStep) -> f32 {
        let ends = |at: PixelStep, step| {
            let beyond = ahead(at, step);
            self.border(at, step).has_line && self.is_lumen(at) && self.is_lumen(beyond)
        };
        let mut cover = 0f32;
        for step in STEPS {
            if ends(here, step) {
                cover = self.most;
            } else if !self.border(here, step).is_leap && ends(ahead(here, step), step) {
                cover = cover.max(self.cover_at(1.5, 0.0));
            }
        }
        cover
    }

    /// The covered share of a pixel outside all lumens, by the distance to the nearest leap whose line lies
    /// on this side. On the other side of a leap it is 0.
    fn cover_beside_lumen(&self, here: PixelStep) -> f32 {
        let mut leaps = STEPS.into_iter().filter(|step| self.border(here, *step).is_leap).peekable();
        if leaps.peek().is_some() && !leaps.any(|step| self.shows_line(here, step)) {
            return 0.0;
        }
        let mut cover = 0f32;
        for j in (here[1] - self.reach).max(0)..(here[1] + self.reach + 1).min(self.size[1]) {
            let columns = (here[0] - self.reach).max(0)..(here[0] + self.reach + 1).min(self.size[0]);
            let row = (j * self.size[0] + columns.start) as usize..(j * self.size[0] + columns.end) as usize;
            for (i, bits) in columns.zip(&self.leap[row]) {
                if bits & LEAPS == 0 {
                    continue;
                }
                let (owner, [right, down]) = ([i, j], [here[0] - i, here[1] - j]);
                let (x, y) = (right as f32, down as f32);
                if bits & TO_THE_RIGHT != 0 && self.shows_line_of(owner, [1, 0], right > 0) {
                    cover = cover.max(self.cover_at(x - 0.5, y));
                }
                if bits & DOWNWARDS != 0 && self.shows_line_of(owner, [0, 1], down > 0) {
                    cover = cover.max(self.cover_at(x, y - 0.5));
                }
            }
        }
        cover
    }

    /// Whether either of two neighbouring pixels shows the line of the leap between them.
    fn shows_line_of(&self, owner: PixelStep, step: PixelStep, beyond: bool) -> bool {
        if beyond {
            self.shows_line(ahead(owner, step), [-step[0], -step[1]])
        } else {
            self.shows_line(owner, step)
        }
    }

    /// Whether a shown pixel shows the line of a leap: the line lies in this pixel, or it would lie in the
    /// other, which shows nothing, and this pixel is not lumen.
    fn shows_line(&self, here: PixelStep, step: PixelStep) -> bool {
        let may_lie_here = !(self.is_lumen(here) || self.is_shown(ahead(here, step)));
        self.is_shown(here) && (self.border(here, step).has_line || may_lie_here)
    }

    /// The share of a pixel that a line covers, by the offset between its leap and the pixel (pixels).
    fn cover_at(&self, x: f32, y: f32) -> f32 {
        self.most * (self.line_width + 0.5 - (x * x + y * y).sqrt()).clamp(0.0, 1.0)
    }

    fn border(&self, here: PixelStep, step: PixelStep) -> Border {
        let (bit, line) =
            if step[1] == 0 { (TO_THE_RIGHT, LINE_TO_THE_RIGHT) } else { (DOWNWARDS, LINE_DOWNWARDS) };
        let is_owner = step[0] + step[1] > 0;
        let bits = self.bits(if is_owner { here } else { ahead(here, step) });
        let is_leap = bits & bit != 0;
        Border { is_leap, has_line: is_leap && (bits & line == 0) == is_owner }
    }

    fn is_lumen(&self, here: PixelStep) -> bool {
        self.bits(here) & LUMEN != 0
    }

    fn is_shown(&self, [i, j]: PixelStep) -> bool {
        self.value.is_empty() || !self.value[(j * self.size[0] + i) as usize].is_nan()
    }

    fn bits(&self, [i, j]: PixelStep) -> u32 {
        let is_inside = (0..self.size[0]).contains(&i) && (0..self.size[1]).contains(&j);
        if is_inside { self.leap[(j * self.size[0] + i) as usize] } else { 0 }
    }
}

fn ahead([i, j]: PixelStep, [right, down]: PixelStep) -> PixelStep {
    [i + right, j + down]
}
