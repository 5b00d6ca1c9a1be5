//! Direction and width of an edge, seen from one of its nodes.

use glam::DVec3;

use crate::trace::find::quantiles::median;
use crate::trace::find::whole_vessels::graph::Graph;

/// Distance from the node at which the direction is taken, in radii.
const SAMPLE_RADII: f64 = 2.0;

/// Maximum number of consecutive edges that are followed if the first ones are short.
const MOST_EDGES: usize = 4;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Outlook {
    pub direction: DVec3,
    pub radius: f64,
}

pub(crate) fn outlook(graph: &Graph, edge: usize, node: usize, radius: f64) -> Outlook {
    let place = graph.places[node];
    let (mut edge, mut node) = (edge, node);
    let mut radii = Vec::new();
    let mut seen = place;
    for _ in 0..MOST_EDGES {
        for point in graph.points_from(edge, node) {
            radii.push(point.radius);
            seen = point.place;
            // The larger radius decides, so that the direction of a narrow edge is not taken inside a wide lumen.
            if radii.len() > 2 && seen.distance(place) >= SAMPLE_RADII * radius.max(point.radius) {
                return outlook_of(place, seen, radii);
            }
        }
        node = graph.far(edge, node);
        // Beyond a junction, it is not known which edge continues this one.
        let Some(next) = only_other(graph, node, edge) else { break };
        edge = next;
    }
    outlook_of(place, seen, radii)
}

fn outlook_of(place: DVec3, seen: DVec3, mut radii: Vec<f64>) -> Outlook {
    Outlook { direction: (seen - place).normalize_or(DVec3::Z), radius: median(&mut radii).unwrap_or(0.0) }
}

fn only_other(graph: &Graph, node: usize, edge: usize) -> Option<usize> {
    let at_node = &graph.incident[node];
    at_node.iter().copied().find(|other| *other != edge).filter(|_| at_node.len() == 2)
}
