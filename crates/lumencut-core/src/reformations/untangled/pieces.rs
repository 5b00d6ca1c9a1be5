//! Vessels cut at the points where they meet; each piece has stations that are dense enough for an image.

use glam::DVec3;

use crate::error::{Error, ErrorKind, Result};
use crate::math::arc_length::LinePlace;
use crate::math::same_place::VESSEL_END;
use crate::reformations::connections::Ends;
use crate::vessel_tree::{Vessel, VesselTree};

const MAX_STATION_DISTANCE_MM: f64 = 0.5;

const MIN_STEPS: f64 = 4.0;

/// A vessel point nearer to the last station than this share of a step becomes no station.
const MIN_STEP_SHARE: f64 = 0.1;

/// A part of a vessel between two points where vessels meet or end. Stations follow the vessel's own order.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub vessel: usize,
    /// The junctions at the first and the last station.
    pub nodes: [usize; 2],
    /// The stations (mm, LPS).
    pub points: Vec<DVec3>,
    /// Arc length of each station (mm).
    pub at: Vec<f64>,
    pub radius: Vec<f64>,
}

impl Piece {
    pub(super) fn length(&self) -> f64 {
        self.at[self.at.len() - 1] - self.at[0]
    }

    /// The mean radius over the first `reach` mm from one of its ends (0 or 1).
    pub(super) fn mean_radius(&self, end: usize, reach: f64) -> f64 {
        let reach = reach.min(self.length());
        let (mut sum, mut walked) = (0.0, 0.0);
        for n in 0..self.at.len() - 1 {
            let segment = if end == 0 { n } else { self.at.len() - 2 - n };
            let step = (self.at[segment + 1] - self.at[segment]).min(reach - walked);
            sum += step * f64::midpoint(self.radius[segment], self.radius[segment + 1]);
            walked += step;
            if walked >= reach {
                break;
            }
        }
        sum / walked
    }
}

/// All pieces, in the order of the vessels and along each vessel, and the number of junctions.
pub(super) fn pieces_of(tree: &VesselTree, unknown_radius: f64) -> Result<(Vec<Piece>, usize)> {
    let first_and_last = |vessel: &Vessel| [vessel.points()[0], vessel.points()[vessel.points().len() - 1]];
    let ends = Ends::of(tree.vessels().iter().flat_map(first_and_last));
    let mut pieces = Vec::new();
    for (id, vessel) in tree.vessels().iter().enumerate() {
        let cuts = cuts(vessel, &ends);
        if cuts.len() < 2 {
            let found = "all points within 0.001 mm of each other";
            let subject = format!("vessel {id} of the tree");
            let error = Error::new(ErrorKind::VesselTree, subject, found, "a vessel with a length");
            return Err(error.mend("leave this vessel out"));
        }
        for cut in cuts.windows(2) {
            let nodes = [cut[0].1, cut[1].1];
            pieces.push(Stations { vessel, unknown_radius }.piece(id, nodes, cut[0].0, cut[1].0));
        }
    }
    Ok((pieces, ends.count as usize))
}

/// The points where a vessel is cut, ends included, and their junctions; no two are at the same arc length.
fn cuts(vessel: &Vessel, ends: &Ends) -> Vec<(usize, usize)> {
    let (points, at) = (vessel.points(), vessel.arc_length());
    let last = points.len() - 1;
    let mut cuts: Vec<(usize, usize)> = Vec::new();
    for (i, point) in points.iter().enumerate() {
        let Some(node) = ends.at(*point) else { continue };
        // Points within one junction make a single cut; the vessel's last point makes the last cut.
        let is_same = |&(n, _): &(usize, usize)| at[i] - at[n] <= 2.0 * VESSEL_END;
        match cuts.last() {
            Some(cut) if is_same(cut) && i == last && cuts.len() > 1 => {
                cuts.pop();
                cuts.push((i, node as usize));
            }
            Some(cut) if is_same(cut) => {}
            _ => cuts.push((i, node as usize)),
        }
    }
    cuts
}

struct Stations<'a> {
    vessel: &'a Vessel,
    unknown_radius: f64,
}

impl Stations<'_> {
    fn piece(&self, id: usize, nodes: [usize; 2], first: usize, last: usize) -> Piece {
        let along = self.vessel.arc_length();
        let step = MAX_STATION_DISTANCE_MM.min((along[last] - along[first]) / MIN_STEPS);
        let mut at = vec![along[first]];
        let mut previous = along[first];
        for (i, place) in along.iter().enumerate().take(last + 1).skip(first + 1) {
            let is_apart = |other: f64| (place - other).abs() >= MIN_STEP_SHARE * step;
            if i == last || (is_apart(previous) && is_apart(along[last])) {
                let parts = ((place - previous) / step).ceil().max(1.0);
                let between = (1..parts as usize).map(|n| previous + (place - previous) * (n as f64 / parts));
                at.extend(between);
                at.push(*place);
                previous = *place;
            }
        }
        let places: Vec<_> = at.iter().map(|at| LinePlace::at(along, *at)).collect();
        let mut points: Vec<_> = places.iter().map(|place| place.point(self.vessel.points())).collect();
        // The first and last station are the vessel's own points, without rounding.
        points[0] = self.vessel.points()[first];
        let end = points.len() - 1;
        points[end] = self.vessel.points()[last];
        let radius = places.iter().map(|place| self.radius(*place)).collect();
        Piece { vessel: id, nodes, points, at, radius }
    }

    fn radius(&self, place: LinePlace) -> f64 {
        let known = self.vessel.radius().map_or(0.0, |radius| place.value(radius));
        if known > 0.0 { known } else { self.unknown_radius }
    }
}

pub(super) fn vessels_of(pieces: &[Piece], numbers: &[usize]) -> Vec<usize> {
    let mut vessels: Vec<usize> = numbers.iter().map(|n| pieces[*n].vessel).collect();
    vessels.sort_unstable();
    vessels.dedup();
    vessels
}
