//! What a lumen map shows beside the values of the volume: how thick calcium lies at the wall, and which branches open where.

use std::sync::Arc;

use glam::{DVec2, DVec3, Vec3};
use rayon::prelude::*;

use lumencut_core::error::Result;
use lumencut_core::math::centerline_path::CenterlinePath;
use lumencut_core::reformations::Layout;
use lumencut_core::reformations::cpr::View;
use lumencut_core::reformations::lumen_map::{LumenMap, LumenMapParameters};
use lumencut_core::stop::{Stop, go_on};
use lumencut_core::vessel_tree::Vessel;
use lumencut_core::volume::Volume;
use lumencut_vessels::voxels::Voxels;

use crate::lumen_wall::FoundWall;
use crate::rays_across::TOO_BRIGHT;

/// Calcium begins at this level (HU) at least.
const LEAST_CALCIUM: f64 = 130.0;

/// The distance of samples through the wall, in the sides that [`Voxels::sampling_side`] tells.
const SAMPLE: f64 = 0.5;

/// A branch hangs on a vessel where one of its ends lies within this number of radii of the wall, or this much farther (mm).
const HANGS: (f64, f64) = (1.6, 2.0);

/// How a lumen map is asked for.
#[derive(Clone, Copy, Debug)]
pub struct MapRequest {
    /// The side of a pixel (mm).
    pub pixel_spacing: f64,
    /// The direction of the middle column (radians); None turns the side where most calcium lies to the middle.
    pub angle: Option<f64>,
    /// How much of the other side is repeated beyond each edge (radians).
    pub overlap: f64,
    /// From where to where beyond the wall the map is about what lies there (mm).
    pub band: [f64; 2],
    /// From which level on something at the wall is calcium or metal; None is what the levels of the vessel say.
    pub calcium_level: Option<f64>,
}

/// The side of a pixel of the map in which the side with most calcium is looked for (mm).
const COARSE: f64 = 1.0;

/// The map of a vessel whose wall was found, with its pixels in the middle of the band.
///
/// # Errors
/// [`lumencut_core::error::ErrorKind::Camera`] for what cannot be laid out, [`lumencut_core::error::ErrorKind::Interrupted`].
pub fn lumen_map(
    volume: &Volume,
    path: &Arc<CenterlinePath>,
    view: &View,
    found: &FoundWall,
    (request, stop): (&MapRequest, Stop),
) -> Result<LumenMap> {
    let parameters = LumenMapParameters {
        pixel_spacing: request.pixel_spacing,
        mean_radius: found.mean_radius,
        angle: request.angle.unwrap_or(0.0),
        overlap: request.overlap,
        beyond: f64::midpoint(request.band[0], request.band[1]),
    };
    let laid = |parameters| LumenMap::new(Arc::clone(path), view, Arc::clone(&found.wall), parameters);
    let level = request.calcium_level.or_else(|| found.levels.map(calcium_level));
    let (None, Some(level)) = (request.angle, level) else { return laid(parameters) };
    let coarse = laid(LumenMapParameters { pixel_spacing: COARSE, overlap: 0.0, ..parameters })?;
    let angle = thickest_side(&coarse, &thickness(volume, &coarse, (request.band, level), stop)?);
    laid(LumenMapParameters { angle, ..parameters })
}

/// From which level on something at the wall is calcium or metal, by the levels of the lumen and its surroundings.
pub fn calcium_level([lumen, around]: [f64; 2]) -> f64 {
    (lumen + TOO_BRIGHT * (lumen - around)).max(LEAST_CALCIUM)
}

/// How much of the way through the wall is brighter than a level (mm), for each pixel: from the first to the second of two distances
/// beyond the wall (mm). NaN outside the volume and where the wall is open.
///
/// # Errors
/// Those of the layout, also where the caller asks to stop.
pub fn thickness(
    volume: &Volume,
    map: &LumenMap,
    (band, level): ([f64; 2], f64),
    stop: Stop,
) -> Result<Vec<f32>> {
    let curved = map.curved(stop)?;
    let voxels = Voxels::new(volume);
    let index = &voxels.index_from_world;
    let steps = ((band[1] - band[0]) / (SAMPLE * voxels.sampling_side)).ceil().max(1.0);
    let step = (band[1] - band[0]) / steps;
    let own = map.parameters().beyond;
    let through = |values: &mut Vec<f32>, (position, direction): (&DVec3, &Vec3)| {
        go_on(stop)?;
        let ray = direction.as_dvec3();
        let start = index.transform_point3(*position + ray * (band[0] - own + 0.5 * step));
        if !start.is_finite() {
            return Ok(f32::NAN);
        }
        values.clear();
        while values.len() < steps as usize {
            voxels.along(start, index.transform_vector3(ray) * step, values);
        }
        let values = &values[..steps as usize];
        let is_outside = values.iter().any(|value| value.is_nan());
        let bright = values.iter().filter(|value| f64::from(**value) > level).count();
        Ok(if is_outside { f32::NAN } else { (bright as f64 * step) as f32 })
    };
    let pixels = curved.position().par_iter().zip(curved.slab_direction());
    pixels.map_init(Vec::new, through).collect()
}

/// The direction in which most lies at the wall (radians): a map with it in the middle is cut open on the other side. 0 where nothing
/// lies at the wall.
fn thickest_side(map: &LumenMap, thickness: &[f32]) -> f64 {
    let width = map.size()[0];
    let sum: DVec2 = thickness
        .iter()
        .enumerate()
        .filter(|(_, thick)| thick.is_finite())
        .map(|(n, thick)| DVec2::from_angle(map.around((n % width) as f64)) * f64::from(*thick))
        .sum();
    // The middle column, opposite to the cut, gets what is thickest.
    if sum == DVec2::ZERO { 0.0 } else { sum.to_angle() }
}

/// Where another vessel opens into a mapped one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ostium {
    /// The id of the other vessel.
    pub vessel: usize,
    /// The place along the mapped vessel (mm).
    pub at: f64,
    /// The direction around it (radians).
    pub around: f64,
    /// The point of the other vessel where it leaves the wall (mm, LPS).
    pub point: DVec3,
}

/// Where the vessels of a tree open into the mapped one, in the order of their ids. A vessel that runs along the mapped one is not
/// told, nor one that lies wholly within its wall.
pub fn ostia(map: &LumenMap, vessels: &[Vessel]) -> Vec<Ostium> {
    let found = |(vessel, other): (usize, &Vessel)| {
        let mut points = other.points().to_vec();
        let near = |point: DVec3| Place::of(map, point).is_some_and(|place| place.hangs(map));
        if !near(points[0]) {
            points.reverse();
        }
        let first = Place::of(map, points[0]).filter(|place| place.hangs(map))?;
        let leaves = points
            .iter()
            .find(|point| Place::of(map, **point).is_none_or(|place| place.away > place.wall(map)))?;
        let place = Place::of(map, *leaves)?;
        // Both ends of a part of the mapped vessel lie on it, and so does all between.
        let is_apart = place.away <= HANGS.0 * place.wall(map) + HANGS.1;
        is_apart.then_some(Ostium {
            vessel,
            at: f64::midpoint(first.at, place.at),
            around: place.around,
            point: *leaves,
        })
    };
    vessels.iter().enumerate().filter_map(found).collect()
}

/// A point by its place along and around the mapped vessel.
struct Place {
    at: f64,
    around: f64,
    away: f64,
}

impl Place {
    /// The place of a point that lies along the vessel.
    fn of(map: &LumenMap, point: DVec3) -> Option<Self> {
        let straight = map.straightened().straightened_from_world(point);
        let offset = straight.truncate();
        let is_along = (0.0..=map.straightened().length()).contains(&straight.z);
        is_along.then(|| Self { at: straight.z, around: offset.to_angle(), away: offset.length() })
    }

    fn wall(&self, map: &LumenMap) -> f64 {
        map.wall_at(self.at, self.around)
    }

    fn hangs(&self, map: &LumenMap) -> bool {
        self.away <= HANGS.0 * self.wall(map) + HANGS.1
    }
}

#[cfg(test)]
#[path = "tests/lumen_map.rs"]
mod tests;
