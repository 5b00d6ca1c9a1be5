//! Reads SWC trees, in which each text line is a node: `id type x y z radius parent`.

use glam::DVec3;

use crate::centerlines::{Centerlines, Line};
use crate::error::{Error, Result, excerpt};
use crate::text::{self, Separator};

const COLUMNS: &str = "7 numbers: id type x y z radius parent";

/// One line from each root or branch point to the next branch point or leaf. Lines that meet have
/// bit-identical end points. Node types are ignored.
pub(crate) fn read(bytes: &[u8]) -> Result<Centerlines> {
    let nodes =
        text::data_lines(bytes).map(|(number, line)| node(number, &line)).collect::<Result<Vec<_>>>()?;
    if nodes.is_empty() {
        return Err(Error::new("", "no node", "an SWC file with a node per line"));
    }
    let tree = Tree::new(&nodes)?;
    // The file states the parents, so nothing is joined by position.
    let mut out = Centerlines { joined: true, ..Centerlines::of("SWC") };
    out.lines = tree.branches(&nodes)?;
    if let Some(scale) = unused_scale(bytes) {
        out.notes.push(format!("the comment {} was not applied", excerpt(&scale)));
    }
    out.without_zero_radii().tidy()
}

/// The factor in a leading comment `SCALE`, if not 1. Programs disagree whether coordinates include it.
fn unused_scale(bytes: &[u8]) -> Option<String> {
    let comments = text::lines(bytes).map_while(|(_, line)| Some(line.strip_prefix('#')?.trim().to_owned()));
    let is_one = |word: &str| word.parse() == Ok(1.0);
    comments.into_iter().find(|comment| {
        let mut words = comment.split_ascii_whitespace();
        words.next() == Some("SCALE") && !words.all(is_one)
    })
}

pub(crate) fn is_node(line: &str) -> bool {
    let fields = text::fields(line, Separator::Blanks);
    fields.len() == 7 && whole(0, fields[1]).is_ok() && node(0, line).is_ok()
}

struct Node {
    line: usize,
    id: i64,
    point: DVec3,
    radius: f64,
    parent: Option<i64>,
}

fn node(line: usize, content: &str) -> Result<Node> {
    let fields = text::fields(content, Separator::Blanks);
    let [id, _, x, y, z, radius, parent, ..] = fields[..] else {
        return Err(Error::new(format!("line {line}"), excerpt(content), COLUMNS));
    };
    let parent = Some(whole(line, parent)?).filter(|parent| *parent != -1);
    let id = whole(line, id)?;
    Ok(Node { line, id, point: text::point(line, [x, y, z])?, radius: text::number(line, radius)?, parent })
}

/// Reads an integer; some programs write 1 as `1.0`.
fn whole(line: usize, field: &str) -> Result<i64> {
    let of_float = || {
        let number = field.parse::<f64>().ok()?;
        (number.fract() == 0.0 && number.abs() < 1e15).then_some(number as i64)
    };
    field
        .parse()
        .ok()
        .or_else(of_float)
        .ok_or_else(|| Error::new(format!("line {line}"), excerpt(field), "a whole number as id or parent"))
}

struct Tree {
    roots: Vec<usize>,
    children: Vec<usize>,
    /// Index of the first child of each node; at the end, the number of all children.
    begins: Vec<usize>,
}

impl Tree {
    fn new(nodes: &[Node]) -> Result<Self> {
        // Nodes are sorted by id, which is usually their order in the file.
        let mut order: Vec<(i64, usize)> = nodes.iter().enumerate().map(|(i, node)| (node.id, i)).collect();
        order.sort_unstable();
        if let Some(pair) = order.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            let [first, again] = [pair[0].1, pair[1].1].map(|i| nodes[i].line);
            let found = format!("the id {} again, first used in line {first}", pair[0].0);
            return Err(Error::new(format!("line {again}"), found, "unique ids"));
        }
        let index = |id: i64| order.binary_search_by_key(&id, |(id, _)| *id).ok().map(|at| order[at].1);
        let parent = |node: &Node| match node.parent {
            None => Ok(None),
            Some(id) => index(id).map(Some).ok_or_else(|| {
                let found = format!("the parent {id}, which is not a node of the file");
                let expected = "the id of a node, or -1 for a root";
                let error = Error::truncated(format!("line {}", node.line), found, expected);
                if id == 0 { error.mend("write -1 as the parent of roots") } else { error }
            }),
        };
        let parents = nodes.iter().map(parent).collect::<Result<Vec<Option<usize>>>>()?;
        Ok(Self::of_parents(&parents))
    }

    fn of_parents(parents: &[Option<usize>]) -> Self {
        let mut begins = vec![0; parents.len() + 1];
        parents.iter().flatten().for_each(|parent| begins[parent + 1] += 1);
        for i in 0..parents.len() {
            begins[i + 1] += begins[i];
        }
        let mut next = begins.clone();
        let mut children = vec![0; begins[parents.len()]];
        let mut roots = Vec::new();
        for (i, parent) in parents.iter().enumerate() {
            match parent {
                None => roots.push(i),
                Some(parent) => {
                    children[next[*parent]] = i;
                    next[*parent] += 1;
                }
            }
        }
        Self { roots, children, begins }
    }

    fn children(&self, node: usize) -> &[usize] {
        &self.children[self.begins[node]..self.begins[node + 1]]
    }

    fn branches(&self, nodes: &[Node]) -> Result<Vec<Line>> {
        let mut lines = Vec::new();
        let mut reached = vec![false; nodes.len()];
        for root in &self.roots {
            reached[*root] = true;
            if self.children(*root).is_empty() {
                lines.push(line(nodes, &[*root]));
            }
            let mut starts: Vec<[usize; 2]> =
                self.children(*root).iter().rev().map(|child| [*root, *child]).collect();
            while let Some([start, child]) = starts.pop() {
                let mut ids = vec![start, child];
                let mut end = child;
                while let [only] = self.children(end) {
                    end = *only;
                    ids.push(end);
                }
                ids[1..].iter().for_each(|i| reached[*i] = true);
                starts.extend(self.children(end).iter().rev().map(|child| [end, *child]));
                lines.push(line(nodes, &ids));
            }
        }
        match reached.iter().position(|reached| !reached) {
            None => Ok(lines),
            Some(i) => {
                let found = format!("the node {}, whose parents form a cycle", nodes[i].id);
                let expected = "parents that lead to a root (parent -1)";
                Err(Error::new(format!("line {}", nodes[i].line), found, expected))
            }
        }
    }
}

fn line(nodes: &[Node], ids: &[usize]) -> Line {
    Line {
        points: ids.iter().map(|i| nodes[*i].point).collect(),
        radius: Some(ids.iter().map(|i| nodes[*i].radius).collect()),
        ..Line::default()
    }
}
