//! Joins single segments, in any order and direction, to chains.

use std::collections::{HashSet, VecDeque};

use glam::DVec3;

use super::Path;
use super::ids::{Id, Incidence, id};

/// If most paths are single segments, joins segments at each point at which exactly two meet. Chains keep the
/// direction of their segments if all agree. Otherwise they run away from the open end that has the largest radius,
/// or is highest.
pub(super) fn join(points: &[DVec3], mut paths: Vec<Path>, notes: &mut Vec<String>) -> Vec<Path> {
    let is_segment = |path: &Path| path.nodes.len() == 2;
    let count = paths.iter().filter(|path| is_segment(path)).count();
    if count < 2 || count <= paths.len() / 2 {
        return paths;
    }
    let others: Vec<Path> = paths.extract_if(.., |path| !is_segment(path)).collect();
    let cloud = Cloud::new(points, paths);
    let mut chains = cloud.chains();
    if chains.len() < count {
        notes.push(format!("{count} single segments were joined to {} chain(s)", chains.len()));
        if !cloud.directed {
            chains = Orientation::new(points, chains).away_from_roots();
            let end = if cloud.has_radius() { "with the largest radius" } else { "that is highest" };
            notes.push(format!("the segments have no common direction: vessels start at the end {end}"));
        }
    }
    chains.extend(others);
    chains
}

struct Cloud {
    segments: Vec<Path>,
    at: Incidence,
    /// Whether a chain may continue through each point.
    open: Vec<bool>,
    /// Whether the directions of the segments agree.
    directed: bool,
}

impl Cloud {
    fn new(points: &[DVec3], segments: Vec<Path>) -> Self {
        let segments = distinct(segments);
        let at =
            Incidence::new(points.len(), segments.len(), |i| [segments[i].nodes[0], segments[i].nodes[1]]);
        let alike = |a: &Path, b: &Path| a.name == b.name && a.group == b.group;
        let is_open = |place: usize| match at.at(place) {
            [a, b] => alike(&segments[*a as usize], &segments[*b as usize]),
            _ => false,
        };
        let open: Vec<bool> = (0..points.len()).map(is_open).collect();
        let begins = |place: usize, i: Id| segments[i as usize].nodes[0] == id(place);
        let follows = |place: usize| begins(place, at.at(place)[0]) != begins(place, at.at(place)[1]);
        let directed = (0..points.len()).filter(|place| open[*place]).all(follows);
        Self { segments, at, open, directed }
    }

    fn has_radius(&self) -> bool {
        self.segments.iter().any(|segment| segment.radius.is_some())
    }

    fn next(&self, node: Id, segment: Id) -> Option<Id> {
        let at = self.at.at(node as usize);
        self.open[node as usize].then(|| if at[0] == segment { at[1] } else { at[0] })
    }

    fn other_end(&self, node: Id, segment: Id) -> Id {
        let nodes = &self.segments[segment as usize].nodes;
        if nodes[0] == node { nodes[1] } else { nodes[0] }
    }

    fn chains(&self) -> Vec<Path> {
        let mut done = vec![false; self.segments.len()];
        let mut out = Vec::new();
        for first in 0..self.segments.len() {
            if !done[first] {
                let (node, segment) = self.beginning(id(first));
                out.push(self.chain(node, segment, &mut done));
            }
        }
        out
    }

    /// The start of the chain that contains the segment `first`. A closed loop starts at `first` itself.
    fn beginning(&self, first: Id) -> (Id, Id) {
        let start = self.segments[first as usize].nodes[0];
        let (mut node, mut segment) = (start, first);
        while let Some(before) = self.next(node, segment) {
            if before == first {
                return (start, first);
            }
            node = self.other_end(node, before);
            segment = before;
        }
        (node, segment)
    }

    fn chain(&self, start: Id, first: Id, done: &mut [bool]) -> Path {
        let Path { group, name, .. } = &self.segments[first as usize];
        let mut path =
            Path { nodes: vec![start], radius: Some(Vec::new()), group: *group, name: name.clone() };
        let (mut node, mut next) = (start, Some(first));
        while let Some(i) = next.filter(|i| !done[*i as usize]) {
            done[i as usize] = true;
            let segment = &self.segments[i as usize];
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

fn distinct(mut segments: Vec<Path>) -> Vec<Path> {
    let mut known = HashSet::new();
    segments.retain(|path| {
        let [a, b] = [path.nodes[0], path.nodes[1]];
        known.insert([a.min(b), a.max(b)])
    });
    segments
}

struct Orientation<'a> {
    points: &'a [DVec3],
    chains: Vec<Option<Path>>,
    ends: Incidence,
}

impl<'a> Orientation<'a> {
    fn new(points: &'a [DVec3], chains: Vec<Path>) -> Self {
        let ends = |i: usize| [chains[i].nodes[0], chains[i].nodes[chains[i].nodes.len() - 1]];
        let ends = Incidence::new(points.len(), chains.len(), ends);
        Self { points, chains: chains.into_iter().map(Some).collect(), ends }
    }

    /// Sort key of the points at which chains may start: open ends first, then wide ones, then high ones.
    fn rank(&self, node: Id) -> [f64; 5] {
        let chains = self.ends.at(node as usize);
        let radius = chains.iter().filter_map(|i| self.chains[*i as usize].as_ref()).filter_map(|chain| {
            let radius = chain.radius.as_ref()?;
            if chain.nodes[0] == node { radius.first() } else { radius.last() }
        });
        let [x, y, z] = self.points[node as usize].to_array();
        [f64::from(u8::from(chains.len() == 1)), radius.copied().fold(0.0, f64::max), z, y, x]
    }

    fn away_from_roots(mut self) -> Vec<Path> {
        let ends = (0..self.points.len()).filter(|place| !self.ends.at(*place).is_empty()).map(id);
        let mut roots: Vec<([f64; 5], Id)> = ends.map(|node| (self.rank(node), node)).collect();
        roots.sort_by(|a, b| descending(&a.0, &b.0));
        let mut left = vec![true; self.points.len()];
        let mut out = Vec::new();
        for (_, root) in roots {
            let mut next = VecDeque::from([root]);
            while let Some(node) = next.pop_front() {
                if !std::mem::take(&mut left[node as usize]) {
                    continue;
                }
                let from = out.len();
                for i in self.ends.at(node as usize) {
                    out.extend(self.chains[*i as usize].take().map(|chain| begun_at(node, chain)));
                }
                let second = |chain: &Path| self.points[chain.nodes[1] as usize].to_array();
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

fn begun_at(node: Id, mut chain: Path) -> Path {
    if chain.nodes[0] != node {
        chain.nodes.reverse();
        chain.radius.iter_mut().for_each(|radius| radius.reverse());
    }
    chain
}
