//! The wall that a lumen map unrolls, and its openings at branches. The wall is the measured contour; if there is none, it is where
//! values fall along rays; if they do not fall, it is at the centerline's radius.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::math::arc_length::LinePlace;
use lumencut_core::math::statistics::median;
use lumencut_core::reformations::Wall;
use lumencut_core::reformations::cpr::Straightened;
use lumencut_core::vessel_tree::Vessel;
use lumencut_core::volume::Volume;
use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::section::flags::BRANCH;
use lumencut_vessels::measure::section::known_radius;
use lumencut_vessels::voxels::Voxels;

use crate::rays_across::{Fall, RaysAcross};

/// Number of directions around the vessel in which the wall is known.
const DIRECTIONS: usize = 180;

/// The smallest distance along the vessel (mm) between stations, the places at which the wall is determined.
const STATION_STEP_MM: f64 = 1.0;

/// A ray leaves through the opening of a branch if it meets no wall within this many radii.
const OPEN_RADII: f64 = 1.6;

/// A neighbouring ray also leaves if it meets a wall beyond this many contour radii, which is the branch's wall.
const NEAR_OPEN_RADII: f64 = 1.15;

/// Smaller openings (mm²) are ignored, since single rays pass between the struts of a stent.
const MIN_OPENING_MM2: f64 = 3.0;

/// A section's own levels are used only if its contrast differs from the usual one by at most this factor.
const MAX_CONTRAST_RATIO: f64 = 2.0;

/// The wall around a vessel.
pub struct FoundWall {
    /// The radius of the wall, and its openings.
    pub wall: Arc<Wall>,
    /// Median levels of lumen and surroundings, if the vessel was measured.
    pub levels: Option<[f64; 2]>,
    /// The radius at which map columns are true to scale (mm): the median of the centerline's radii, else of the wall's.
    pub mean_radius: f64,
}

/// The wall of a vessel from its profile; without a profile, from the centerline's radius. Fails with
/// [`ErrorKind::VesselTree`] if neither profile nor vessel has a radius.
pub fn lumen_wall(
    volume: &Volume,
    vessel: &Vessel,
    straightened: &Straightened,
    profile: Option<&Profile>,
) -> Result<FoundWall> {
    let stations = match profile {
        Some(profile) => measured(volume, vessel, straightened, profile)?,
        None => unmeasured(vessel, straightened)?,
    };
    let at = stations.iter().map(|station| station.at).collect();
    let radius = median_filtered(&stations, |station, k| station.radius[k]);
    let open = openings(&stations);
    let mean_radius = known_radius(vessel).or_else(|| median(&mut radius.clone())).unwrap_or(1.0);
    Ok(FoundWall {
        wall: Arc::new(Wall::new(at, radius, open)?),
        levels: profile.and_then(median_levels),
        mean_radius,
    })
}

struct Station {
    at: f64,
    radius: Vec<f64>,
    exit: Vec<Exit>,
}

#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
enum Exit {
    No,
    /// The ray meets a wall farther away. It counts as leaving if a neighbouring ray leaves.
    Perhaps,
    Yes,
}

fn unmeasured(vessel: &Vessel, straightened: &Straightened) -> Result<Vec<Station>> {
    let length = straightened.length();
    let count = (length / STATION_STEP_MM).ceil().max(1.0);
    (0..=count as usize)
        .map(|n| {
            let share = n as f64 / count;
            let radius = radius_at(vessel, share).ok_or_else(no_radius)?;
            Ok(Station {
                at: length * share,
                radius: vec![radius; DIRECTIONS],
                exit: vec![Exit::No; DIRECTIONS],
            })
        })
        .collect()
}

pub(crate) fn no_radius() -> Error {
    let found = "a vessel without radii, whose lumen could not be measured either";
    Error::new(
        ErrorKind::VesselTree,
        "radius of the vessel",
        found,
        "radii above 0 mm, or a lumen in the volume",
    )
}

/// The centerline's radius at a fraction of its length, if it is above 0.
fn radius_at(vessel: &Vessel, share: f64) -> Option<f64> {
    let lengths = vessel.arc_length();
    let place = LinePlace::at(lengths, share * lengths[lengths.len() - 1]);
    Some(place.value(vessel.radius()?)).filter(|radius| *radius > 0.0)
}

fn measured(
    volume: &Volume,
    vessel: &Vessel,
    straightened: &Straightened,
    profile: &Profile,
) -> Result<Vec<Station>> {
    let scale = straightened.length() / profile.length();
    let usual = median_radius(vessel, profile).ok_or_else(no_radius)?;
    let levels = median_levels(profile);
    let rays = RaysAcross { voxels: &Voxels::new(volume), straightened, directions: DIRECTIONS };
    let mut chosen: Vec<usize> = Vec::new();
    for n in 0..profile.len() {
        if chosen
            .last()
            .is_none_or(|last| profile.arc_length[n] - profile.arc_length[*last] >= STATION_STEP_MM)
        {
            chosen.push(n);
        }
    }
    let station = |n: &usize| {
        let at = profile.arc_length[*n] * scale;
        let contour = polar(straightened, at, &profile.contour[*n]);
        let mut known: Vec<f64> = contour.iter().flatten().copied().collect();
        let own =
            median(&mut known).or_else(|| radius_at(vessel, at / straightened.length())).unwrap_or(usual);
        let own_levels = Some(profile.levels[*n]).filter(|local| is_alike(*local, levels));
        // At a branch the contour may reach into the branch.
        let is_branching = profile.flags[*n] & BRANCH != 0;
        let usual = |k: usize| if is_branching { own } else { contour[k].unwrap_or(own) };
        let reach = |k: usize| OPEN_RADII * usual(k);
        let falls = own_levels.or(levels).map(|levels| rays.falls(at, levels, reach));
        let fall = |k: usize| falls.as_ref().map_or(Fall::Unknown, |falls| falls[k]);
        let radius = |k: usize| contour[k].unwrap_or_else(|| fall(k).radius().unwrap_or(own));
        let exit = |k: usize| match fall(k) {
            Fall::Open => Exit::Yes,
            Fall::Wall(away) if away > NEAR_OPEN_RADII * usual(k) => Exit::Perhaps,
            Fall::Wall(_) | Fall::Unknown => Exit::No,
        };
        Station {
            at,
            radius: (0..DIRECTIONS).map(radius).collect(),
            exit: (0..DIRECTIONS).map(exit).collect(),
        }
    };
    Ok(chosen.par_iter().map(station).collect())
}

/// Whether a section's own levels are usable. They are not if its surroundings are bone or air outside the skin.
fn is_alike(local: [f64; 2], usual: Option<[f64; 2]>) -> bool {
    let contrast = |[lumen, around]: [f64; 2]| lumen - around;
    let ratio = contrast(local) / usual.map_or(contrast(local), contrast);
    ratio.is_finite() && (1.0 / MAX_CONTRAST_RATIO..=MAX_CONTRAST_RATIO).contains(&ratio)
}

fn median_radius(vessel: &Vessel, profile: &Profile) -> Option<f64> {
    let half = profile.diameter_equivalent().into_iter().map(|diameter| diameter / 2.0);
    let mut measured: Vec<f64> = half.filter(|radius| radius.is_finite()).collect();
    median(&mut measured).or_else(|| known_radius(vessel))
}

/// Arc lengths (mm) on a line of this length, and the usable levels there.
pub(crate) fn usable_levels(profile: &Profile, length: f64) -> Vec<(f64, [f64; 2])> {
    let usual = median_levels(profile);
    let places = profile.arc_length.iter().map(|at| at * length / profile.length());
    places.zip(profile.levels.iter().copied()).filter(|(_, levels)| is_alike(*levels, usual)).collect()
}

fn median_levels(profile: &Profile) -> Option<[f64; 2]> {
    let of = |n: usize| {
        let mut levels: Vec<f64> =
            profile.levels.iter().map(|pair| pair[n]).filter(|l| l.is_finite()).collect();
        median(&mut levels)
    };
    Some([of(0)?, of(1)?])
}

/// A contour in polar form: the farthest crossing in each direction (mm).
fn polar(straightened: &Straightened, at: f64, contour: &[DVec3]) -> Vec<Option<f64>> {
    let frame = straightened.frame(at);
    let middle = straightened.world_from_straightened(DVec3::new(0.0, 0.0, at));
    let inside = |point: &DVec3| {
        let away = *point - middle;
        DVec2::new(away.dot(frame.across), away.dot(frame.ahead))
    };
    let corners: Vec<DVec2> = contour.iter().map(inside).collect();
    let crossing = |k: usize| {
        let direction = DVec2::from_angle(TAU * k as f64 / DIRECTIONS as f64);
        let ends = corners.iter().zip(corners.iter().cycle().skip(1));
        ends.filter_map(|(a, b)| crossing_of(direction, *a, *b)).reduce(f64::max)
    };
    (0..DIRECTIONS).map(crossing).collect()
}

fn crossing_of(direction: DVec2, a: DVec2, b: DVec2) -> Option<f64> {
    let [from, to] = [a, b].map(|end| direction.perp_dot(end));
    // With >=, a corner on the ray belongs to only one of its two edges.
    if (from >= 0.0) == (to >= 0.0) {
        return None;
    }
    Some(direction.dot(a.lerp(b, from / (from - to)))).filter(|away| *away > 0.0)
}

/// The openings: directions in which rays certainly leave, and directions connected to them in which rays may leave.
fn openings(stations: &[Station]) -> Vec<bool> {
    let is_sure = |station: &Station, k: usize| f64::from(u8::from(station.exit[k] == Exit::Yes));
    let sure: Vec<bool> = median_filtered(stations, is_sure).into_iter().map(|share| share > 0.5).collect();
    let mut seen = vec![false; sure.len()];
    let mut open = vec![false; sure.len()];
    for seed in 0..sure.len() {
        if sure[seed] && !seen[seed] {
            seen[seed] = true;
            let opening = grown(seed, stations, &sure, &mut seen);
            let area = |n: &usize| {
                STATION_STEP_MM * TAU / DIRECTIONS as f64 * stations[n / DIRECTIONS].radius[n % DIRECTIONS]
            };
            if opening.iter().map(area).sum::<f64>() >= MIN_OPENING_MM2 {
                opening.into_iter().for_each(|n| open[n] = true);
            }
        }
    }
    open
}

/// All directions connected to a certain one; they are marked as seen.
fn grown(seed: usize, stations: &[Station], sure: &[bool], seen: &mut [bool]) -> Vec<usize> {
    let mut found = vec![seed];
    let mut next = 0;
    while next < found.len() {
        let (row, k) = (found[next] / DIRECTIONS, found[next] % DIRECTIONS);
        next += 1;
        for near in rows_around(row, stations.len()).flat_map(|row| around(k).map(|k| row * DIRECTIONS + k)) {
            let leaves = sure[near] || stations[near / DIRECTIONS].exit[near % DIRECTIONS] >= Exit::Perhaps;
            if leaves && !seen[near] {
                seen[near] = true;
                found.push(near);
            }
        }
    }
    found
}

/// A 3 × 3 median of an image with a row per station, which removes specks.
fn median_filtered(stations: &[Station], value: impl Fn(&Station, usize) -> f64 + Sync) -> Vec<f64> {
    let entry = |row: usize, k: usize| {
        let rows = rows_around(row, stations.len());
        let mut near: Vec<f64> = rows.flat_map(|row| around(k).map(|k| value(&stations[row], k))).collect();
        median(&mut near).unwrap_or(0.0)
    };
    let entry = &entry;
    let rows = (0..stations.len()).into_par_iter();
    rows.flat_map_iter(|row| (0..DIRECTIONS).map(move |k| entry(row, k))).collect()
}

fn rows_around(row: usize, count: usize) -> std::ops::Range<usize> {
    row.saturating_sub(1)..(row + 2).min(count)
}

fn around(k: usize) -> [usize; 3] {
    [DIRECTIONS - 1, 0, 1].map(|step| (k + step) % DIRECTIONS)
}

#[cfg(test)]
#[path = "tests/lumen_wall.rs"]
mod tests;
