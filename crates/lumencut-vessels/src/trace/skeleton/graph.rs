//! The skeleton as a graph of branches that has as many cycles as the mask. Touching voxels are joined by edges.
//! Three voxels that touch each other enclose no hole. So the graph keeps a spanning forest, plus one edge for each
//! cycle that such triangles do not fill. Voxel cubes have the same topology as these triangles, because cubes that
//! touch in pairs share a point.

use std::collections::HashMap;

use crate::trace::skeleton::foreground::Foreground;

#[derive(Clone, Debug)]
pub(crate) struct Branch {
    pub nodes: [usize; 2],
    /// Cells of the branch from start to end, including both; at least two.
    pub cells: Vec<u32>,
}

pub(crate) struct Graph {
    pub nodes: Vec<u32>,
    /// Branches; None for those that were removed.
    pub branches: Vec<Option<Branch>>,
    /// Indices of the branches at each node; a branch with both ends there is listed twice.
    pub(crate) incident: Vec<Vec<usize>>,
}

impl Graph {
    /// Builds the graph of `skeleton`, the cells that [`crate::trace::skeleton::thinning::thin`] leaves.
    pub(crate) fn new(foreground: &Foreground, skeleton: &[u32]) -> Self {
        let mut cells = skeleton.to_vec();
        cells.sort_unstable();
        let links = links(foreground, &cells);
        let mut graph = Self { nodes: Vec::new(), branches: Vec::new(), incident: Vec::new() };
        let mut node_of = HashMap::new();
        let mut passed = vec![false; cells.len()];
        for place in 0..cells.len() {
            if links[place].len() != 2 {
                graph.branches_from(place, &cells, &links, &mut node_of, &mut passed);
            }
        }
        // The cells that remain form rings without a junction.
        for place in 0..cells.len() {
            if links[place].len() == 2 && !passed[place] {
                graph.branches_from(place, &cells, &links, &mut node_of, &mut passed);
            }
        }
        graph
    }

    fn branches_from(
        &mut self,
        start: usize,
        cells: &[u32],
        links: &[Vec<usize>],
        node_of: &mut HashMap<usize, usize>,
        passed: &mut [bool],
    ) {
        let first = self.node(start, cells, node_of);
        passed[start] = true;
        for &step in &links[start] {
            let (mut before, mut place) = (start, step);
            let mut line = vec![cells[start], cells[place]];
            while links[place].len() == 2 && place != start && !passed[place] {
                passed[place] = true;
                let next = if links[place][0] == before { links[place][1] } else { links[place][0] };
                (before, place) = (place, next);
                line.push(cells[place]);
            }
            // Skips lines that were followed from their other end, and adjacent nodes that are already joined.
            let walked = links[place].len() == 2 && place != start;
            if walked || (line.len() == 2 && place < start) {
                continue;
            }
            let last = self.node(place, cells, node_of);
            self.add(Branch { nodes: [first, last], cells: line });
        }
    }

    fn node(&mut self, place: usize, cells: &[u32], node_of: &mut HashMap<usize, usize>) -> usize {
        *node_of.entry(place).or_insert_with(|| {
            self.nodes.push(cells[place]);
            self.incident.push(Vec::new());
            self.nodes.len() - 1
        })
    }

    pub(crate) fn add(&mut self, branch: Branch) {
        for node in branch.nodes {
            self.incident[node].push(self.branches.len());
        }
        self.branches.push(Some(branch));
    }

    pub(crate) fn remove(&mut self, number: usize) -> Option<Branch> {
        let branch = self.branches[number].take()?;
        for node in branch.nodes {
            self.incident[node].retain(|&other| other != number);
        }
        Some(branch)
    }

    /// Merges the two branches at a node without other branches.
    pub(crate) fn join_at(&mut self, node: usize) {
        let [a, b] = self.incident[node][..] else { return };
        if a == b {
            return;
        }
        let (Some(mut a), Some(mut b)) = (self.remove(a), self.remove(b)) else { return };
        if a.nodes[1] != node {
            a.reverse();
        }
        if b.nodes[0] != node {
            b.reverse();
        }
        a.cells.extend_from_slice(&b.cells[1..]);
        self.add(Branch { nodes: [a.nodes[0], b.nodes[1]], cells: a.cells });
    }
}

impl Branch {
    pub(crate) fn reverse(&mut self) {
        self.nodes.reverse();
        self.cells.reverse();
    }
}

fn links(foreground: &Foreground, cells: &[u32]) -> Vec<Vec<usize>> {
    let edges = edges(foreground, cells);
    let mut parent: Vec<usize> = (0..cells.len()).collect();
    let mut links = vec![Vec::new(); cells.len()];
    let mut closing = Vec::new();
    for &[a, b] in &edges {
        let [from, to] = [root(&mut parent, a), root(&mut parent, b)];
        if from == to {
            closing.push([a, b]);
        } else {
            parent[from] = to;
            links[a].push(b);
            links[b].push(a);
        }
    }
    for [a, b] in around_holes(&edges, &closing, cells.len()) {
        links[a].push(b);
        links[b].push(a);
    }
    links
}

fn edges(foreground: &Foreground, cells: &[u32]) -> Vec<[usize; 2]> {
    let [_, j, k] = foreground.strides();
    // Only the second half of the 26 neighbours is visited, so that each pair is found once.
    let sides = foreground.world_from_index.matrix3;
    let mut edges = Vec::new();
    for step in 14..27_usize {
        let [di, dj, dk] = [step % 3, step / 3 % 3, step / 9].map(|n| n as isize - 1);
        let offset = di + dj * j as isize + dk * k as isize;
        let length = (sides * glam::DVec3::new(di as f64, dj as f64, dk as f64)).length();
        for (place, &cell) in cells.iter().enumerate() {
            if let Ok(other) = cells.binary_search(&((cell as isize + offset) as u32)) {
                edges.push((length, [place, other]));
            }
        }
    }
    edges.sort_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)));
    edges.into_iter().map(|(_, edge)| edge).collect()
}

/// One edge of `closing` per hole: the edges whose cycles are not sums of triangles.
fn around_holes(edges: &[[usize; 2]], closing: &[[usize; 2]], places: usize) -> Vec<[usize; 2]> {
    let number_of: HashMap<[usize; 2], usize> =
        closing.iter().enumerate().map(|(n, &edge)| (edge, n)).collect();
    let mut touching = vec![Vec::new(); places];
    for &[a, b] in edges {
        touching[a].push(b);
        touching[b].push(a);
    }
    // Gaussian elimination modulo 2.
    let mut triangles: HashMap<usize, Vec<usize>> = HashMap::new();
    for &[a, b] in closing {
        for &c in touching[a].iter().filter(|c| touching[b].contains(c)) {
            let bounds = [[a, b], [a.min(c), a.max(c)], [b.min(c), b.max(c)]];
            let mut row: Vec<usize> = bounds.iter().filter_map(|edge| number_of.get(edge).copied()).collect();
            row.sort_unstable_by(|one, other| other.cmp(one));
            while let Some(known) = row.first().and_then(|last| triangles.get(last)) {
                row = difference(&row, known);
            }
            if let Some(&last) = row.first() {
                triangles.insert(last, row);
            }
        }
    }
    let holes = (0..closing.len()).filter(|number| !triangles.contains_key(number));
    holes.map(|number| closing[number]).collect()
}

fn difference(one: &[usize], other: &[usize]) -> Vec<usize> {
    let mut all: Vec<usize> = one.iter().filter(|n| !other.contains(n)).copied().collect();
    all.extend(other.iter().filter(|n| !one.contains(n)));
    all.sort_unstable_by(|a, b| b.cmp(a));
    all
}

fn root(parent: &mut [usize], mut place: usize) -> usize {
    while parent[place] != place {
        parent[place] = parent[parent[place]];
        place = parent[place];
    }
    place
}
