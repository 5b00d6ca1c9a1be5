//! Moves and smooths a line by hand. Points keep their radii, so the tube follows. Moved points are marked as by hand.

use std::f64::consts::FRAC_PI_2;

use glam::DVec3;
use lumencut_core::math::arc_length::arc_lengths;
use lumencut_core::math::centerline_path::smoothed;

use crate::defaults::SMOOTHING;
use crate::study::document::WorldPoint;
use crate::study::draft::Draft;
use crate::study::failure::{Failure, Result};
use crate::study::line_edits::MEETING;
use crate::study::lines::{Line, wrong};
use crate::study::open_study::Study;

#[derive(Clone, Copy, Debug)]
pub(crate) enum Reshaping {
    /// Moves the point at an arc length (mm) to another place. The line near it follows smoothly.
    Bend { at: f64, to: WorldPoint },
    /// Averages the line by a Gaussian with this standard deviation (mm). Its ends stay.
    Smooth { sigma: f64 },
}

/// How far the line follows a pull on each side: at least this far (mm), and this many times as far as the pull, so that the
/// line turns by less than 30 degrees.
const LEAST_REACH_MM: f64 = 10.0;
const REACH_PER_PULL: f64 = 3.0;

/// Points that moved by less (mm) did not move.
const MOVED_MM: f64 = 1e-3;

/// The line after a change. Fails with an error of kind `vessel tree` for a place that is not on the line, or a smoothing out of range.
pub(crate) fn reshaped(line: &Line, how: &Reshaping) -> Result<Line> {
    let points = match *how {
        Reshaping::Bend { at, to } => bent(&line.points, at, DVec3::from_array(to))?,
        Reshaping::Smooth { sigma } => {
            let [least, most] = SMOOTHING.range;
            if !(least..=most).contains(&sigma) {
                let expected = format!("{least} to {most} mm");
                return Err(wrong("smoothing", format!("{sigma} mm"), &expected).into());
            }
            smoothed(&line.vessel()?, sigma)?.points().to_vec()
        }
    };
    let before = line.points.iter().enumerate();
    let is_moved = |(n, point): (usize, &DVec3)| {
        line.by_hand.as_ref().is_some_and(|by_hand| by_hand[n]) || point.distance(points[n]) > MOVED_MM
    };
    let by_hand: Vec<bool> = before.map(is_moved).collect();
    let by_hand = by_hand.contains(&true).then_some(by_hand);
    Ok(Line { points, by_hand, ..line.clone() })
}

/// The points after the one at an arc length (mm) was moved. An end moves only if it is the one that is moved.
fn bent(points: &[DVec3], at: f64, to: DVec3) -> Result<Vec<DVec3>> {
    let lengths = arc_lengths(points);
    let whole = lengths[lengths.len() - 1];
    if !(0.0..=whole).contains(&at) || !to.is_finite() {
        let expected = format!("a place from 0 to {whole:.3} mm along it, moved to a point");
        return Err(wrong("place", format!("a move at {at:.3} mm"), &expected).into());
    }
    let pull = to - place_at(points, &lengths, at);
    let reach = LEAST_REACH_MM.max(REACH_PER_PULL * pull.length());
    let weight = |length: f64| {
        let room = if length < at { at } else { whole - at };
        // An end has no room beyond itself, and moves if it is the moved place.
        let share = if length == at { 0.0 } else { (length - at).abs() / reach.min(room) };
        if share < 1.0 { (FRAC_PI_2 * share).cos().powi(2) } else { 0.0 }
    };
    Ok(points.iter().zip(&lengths).map(|(point, length)| *point + pull * weight(*length)).collect())
}

fn place_at(points: &[DVec3], lengths: &[f64], at: f64) -> DVec3 {
    let after = lengths.partition_point(|length| *length < at).clamp(1, lengths.len() - 1);
    let step = lengths[after] - lengths[after - 1];
    points[after - 1].lerp(points[after], (at - lengths[after - 1]) / step)
}

impl Study {
    pub(crate) fn reshaped(&self, line: usize, how: &Reshaping) -> Result<Vec<WorldPoint>> {
        let line = reshaped(&*self.lines.get(line)?, how)?;
        Ok(line.points.iter().map(|point| point.to_array()).collect())
    }

    pub(crate) fn reshape_vessel(&mut self, draft: &mut Draft, id: u32, how: &Reshaping) -> Result<()> {
        if let Reshaping::Bend { to, .. } = how {
            self.check_within(*to)?;
        }
        let Some(line) = draft.document.vessel(id).map(|vessel| vessel.line) else { return Ok(()) };
        let before = self.lines.get(line)?;
        let after = reshaped(&before, how)?;
        if after.points == before.points {
            return Ok(());
        }
        for vessel in draft.document.vessels.iter_mut().filter(|vessel| vessel.id != id && vessel.is_sure()) {
            if let Some(follower) = following(&*self.lines.get(vessel.line)?, [&before, &after])? {
                vessel.take_line(self.lines.add(follower)?);
            }
        }
        let line = self.lines.add(after)?;
        if let Some(vessel) = draft.document.vessels.iter_mut().find(|vessel| vessel.id == id) {
            vessel.take_line(line);
            vessel.clicks = None;
        }
        Ok(())
    }

    fn check_within(&self, to: WorldPoint) -> Result<()> {
        if self.at(to).value.is_some() {
            return Ok(());
        }
        Err(Failure {
            kind: "vessel tree",
            ..Failure::of_message("place of the line", &"a point outside the scan", "a point inside the scan")
        })
    }
}

/// A line whose ends follow the points of another line that they meet; None if none moves.
fn following(line: &Line, [before, after]: [&Line; 2]) -> Result<Option<Line>> {
    let mut moved = line.clone();
    for is_last in [false, true] {
        let end = line.points[if is_last { line.points.len() - 1 } else { 0 }];
        let met = before.points.iter().position(|point| point.distance(end) <= MEETING);
        let Some(n) = met.filter(|n| before.points[*n].distance(after.points[*n]) > MOVED_MM) else {
            continue;
        };
        let at = if is_last { arc_lengths(&moved.points).last().copied().unwrap_or(0.0) } else { 0.0 };
        let to = (end + after.points[n] - before.points[n]).to_array();
        moved = reshaped(&moved, &Reshaping::Bend { at, to })?;
    }
    Ok((moved.points != line.points).then_some(moved))
}

#[cfg(test)]
#[path = "tests/reshaping.rs"]
mod tests;
