//! What a lumen map shows in addition to voxel values: the thickness of calcium at the wall, and the ostia of branches.

use std::sync::Arc;

use glam::{DVec2, DVec3, Vec3};
use rayon::prelude::*;

use lumencut_core::error::Result;
use lumencut_core::math::centerline_path::CenterlinePath;
use lumencut_core::reformations::cpr::{Straightened, View};
use lumencut_core::reformations::lumen_map::{LumenMap, LumenMapParameters};
use lumencut_core::reformations::{Layout, Wall};
use lumencut_core::stop::{Stop, go_on};
use lumencut_core::vessel_tree::Vessel;
use lumencut_core::volume::Volume;
use lumencut_vessels::voxels::Voxels;

use crate::lumen_wall::FoundWall;
use crate::rays_across::TOO_BRIGHT;

const MIN_CALCIUM_HU: f64 = 130.0;

/// Distance between samples through the wall, in units of [`Voxels::sampling_side`].
const SAMPLE_STEP: f64 = 0.5;

/// A branch is attached if one of its ends is nearer to the centerline than this many wall radii plus this distance (mm).
const ATTACHED: (f64, f64) = (1.6, 2.0);

/// The parameters of a lumen map.
#[derive(Clone, Copy, Debug)]
pub struct MapRequest {
    /// Pixel side (mm).
    pub pixel_spacing: f64,
    /// Direction of the middle column (radians); None centres the side with most calcium.
    pub angle: Option<f64>,
    /// The angle that the map repeats beyond each edge (radians).
    pub overlap: f64,
    /// The range of distances beyond the wall that is mapped (mm).
    pub band: [f64; 2],
    /// The lowest value that counts as calcium or metal; None derives it from the vessel's levels.
    pub calcium_level: Option<f64>,
}

/// Pixel side (mm) of the coarse map that finds the side with most calcium.
const COARSE_PIXEL_MM: f64 = 1.0;

/// The map of a vessel whose wall is known. The pixels lie in the middle of the band. Fails with
/// [`lumencut_core::error::ErrorKind::Camera`] for an invalid layout;
/// [`lumencut_core::error::ErrorKind::Interrupted`].
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
    let coarse = laid(LumenMapParameters { pixel_spacing: COARSE_PIXEL_MM, overlap: 0.0, ..parameters })?;
    let angle = thickest_side(&coarse, &thickness(volume, &coarse, (request.band, level), stop)?);
    laid(LumenMapParameters { angle, ..parameters })
}

/// The lowest value that counts as calcium or metal, from the levels of the lumen and its surroundings.
pub fn calcium_level([lumen, around]: [f64; 2]) -> f64 {
    (lumen + TOO_BRIGHT * (lumen - around)).max(MIN_CALCIUM_HU)
}

/// The wall that a map shows.
pub fn walls(map: &LumenMap) -> Walls<'_> {
    Walls { straightened: map.straightened(), wall: map.wall_table() }
}

/// For each pixel, the thickness (mm) of what exceeds a level between two distances beyond the wall (mm). NaN outside the volume
/// and at openings of the wall.
pub fn thickness(
    volume: &Volume,
    map: &LumenMap,
    (band, level): ([f64; 2], f64),
    stop: Stop,
) -> Result<Vec<f32>> {
    let curved = map.curved(stop)?;
    let voxels = Voxels::new(volume);
    let index = &voxels.index_from_world;
    let steps = ((band[1] - band[0]) / (SAMPLE_STEP * voxels.sampling_side)).ceil().max(1.0);
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

/// The direction with most calcium at the wall (radians), or 0 without calcium.
fn thickest_side(map: &LumenMap, thickness: &[f32]) -> f64 {
    let width = map.size()[0];
    let sum: DVec2 = thickness
        .iter()
        .enumerate()
        .filter(|(_, thick)| thick.is_finite())
        .map(|(n, thick)| DVec2::from_angle(map.around((n % width) as f64)) * f64::from(*thick))
        .sum();
    // The thickest side becomes the middle column, opposite to the cut.
    if sum == DVec2::ZERO { 0.0 } else { sum.to_angle() }
}

/// An ostium: the place at which another vessel opens into the mapped one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ostium {
    /// Id of the other vessel.
    pub vessel: usize,
    /// Arc length on the mapped vessel (mm).
    pub at: f64,
    /// Direction around the mapped vessel (radians).
    pub around: f64,
    /// The point where the other vessel leaves the wall (mm, LPS).
    pub point: DVec3,
}

/// The wall of a vessel in its straightened space.
#[derive(Clone, Copy)]
pub struct Walls<'a> {
    /// The straightened space in which the wall is known.
    pub straightened: &'a Straightened,
    /// The wall.
    pub wall: &'a Wall,
}

/// The ostia of other vessels on one with this wall, by vessel id. Vessels that run along it or lie inside its wall have none.
pub fn ostia(map: &Walls, vessels: &[Vessel]) -> Vec<Ostium> {
    let found = |(vessel, other): (usize, &Vessel)| {
        let mut points = other.points().to_vec();
        let near = |point: DVec3| WallCoordinates::of(map, point).is_some_and(|place| place.hangs(map));
        if !near(points[0]) {
            points.reverse();
        }
        let first = WallCoordinates::of(map, points[0]).filter(|place| place.hangs(map))?;
        let leaves = points.iter().find(|point| {
            WallCoordinates::of(map, **point).is_none_or(|place| place.away > place.wall(map))
        })?;
        let place = WallCoordinates::of(map, *leaves)?;
        // A vessel does not open into the wall here if its first point outside the wall is far away.
        let is_apart = place.away <= ATTACHED.0 * place.wall(map) + ATTACHED.1;
        is_apart.then_some(Ostium {
            vessel,
            at: f64::midpoint(first.at, place.at),
            around: place.around,
            point: *leaves,
        })
    };
    vessels.iter().enumerate().filter_map(found).collect()
}

struct WallCoordinates {
    at: f64,
    around: f64,
    away: f64,
}

impl WallCoordinates {
    fn of(map: &Walls, point: DVec3) -> Option<Self> {
        let straight = map.straightened.straightened_from_world(point);
        let offset = straight.truncate();
        let is_along = (0.0..=map.straightened.length()).contains(&straight.z);
        is_along.then(|| Self { at: straight.z, around: offset.to_angle(), away: offset.length() })
    }

    fn wall(&self, map: &Walls) -> f64 {
        map.wall.radius(self.at, self.around)
    }

    fn hangs(&self, map: &Walls) -> bool {
        self.away <= ATTACHED.0 * self.wall(map) + ATTACHED.1
    }
}

#[cfg(test)]
#[path = "tests/lumen_map.rs"]
mod tests;
