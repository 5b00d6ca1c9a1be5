//! The outline of a basin as a smooth closed line.

use glam::DVec2;

use super::basins::Basins;
use super::plane_map::PlaneMap;
use crate::measure::section::rays::RAYS;

/// The staircase of the grid is smoothed by a Gaussian with this standard deviation (steps).
const SMOOTHING: f64 = 2.0;

/// Directions of a step along the outline, clockwise as seen in the image; the basin lies to the right.
const STEPS: [(isize, isize); 4] = [(1, 0), (0, 1), (-1, 0), (0, -1)];

/// A corner of an outline and the unit vector out of the basin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corner {
    pub at: DVec2,
    pub out: DVec2,
}

/// The outline of a basin, as [`RAYS`] corners at equal distances; empty without the basin.
pub(crate) fn outline(map: &PlaneMap, basins: &Basins, basin: u32) -> Vec<Corner> {
    let Some(first) = basins.of.iter().position(|of| *of == basin) else { return Vec::new() };
    let steps = staircase(first, map.count, |n| basins.of[n] == basin);
    let middle = map.place(0) - DVec2::splat(0.5 * map.step);
    let corners: Vec<DVec2> = steps.iter().map(|corner| middle + *corner * map.step).collect();
    with_normals(&evenly(&smooth(&corners)))
}

/// Corners of the pixels along the outline of a region, in pixels; `first` is its first pixel.
fn staircase(first: usize, count: usize, is_in: impl Fn(usize) -> bool) -> Vec<DVec2> {
    let inside = |x: isize, y: isize| {
        let within = |n: isize| n >= 0 && n < count as isize;
        within(x) && within(y) && is_in(y as usize * count + x as usize)
    };
    let start = ((first % count) as isize, (first / count) as isize);
    let (mut at, mut way) = (start, 0);
    let mut corners = Vec::new();
    loop {
        corners.push(DVec2::new(at.0 as f64, at.1 as f64));
        at = (at.0 + STEPS[way].0, at.1 + STEPS[way].1);
        let (right, left) = match way {
            0 => ((at.0, at.1), (at.0, at.1 - 1)),
            1 => ((at.0 - 1, at.1), (at.0, at.1)),
            2 => ((at.0 - 1, at.1 - 1), (at.0 - 1, at.1)),
            _ => ((at.0, at.1 - 1), (at.0 - 1, at.1 - 1)),
        };
        if !inside(right.0, right.1) {
            way = (way + 1) % 4;
        } else if inside(left.0, left.1) {
            way = (way + 3) % 4;
        }
        if at == start && way == 0 {
            return corners;
        }
    }
}

fn smooth(corners: &[DVec2]) -> Vec<DVec2> {
    let reach = (3.0 * SMOOTHING) as usize;
    let weight = |n: usize| (-0.5 * ((n as f64 - reach as f64) / SMOOTHING).powi(2)).exp();
    let all: f64 = (0..=2 * reach).map(weight).sum();
    let count = corners.len();
    let one = |n: usize| {
        let at = |m: usize| corners[(n + m + reach * count - reach) % count];
        (0..=2 * reach).map(|m| at(m) * weight(m)).sum::<DVec2>() / all
    };
    (0..count).map(one).collect()
}

/// [`RAYS`] points at equal distances along a closed line.
fn evenly(corners: &[DVec2]) -> Vec<DVec2> {
    let next = |n: usize| corners[(n + 1) % corners.len()];
    let mut lengths = vec![0.0];
    for n in 0..corners.len() {
        lengths.push(lengths[n] + corners[n].distance(next(n)));
    }
    let whole = lengths[corners.len()];
    let one = |ray: usize| {
        let at = whole * ray as f64 / RAYS as f64;
        let n = (lengths.partition_point(|length| *length <= at) - 1).min(corners.len() - 1);
        corners[n].lerp(next(n), (at - lengths[n]) / (lengths[n + 1] - lengths[n]).max(f64::EPSILON))
    };
    (0..RAYS).map(one).collect()
}

fn with_normals(points: &[DVec2]) -> Vec<Corner> {
    let one = |n: usize| {
        let along = points[(n + 1) % RAYS] - points[(n + RAYS - 1) % RAYS];
        Corner { at: points[n], out: DVec2::new(along.y, -along.x).normalize_or(DVec2::X) }
    };
    (0..points.len()).map(one).collect()
}
