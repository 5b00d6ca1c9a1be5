//! The order in which vessel pieces are laid out (grow) from the root of each connected part, and the cycles.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::DVec3;

use super::pieces::Piece;
use crate::error::{Error, ErrorKind, Result};

const RADIUS_MEAN_LENGTH_MM: f64 = 10.0;

const SAME_RADIUS_MM: f64 = 1e-6;

#[derive(Clone, Debug)]
pub(super) struct Part {
    /// The point from which the part grows (mm, LPS).
    pub root: DVec3,
    /// The pieces of the part, each after the one that it follows.
    pub order: Vec<usize>,
    /// The pieces that begin at the root.
    pub first: Vec<usize>,
}

#[derive(Clone, Debug)]
pub(super) struct Growth {
    /// The parts, ordered by the lowest index of their pieces.
    pub parts: Vec<Part>,
    /// Whether each piece grows from its last station to its first.
    pub is_reversed: Vec<bool>,
    pub children: Vec<Vec<usize>>,
    /// Each piece that closes a cycle, the piece that reached the closing junction first, and that one's end there (0 or 1).
    pub closures: Vec<(usize, usize, usize)>,
}

impl Growth {
    /// The part with the vessel end nearest to `root` grows from that end, other parts from the free end with
    /// the largest mean radius. Fails with [`ErrorKind::VesselTree`] if one of the others has no free end.
    pub(super) fn new(pieces: &[Piece], nodes: usize, root: Option<DVec3>) -> Result<Self> {
        let graph = Graph::new(pieces, nodes);
        let mut growth = Self {
            parts: Vec::new(),
            is_reversed: vec![false; pieces.len()],
            children: vec![Vec::new(); pieces.len()],
            closures: Vec::new(),
        };
        let named = root.map(|root| graph.nearest_end(root));
        let mut is_known = vec![false; pieces.len()];
        for piece in 0..pieces.len() {
            if is_known[piece] {
                continue;
            }
            let members = graph.reached_from(piece);
            members.iter().for_each(|member| is_known[*member] = true);
            let own = named.filter(|(piece, _)| members.binary_search(piece).is_ok());
            let root = match own {
                Some(root) => root,
                None => graph.widest_free_end(&members)?,
            };
            growth.grow(&graph, root);
        }
        Ok(growth)
    }

    fn grow(&mut self, graph: &Graph, (piece, end): (usize, usize)) {
        let pieces = graph.pieces;
        let root = pieces[piece].nodes[end];
        let point = if end == 0 { pieces[piece].points[0] } else { *last_of(&pieces[piece].points) };
        let mut part = Part { root: point, order: Vec::new(), first: Vec::new() };
        // The piece along which the search reached each junction; none for the root.
        let mut led: Vec<Option<Option<usize>>> = vec![None; graph.ends.len()];
        let mut is_used = vec![false; pieces.len()];
        let mut late = Vec::new();
        // Bits of non-negative floats sort like the floats.
        let mut waiting = BinaryHeap::from([Reverse((0.0f64.to_bits(), None, root))]);
        while let Some(Reverse((bits, by, node))) = waiting.pop() {
            if led[node].is_some() {
                continue;
            }
            led[node] = Some(by);
            if let Some(by) = by {
                is_used[by] = true;
                self.attach(&mut part, by, led[graph.pieces[by].nodes[self.start(by)]].flatten());
            }
            for &(piece, end) in &graph.ends[node] {
                let other = pieces[piece].nodes[1 - end];
                if led[other].is_none() {
                    // If another piece reaches the far end first, `close` sets the direction again.
                    let length = f64::from_bits(bits) + pieces[piece].length();
                    self.is_reversed[piece] = end == 1;
                    waiting.push(Reverse((length.to_bits(), Some(piece), other)));
                } else if !is_used[piece] {
                    late.push((piece, if other == node { 0 } else { 1 - end }));
                }
            }
        }
        for (piece, near) in late {
            if !std::mem::replace(&mut is_used[piece], true) {
                self.close(&mut part, pieces, piece, near, &led);
            }
        }
        self.parts.push(part);
    }

    /// The end of a piece (0 or 1) at which it begins to grow.
    fn start(&self, piece: usize) -> usize {
        usize::from(self.is_reversed[piece])
    }

    fn attach(&mut self, part: &mut Part, piece: usize, after: Option<usize>) {
        part.order.push(piece);
        match after {
            Some(before) => self.children[before].push(piece),
            None => part.first.push(piece),
        }
    }

    /// Adds a piece whose ends have both been reached; it grows from end `near` and stays free at the other.
    fn close(
        &mut self,
        part: &mut Part,
        pieces: &[Piece],
        piece: usize,
        near: usize,
        led: &[Option<Option<usize>>],
    ) {
        self.is_reversed[piece] = near == 1;
        self.attach(part, piece, led[pieces[piece].nodes[near]].flatten());
        let far = pieces[piece].nodes[1 - near];
        // The cycle closes at the end of the piece that was followed, or at the start of a piece at the root.
        let there = match led[far].flatten() {
            Some(by) => (by, 1 - self.start(by)),
            None => (part.first[0], self.start(part.first[0])),
        };
        self.closures.push((piece, there.0, there.1));
    }
}

struct Graph<'a> {
    pieces: &'a [Piece],
    /// The pieces that end at each junction, and by which end (0 or 1).
    ends: Vec<Vec<(usize, usize)>>,
}

impl<'a> Graph<'a> {
    fn new(pieces: &'a [Piece], nodes: usize) -> Self {
        let mut ends = vec![Vec::new(); nodes];
        for (n, piece) in pieces.iter().enumerate() {
            (0..2).for_each(|end| ends[piece.nodes[end]].push((n, end)));
        }
        Self { pieces, ends }
    }

    fn reached_from(&self, piece: usize) -> Vec<usize> {
        let mut is_found = vec![false; self.pieces.len()];
        let (mut found, mut waiting) = (Vec::new(), vec![piece]);
        while let Some(piece) = waiting.pop() {
            if !std::mem::replace(&mut is_found[piece], true) {
                found.push(piece);
                let nodes = self.pieces[piece].nodes.iter();
                waiting.extend(nodes.flat_map(|node| self.ends[*node].iter().map(|(other, _)| *other)));
            }
        }
        found.sort_unstable();
        found
    }

    fn nearest_end(&self, point: DVec3) -> (usize, usize) {
        let ends = self.pieces.iter().enumerate().flat_map(|(n, piece)| {
            [((n, 0), piece.points[0]), ((n, 1), *last_of(&piece.points))]
                .map(|(end, place)| (end, place.distance_squared(point)))
        });
        ends.fold(((0, 0), f64::INFINITY), |best, end| if end.1 < best.1 { end } else { best }).0
    }

    fn widest_free_end(&self, members: &[usize]) -> Result<(usize, usize)> {
        let mut widest: Option<((usize, usize), f64)> = None;
        for &piece in members {
            for end in 0..2 {
                let is_free = self.ends[self.pieces[piece].nodes[end]].len() == 1;
                let radius = self.pieces[piece].mean_radius(end, RADIUS_MEAN_LENGTH_MM);
                if is_free && widest.is_none_or(|(_, most)| radius > most + SAME_RADIUS_MM) {
                    widest = Some(((piece, end), radius));
                }
            }
        }
        widest.map(|(end, _)| end).ok_or_else(|| {
            let vessel = self.pieces[members[0]].vessel;
            let found = "a loop without a free end to start at";
            let expected = "a free end in every connected part";
            Error::new(ErrorKind::VesselTree, format!("vessel {vessel} of the tree"), found, expected)
                .mend("give a point to start at as the root, or leave out this vessel")
        })
    }
}

fn last_of<T>(values: &[T]) -> &T {
    &values[values.len() - 1]
}
