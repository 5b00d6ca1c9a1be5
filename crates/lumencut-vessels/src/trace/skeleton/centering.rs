//! Centres and smooths lines of voxels, and extends them to the end walls (caps) of the lumen.

use glam::DVec3;

use crate::trace::lines::directions::chord_directions;
use crate::trace::lines::smoothing::smoothed_by_gaussian;
use crate::trace::skeleton::mask_lumen::Lumen;
use crate::trace::skeleton::through_lines::ThroughLine;
use lumencut_core::error::Result;
use lumencut_core::math::arc_length::{arc_lengths, point_at};
use lumencut_core::math::same_place::ALONG_LINE;
use lumencut_core::stop::{Stop, go_on};

const ROUNDS: usize = 3;

/// Standard deviation of the smoothing: in radii, but at least some voxels.
const SMOOTHING: f64 = 0.5;
const SMOOTHING_VOXELS: f64 = 1.0;

/// Half-length of the chord that gives the direction: in radii, but at least some voxels.
const CHORD_RADII: f64 = 0.75;
const REACH_VOXELS: f64 = 1.5;

/// A move must keep this fraction of the distance to the wall, so that the line stays inside a crescent.
const LEAST_ROOM: f64 = 0.8;

/// For each end that lies on another line, the radius of that line; inside its lumen a branch has no own sections.
pub(crate) type OnOther = [Option<f64>; 2];

/// Centres a line in the lumen. Errors: [`lumencut_core::error::ErrorKind::Interrupted`] if stopped.
pub(crate) fn center(line: &mut ThroughLine, lumen: &Lumen, on_other: OnOther, stop: Stop) -> Result<()> {
    let closed = line.is_closed;
    let radii: Vec<f64> =
        line.points.iter().map(|point| lumen.radius(*point).max(lumen.side() / 2.0)).collect();
    let scaled = |share: f64, voxels: f64| -> Vec<f64> {
        radii.iter().map(|radius| (share * radius).max(voxels * lumen.side())).collect()
    };
    let sigma = scaled(SMOOTHING, SMOOTHING_VOXELS);
    let reach = scaled(CHORD_RADII, REACH_VOXELS);
    line.points = smoothed_by_gaussian(&line.points, &sigma, closed);
    for _ in 0..ROUNDS {
        go_on(stop)?;
        let along = chord_directions(&line.points, &reach, closed);
        let weights = weights(&line.points, on_other);
        let mut moved = line.points.clone();
        for (n, point) in moved.iter_mut().enumerate() {
            if weights[n] > 0.0 {
                *point += weights[n] * shift(lumen, *point, along[n]);
            }
        }
        if closed {
            let last = moved.len() - 1;
            moved[last] = moved[0];
        }
        line.points = smoothed_by_gaussian(&moved, &sigma, closed);
    }
    Ok(())
}

fn shift(lumen: &Lumen, point: DVec3, direction: DVec3) -> DVec3 {
    let Some(section) = lumen.cross_section(point, direction) else { return DVec3::ZERO };
    let whole = section.center - point;
    let room = LEAST_ROOM * lumen.radius(point);
    let shares = [1.0, 0.5, 0.25].into_iter();
    let fits = shares.map(|share| share * whole).find(|shift| lumen.radius(point + *shift) >= room);
    fits.unwrap_or(DVec3::ZERO)
}

/// Weight of the move of each point: 0 within the lumen of another line, 1 from 1.5 of that line's radii on.
fn weights(points: &[DVec3], on_other: OnOther) -> Vec<f64> {
    let ways = arc_lengths(points);
    let whole = ways[ways.len() - 1];
    let weight = |way: f64, radius: Option<f64>| {
        radius.map_or(1.0, |radius| (2.0 * (way / radius.max(1e-9) - 1.0)).clamp(0.0, 1.0))
    };
    ways.iter().map(|way| weight(*way, on_other[0]).min(weight(whole - *way, on_other[1]))).collect()
}

/// Distance (mm) from an end to the point that is as far from the end as from the wall, at most `limit`.
fn way_inwards(radius: impl Fn(f64) -> f64, step: f64, limit: f64) -> f64 {
    let (mut way, mut missing) = (0.0, radius(0.0));
    while missing > ALONG_LINE && way < limit {
        let next = radius(way + step) - (way + step);
        if next <= 0.0 {
            way += step * missing / (missing - next);
            break;
        }
        (way, missing) = (way + step, next);
    }
    way.min(limit)
}

/// Replaces the start of the line by a straight piece that ends at the wall. The piece begins where the line is one
/// radius away from its start; at most `most` mm are replaced.
pub(crate) fn lead_to_cap(points: &mut Vec<DVec3>, lumen: &Lumen, most: f64) {
    let ways = arc_lengths(points);
    let whole = ways[ways.len() - 1];
    let inner = |way: f64| lumen.radius(point_at(points, &ways, way));
    let cut = way_inwards(inner, lumen.side() / 2.0, most.min(whole / 2.0));
    let radius = inner(cut).max(lumen.side());
    let from = point_at(points, &ways, cut);
    let behind = point_at(points, &ways, (cut + 2.0 * radius).min(whole));
    let direction = (from - behind).normalize_or_zero();
    let way = lumen.way_to_wall(from, direction, 4.0 * radius + cut);
    let kept = if way + lumen.side() < cut || direction == DVec3::ZERO { 0.0 } else { cut };
    let (from, direction, way) = if kept > 0.0 {
        (from, direction, way)
    } else {
        // The end bends, so the line continues from its own last point.
        let behind = point_at(points, &ways, radius.min(whole));
        let direction = (points[0] - behind).normalize_or_zero();
        (points[0], direction, lumen.way_to_wall(points[0], direction, 4.0 * radius))
    };
    let removed = ways.iter().filter(|known| **known < kept - ALONG_LINE).count().max(1);
    let count = (way / lumen.side() - ALONG_LINE).ceil().max(1.0) as usize;
    let mut led: Vec<DVec3> =
        (0..=count).rev().map(|n| from + way * (n as f64 / count as f64) * direction).collect();
    let tail = points.split_off(removed);
    // Points near `from` are dropped, even if they coincide with it.
    let tail: Vec<DVec3> =
        tail.into_iter().skip_while(|point| point.distance(from) < lumen.side() / 2.0 - ALONG_LINE).collect();
    led.extend(tail.iter().copied());
    *points = led;
}
