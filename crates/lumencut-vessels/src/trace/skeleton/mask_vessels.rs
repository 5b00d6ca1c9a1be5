//! Orders the vessels of a mask, and directs them outwards.

use std::collections::{HashMap, VecDeque};

use glam::DVec3;

use lumencut_core::math::arc_length::arc_lengths;

/// A vessel of a mask.
#[derive(Clone, Debug)]
pub struct MaskVessel {
    /// Points (mm, LPS), at least two.
    pub points: Vec<DVec3>,
    /// Radius of each point (mm).
    pub radius: Vec<f64>,
    /// Confidence of each point, 0 to 1; empty if the vessel was not refined.
    pub confidence: Vec<f64>,
    /// Indices of the graph nodes at start and end.
    pub nodes: [usize; 2],
    /// Whether the first point, and the last point, is an end of the lumen.
    pub is_free: [bool; 2],
    /// The most frequent mask value along the vessel.
    pub label: i64,
    /// Whether the vessel bridges a gap.
    pub is_bridge: bool,
}

impl MaskVessel {
    fn reverse(&mut self) {
        self.points.reverse();
        self.radius.reverse();
        self.confidence.reverse();
        self.nodes.reverse();
        self.is_free.reverse();
    }

    /// Length of the vessel (mm).
    pub fn length(&self) -> f64 {
        arc_lengths(&self.points).last().copied().unwrap_or(0.0)
    }

    /// Mean radius of the points (mm).
    pub fn mean_radius(&self) -> f64 {
        self.radius.iter().sum::<f64>() / self.radius.len() as f64
    }
}

/// Orders and directs vessels: the longest component first, and outwards from the free end of its widest vessel.
pub(crate) fn outwards(vessels: Vec<MaskVessel>) -> Vec<MaskVessel> {
    let mut at_node: HashMap<usize, Vec<usize>> = HashMap::new();
    for (number, vessel) in vessels.iter().enumerate() {
        for node in vessel.nodes {
            at_node.entry(node).or_default().push(number);
        }
    }
    let mut by_width: Vec<usize> = (0..vessels.len()).collect();
    let is_inner = |number: usize| !vessels[number].is_free.contains(&true);
    by_width.sort_by(|&a, &b| {
        // The mean radii are rounded, so that rounding errors have no effect.
        let width = |number: usize| (vessels[number].mean_radius() * 1e6).round();
        is_inner(a).cmp(&is_inner(b)).then(width(b).total_cmp(&width(a)))
    });
    let mut waiting: Vec<Option<MaskVessel>> = vessels.into_iter().map(Some).collect();
    let mut pieces: Vec<Vec<MaskVessel>> = Vec::new();
    for root in by_width {
        let Some(vessel) = &waiting[root] else { continue };
        let end = usize::from(vessel.is_free[1] && !vessel.is_free[0]);
        let mut nodes = VecDeque::from([vessel.nodes[end]]);
        let mut piece = Vec::new();
        while let Some(node) = nodes.pop_front() {
            for &number in &at_node[&node] {
                let Some(mut vessel) = waiting[number].take() else { continue };
                if vessel.nodes[0] != node {
                    vessel.reverse();
                }
                nodes.push_back(vessel.nodes[1]);
                piece.push(vessel);
            }
        }
        pieces.push(piece);
    }
    let whole = |piece: &[MaskVessel]| (piece.iter().map(MaskVessel::length).sum::<f64>() * 1e6).round();
    pieces.sort_by(|a, b| whole(b).total_cmp(&whole(a)));
    pieces.into_iter().flatten().collect()
}
