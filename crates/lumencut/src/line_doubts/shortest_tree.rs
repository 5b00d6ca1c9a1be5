//! Computes the minimum spanning tree of points, and a short path through all of them.

use glam::DVec3;

use super::nearby::Nearby;

/// If no point has more than two edges, the tree is the shortest path through all points.
pub(super) struct ShortestTree {
    /// The two points of each edge, and the length of the edge.
    pub edges: Vec<(usize, usize, f64)>,
    neighbours: Vec<Vec<(usize, f64)>>,
}

impl ShortestTree {
    /// Borůvka's algorithm: each round connects every component by its shortest edge.
    pub(super) fn new(points: &[DVec3], nearby: &Nearby) -> Self {
        let mut heads: Vec<usize> = (0..points.len()).collect();
        let mut edges = Vec::with_capacity(points.len().saturating_sub(1));
        while edges.len() + 1 < points.len() {
            let piece: Vec<usize> = (0..points.len()).map(|n| head(&mut heads, n)).collect();
            let boxes = nearby.pieces_of_boxes(&piece);
            let mut best: Vec<Option<(f64, usize, usize)>> = vec![None; points.len()];
            for n in 0..points.len() {
                let bound = best[piece[n]].map_or(f64::INFINITY, |(length, ..)| length);
                if let Some((length, other)) = nearby.nearest_of_others(n, &piece, &boxes, bound) {
                    let edge = (length, n.min(other), n.max(other));
                    if best[piece[n]].is_none_or(|before| edge < before) {
                        best[piece[n]] = Some(edge);
                    }
                }
            }
            let before = edges.len();
            for (length, a, b) in best.into_iter().flatten() {
                let (first, second) = (head(&mut heads, a), head(&mut heads, b));
                if first != second {
                    heads[first] = second;
                    edges.push((a, b, length));
                }
            }
            // A point with NaN has no distance to other points, so no edge reaches it.
            if edges.len() == before {
                break;
            }
        }
        let mut neighbours = vec![Vec::new(); points.len()];
        for (a, b, length) in &edges {
            neighbours[*a].push((*b, *length));
            neighbours[*b].push((*a, *length));
        }
        Self { edges, neighbours }
    }

    pub(super) fn is_path(&self) -> bool {
        self.neighbours.iter().all(|edges| edges.len() <= 2)
    }

    /// The points along a short path: it follows the longest path in the tree, and visits short branches on the way.
    pub(super) fn path(&self) -> Vec<usize> {
        let start = self.farthest(self.farthest(0));
        let (order, before) = self.from(start);
        let mut reach = vec![0.0_f64; order.len()];
        for n in order.iter().rev() {
            for (next, length) in self.neighbours[*n].iter().filter(|(next, _)| before[*next] == Some(*n)) {
                reach[*n] = reach[*n].max(reach[*next] + length);
            }
        }
        let (mut path, mut open) = (Vec::with_capacity(order.len()), vec![start]);
        while let Some(n) = open.pop() {
            path.push(n);
            let behind = self.neighbours[n].iter().filter(|(next, _)| before[*next] == Some(n));
            let mut behind: Vec<(usize, f64)> = behind.copied().collect();
            behind.sort_by(|(a, to_a), (b, to_b)| (reach[*b] + to_b).total_cmp(&(reach[*a] + to_a)));
            open.extend(behind.into_iter().map(|(next, _)| next));
        }
        path
    }

    /// The component of each point after removing the edges longer than `longest`.
    pub(super) fn pieces(&self, longest: f64) -> Vec<usize> {
        let mut heads: Vec<usize> = (0..self.neighbours.len()).collect();
        for (a, b, _) in self.edges.iter().filter(|(.., length)| *length <= longest) {
            let (first, second) = (head(&mut heads, *a), head(&mut heads, *b));
            heads[first] = second;
        }
        (0..heads.len()).map(|n| head(&mut heads, n)).collect()
    }

    fn farthest(&self, start: usize) -> usize {
        let (order, before) = self.from(start);
        let mut along = vec![0.0_f64; order.len()];
        for n in &order {
            for (next, length) in self.neighbours[*n].iter().filter(|(next, _)| before[*next] == Some(*n)) {
                along[*next] = along[*n] + length;
            }
        }
        order.into_iter().fold(start, |far, n| if along[n] > along[far] { n } else { far })
    }

    fn from(&self, start: usize) -> (Vec<usize>, Vec<Option<usize>>) {
        let mut before = vec![None; self.neighbours.len()];
        let mut order = vec![start];
        let mut at = 0;
        while at < order.len() {
            let n = order[at];
            let own = before[n];
            for (next, _) in self.neighbours[n].iter().filter(|(next, _)| own != Some(*next)) {
                before[*next] = Some(n);
                order.push(*next);
            }
            at += 1;
        }
        (order, before)
    }
}

fn head(heads: &mut [usize], mut number: usize) -> usize {
    while heads[number] != number {
        heads[number] = heads[heads[number]];
        number = heads[number];
    }
    number
}
