//! Clouds of segments, each a line of its own in any order and direction, become the chains that they form.

use std::collections::{HashMap, HashSet, VecDeque};

use glam::DVec3;

use super::Path;

/// Where most paths are single segments: joins them at places where just two of them meet. Other paths
/// stay as they are; where one ends on a chain the graph cuts it. Notes what was done.
///
/// Chains go the way of their segments where those follow each other throughout. Otherwise they run away from
/// the open end with the largest radius, or the highest where no radius is known.
pub fn join(points: &[DVec3], paths: Vec<Path>, notes: &mut Vec<String>) -> Vec<Path> {
    let is_segment = |path: &Path| path.nodes.len() == 2;
    let count = paths.iter().filter(|path| is_segment(path)).count();
    if count < 2 || count <= paths.len() / 2 {
        return paths;
    }
    let (segments, others): (Vec<Path>, Vec<Path>) = paths.into_iter().partition(is_segment);
    let cloud = Cloud::new(points, segments);
    let mut chains = cloud.chains();
    if chains.len() < count {
        notes.push(format!("{count} single segments were joined to {} chain(s)", chains.len()));
        if !cloud.directed {
            chains = Orientation::new(points, chains).away_from_roots();
            let end = if cloud.has_radius() { "with the largest radius" } else { "that is highest" };
            notes.push(format!("the segments have no common direction: vessels run away from the end {end}"));
        }
    }
    chains.extend(others);
    chains
}

/// Segments by the places where they meet.
struct Cloud {
    segments: Vec<Path>,
    /// The segments that end at each place.
    at: Vec<Vec<usize>>,
    /// Whether chains pass each place.
    open: Vec<bool>,
    /// Whether the segments follow each other at all places that chains pass.
    directed: bool,
}

impl Cloud {
    fn new(points: &[DVec3], segments: Vec<Path>) -> Self {
        let mut known = HashSet::new();
        let is_new =
            |path: &Path| known.insert((path.nodes[0].min(path.nodes[1]), path.nodes[0].max(path.nodes[1])));
        let segments: Vec<Path> = segments.into_iter().filter(is_new).collect();
        let mut at = vec![Vec::new(); points.len()];
        for (i, segment) in segments.iter().enumerate() {
            segment.nodes.iter().for_each(|node| at[*node].push(i));
        }
        let alike = |a: &Path, b: &Path| a.name == b.name && a.group == b.group;
        let open: Vec<bool> =
            at.iter().map(|ids| ids.len() == 2 && alike(&segments[ids[0]], &segments[ids[1]])).collect();
        let begins = |node: usize, i: usize| segments[i].nodes[0] == node;
        let follows = |node: usize| begins(node, at[node][0]) != begins(node, at[node][1]);
        let directed = (0..at.len()).filter(|node| open[*node]).all(follows);
        Self { segments, at, open, directed }
    }

    fn has_radius(&self) -> bool {
        self.segments.iter().any(|segment| segment.radius.is_some())
    }

    /// The other segment at a place that chains pass.
    fn next(&self, node: usize, segment: usize) -> Option<usize> {
        let at = &self.at[node];
        self.open[node].then(|| if at[0] == segment { at[1] } else { at[0] })
    }

    fn other_end(&self, node: usize, segment: usize) -> usize {
        let nodes = &self.segments[segment].nodes;
        if nodes[0] == node { nodes[1] } else { nodes[0] }
    }

    /// Every segment in one chain, in the order in which they come in the file.
    fn chains(&self) -> Vec<Path> {
        let mut done = vec![false; self.segments.len()];
        let mut out = Vec::new();
        for first in 0..self.segments.len() {
            if !done[first] {
                let (node, segment) = self.beginning(first);
                out.push(self.chain(node, segment, &mut done));
            }
        }
        out
    }

    /// The place and segment where the chain through `first` begins; around a loop `first` itself.
    fn beginning(&self, first: usize) -> (usize, usize) {
        let (mut node, mut segment) = (self.segments[first].nodes[0], first);
        while let Some(before) = self.next(node, segment) {
            if before == first {
                return (self.segments[first].nodes[0], first);
            }
            node = self.other_end(node, before);
            segment = before;
        }
        (node, segment)
    }

    fn chain(&self, start: usize, first: usize, done: &mut [bool]) -> Path {
        let Path { group, name, .. } = &self.segments[first];
        let mut path =
            Path { nodes: vec![start], radius: Some(Vec::new()), group: *group, name: name.clone() };
        let (mut node, mut next) = (start, Some(first));
        while let Some(i) = next.filter(|i| !done[*i]) {
            done[i] = true;
            let segment = &self.segments[i];
            let side = usize::from(segment.nodes[0] != node);
            path.radius = path.radius.take().zip(segment.radius.as_ref()).map(|(mut known, ends)| {
                if known.is_empty() {
                    known.push(ends[side]);
                }
                known.push(ends[1 - side]);
                known
            });
            node = segment.nodes[1 - side];
            path.nodes.push(node);
            next = self.next(node, i);
        }
        path
    }
}

/// Gives chains without a direction one that does not depend on the order of the file.
struct Orientation<'a> {
    points: &'a [DVec3],
    chains: Vec<Option<Path>>,
    /// The chains that end at each place.
    ends: HashMap<usize, Vec<usize>>,
}

impl<'a> Orientation<'a> {
    fn new(points: &'a [DVec3], chains: Vec<Path>) -> Self {
        let mut ends: HashMap<usize, Vec<usize>> = HashMap::new();
        for (i, chain) in chains.iter().enumerate() {
            let nodes = [chain.nodes[0], chain.nodes[chain.nodes.len() - 1]];
            nodes.iter().for_each(|node| ends.entry(*node).or_default().push(i));
        }
        Self { points, chains: chains.into_iter().map(Some).collect(), ends }
    }

    /// Where a vessel is likelier to come from than from another place: an open end, wide, high.
    fn rank(&self, node: usize) -> [f64; 5] {
        let chains = &self.ends[&node];
        let radius = chains.iter().filter_map(|i| self.chains[*i].as_ref()).filter_map(|chain| {
            let radius = chain.radius.as_ref()?;
            if chain.nodes[0] == node { radius.first() } else { radius.last() }
        });
        let [x, y, z] = self.points[node].to_array();
        [f64::from(u8::from(chains.len() == 1)), radius.copied().fold(0.0, f64::max), z, y, x]
    }

    /// All chains, each directed away from the root of its tree, the trees with the widest roots first.
    fn away_from_roots(mut self) -> Vec<Path> {
        let mut roots: Vec<([f64; 5], usize)> =
            self.ends.keys().map(|node| (self.rank(*node), *node)).collect();
        roots.sort_by(|a, b| descending(&a.0, &b.0));
        let mut out = Vec::new();
        for (_, root) in roots {
            let mut next = VecDeque::from([root]);
            while let Some(node) = next.pop_front() {
                let from = out.len();
                for i in self.ends.remove(&node).unwrap_or_default() {
                    out.extend(self.chains[i].take().map(|chain| begun_at(node, chain)));
                }
                let second = |chain: &Path| self.points[chain.nodes[1]].to_array();
                out[from..].sort_by(|a, b| descending(&second(a), &second(b)));
                next.extend(out[from..].iter().filter_map(|chain: &Path| chain.nodes.last()));
            }
        }
        out
    }
}

fn descending(a: &[f64], b: &[f64]) -> std::cmp::Ordering {
    let pairs = a.iter().zip(b).map(|(a, b)| b.total_cmp(a));
    pairs.fold(std::cmp::Ordering::Equal, std::cmp::Ordering::then)
}

fn begun_at(node: usize, mut chain: Path) -> Path {
    if chain.nodes[0] != node {
        chain.nodes.reverse();
        chain.radius.iter_mut().for_each(|radius| radius.reverse());
    }
    chain
}
