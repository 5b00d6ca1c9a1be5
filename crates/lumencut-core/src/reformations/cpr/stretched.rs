//! Stretched CPR: the surface of parallel lines through the vessel, unrolled. Seen along these lines the
//! surface is a curve. A row's position is the length along this curve, so lengths on the surface are true.
//! With the unit vector l of the lines, a step ds is √(ds² − (ds·l)²) high and ds·l wide.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::surface::{Anchor, Row, Run, Surface, comes_first, one_row};
use super::view::Axes;
use crate::error::Result;
use crate::math::centerline_path::CenterlinePath;
use crate::math::same_place::ON_PICTURE;

/// A segment that is not parallel to the lines.
#[derive(Clone, Copy, Debug)]
struct Strip {
    segment: usize,
    /// Top edge in the image, downwards (mm), and height.
    y: f64,
    height: f64,
    /// Unit vector from top to bottom edge, perpendicular to the lines.
    down: DVec3,
}

pub(super) struct Stretched {
    path: Arc<CenterlinePath>,
    across: DVec3,
    strips: Vec<Strip>,
    reach: f64,
    middle: f64,
}

impl Stretched {
    pub(super) fn new(path: Arc<CenterlinePath>, axes: Axes) -> Result<Self> {
        let points = path.points();
        // The vessel runs downwards in the image, so a vessel that rises in space is shown upside down.
        let rises = (points[points.len() - 1] - points[0]).dot(axes.up) > 0.0;
        let across = if rises { -axes.across } else { axes.across };
        let (mut strips, mut y) = (Vec::new(), 0.0);
        for (segment, ends) in points.windows(2).enumerate() {
            let step = (ends[1] - ends[0]).reject_from_normalized(across);
            let height = step.length();
            if height > f64::EPSILON * ends[0].abs().max_element().max(1.0) {
                strips.push(Strip { segment, y, height, down: step / height });
                y += height;
            }
        }
        if strips.is_empty() {
            return Err(one_row("stretched", "choose another angle, or another mode"));
        }
        let places = points.iter().map(|point| point.dot(across));
        let [left, right] = places.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
        let (reach, middle) = ((right - left) / 2.0, (left + right) / 2.0);
        Ok(Self { path, across, strips, reach, middle })
    }

    fn strip(&self, y: f64) -> &Strip {
        &self.strips[self.strips.partition_point(|strip| strip.y <= y).max(1) - 1]
    }

    fn anchor(&self, strip: &Strip, share: f64) -> Anchor {
        let [from, to] = [strip.segment, strip.segment + 1];
        let point = self.path.points()[from] + (self.path.points()[to] - self.path.points()[from]) * share;
        let [start, end] = [from, to].map(|i| self.path.arc_length()[i]);
        let arc_length = start + (end - start) * share;
        Anchor { point, x: point.dot(self.across) - self.middle, arc_length }
    }

    /// The point of a strip nearest to a point, across the lines; if `goes_on`, also beyond the strip's ends.
    fn nearest_candidate(&self, strip: &Strip, point: DVec3, goes_on: bool) -> Candidate {
        let share = (point - self.path.points()[strip.segment]).dot(strip.down) / strip.height;
        let share = if goes_on { share } else { share.clamp(0.0, 1.0) };
        let anchor = self.anchor(strip, share);
        let offset = point - anchor.point;
        Candidate {
            distance: offset.reject_from_normalized(self.across).length(),
            aside: offset.dot(self.across).abs(),
            y: strip.y + strip.height * share,
        }
    }
}

#[derive(Clone, Copy, Debug)]
struct Candidate {
    /// Distance of the point from the surface at this candidate (mm).
    distance: f64,
    /// Distance of the point from the vessel (mm).
    aside: f64,
    /// Position in the image, downwards (mm).
    y: f64,
}

impl Candidate {
    fn is_better(&self, other: &Self) -> bool {
        if (self.distance - other.distance).abs() > ON_PICTURE {
            return self.distance < other.distance;
        }
        comes_first([self.aside, self.y], [other.aside, other.y])
    }
}

impl Surface for Stretched {
    fn height(&self) -> f64 {
        self.strips.last().map_or(0.0, |last| last.y + last.height)
    }

    fn reach(&self) -> f64 {
        self.reach
    }

    fn row(&self, y: f64) -> Row {
        let strip = self.strip(y);
        let anchor = self.anchor(strip, (y - strip.y) / strip.height);
        Row { across: self.across, ahead: self.across.cross(strip.down), runs: vec![Run::at(anchor)] }
    }

    fn image_from_world(&self, point: DVec3) -> DVec2 {
        let x = point.dot(self.across) - self.middle;
        let within = self.strips.iter().map(|strip| self.nearest_candidate(strip, point, false));
        let ends = [&self.strips[0], &self.strips[self.strips.len() - 1]]
            .map(|end| self.nearest_candidate(end, point, true));
        let beyond = ends.into_iter().filter(|end| end.y < 0.0 || end.y > self.height());
        let better = |best: Candidate, other: Candidate| if other.is_better(&best) { other } else { best };
        // A position beyond the ends counts only if the surface is nearer there than within the vessel.
        let best = within
            .reduce(better)
            .into_iter()
            .chain(beyond)
            .reduce(|best, end| if end.distance + ON_PICTURE < best.distance { end } else { best });
        DVec2::new(x, best.map_or(0.0, |best| best.y))
    }

    fn folded(&self, y: f64, x: &[f64]) -> Vec<bool> {
        let own = self.row(y).runs[0].from;
        let others: Vec<_> = self
            .strips
            .iter()
            .map(|strip| (self.nearest_candidate(strip, own.point, false), strip))
            .filter(|(other, _)| other.distance <= ON_PICTURE && (other.y - y).abs() > ON_PICTURE)
            .map(|(other, strip)| [self.anchor(strip, (other.y - strip.y) / strip.height).x, other.y])
            .collect();
        let belongs_there = |x: f64| {
            let elsewhere =
                |&[beside, down]: &[f64; 2]| comes_first([(x - beside).abs(), down], [(x - own.x).abs(), y]);
            others.iter().any(elsewhere)
        };
        x.iter().map(|x| belongs_there(*x)).collect()
    }
}
