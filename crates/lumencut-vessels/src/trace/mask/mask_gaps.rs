//! Finds the gaps between the components of a mask, and bridges them.

use std::collections::HashMap;

use glam::DVec3;

use crate::trace::skeleton::mask_vessels::MaskVessel;
use lumencut_core::error::Result;
use lumencut_core::math::arc_length::arc_lengths;
use lumencut_core::stop::{Stop, go_on};

/// A gap between two components.
#[derive(Clone, Debug)]
pub struct Gap {
    /// Width of the gap (mm).
    pub width: f64,
    /// Indices of the vessels on both sides.
    pub vessels: [usize; 2],
    /// Points of the centerlines on both sides (mm, LPS).
    pub points: [DVec3; 2],
    radii: [f64; 2],
    /// Whether the gap was bridged.
    pub is_bridged: bool,
}

/// The gaps of smallest total width that connect all components. Each leads from an end to another end or to a wall.
pub(crate) fn gaps(vessels: &[MaskVessel], stop: Stop) -> Result<Vec<Gap>> {
    let piece_of = piece_of(vessels);
    let mut narrowest: HashMap<[usize; 2], Gap> = HashMap::new();
    for (number, vessel) in vessels.iter().enumerate() {
        for from in starts(vessel) {
            go_on(stop)?;
            for (other, target) in vessels.iter().enumerate() {
                let pieces = [piece_of[number].min(piece_of[other]), piece_of[number].max(piece_of[other])];
                if pieces[0] != pieces[1] {
                    let gap = gap([number, other], vessel, from, target);
                    let known = narrowest.entry(pieces).or_insert_with(|| gap.clone());
                    if gap.width < known.width {
                        *known = gap;
                    }
                }
            }
        }
    }
    let mut all: Vec<([usize; 2], Gap)> = narrowest.into_iter().collect();
    all.sort_by(|(a, one), (b, other)| one.width.total_cmp(&other.width).then(a.cmp(b)));
    let mut parent: Vec<usize> = (0..vessels.len()).collect();
    let mut kept = Vec::new();
    for (pieces, gap) in all {
        let [a, b] = pieces.map(|piece| root(&mut parent, piece));
        if a != b {
            parent[a] = b;
            kept.push(gap);
        }
    }
    Ok(kept)
}

/// Bridges gaps up to `widest` mm by straight vessels, with points at most `step` mm apart.
pub(crate) fn bridge(vessels: &mut Vec<MaskVessel>, gaps: &mut [Gap], widest: f64, step: f64) {
    for gap in gaps.iter_mut().filter(|gap| gap.width <= widest) {
        let [from, to] = gap.points;
        let count = (from.distance(to) / step).ceil().max(1.0) as usize;
        let share = |n: usize| n as f64 / count as f64;
        let mut points: Vec<DVec3> = (0..count).map(|n| from.lerp(to, share(n))).collect();
        points.push(to);
        let radius = (0..=count).map(|n| gap.radii[0] + share(n) * (gap.radii[1] - gap.radii[0])).collect();
        let [label, other] = gap.vessels.map(|number| vessels[number].label);
        let label = if label == other { label } else { 0 };
        let nodes = [usize::MAX; 2];
        let confidence = vec![0.0; count + 1];
        let is_free = [false; 2];
        vessels.push(MaskVessel { points, radius, confidence, nodes, is_free, label, is_bridge: true });
        gap.is_bridged = true;
    }
}

fn starts(vessel: &MaskVessel) -> Vec<usize> {
    let last = vessel.points.len() - 1;
    if vessel.nodes[0] == vessel.nodes[1] {
        return (0..last).collect();
    }
    [0, last].into_iter().zip(vessel.is_free).filter_map(|(n, is_free)| is_free.then_some(n)).collect()
}

fn gap(numbers: [usize; 2], vessel: &MaskVessel, from: usize, target: &MaskVessel) -> Gap {
    let point = vessel.points[from];
    let start = to_wall(vessel)[from];
    let inside = to_wall(target);
    let width = |n: usize| (point.distance(target.points[n]) - start - inside[n]).max(0.0);
    // The width is rounded, so that of equally near points an end is preferred.
    let rank = |n: usize| ((width(n) * 1e6).round() as u64, inside[n] > 0.0);
    let nearest = (0..target.points.len()).min_by_key(|&n| rank(n)).unwrap_or(0);
    Gap {
        width: width(nearest),
        vessels: numbers,
        points: [point, target.points[nearest]],
        radii: [vessel.radius[from], target.radius[nearest]],
        is_bridged: false,
    }
}

fn piece_of(vessels: &[MaskVessel]) -> Vec<usize> {
    let mut parent: Vec<usize> = (0..vessels.len()).collect();
    let mut first_at: HashMap<[u64; 3], usize> = HashMap::new();
    for (number, vessel) in vessels.iter().enumerate() {
        for point in [vessel.points[0], vessel.points[vessel.points.len() - 1]] {
            let other = *first_at.entry(point.to_array().map(f64::to_bits)).or_insert(number);
            let [a, b] = [other, number].map(|number| root(&mut parent, number));
            parent[b] = a;
        }
    }
    (0..vessels.len()).map(|number| root(&mut parent, number)).collect()
}

fn root(parent: &mut [usize], mut place: usize) -> usize {
    while parent[place] != place {
        parent[place] = parent[parent[place]];
        place = parent[place];
    }
    place
}

/// Distance (mm) over which lumen extends beyond each point: to the wall, but not past a free end.
fn to_wall(vessel: &MaskVessel) -> Vec<f64> {
    let ways = arc_lengths(&vessel.points);
    let whole = ways[ways.len() - 1];
    let to_end = |way: f64| {
        let ends = [way, whole - way].into_iter().zip(vessel.is_free);
        ends.filter_map(|(way, is_free)| is_free.then_some(way)).fold(f64::INFINITY, f64::min)
    };
    ways.iter().zip(&vessel.radius).map(|(way, radius)| radius.min(to_end(*way))).collect()
}
