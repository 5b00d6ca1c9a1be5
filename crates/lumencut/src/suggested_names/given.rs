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
    /// Names consecutive ways for at most `length` (mm). A piece that has a name keeps it.
    pub(super) fn name(&mut self, graph: &Graph, ways: &[Way], name: &str, side: Option<Side>, length: f64) {
        let name = offered_name(name, side);
        let mut left = length;
        for way in ways {
            if left <= 0.0 || self.stretches.iter().any(|(piece, _)| *piece == way.piece) {
                continue;
            }
            let piece = &graph.pieces[way.piece];
            let [from, to] = piece.range;
            let long = left.min(to - from);
            let range = if way.is_backward { [to - long, to] } else { [from, from + long] };
            self.stretches.push((way.piece, NamedStretch { name: name.clone(), range }));
            left -= to - from;
        }
    }

    /// The stretches of a line in order; neighbours with one name are one stretch.
    pub(super) fn of_line(&self, graph: &Graph, line: usize) -> Vec<NamedStretch> {
        let pieces = (0..graph.pieces.len()).filter(|piece| graph.pieces[*piece].line == line);
        let of_piece = |piece| self.stretches.iter().find(|(named, _)| *named == piece);
        let own = pieces.filter_map(of_piece).map(|(_, stretch)| stretch.clone());
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
