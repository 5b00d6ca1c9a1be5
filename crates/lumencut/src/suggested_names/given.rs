//! The names that rules give to stretches of lines.

use crate::suggested_names::graph::{Graph, Way};
use crate::vessel_names::{Side, offered_name};

/// A name for a part of a line.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedStretch {
    /// A name of [`crate::vessel_names::VESSEL_NAMES`], with a side where the vessel is paired.
    pub name: String,
    /// Where it starts and ends on the line (arc length, mm).
    pub range: [f64; 2],
}

/// The named stretches of each line.
#[derive(Default)]
pub(super) struct Given {
    /// Numbers of pieces with their stretches.
    stretches: Vec<(usize, NamedStretch)>,
}

impl Given {
    /// Names consecutive ways for at most `length` (mm). A part of a piece that has a name keeps it, and ends the new name there.
    pub(super) fn name(&mut self, graph: &Graph, ways: &[Way], name: &str, side: Option<Side>, length: f64) {
        self.name_between(graph, ways, &offered_name(name, side), [0.0, length]);
    }

    /// Gives a name to the part of consecutive ways between two lengths (mm).
    pub(super) fn name_between(&mut self, graph: &Graph, ways: &[Way], name: &str, [from, to]: [f64; 2]) {
        let mut at = 0.0;
        for way in ways {
            let [start, end] = graph.pieces[way.piece].range;
            let [first, last] = [from.max(at) - at, to.min(at + end - start) - at];
            let part =
                if way.is_backward { [end - last, end - first] } else { [start + first, start + last] };
            let range = self.free(*way, part);
            if range[0] < range[1] {
                self.stretches.push((way.piece, NamedStretch { name: name.to_owned(), range }));
            }
            at += end - start;
        }
    }

    /// The part of a range up to the first name on its way.
    fn free(&self, way: Way, [mut from, mut to]: [f64; 2]) -> [f64; 2] {
        for (_, NamedStretch { range, .. }) in self.stretches.iter().filter(|(piece, _)| *piece == way.piece)
        {
            if range[0] >= to || range[1] <= from {
                continue;
            }
            if way.is_backward {
                from = range[1];
            } else {
                to = range[0];
            }
        }
        [from, to]
    }

    /// The stretches of a line in order; neighbours with one name are one stretch.
    pub(super) fn of_line(&self, graph: &Graph, line: usize) -> Vec<NamedStretch> {
        let pieces = (0..graph.pieces.len()).filter(|piece| graph.pieces[*piece].line == line);
        let of_piece = |piece| self.stretches.iter().filter(move |(named, _)| *named == piece);
        let mut own: Vec<NamedStretch> = Vec::new();
        for (_, stretch) in pieces.flat_map(of_piece) {
            let place = own.partition_point(|before| before.range[0] < stretch.range[0]);
            own.insert(place, stretch.clone());
        }
        let mut joined: Vec<NamedStretch> = Vec::new();
        for stretch in own {
            match joined.last_mut() {
                Some(last) if last.name == stretch.name && stretch.range[0] - last.range[1] < 1e-6 => {
                    last.range[1] = stretch.range[1];
                }
                _ => joined.push(stretch),
            }
        }
        joined
    }
}
