//! Splits vessels where they meet, and follows them from there.

use glam::DVec3;
use lumencut_core::math::arc_length::{arc_lengths, point_at};
use lumencut_core::math::same_place::VESSEL_END;
use lumencut_core::math::statistics::median;

use crate::parts::touching;

/// The radius of a vessel is the median over this length from its start (mm).
const RADIUS_OVER: f64 = 40.0;
/// The direction of a vessel is taken over this length (mm).
const DIRECTION_OVER: f64 = 10.0;
/// A vessel divides where a branch is at least this share as wide as the part behind it.
const DIVIDES: f64 = 0.55;
/// The share of the radius that counts in the choice of the continuation, whatever its direction.
const SIDEWAYS: f64 = 0.2;

/// A vessel: its points (mm, LPS) and the radius at each (mm).
pub(super) type Tube<'a> = (&'a [DVec3], &'a [f64]);

/// The part of a line between two places where lines meet, or its ends.
pub(super) struct Piece {
    pub line: usize,
    /// Where it starts and ends on the line (arc length, mm).
    pub range: [f64; 2],
    points: Vec<DVec3>,
    radius: Vec<f64>,
    nodes: [usize; 2],
}

/// A piece that is followed in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Way {
    pub piece: usize,
    pub(super) is_backward: bool,
}

/// All pieces, and where they meet.
pub(super) struct Graph {
    pub pieces: Vec<Piece>,
    /// The ways that leave each node.
    leaving: Vec<Vec<Way>>,
}

impl Graph {
    pub(super) fn of(tubes: &[Tube]) -> Self {
        let mut graph = Self { pieces: Vec::new(), leaving: Vec::new() };
        let mut places = Vec::new();
        for (line, cuts) in cuts(tubes).into_iter().enumerate() {
            let (points, radius) = tubes[line];
            let lengths = arc_lengths(points);
            for pair in cuts.windows(2) {
                let [from, to] = [pair[0], pair[1]];
                let nodes = [from, to].map(|place| graph.node(&mut places, points[place]));
                let piece = graph.pieces.len();
                graph.leaving[nodes[0]].push(Way { piece, is_backward: false });
                graph.leaving[nodes[1]].push(Way { piece, is_backward: true });
                graph.pieces.push(Piece {
                    line,
                    range: [lengths[from], lengths[to]],
                    points: points[from..=to].to_vec(),
                    radius: radius[from..=to].to_vec(),
                    nodes,
                });
            }
        }
        graph
    }

    fn node(&mut self, places: &mut Vec<DVec3>, place: DVec3) -> usize {
        let known = places.iter().position(|known| known.distance_squared(place) <= VESSEL_END * VESSEL_END);
        known.unwrap_or_else(|| {
            places.push(place);
            self.leaving.push(Vec::new());
            places.len() - 1
        })
    }

    /// All ways in both directions.
    pub(super) fn ways(&self) -> impl Iterator<Item = Way> + '_ {
        self.leaving.iter().flatten().copied()
    }

    /// The other ways that leave the place where `way` ends.
    pub(super) fn after(&self, way: Way) -> Vec<Way> {
        let node = self.pieces[way.piece].nodes[usize::from(!way.is_backward)];
        self.leaving[node].iter().copied().filter(|next| next.piece != way.piece).collect()
    }

    pub(super) fn reversed(way: Way) -> Way {
        Way { is_backward: !way.is_backward, ..way }
    }

    pub(super) fn length(&self, way: Way) -> f64 {
        let [from, to] = self.pieces[way.piece].range;
        to - from
    }

    /// The median radius over the first [`RADIUS_OVER`] of a way (mm).
    pub(super) fn radius(&self, way: Way) -> f64 {
        self.course(way, RADIUS_OVER).radius()
    }

    /// Follows a way, and at each place where vessels meet the widest and straightest one, for at least `length` (mm) if the vessel
    /// is that long.
    pub(super) fn course(&self, way: Way, length: f64) -> Course {
        let mut course = Course::default();
        let mut next = Some(way);
        while let Some(way) = next {
            course.add(self, way);
            let ahead = self.after(way).into_iter().filter(|way| !course.has(way.piece));
            next = (course.length() < length)
                .then(|| ahead.max_by(|a, b| self.rank(&course, *a).total_cmp(&self.rank(&course, *b))))
                .flatten();
        }
        course
    }

    /// The ways of a course up to the first place where the vessel divides in two of similar width.
    pub(super) fn undivided<'c>(&self, course: &'c Course) -> &'c [Way] {
        let divides = |pair: &[Way]| {
            let branches = self.after(pair[0]).into_iter().filter(|way| way.piece != pair[1].piece);
            branches.into_iter().any(|way| self.radius(way) >= DIVIDES * self.radius(pair[1]))
        };
        let end = course.ways.windows(2).position(divides).map_or(course.ways.len(), |place| place + 1);
        &course.ways[..end]
    }

    /// How well a way continues a course.
    fn rank(&self, course: &Course, way: Way) -> f64 {
        let mut ahead = Course::default();
        ahead.add(self, way);
        let start = (course.length() - DIRECTION_OVER).max(0.0);
        let before = (course.point(f64::INFINITY) - course.point(start)).normalize_or_zero();
        let after = (ahead.point(DIRECTION_OVER) - ahead.point(0.0)).normalize_or_zero();
        ahead.radius() * (SIDEWAYS + before.dot(after).max(0.0))
    }
}

/// Points along consecutive ways.
#[derive(Default)]
pub(super) struct Course {
    pub ways: Vec<Way>,
    points: Vec<DVec3>,
    radius: Vec<f64>,
    lengths: Vec<f64>,
}

impl Course {
    fn add(&mut self, graph: &Graph, way: Way) {
        let piece = &graph.pieces[way.piece];
        let (mut points, mut radius) = (piece.points.clone(), piece.radius.clone());
        if way.is_backward {
            points.reverse();
            radius.reverse();
        }
        let skipped = usize::from(!self.points.is_empty());
        self.points.extend(&points[skipped..]);
        self.radius.extend(&radius[skipped..]);
        self.lengths = arc_lengths(&self.points);
        self.ways.push(way);
    }

    pub(super) fn has(&self, piece: usize) -> bool {
        self.ways.iter().any(|way| way.piece == piece)
    }

    pub(super) fn length(&self) -> f64 {
        self.lengths.last().copied().unwrap_or_default()
    }

    /// The point after this length (mm), at most the last one.
    pub(super) fn point(&self, at: f64) -> DVec3 {
        point_at(&self.points, &self.lengths, at.min(self.length()))
    }

    /// From the first point to the one after this length (mm).
    pub(super) fn reach(&self, at: f64) -> DVec3 {
        self.point(at) - self.point(0.0)
    }

    /// The median radius over the first [`RADIUS_OVER`] (mm).
    pub(super) fn radius(&self) -> f64 {
        self.radius_between(0.0, RADIUS_OVER)
    }

    pub(super) fn radius_between(&self, from: f64, to: f64) -> f64 {
        let all = self.lengths.iter().zip(&self.radius);
        let mut inside: Vec<f64> =
            all.filter(|(at, _)| (from..=to).contains(*at)).map(|(_, radius)| *radius).collect();
        median(&mut inside).unwrap_or_default()
    }

    /// Where each way starts along the course (mm).
    pub(super) fn starts(&self, graph: &Graph) -> Vec<f64> {
        let lengths = self.ways.iter().scan(0.0, |at, way| {
            let start = *at;
            *at += graph.length(*way);
            Some(start)
        });
        lengths.collect()
    }
}

/// For each line, the numbers of the points at which it is cut.
fn cuts(tubes: &[Tube]) -> Vec<Vec<usize>> {
    let lines: Vec<&[DVec3]> = tubes.iter().map(|(points, _)| *points).collect();
    let mut cuts: Vec<Vec<usize>> = lines.iter().map(|line| vec![0, line.len() - 1]).collect();
    touching(&lines, |number, point, owner| {
        if number != owner {
            cuts[number].push(point);
        }
    });
    for cuts in &mut cuts {
        cuts.sort_unstable();
        cuts.dedup();
    }
    cuts
}
