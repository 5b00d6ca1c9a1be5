//! Finds neighbouring tracks of similar width. Bone fills a neighbourhood, but a vessel only passes through it.

use glam::DVec3;
use rayon::prelude::*;

use crate::trace::find::point_grid::PointGrid;
use crate::trace::find::track::Track;
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

const NEIGHBOR_MM: f64 = 12.0;

const MAX_RADIUS_RATIO: f64 = 2.2;

/// Distance between sampled points of a track (mm).
const STEP: f64 = 2.0;

/// Sorted numbers of the neighbours of each track. Only tracks marked in `counts` can be neighbours.
pub(crate) fn beside(tracks: &[Track], counts: &[bool], stop: Stop) -> Result<Vec<Vec<usize>>> {
    let radii: Vec<f64> = tracks.iter().map(Track::radius).collect();
    let places: Vec<Vec<DVec3>> = tracks.par_iter().map(spread_out).collect();
    let mut owners = Vec::new();
    for (number, places) in places.iter().enumerate().filter(|(number, _)| counts[*number]) {
        owners.resize(owners.len() + places.len(), number);
    }
    let counted = places.iter().zip(counts).filter(|(_, counts)| **counts);
    let grid =
        PointGrid::new(counted.flat_map(|(places, _)| places.iter().copied()).collect(), NEIGHBOR_MM / 2.0);
    let around = |number: usize| {
        go_on(stop)?;
        let mut found = vec![number];
        for place in &places[number] {
            grid.near(*place, NEIGHBOR_MM, |point| {
                let other = owners[point];
                let is_alike = (radii[other] / radii[number]).ln().abs() <= MAX_RADIUS_RATIO.ln();
                if let (true, Err(at)) = (is_alike, found.binary_search(&other)) {
                    found.insert(at, other);
                }
            });
        }
        found.retain(|other| *other != number);
        Ok(found)
    };
    (0..tracks.len()).into_par_iter().map(around).collect()
}

fn spread_out(track: &Track) -> Vec<DVec3> {
    let mut places = vec![track.points[0].place];
    let mut walked = 0.0;
    for pair in track.points.windows(2) {
        walked += pair[0].place.distance(pair[1].place);
        if walked >= STEP {
            walked = 0.0;
            places.push(pair[1].place);
        }
    }
    places.extend(track.points.last().map(|point| point.place));
    places
}
