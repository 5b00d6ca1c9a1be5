//! The path of a run (line of a vessel) along tracks and links. The centred line of the run must stay near it.

use glam::DVec3;

use crate::trace::find::whole_vessels::graph::WayPoint;
use crate::trace::lines::centerline::Centerline;
use crate::trace::lines::nearest_point;
use crate::trace::lines::smoothing::smoothed_by_gaussian;
use lumencut_core::math::arc_length::arc_lengths;

/// Maximum deviation from the path (mm, or radii if larger); maximum length relative to that of the path.
const STRAYED: f64 = 1.5;
const STRAYED_RADII: f64 = 0.5;
const ASTRAY: f64 = 1.25;

/// Standard deviation of the smoothing of the path, in radii.
const SMOOTHED: f64 = 0.4;

pub(crate) struct Way {
    pub points: Vec<WayPoint>,
    pub line: Centerline,
    /// Whether each point is on or near a link. Sections there may show several lumens.
    near_link: Vec<bool>,
}

impl Way {
    pub(crate) fn along(points: &[WayPoint]) -> Self {
        let mut points = points.to_vec();
        let mut near_link = near_links(&points);
        while let Some(n) = turn(&points, &near_link) {
            points.remove(n);
            near_link.remove(n);
        }
        let line = Centerline {
            points: points.iter().map(|point| point.place).collect(),
            radius: points.iter().map(|point| point.radius).collect(),
            confidence: vec![0.0; points.len()],
        };
        Self { points, line, near_link }
    }

    pub(crate) fn length(&self) -> f64 {
        length(&self.line.points)
    }

    /// Replaces the centred line by the path near links, and wherever the line strays from the path.
    pub(crate) fn guarded(&self, line: &Centerline) -> Centerline {
        let way = &self.line;
        let nearest: Vec<usize> =
            line.points.iter().map(|point| nearest_point(&way.points, *point)).collect();
        let strays = |n: &usize| {
            let known = nearest[*n];
            let far = STRAYED.max(STRAYED_RADII * way.radius[known]) + self.spacing(known);
            self.near_link[known] || line.points[*n].distance(way.points[known]) > far
        };
        let count = line.points.len();
        let mut made = Centerline { points: Vec::new(), radius: Vec::new(), confidence: Vec::new() };
        let mut sigma = Vec::new();
        let mut next = 0;
        while next < count {
            let strayed = (next..count).find(strays).unwrap_or(count);
            let back = (strayed..count).find(|n| !strays(n)).unwrap_or(count);
            made.append(piece(line, next, strayed));
            sigma.resize(made.points.len(), 0.0);
            if back > strayed {
                let from = strayed.checked_sub(1).map_or(0, |n| nearest[n] + 1);
                let to = if back < count { nearest[back] } else { way.points.len() };
                made.append(piece(way, from, to.max(from)));
                sigma.extend(way.radius[from..to.max(from)].iter().map(|radius| SMOOTHED * radius));
            }
            next = back;
        }
        if made.points.len() < 2 || length(&made.points) > ASTRAY * self.length() + STRAYED {
            return way.clone();
        }
        Centerline { points: smoothed_by_gaussian(&made.points, &sigma, false), ..made }
    }

    fn spacing(&self, n: usize) -> f64 {
        let points = &self.line.points;
        points[n.saturating_sub(1)].distance(points[(n + 1).min(points.len() - 1)]) / 2.0
    }
}

fn near_links(points: &[WayPoint]) -> Vec<bool> {
    let lengths = arc_lengths(&points.iter().map(|point| point.place).collect::<Vec<DVec3>>());
    let mut near = vec![false; points.len()];
    for n in (0..points.len()).filter(|n| points[*n].is_link) {
        // The points next to a link are track points with their own radii.
        let beside = [n.saturating_sub(1), (n + 1).min(points.len() - 1)];
        let reach = beside.map(|m| points[m].radius).into_iter().fold(0.0, f64::max);
        let first = lengths.partition_point(|length| *length < lengths[n] - reach);
        let end = lengths.partition_point(|length| *length <= lengths[n] + reach);
        near[first..end].fill(true);
    }
    near
}

fn turn(points: &[WayPoint], near_link: &[bool]) -> Option<usize> {
    let turns = |n: &usize| {
        let [before, here, after] = [n - 1, *n, n + 1].map(|m| points[m].place);
        near_link[*n] && (here - before).dot(after - here) < 0.0
    };
    (1..points.len().saturating_sub(1)).find(turns)
}

fn piece(line: &Centerline, first: usize, end: usize) -> Centerline {
    let range = first..end;
    Centerline {
        points: line.points[range.clone()].to_vec(),
        radius: line.radius[range.clone()].to_vec(),
        confidence: line.confidence[range].to_vec(),
    }
}

fn length(points: &[DVec3]) -> f64 {
    arc_lengths(points).last().copied().unwrap_or(0.0)
}
