//! Divides the graph into runs, which follow the straightest and widest edges from the root outwards.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::DVec3;

use crate::trace::find::quantiles::median;
use crate::trace::find::whole_vessels::edge_ends::{Outlook, outlook};
use crate::trace::find::whole_vessels::graph::{Graph, WayPoint};
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

/// Limits for a node that a run meets from the side: there, two other edges form one vessel that passes through, and the
/// run ends, if the cosine between them is below `STRAIGHT` and both are `WIDER` times as wide as the run.
const STRAIGHT: f64 = -0.8;
const WIDER: f64 = 1.5;

/// Scores that differ by less than this count as equal.
const ROUNDING: f64 = 1e-9;

/// Number of points at an end from which its width is taken.
const LAST: usize = 5;

#[derive(Clone, Debug)]
pub(crate) struct Run {
    /// Points of the run, from the root outwards.
    pub points: Vec<WayPoint>,
    /// Nodes on the run, each with the index of its point.
    pub knots: Vec<(usize, usize)>,
}

pub(crate) struct Runs {
    /// Each run comes after the run on which it starts, except runs that another one met from the side.
    pub runs: Vec<Run>,
    /// Index of the run that passes each node.
    pub(crate) owners: Vec<usize>,
}

const NONE: usize = usize::MAX;

type Start = (u64, Reverse<usize>, usize);

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
    fn run(&mut self, edge: usize, node: usize) {
        let mut run = Run { points: Vec::new(), knots: Vec::new() };
        let number = self.made.runs.len();
        let met = self.grow(&mut run, number, edge, node);
        self.made.runs.push(run);
        if let Some((node, edges)) = met {
            self.run_through(node, edges);
        }
    }

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

    /// Extends a run. If it meets another run from the side, returns the node and the other run's edges.
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

    fn open_others(&mut self, edges: &[usize], node: usize) {
        for &edge in edges.iter().filter(|edge| !self.used[**edge]) {
            let radius = outlook(self.graph, edge, node, 0.0).radius;
            // The bits of non-negative floats have the same order as their values.
            self.open.push((radius.to_bits(), Reverse(edge), node));
        }
    }
}

/// Index of the straightest and widest new edge; of equal edges, the first.
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

fn from_the_side(before: &Outlook, ahead: &[Outlook]) -> Option<[usize; 2]> {
    let pairs = (1..ahead.len()).flat_map(|b| (0..b).map(move |a| [a, b]));
    let mut through = pairs.filter(|[a, b]| {
        ahead[*a].direction.dot(ahead[*b].direction) < STRAIGHT
            && ahead[*a].radius.min(ahead[*b].radius) > WIDER * before.radius
    });
    through.next()
}

fn usual_radius(points: &[WayPoint]) -> f64 {
    median(&mut points.iter().map(|point| point.radius).collect::<Vec<_>>()).unwrap_or(0.0)
}

impl Run {
    fn go_on(&mut self, graph: &Graph, edge: usize, node: usize) {
        let points = graph.points_from(edge, node);
        if self.knots.is_empty() {
            self.knots.push((node, 0));
            self.points.push(points[0]);
        }
        // A link of length 0 has only one point.
        let last = self.points[self.points.len() - 1].place;
        let skipped = points.iter().take_while(|point| point.place == last).count().max(1);
        self.points.extend_from_slice(&points[skipped.min(points.len())..]);
        self.knots.push((graph.far(edge, node), self.points.len() - 1));
    }

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
