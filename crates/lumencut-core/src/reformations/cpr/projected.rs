//! Projected CPR: the vessel as the viewer sees it. A pixel's depth is that of the nearest vessel point in its row.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::surface::{Anchor, Row, Run, Surface, one_row};
use super::view::Axes;
use crate::error::Result;
use crate::math::centerline_path::CenterlinePath;
use crate::math::same_place::ON_PICTURE;

pub(super) struct Projected {
    path: Arc<CenterlinePath>,
    axes: Axes,
    heights: Vec<f64>,
    ends: [f64; 2],
    /// Half of the vessel's extent across the view, and the middle of this extent (mm).
    reach: f64,
    middle: f64,
}

impl Projected {
    pub(super) fn new(path: Arc<CenterlinePath>, axes: Axes, row: f64) -> Result<Self> {
        let heights: Vec<_> = path.points().iter().map(|point| point.dot(axes.up)).collect();
        let [low, high] = range(heights.iter().copied());
        if high - low < row {
            return Err(one_row("projected", "choose another up, or another mode"));
        }
        let [left, right] = range(path.points().iter().map(|point| point.dot(axes.across)));
        let (reach, middle) = ((right - left) / 2.0, (left + right) / 2.0);
        Ok(Self { path, axes, heights, ends: [low, high], reach, middle })
    }

    fn anchor(&self, segment: usize, share: f64) -> Anchor {
        let [from, to] = [segment, segment + 1];
        let point = self.path.points()[from].lerp(self.path.points()[to], share);
        let [start, end] = [from, to].map(|i| self.path.arc_length()[i]);
        Anchor {
            point,
            x: point.dot(self.axes.across) - self.middle,
            arc_length: start + (end - start) * share,
        }
    }

    fn runs(&self, height: f64) -> Vec<Run> {
        let mut runs: Vec<Run> = Vec::new();
        for (segment, ends) in self.heights.windows(2).enumerate() {
            let &[from, to] = ends else { continue };
            if height < from.min(to) || height > from.max(to) {
                continue;
            }
            let run = if from == to {
                Run { from: self.anchor(segment, 0.0), to: self.anchor(segment, 1.0) }
            } else {
                Run::at(self.anchor(segment, (height - from) / (to - from)))
            };
            // A row through a vessel point meets both segments that share the point; only one of the two is kept.
            let end = runs.last().map_or(f64::NEG_INFINITY, |last| last.to.arc_length);
            if run.to.arc_length > end + ON_PICTURE {
                if runs.last().is_some_and(|last| {
                    last.to.arc_length + ON_PICTURE >= run.from.arc_length && is_point(last)
                }) {
                    runs.pop();
                }
                runs.push(run);
            }
        }
        runs
    }
}

fn is_point(run: &Run) -> bool {
    run.from.arc_length == run.to.arc_length
}

impl Surface for Projected {
    fn height(&self) -> f64 {
        self.ends[1] - self.ends[0]
    }

    fn reach(&self) -> f64 {
        self.reach
    }

    fn row(&self, y: f64) -> Row {
        let height = self.ends[1] - y;
        let within = height.clamp(self.ends[0], self.ends[1]);
        let mut runs = self.runs(within);
        let beyond = self.axes.up * (height - within);
        for run in &mut runs {
            (run.from.point, run.to.point) = (run.from.point + beyond, run.to.point + beyond);
        }
        Row { across: self.axes.across, ahead: self.axes.ahead, runs }
    }

    fn image_from_world(&self, point: DVec3) -> DVec2 {
        DVec2::new(point.dot(self.axes.across) - self.middle, self.ends[1] - point.dot(self.axes.up))
    }

    fn folded(&self, y: f64, x: &[f64]) -> Vec<bool> {
        vec![self.row(y).is_shared(); x.len()]
    }
}

fn range(numbers: impl Iterator<Item = f64>) -> [f64; 2] {
    numbers.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], n| [low.min(n), high.max(n)])
}
