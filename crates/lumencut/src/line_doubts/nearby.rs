//! Finds neighbours of a point by a tree of bounding boxes of the points of a line.

use glam::DVec3;

const MAX_LEAF_POINTS: usize = 8;

struct Node {
    low: DVec3,
    high: DVec3,
    from: usize,
    to: usize,
    /// Index of the second child box; the first child is the next box.
    second: Option<usize>,
}

pub(super) struct Nearby<'a> {
    points: &'a [DVec3],
    order: Vec<usize>,
    nodes: Vec<Node>,
}

impl<'a> Nearby<'a> {
    pub(super) fn new(points: &'a [DVec3]) -> Self {
        let mut nearby = Self { points, order: (0..points.len()).collect(), nodes: Vec::new() };
        if !points.is_empty() {
            nearby.divide(0, points.len());
        }
        nearby
    }

    fn divide(&mut self, from: usize, to: usize) {
        let points = self.points;
        let part = &mut self.order[from..to];
        let (low, high) = part
            .iter()
            .fold((DVec3::MAX, DVec3::MIN), |(low, high), n| (low.min(points[*n]), high.max(points[*n])));
        let number = self.nodes.len();
        self.nodes.push(Node { low, high, from, to, second: None });
        if to - from <= MAX_LEAF_POINTS {
            return;
        }
        let sides = (high - low).to_array();
        let axis = (0..3).fold(0, |widest, axis| if sides[axis] > sides[widest] { axis } else { widest });
        let middle = part.len() / 2;
        part.select_nth_unstable_by(middle, |a, b| points[*a][axis].total_cmp(&points[*b][axis]));
        self.divide(from, from + middle);
        self.nodes[number].second = Some(self.nodes.len());
        self.divide(from + middle, to);
    }

    /// Calls `visit` with each point at most `reach` away from a position, until `visit` returns false.
    pub(super) fn within(&self, place: DVec3, reach: f64, mut visit: impl FnMut(usize) -> bool) {
        let mut open: Vec<usize> = if self.nodes.is_empty() { Vec::new() } else { vec![0] };
        while let Some(number) = open.pop() {
            let node = &self.nodes[number];
            if node.distance(place) > reach {
                continue;
            }
            if let Some(second) = node.second {
                open.extend([second, number + 1]);
                continue;
            }
            for n in &self.order[node.from..node.to] {
                if self.points[*n].distance(place) <= reach && !visit(*n) {
                    return;
                }
            }
        }
    }

    pub(super) fn pieces_of_boxes(&self, piece: &[usize]) -> Vec<Option<usize>> {
        let mut found = vec![None; self.nodes.len()];
        for (number, node) in self.nodes.iter().enumerate().rev() {
            found[number] = match node.second {
                Some(second) => found[number + 1].filter(|one| found[second] == Some(*one)),
                None => {
                    let own = &self.order[node.from..node.to];
                    let first = piece[own[0]];
                    own.iter().all(|n| piece[*n] == first).then_some(first)
                }
            };
        }
        found
    }

    /// The nearest point to `n` that belongs to another component and is within `bound`, with its distance.
    pub(super) fn nearest_of_others(
        &self,
        n: usize,
        piece: &[usize],
        boxes: &[Option<usize>],
        bound: f64,
    ) -> Option<(f64, usize)> {
        let (place, own) = (self.points[n], piece[n]);
        let (mut best, mut found) = (bound, None);
        let mut open = vec![0];
        while let Some(number) = open.pop() {
            let node = &self.nodes[number];
            if boxes[number] == Some(own) || node.distance(place) > best {
                continue;
            }
            if let Some(second) = node.second {
                let halves = [number + 1, second];
                let is_first_nearer =
                    self.nodes[halves[0]].distance(place) <= self.nodes[halves[1]].distance(place);
                open.extend(if is_first_nearer { [halves[1], halves[0]] } else { halves });
                continue;
            }
            for other in self.order[node.from..node.to].iter().copied().filter(|m| piece[*m] != own) {
                let distance = self.points[other].distance(place);
                if distance == 0.0 {
                    // No point can be nearer. Stopping here avoids quadratic time among coincident points.
                    return Some((distance, other));
                }
                // Of equally near points, the lower index wins, so that the spanning tree made of these pairs has no cycle.
                if distance < best || (distance == best && found.is_none_or(|(_, before)| other < before)) {
                    (best, found) = (distance, Some((distance, other)));
                }
            }
        }
        found
    }
}

impl Node {
    fn distance(&self, place: DVec3) -> f64 {
        place.distance(place.clamp(self.low, self.high))
    }
}
