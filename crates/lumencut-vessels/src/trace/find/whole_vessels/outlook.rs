//! Where an edge leads to from a node, and how wide it is.

use glam::DVec3;

use crate::trace::find::quantiles::median;
use crate::trace::find::whole_vessels::graph::Graph;

/// How far is looked along an edge, in radii of what comes before.
const AWAY: f64 = 2.0;

/// Through how many edges is looked where the first ones are short.
const MOST_EDGES: usize = 4;

/// Where something leads to, and how wide it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Outlook {
    /// Where it leads to (unit vector).
    pub direction: DVec3,
    /// Its radius (mm).
    pub radius: f64,
}

/// Where an edge leads to from a node of a run with some radius (mm).
pub(crate) fn outlook(graph: &Graph, edge: usize, node: usize, radius: f64) -> Outlook {
    let place = graph.places[node];
    let (mut edge, mut node) = (edge, node);
    let mut radii = Vec::new();
    let mut seen = place;
    for _ in 0..MOST_EDGES {
        for point in graph.points_from(edge, node) {
            radii.push(point.radius);
            seen = point.place;
            // A narrow edge is seen after less of it, but never before it has left the lumen.
            if radii.len() > 2 && seen.distance(place) >= AWAY * radius.max(point.radius) {
                return outlook_of(place, seen, radii);
            }
        }
        node = graph.far(edge, node);
        // Beyond a junction it is not known what goes on.
        let Some(next) = only_other(graph, node, edge) else { break };
        edge = next;
    }
    outlook_of(place, seen, radii)
}

fn outlook_of(place: DVec3, seen: DVec3, mut radii: Vec<f64>) -> Outlook {
    Outlook { direction: (seen - place).normalize_or(DVec3::Z), radius: median(&mut radii).unwrap_or(0.0) }
}

/// The other edge at a node where two meet.
fn only_other(graph: &Graph, node: usize, edge: usize) -> Option<usize> {
    let at_node = &graph.incident[node];
    at_node.iter().copied().find(|other| *other != edge).filter(|_| at_node.len() == 2)
}
