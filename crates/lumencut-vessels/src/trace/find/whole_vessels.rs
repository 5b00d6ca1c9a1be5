//! Turns linked tracks into complete vessels, from the root outwards, in ranked parts. Tracks and links form a graph.
//! From each root, lines called runs follow the straightest and widest edges. The runs are then centred, and start
//! and end on points of the runs that they meet.

pub(crate) mod attached;
pub(crate) mod centered;
pub(crate) mod edge_ends;
pub(crate) mod graph;
pub(crate) mod rings;
pub(crate) mod roots;
pub(crate) mod run_path;
pub(crate) mod runs;
pub(crate) mod stubs;
pub(crate) mod sure_parts;
pub(crate) mod trimmed;

use rayon::prelude::*;

use crate::trace::find::found::FoundVessel;
use crate::trace::find::links::link::Link;
use crate::trace::find::progress::{Stage, Stages};
use crate::trace::find::scan::Scan;
use crate::trace::find::track::Track;
use crate::trace::find::whole_vessels::attached::{Attached, attached};
use crate::trace::find::whole_vessels::centered::{Centered, centered};
use crate::trace::find::whole_vessels::graph::Graph;
use crate::trace::find::whole_vessels::rings::closed;
use crate::trace::find::whole_vessels::roots::roots;
use crate::trace::find::whole_vessels::runs::runs;
use crate::trace::find::whole_vessels::stubs::without_stubs;
use crate::trace::find::whole_vessels::trimmed::trimmed;
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

pub(crate) fn of(
    scan: &Scan,
    tracks: &[Track],
    links: &[Link],
    smallest_radius: f64,
    (stop, stages): (Stop, Stages),
) -> Result<Vec<FoundVessel>> {
    let (tracks, links) = without_stubs(tracks, links, stop)?;
    let tracks = &tracks;
    let graph = Graph::new(tracks, &links);
    let roots = roots(scan, tracks, &graph, stop)?;
    let runs = runs(&graph, &roots, stop)?;
    let pieces = stages.stage(Stage::Vessels, runs.runs.len());
    let line = |number| {
        go_on(stop)?;
        let line = centered(scan, &runs, number, stop)?;
        pieces.done(1);
        Ok(line)
    };
    let lines: Vec<Centered> = (0..runs.runs.len()).into_par_iter().map(line).collect::<Result<_>>()?;
    let whole = trimmed(attached(&runs, &graph.places, &lines, stop)?, smallest_radius, stop)?;
    let whole: Vec<Option<Attached>> = whole.into_iter().map(|run| run.map(closed)).collect();
    let mut part_of_root = vec![0; graph.places.len()];
    let (of_node, count) = graph.parts();
    for (rank, [_, node]) in roots.iter().enumerate() {
        part_of_root[of_node[*node]] = rank;
    }
    let mut stays = vec![Vec::new(); count];
    for (run, line) in runs.runs.iter().zip(&whole) {
        let rank = part_of_root[of_node[run.knots[0].0]];
        stays[rank].extend(line.iter().map(|line| &line.points));
    }
    // Connected parts without vessels get no number.
    stays.retain(|lines| !lines.is_empty());
    let lines = stays.iter().enumerate().flat_map(|(part, lines)| lines.iter().map(move |line| (part, line)));
    Ok(lines.flat_map(|(part, line)| sure_parts::vessels(tracks, line, part)).collect())
}

#[cfg(test)]
#[path = "whole_vessels/tests/whole_vessels.rs"]
mod tests;
