//! If a line runs along another one without sharing its points, it takes over the points of the other line.

use std::cell::Cell;

use glam::DVec3;

use super::Path;
use super::ids::Id;

/// Maximum sideways distance from the other line, as a share of its radius.
const PART_OF_RADIUS: f64 = 0.1;
/// Maximum sideways distance between lines of one group, as a share of the radius.
const PART_OF_RADIUS_IN_GROUP: f64 = 0.5;
/// Maximum sideways distance if there is no radius, as a share of the median point spacing.
const PART_OF_SPACING: f64 = 0.5;
/// Upper limit of the distance without radius (mm); else sparse points could reach a neighbouring vessel.
const MOST_BY_SPACING: f64 = 0.5;
/// Minimum length of a shared stretch, as a multiple of the maximum sideways distance.
const SHORTEST_STRETCH: f64 = 10.0;
/// Maximum number of point-segment comparisons (about one second). With huge radii, all would be compared.
const MOST_COMPARISONS: usize = 1 << 26;

pub(super) struct Followed {
    /// Number of ends at which a path follows another one.
    pub ends: usize,
    /// Whether all comparisons were made within the limit.
    pub whole: bool,
}

pub(super) fn follow(points: &[DVec3], paths: &mut [Path], spacing: f64) -> Followed {
    let mut followed = 0;
    let left = Cell::new(MOST_COMPARISONS);
    // A path that follows another one loses its old end. A third path may begin there.
    let mut moved: Vec<(Id, Id)> = Vec::new();
    for i in 1..paths.len() {
        let (earlier, rest) = paths.split_at_mut(i);
        let path = &mut rest[0];
        for _ in 0..2 {
            if let Some(shared) = longest(points, path, earlier, spacing, &left) {
                moved.extend(shared.replace(path, earlier));
                followed += 1;
            }
            reverse(path);
        }
    }
    for path in paths {
        for (from, to) in &moved {
            path.nodes.iter_mut().filter(|node| *node == from).for_each(|node| *node = *to);
        }
        path.drop_repeats();
    }
    Followed { ends: followed, whole: left.get() > 0 }
}

struct Shared {
    other: usize,
    backwards: bool,
    last: usize,
    /// Last point on the other path, counted in the direction in which `path` follows it.
    other_last: usize,
    length: f64,
}

/// The longest stretch from the start of `path` along an `earlier` path. None if they share the first step,
/// because equal points are better evidence than distances.
fn longest(
    points: &[DVec3],
    path: &Path,
    earlier: &[Path],
    spacing: f64,
    left: &Cell<usize>,
) -> Option<Shared> {
    let count = path.nodes.len();
    if earlier.iter().any(|other| shares_end(other, &path.nodes[..2])) {
        return None;
    }
    let mut best: Option<Shared> = None;
    for (other, candidate) in earlier.iter().enumerate() {
        let unlike = candidate.radius.is_some() != path.radius.is_some();
        if unlike || shares_end(candidate, &path.nodes[count - 2..]) {
            continue;
        }
        for backwards in [false, true] {
            let walk = Walk { points, path, other: candidate, backwards, spacing, left };
            let found = walk.along().map(|(last, other_last, length)| Shared {
                other,
                backwards,
                last,
                other_last,
                length,
            });
            if found.as_ref().is_some_and(|new| best.as_ref().is_none_or(|old| new.length > old.length)) {
                best = found;
            }
        }
    }
    best
}

fn shares_end(other: &Path, step: &[Id]) -> bool {
    let is_step = |pair: &[Id]| pair == step || [pair[1], pair[0]] == step;
    is_step(&other.nodes[..2]) || is_step(&other.nodes[other.nodes.len() - 2..])
}

struct Walk<'a> {
    points: &'a [DVec3],
    path: &'a Path,
    other: &'a Path,
    backwards: bool,
    spacing: f64,
    left: &'a Cell<usize>,
}

impl Walk<'_> {
    fn other_index(&self, i: usize) -> usize {
        if self.backwards { self.other.nodes.len() - 1 - i } else { i }
    }

    fn other_point(&self, i: usize) -> DVec3 {
        self.points[self.other.nodes[self.other_index(i)] as usize]
    }

    /// Maximum sideways distance at point `i` (mm).
    fn tolerance(&self, i: usize, in_group: bool) -> f64 {
        let part = if in_group { PART_OF_RADIUS_IN_GROUP } else { PART_OF_RADIUS };
        let radius = self.other.radius.as_ref().map(|radius| radius[self.other_index(i)]);
        match radius.filter(|radius| *radius > 0.0) {
            Some(radius) => part * radius,
            None => (PART_OF_SPACING * self.spacing).min(MOST_BY_SPACING),
        }
    }

    /// How far this path follows the other one: the last point on each of them, and the length (mm).
    fn along(&self) -> Option<(usize, usize, f64)> {
        let in_group = self.path.group.is_some() && self.path.group == self.other.group;
        let first = self.points[self.path.nodes[0] as usize];
        if first.distance(self.other_point(0)) > self.tolerance(0, in_group) {
            return None;
        }
        let (mut at, mut last, mut length) = (0, 0, 0.0);
        let mut before = first;
        for (i, node) in self.path.nodes.iter().enumerate().skip(1) {
            let point = self.points[*node as usize];
            let step = point.distance(before);
            let (segment, distance) =
                self.nearest_segment(at, point, 2.0 * step + self.tolerance(at, in_group));
            if self.left.get() == 0 {
                return None;
            }
            if distance > self.tolerance(segment, in_group) {
                break;
            }
            (at, last, length, before) = (segment, i, length + step, point);
        }
        let shortest = SHORTEST_STRETCH * self.tolerance(0, false);
        // A path that follows the other one to its own last point takes the nearer end of the last segment; a path that
        // leaves earlier takes that segment's start.
        let whole = last + 1 == self.path.nodes.len();
        let nearer_end = whole && at + 1 < self.other.nodes.len() && {
            before.distance(self.other_point(at + 1)) < before.distance(self.other_point(at))
        };
        let other_last = if nearer_end { at + 1 } else { at };
        (last > 0 && other_last > 0 && length >= shortest).then_some((last, other_last, length))
    }

    /// The segment nearest to `point`, up to `reach` mm after segment `from`, and its distance.
    fn nearest_segment(&self, from: usize, point: DVec3, reach: f64) -> (usize, f64) {
        let mut best = (from, f64::INFINITY);
        let mut travelled = 0.0;
        for segment in from..self.other.nodes.len() - 1 {
            self.left.set(self.left.get().saturating_sub(1));
            let (a, b) = (self.other_point(segment), self.other_point(segment + 1));
            let edge = b - a;
            let t = ((point - a).dot(edge) / edge.length_squared()).clamp(0.0, 1.0);
            let distance = point.distance(a + edge * t);
            if distance < best.1 {
                best = (segment, distance);
            }
            travelled += edge.length();
            if travelled > reach {
                break;
            }
        }
        best
    }
}

impl Shared {
    /// Replaces points of `path` by points of the other path; returns the old and new ends.
    fn replace(self, path: &mut Path, earlier: &[Path]) -> Vec<(Id, Id)> {
        let other = &earlier[self.other];
        let count = other.nodes.len();
        let index = |i: usize| if self.backwards { count - 1 - i } else { i };
        let mut moved = vec![(path.nodes[0], other.nodes[index(0)])];
        if self.last + 1 == path.nodes.len() {
            moved.push((path.nodes[self.last], other.nodes[index(self.other_last)]));
        }
        let taken = (0..=self.other_last).map(index);
        path.nodes.splice(..=self.last, taken.clone().map(|i| other.nodes[i]));
        if let (Some(own), Some(radius)) = (&mut path.radius, &other.radius) {
            own.splice(..=self.last, taken.map(|i| radius[i]));
        }
        moved.retain(|(from, to)| from != to);
        moved
    }
}

fn reverse(path: &mut Path) {
    path.nodes.reverse();
    path.radius.iter_mut().for_each(|radius| radius.reverse());
}
