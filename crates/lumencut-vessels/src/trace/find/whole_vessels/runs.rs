//! Whole runs of the graph: from the root outwards each goes on with the edge that is straightest and widest, and the others
//! begin runs of their own.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::DVec3;

use crate::trace::find::quantiles::median;
use crate::trace::find::whole_vessels::graph::{Graph, WayPoint};
use crate::trace::find::whole_vessels::outlook::{Outlook, outlook};
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

/// A run that is met from the side goes on to both sides: where its two edges are this straight (cosine) and both are so many
/// times as wide as what meets it.
const STRAIGHT: f64 = -0.8;
const WIDER: f64 = 1.5;

/// Edges are alike where what decides between them differs by no more.
const ROUNDING: f64 = 1e-9;

/// How many points say how wide an end is.
const LAST: usize = 5;

/// A whole run.
#[derive(Clone, Debug)]
pub(crate) struct Run {
    /// Its points, from the root outwards.
    pub points: Vec<WayPoint>,
    /// The nodes that it passes, and the number of its point at each.
    pub knots: Vec<(usize, usize)>,
}

/// The runs of a graph.
pub(crate) struct Runs {
    /// The runs: each after the one that it leaves, unless that is met from the side.
    pub runs: Vec<Run>,
    /// The run that passes each node.
    pub owners: Vec<usize>,
}

const NONE: usize = usize::MAX;

/// An edge that a run may begin with, the widest one first.
type Start = (u64, Reverse<usize>, usize);

/// All edges of a graph as runs; `roots` are the edge and the node that each part begins with.
///
/// # Errors
/// [`lumencut_core::error::ErrorKind::Interrupted`].
pub(crate) fn runs(graph: &Graph, roots: &[[usize; 2]], stop: Stop) -> Result<Runs> {
    let owners = vec![NONE; graph.places.len()];
    let made = Runs { runs: Vec::new(), owners };
    let mut search = Search { graph, made, used: vec![false; graph.edges.len()], open: BinaryHeap::new() };
    for &[edge, node] in roots {
        search.made.owners[node] = search.made.runs.len();
        search.run(edge, node);
        while let Some((_, Reverse(edge), node)) = search.open.pop() {
            go_on(stop)?;
            if !search.used[edge] {
                search.run(edge, node);
            }
        }
    }
    Ok(search.made)
}

struct Search<'a> {
    graph: &'a Graph,
    made: Runs,
    used: Vec<bool>,
    open: BinaryHeap<Start>,
}

impl Search<'_> {
    /// Makes a run that begins with an edge at a node, and one that it meets from the side.
    fn run(&mut self, edge: usize, node: usize) {
        let mut run = Run { points: Vec::new(), knots: Vec::new() };
        let number = self.made.runs.len();
        let met = self.grow(&mut run, number, edge, node);
        self.made.runs.push(run);
        if let Some((node, edges)) = met {
            self.run_through(node, edges);
        }
    }

    /// Makes a run that goes on from a node to both sides, from its wider end.
    fn run_through(&mut self, node: usize, edges: [usize; 2]) {
        let number = self.made.runs.len();
        self.made.owners[node] = number;
        let mut met = Vec::new();
        let [mut first, mut run] = [0, 1].map(|_| Run { points: Vec::new(), knots: Vec::new() });
        self.used[edges[1]] = true;
        met.extend(self.grow(&mut first, number, edges[0], node));
        self.used[edges[1]] = false;
        met.extend(self.grow(&mut run, number, edges[1], node));
        first.turn();
        let joint = first.points.len() - 1;
        first.points.extend_from_slice(&run.points[1..]);
        first.knots.extend(run.knots[1..].iter().map(|(node, point)| (*node, point + joint)));
        if first.is_wider_at_end() {
            first.turn();
        }
        let at_node = self.graph.incident[node].clone();
        self.made.runs.push(first);
        self.open_others(&at_node, node);
        for (node, edges) in met {
            if self.made.owners[node] == NONE {
                self.run_through(node, edges);
            }
        }
    }

    /// Lets a run go on as far as it does. What it meets from the side is told: the node and both edges there.
    fn grow(
        &mut self,
        run: &mut Run,
        number: usize,
        mut edge: usize,
        mut node: usize,
    ) -> Option<(usize, [usize; 2])> {
        loop {
            self.used[edge] = true;
            run.go_on(self.graph, edge, node);
            node = self.graph.far(edge, node);
            if self.made.owners[node] != NONE {
                return None;
            }
            let free: Vec<usize> =
                self.graph.incident[node].iter().copied().filter(|edge| !self.used[*edge]).collect();
            let before = run.look_back();
            let ahead: Vec<Outlook> =
                free.iter().map(|edge| outlook(self.graph, *edge, node, before.radius)).collect();
            if let Some([a, b]) = from_the_side(&before, &ahead) {
                return Some((node, [free[a], free[b]]));
            }
            self.made.owners[node] = number;
            let is_new = |n: &usize| self.made.owners[self.graph.far(free[*n], node)] != number;
            let next = straightest(&before, &ahead, is_new);
            let others: Vec<usize> = (0..free.len()).filter(|n| Some(*n) != next).map(|n| free[n]).collect();
            self.open_others(&others, node);
            edge = free[next?];
        }
    }

    /// Lets runs begin with edges at a node.
    fn open_others(&mut self, edges: &[usize], node: usize) {
        for &edge in edges.iter().filter(|edge| !self.used[**edge]) {
            let radius = outlook(self.graph, edge, node, 0.0).radius;
            // Radii are not negative: their bits are in their order.
            self.open.push((radius.to_bits(), Reverse(edge), node));
        }
    }
}

/// Which edge is straightest and widest, the first of several; none where none is new.
pub(crate) fn straightest(
    before: &Outlook,
    ahead: &[Outlook],
    is_new: impl Fn(&usize) -> bool,
) -> Option<usize> {
    let widest = ahead.iter().map(|edge| edge.radius).fold(0.0, f64::max).max(f64::MIN_POSITIVE);
    let mut best: Option<(f64, usize)> = None;
    for n in (0..ahead.len()).filter(is_new) {
        let score = ahead[n].direction.dot(before.direction) + ahead[n].radius / widest;
        if best.is_none_or(|(most, _)| score > most + ROUNDING) {
            best = Some((score, n));
        }
    }
    best.map(|(_, n)| n)
}

/// Both edges of a run that is met from the side, where one is.
fn from_the_side(before: &Outlook, ahead: &[Outlook]) -> Option<[usize; 2]> {
    let pairs = (1..ahead.len()).flat_map(|b| (0..b).map(move |a| [a, b]));
    let mut through = pairs.filter(|[a, b]| {
        ahead[*a].direction.dot(ahead[*b].direction) < STRAIGHT
            && ahead[*a].radius.min(ahead[*b].radius) > WIDER * before.radius
    });
    through.next()
}

/// The median radius of some points.
fn usual_radius(points: &[WayPoint]) -> f64 {
    median(&mut points.iter().map(|point| point.radius).collect::<Vec<_>>()).unwrap_or(0.0)
}

impl Run {
    /// Goes on with the points of an edge from a node on.
    fn go_on(&mut self, graph: &Graph, edge: usize, node: usize) {
        let points = graph.points_from(edge, node);
        if self.knots.is_empty() {
            self.knots.push((node, 0));
            self.points.push(points[0]);
        }
        // Where a link has no length both its ends are one point.
        let last = self.points[self.points.len() - 1].place;
        let skipped = points.iter().take_while(|point| point.place == last).count().max(1);
        self.points.extend_from_slice(&points[skipped.min(points.len())..]);
        self.knots.push((graph.far(edge, node), self.points.len() - 1));
    }

    /// Where the run leads to at its end, and how wide it is there.
    fn look_back(&self) -> Outlook {
        let last = self.points.len() - 1;
        let place = self.points[last].place;
        let radius = usual_radius(&self.points[last.saturating_sub(LAST - 1)..]);
        let is_away = |n: &usize| self.points[*n].place.distance(place) >= 2.0 * radius;
        let before = self.points[(0..last).rev().find(is_away).unwrap_or(0)].place;
        Outlook { direction: (place - before).normalize_or(DVec3::Z), radius }
    }

    fn is_wider_at_end(&self) -> bool {
        let count = self.points.len();
        let some = LAST.min(count);
        usual_radius(&self.points[count - some..]) > usual_radius(&self.points[..some])
    }

    fn turn(&mut self) {
        let last = self.points.len() - 1;
        self.points.reverse();
        self.knots.reverse();
        for (_, point) in &mut self.knots {
            *point = last - *point;
        }
    }
}
