//! Whether a line is that of a tube, and how far.

use crate::trace::lines::centerline::Centerline;
use crate::trace::lines::directions::point_directions;
use crate::trace::lines::frames::frames;
use crate::trace::lumen::cross_section::{LumenSection, Probe};
use crate::trace::lumen::lumen_model::LumenModel;
use lumencut_core::math::arc_length::arc_lengths;

/// From this confidence on a point lies in a tube.
const SEEN: f64 = 0.35;

/// The least length of a tube that is seen (mm, and in its radii): what is shorter is not taken for one.
const LEAST_LENGTH: f64 = 2.5;
const LEAST_RADII: f64 = 1.5;

/// The longest stretch over which a tube may be hidden (mm, or in the larger radius beside it where that is more), as where
/// branches leave or calcium lies.
const HIDDEN: f64 = 3.0;
const HIDDEN_RADII: f64 = 2.0;

/// The least length of a branch beyond what it leaves: in mm, and in its own radii.
const SHORTEST: f64 = 3.0;
const SHORTEST_RADII: f64 = 2.0;

/// The lumen of a tube changes by no more than this part of the contrast from one stretch to the next.
const LIKE: f64 = 0.25;

/// A stretch whose walls are brighter than the lumen over more than this share, as in bone, goes on from one before it: with
/// a radius that differs by no more than this factor, and after no more than this length (mm).
const BRIGHT: f64 = 0.5;
const STEADY: f64 = 1.5;
const GOES_ON: f64 = 2.0;

/// How sure a place is at most whose walls are bright.
const BRIGHT_TRUST: f64 = 0.3;

/// A stretch that goes on with about the radius before and a value this near to it (part of the contrast) may be short.
const SAME: f64 = 0.1;

/// With how many points before it a point is compared.
const BEFORE: usize = 8;

/// What is seen along a line.
pub struct Sections {
    lengths: Vec<f64>,
    radius: Vec<f64>,
    trust: Vec<f64>,
    value: Vec<f64>,
    bright: Vec<f64>,
}

impl Sections {
    /// The cross-sections at the points of a line.
    pub fn along(probe: &Probe, line: &Centerline) -> Self {
        let across = frames(&line.points, &point_directions(&line.points, 1.5));
        let look = |n: usize| {
            let guess = Some(line.radius[n]).filter(|radius| *radius > 0.0);
            probe.look(line.points[n], across[n], guess)
        };
        let sections: Vec<Option<LumenSection>> = (0..line.points.len()).map(look).collect();
        let of = |value: fn(&LumenSection) -> f64| -> Vec<f64> {
            sections.iter().map(|section| section.as_ref().map_or(0.0, value)).collect()
        };
        Self {
            lengths: arc_lengths(&line.points),
            radius: line.radius.clone(),
            trust: of(|section| section.trust),
            value: of(|section| section.value),
            bright: of(|section| section.bright),
        }
    }

    /// How sure the line is at each of its points, 0 to 1: how well the lumen is seen, and how near its value is to what is
    /// usual.
    pub fn confidence(&self, usual: &Usual) -> Vec<f64> {
        let sure = |n: usize| {
            let unlike = (self.value[n] - usual.value).abs() / (2.0 * LIKE * usual.contrast);
            let walls = if self.bright[n] > BRIGHT { BRIGHT_TRUST } else { 1.0 };
            self.trust[n] * walls * (1.0 - unlike * unlike).max(0.0)
        };
        (0..self.trust.len()).map(sure).collect()
    }

    /// The last point of the tube that the line begins with at point `from`; none where that is no tube.
    pub fn sound(
        &self,
        from: usize,
        smallest_radius: f64,
        usual: &Usual,
        is_faithful: &dyn Fn(usize) -> bool,
    ) -> Option<usize> {
        let count = self.lengths.len();
        // What comes before is known to be lumen.
        let mut before = self.stretch(0, from.max(1) - 1).filter(|_| from > 0);
        let (mut end, mut next) = (None, from);
        while let Some(stretch) = (next < count).then(|| self.stretch(next, count - 1)).flatten() {
            next = stretch.last + 1;
            let begins = before.as_ref().map_or(self.lengths[from], |before| self.lengths[before.last]);
            let hidden = self.lengths[stretch.first] - begins.max(self.lengths[from.min(count - 1)]);
            let widest = before.as_ref().map_or(0.0, |before| before.radius).max(stretch.radius);
            let length = self.lengths[stretch.last] - self.lengths[stretch.first];
            if hidden > HIDDEN.max(HIDDEN_RADII * widest) {
                break;
            }
            if stretch.goes_on(before.as_ref(), length, hidden, usual) && is_faithful(stretch.last) {
                end = Some(stretch.last);
                before = Some(stretch);
            }
        }
        let is_wide =
            |n: &usize| median(&self.radius[from.max(n.saturating_sub(BEFORE))..=*n]) >= smallest_radius;
        let end = (from..=end?).rev().find(is_wide)?;
        let outside = self.lengths[end] - self.lengths[from];
        (outside >= SHORTEST.max(SHORTEST_RADII * median(&self.radius[from..=end]))).then_some(end)
    }

    /// Whether the tube, seen from point `first` on, is suddenly wider at point `n`, as where it opens into something else.
    fn widens(&self, first: usize, n: usize) -> bool {
        let near = first.max(n.saturating_sub(BEFORE));
        self.radius[n] > STEADY * median(&self.radius[near..n])
    }

    /// The next stretch between two points that is seen.
    fn stretch(&self, from: usize, to: usize) -> Option<TubePart> {
        let first = (from..=to).find(|n| self.trust[*n] >= SEEN)?;
        let last =
            (first + 1..=to).find(|n| self.trust[*n] < SEEN || self.widens(first, *n)).unwrap_or(to + 1) - 1;
        let part = first..=last;
        Some(TubePart {
            first,
            last,
            radius: median(&self.radius[part.clone()]),
            value: median(&self.value[part.clone()]),
            bright: median(&self.bright[part]),
        })
    }
}

/// A stretch of a line along which it is seen to be a tube.
#[derive(Debug)]
struct TubePart {
    first: usize,
    last: usize,
    radius: f64,
    value: f64,
    bright: f64,
}

impl TubePart {
    /// Whether this is a tube that goes on from the stretch before, where there is one.
    fn goes_on(&self, before: Option<&Self>, length: f64, hidden: f64, usual: &Usual) -> bool {
        let value = before.map_or(usual.value, |before| before.value);
        let unlike = (self.value - value).abs() / usual.contrast;
        let is_steady = before.is_some_and(|before| (self.radius / before.radius).ln().abs() <= STEADY.ln());
        let is_long = length >= LEAST_LENGTH.max(LEAST_RADII * self.radius);
        let goes_on = is_steady && (unlike <= SAME || length >= LEAST_LENGTH);
        unlike <= LIKE && (is_long || goes_on) && (self.bright <= BRIGHT || (is_steady && hidden <= GOES_ON))
    }
}

/// What is usual for the lumen.
pub struct Usual {
    /// Its value.
    pub value: f64,
    /// How far that is from the tissue around it.
    pub contrast: f64,
}

impl Usual {
    /// What is usual for the lumen of a model.
    pub fn of(model: &LumenModel) -> Self {
        Self { value: model.low, contrast: model.contrast() }
    }
}

/// The median of some values, of which there is one at least.
pub fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    sorted[sorted.len() / 2]
}
