//! Refines a mask vessel, except inside the vessels that it meets.

use std::ops::Range;

use glam::DVec3;

use crate::trace::lines::centerline::Centerline;
use crate::trace::skeleton::mask_lumen::Lumen;
use lumencut_core::error::Result;
use lumencut_core::math::arc_length::{LinePlace, arc_lengths};

/// A function that finds a better centerline, given the points (mm, LPS) and radii (mm) of a line.
pub type Refine<'a> = &'a (dyn Fn(&[DVec3], &[f64]) -> Result<Option<Centerline>> + Sync);

/// A vessel has left another one where it narrows by at most this fraction over the length of a radius.
const NARROWER: f64 = 0.2;

/// Minimum number of points of a line for it to be refined.
const FEWEST: usize = 5;

/// Refines a vessel. Inside other vessels at its ends the line stays unchanged; over one radius it then
/// changes gradually into the refined line. Points are at most `step` mm apart.
pub(crate) fn refined(
    line: Centerline,
    is_free: [bool; 2],
    lumen: &Lumen,
    refine: Refine,
    step: f64,
) -> Result<Centerline> {
    let own = own_points(&line.points, is_free, lumen);
    if own.len() < FEWEST {
        return Ok(line);
    }
    let part = |values: &[f64]| values[own.clone()].to_vec();
    let old = Centerline {
        points: line.points[own.clone()].to_vec(),
        radius: part(&line.radius),
        confidence: vec![1.0; own.len()],
    };
    let Some(better) = refine(&old.points, &old.radius)? else { return Ok(line) };
    let mut joined = Centerline {
        points: line.points[..own.start].to_vec(),
        radius: line.radius[..own.start].to_vec(),
        confidence: vec![better.confidence[0]; own.start],
    };
    let reaches = [0, 1].map(|end| {
        let at = if end == 0 { 0 } else { old.radius.len() - 1 };
        if is_free[end] { 0.0 } else { old.radius[at] }
    });
    joined.append(blended(&old, better, reaches));
    let after = line.points.len() - own.end;
    let last = joined.confidence[joined.confidence.len() - 1];
    joined.append(Centerline {
        points: line.points[own.end..].to_vec(),
        radius: line.radius[own.end..].to_vec(),
        confidence: vec![last; after],
    });
    Ok(joined.resampled(step))
}

/// Changes the ends of the better line gradually into those of the old one, over `reaches` mm.
fn blended(old: &Centerline, mut better: Centerline, reaches: [f64; 2]) -> Centerline {
    let [before, after] = [&old.points, &better.points].map(|points| arc_lengths(points));
    let [old_length, length] = [&before, &after].map(|lengths| lengths[lengths.len() - 1]);
    let last = better.points.len() - 1;
    for (end, reach) in reaches.into_iter().enumerate().filter(|(_, reach)| *reach > 0.0) {
        let reach = reach.min(length / 3.0).max(f64::MIN_POSITIVE);
        for n in 0..=last {
            let way = if end == 0 { after[n] } else { length - after[n] };
            let share = (1.0 - way / reach).max(0.0);
            let share = share * share * (3.0 - 2.0 * share);
            if share > 0.0 {
                let there = LinePlace::at(&before, if end == 0 { way } else { old_length - way });
                better.points[n] = better.points[n].lerp(there.point(&old.points), share);
                better.radius[n] += share * (there.value(&old.radius) - better.radius[n]);
            }
        }
        let [from, to] = if end == 0 { [0, 0] } else { [old.points.len() - 1, last] };
        better.points[to] = old.points[from];
    }
    better
}

fn own_points(points: &[DVec3], is_free: [bool; 2], lumen: &Lumen) -> Range<usize> {
    let radius: Vec<f64> = points.iter().map(|point| lumen.radius(*point)).collect();
    let lengths = arc_lengths(points);
    let first = if is_free[0] { 0 } else { leaves(&radius, &lengths) };
    if is_free[1] {
        return first..points.len();
    }
    let whole = lengths[lengths.len() - 1];
    let backwards = |values: &[f64], value: fn(f64, f64) -> f64| -> Vec<f64> {
        values.iter().rev().map(|known| value(whole, *known)).collect()
    };
    let last =
        leaves(&backwards(&radius, |_, radius| radius), &backwards(&lengths, |whole, way| whole - way));
    first..points.len().saturating_sub(last).max(first)
}

/// Index of the first point from which the line no longer narrows.
fn leaves(radius: &[f64], lengths: &[f64]) -> usize {
    let stays = |n: usize| {
        let end = lengths.partition_point(|length| *length <= lengths[n] + radius[n]);
        radius[n..end].iter().all(|next| *next >= (1.0 - NARROWER) * radius[n])
    };
    (0..radius.len()).find(|n| stays(*n)).unwrap_or(radius.len())
}
