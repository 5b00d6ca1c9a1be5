//! Thins the voxels of a lumen to centred vessels that meet in common points.

pub(crate) mod centering;
pub mod distance_transform;
pub mod foreground;
pub(crate) mod graph;
pub(crate) mod label_value;
pub(crate) mod mask_lumen;
pub mod mask_refinement;
pub mod mask_vessels;
mod nearest_background;
pub(crate) mod pruning;
pub(crate) mod runs;
pub(crate) mod simple_point;
pub(crate) mod thinning;
pub(crate) mod through_lines;

use glam::DVec3;
use rayon::prelude::*;

use crate::trace::lines::centerline::Centerline;
use crate::trace::lines::directions::chord_directions;
use crate::trace::lines::even_steps::curve_in_even_steps;
use crate::trace::skeleton::centering::{center, lead_to_cap};
use crate::trace::skeleton::distance_transform::squared_distances;
use crate::trace::skeleton::foreground::{Foreground, LUMEN};
use crate::trace::skeleton::graph::Graph;
use crate::trace::skeleton::mask_lumen::Lumen;
use crate::trace::skeleton::mask_refinement::{Refine, refined};
use crate::trace::skeleton::mask_vessels::{MaskVessel, outwards};
use crate::trace::skeleton::pruning::{merge_junctions, prune, remove_round_pieces};
use crate::trace::skeleton::runs::{fill_cavities, pieces};
use crate::trace::skeleton::thinning::thin;
use crate::trace::skeleton::through_lines::{ThroughLine, through_lines};
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::math::arc_length::{arc_lengths, point_at};
use lumencut_core::math::same_place::ALONG_LINE;
use lumencut_core::stop::{Stop, go_on};

/// Maximum number of cells, because cell indices have 32 bits.
const MOST_CELLS: usize = u32::MAX as usize;

/// Default minimum length of a branch, in radii of its parent.
pub const PARENT_RADII: f64 = 2.0;

pub(crate) struct Skeletonization<'a> {
    /// Minimum length of a branch, in radii of its parent.
    pub parent_radii: f64,
    /// Maximum distance between neighbouring points (mm).
    pub step: f64,
    /// Function that refines each vessel in a volume, if given.
    pub refine: Option<Refine<'a>>,
    /// Called often; returns whether to stop.
    pub stop: Stop<'a>,
    /// Called at the start of each step with the step's index in [`COSTS`].
    pub begin: &'a (dyn Fn(usize) + Sync),
}

/// Relative duration of each step per lumen voxel: cavities and components, distances, thinning, lines.
pub(crate) const COSTS: [usize; 4] = [2, 3, 6, 4];

pub(crate) struct Skeleton {
    /// Vessels. Those that meet share bit-identical end points. Empty if no part is longer than wide.
    pub vessels: Vec<MaskVessel>,
    /// Number of filled cavities, and of the voxels in them.
    pub filled: [usize; 2],
    /// Number of connected components of the lumen.
    pub pieces: usize,
    /// Number of lumen voxels, including those of filled cavities.
    pub voxels: usize,
}

/// If an end is moved, the shift fades out along the line over this many radii.
const JOINED: f64 = 1.5;

pub(crate) fn skeleton(mut foreground: Foreground, skeleton: &Skeletonization) -> Result<Skeleton> {
    let stop = skeleton.stop;
    if foreground.cells.len() > MOST_CELLS {
        let found = format!("{:?} voxels in the box around the lumen", foreground.size);
        return Err(Error::new(ErrorKind::Volume, "mask", found, format!("at most {MOST_CELLS} in all")));
    }
    let filled = fill_cavities(&mut foreground, stop)?;
    let pieces = pieces(&foreground, stop)?;
    (skeleton.begin)(1);
    let lumen_cells: Vec<u32> =
        (0..foreground.cells.len() as u32).filter(|&cell| foreground.cells[cell as usize] == LUMEN).collect();
    let squares = squared_distances(&foreground, &lumen_cells, stop)?;
    (skeleton.begin)(2);
    let thinned = thin(&mut foreground, &lumen_cells, &squares, stop)?;
    (skeleton.begin)(3);
    let lumen = Lumen::new(&foreground, &squares);
    let mut graph = Graph::new(&foreground, &thinned);
    prune(&mut graph, &lumen, skeleton.parent_radii);
    remove_round_pieces(&mut graph, &lumen);
    merge_junctions(&mut graph, &lumen);
    let vessels = outwards(vessels(&graph, &lumen, skeleton)?);
    Ok(Skeleton { vessels, filled, pieces, voxels: lumen_cells.len() })
}

fn vessels(graph: &Graph, lumen: &Lumen, skeleton: &Skeletonization) -> Result<Vec<MaskVessel>> {
    let mut lines = through_lines(graph, lumen);
    let passes = |line: &ThroughLine, n: usize| line.is_closed || (n > 0 && n + 1 < line.knots.len());
    let mut is_passed = vec![false; graph.nodes.len()];
    for line in &lines {
        for (n, knot) in line.knots.iter().enumerate() {
            is_passed[knot.node] |= passes(line, n);
        }
    }
    let on_other = |line: &ThroughLine| {
        [line.knots.first(), line.knots.last()].map(|knot| {
            let knot = knot.filter(|knot| !line.is_closed && is_passed[knot.node])?;
            Some(lumen.radius_at_cell(graph.nodes[knot.node]))
        })
    };
    lines.par_iter_mut().try_for_each(|line| center(line, lumen, on_other(line), skeleton.stop))?;
    let mut node_place: Vec<Option<DVec3>> = vec![None; graph.nodes.len()];
    for line in &lines {
        for (_, knot) in line.knots.iter().enumerate().filter(|(n, _)| passes(line, *n)) {
            node_place[knot.node].get_or_insert(line.points[knot.point]);
        }
    }
    let made: Vec<Vec<MaskVessel>> = lines
        .par_iter_mut()
        .map(|line| {
            go_on(skeleton.stop)?;
            attach(line, &node_place, on_other(line));
            split(line, graph, lumen, skeleton)
        })
        .collect::<Result<_>>()?;
    Ok(made.into_iter().flatten().collect())
}

/// Moves ends that lie on another line to where that line runs now; the shift fades out along the moved line.
fn attach(line: &mut ThroughLine, node_place: &[Option<DVec3>], on_other: [Option<f64>; 2]) {
    let ways = arc_lengths(&line.points);
    let whole = ways[ways.len() - 1];
    let last = line.points.len() - 1;
    for (end, radius) in on_other.into_iter().enumerate() {
        let knot = line.knots[if end == 0 { 0 } else { line.knots.len() - 1 }];
        let (Some(radius), Some(place)) = (radius, node_place[knot.node]) else { continue };
        let point = if end == 0 { 0 } else { last };
        let delta = place - line.points[point];
        bring_back(&mut line.points, &ways, end, delta, (JOINED * radius).min(whole / 2.0));
        line.points[point] = place;
        let next = line.knots[if end == 0 { 1 } else { line.knots.len() - 2 }].point;
        lead_in(&mut line.points, end, place, radius, next);
    }
    for knot in &line.knots {
        if let Some(place) = node_place[knot.node] {
            line.points[knot.point] = place;
        }
    }
}

/// Bends a line to `place`, starting where it is `radius` mm away, outside the other lumen.
fn lead_in(points: &mut [DVec3], end: usize, place: DVec3, radius: f64, next: usize) {
    let last = points.len() - 1;
    let from_end = |n: usize| if end == 0 { n } else { last - n };
    let most = if end == 0 { next } else { last - next };
    let Some(exit) = (1..most).find(|&n| points[from_end(n)].distance(place) >= radius) else { return };
    let outside = points[from_end((exit + 3).min(most))] - points[from_end(exit)];
    let direction = outside.normalize_or_zero();
    let from = points[from_end(exit)];
    // A quadratic Bézier curve that is tangent to the line where it leaves.
    let control = from - direction * (from.distance(place) / 2.0);
    for n in 1..exit {
        let t = n as f64 / exit as f64;
        points[from_end(n)] = place.lerp(control, t).lerp(control.lerp(from, t), t);
    }
}

fn split(
    line: &ThroughLine,
    graph: &Graph,
    lumen: &Lumen,
    skeleton: &Skeletonization,
) -> Result<Vec<MaskVessel>> {
    let mut made = Vec::new();
    for pair in line.knots.windows(2) {
        let mut points = line.points[pair[0].point..=pair[1].point].to_vec();
        let is_free = [pair[0], pair[1]].map(|knot| graph.incident[knot.node].len() == 1);
        let whole = arc_lengths(&points)[points.len() - 1];
        for end in 0..2 {
            if is_free[end] {
                lead_to_cap(&mut points, lumen, whole / 2.0);
            }
            points.reverse();
        }
        let points = curve_in_even_steps(&points, skeleton.step);
        let radius = radii(&points, is_free, lumen);
        let mut line = Centerline { points, radius, confidence: Vec::new() };
        if let Some(refine) = skeleton.refine {
            line = refined(line, is_free, lumen, refine, skeleton.step)?;
        }
        let Centerline { points, radius, confidence } = line;
        let nodes = [pair[0].node, pair[1].node];
        made.push(MaskVessel { points, radius, confidence, nodes, is_free, label: 0, is_bridge: false });
    }
    Ok(made)
}

fn bring_back(points: &mut [DVec3], ways: &[f64], end: usize, delta: DVec3, length: f64) {
    let whole = ways[ways.len() - 1];
    for (point, way) in points.iter_mut().zip(ways) {
        let way = if end == 0 { *way } else { whole - way };
        let share = (1.0 - way / length.max(1e-9)).max(0.0);
        *point += share * share * (3.0 - 2.0 * share) * delta;
    }
}

/// Radius at each point: that of a circle with the area of the section, at most half a voxel more than the
/// distance to the wall. Within a voxel of a cap the section degenerates, so the last good value is used.
fn radii(points: &[DVec3], is_free: [bool; 2], lumen: &Lumen) -> Vec<f64> {
    let side = lumen.side();
    let reach = vec![2.0 * side; points.len()];
    let along = chord_directions(points, &reach, false);
    let ways = arc_lengths(points);
    let whole = ways[ways.len() - 1];
    let measured = |way: f64| {
        let n = ways.partition_point(|known| *known < way - ALONG_LINE).min(points.len() - 1);
        let section = lumen.cross_section(point_at(points, &ways, way), along[n]);
        section.map_or(0.0, |section| section.radius.min(section.shortest + side / 2.0))
    };
    let [first, last] = is_free.map(|is_free| if is_free { side.min(whole / 2.0) } else { 0.0 });
    ways.iter().map(|way| measured(way.clamp(first, whole - last))).collect()
}
