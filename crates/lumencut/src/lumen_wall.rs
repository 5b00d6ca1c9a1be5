//! The wall that a lumen map unrolls: the measured contour, or else where values fall along rays, or else the radius of the
//! centerline; and where it is open, because a branch begins.

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
use lumencut_vessels::measure::flags::BRANCH;
use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::section_plane::known_radius;
use lumencut_vessels::voxels::Voxels;

use crate::rays_across::{Fall, RaysAcross};

/// In how many directions around the vessel the wall is known.
const DIRECTIONS: usize = 180;

/// How far apart it is known along the vessel (mm), at least.
const STEP: f64 = 1.0;

/// A ray that meets no wall within this number of radii leaves through the opening of a branch.
const OPEN: f64 = 1.6;

/// So does one beside it that meets a wall only beyond this number of radii of the contour: that of the branch.
const BESIDE_OPEN: f64 = 1.15;

/// A smaller hole in the wall is none (mm²): between struts of stents single rays slip through.
const SMALLEST_OPENING: f64 = 3.0;

/// A section's own contrast counts up to so many times the usual one, and down to this part of it.
const MOST_UNLIKE: f64 = 2.0;

/// The wall around a vessel.
pub struct FoundWall {
    /// Its radius, and where it is open.
    pub wall: Arc<Wall>,
    /// The median levels of the lumen and of its surroundings, where the vessel was measured.
    pub levels: Option<[f64; 2]>,
    /// The radius at which the columns of a map are true (mm): the median of the centerline's, or else of the wall's.
    pub mean_radius: f64,
}

/// The wall of a vessel whose straightened space is known, by its profile. Without a profile it is the radius of the centerline.
///
/// # Errors
/// [`ErrorKind::VesselTree`] where neither a profile nor the vessel has a radius.
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
    let radius = quiet(&stations, |station, k| station.radius[k]);
    let open = openings(&stations);
    let mean_radius = known_radius(vessel).or_else(|| median(&mut radius.clone())).unwrap_or(1.0);
    Ok(FoundWall {
        wall: Arc::new(Wall::new(at, radius, open)?),
        levels: profile.and_then(median_levels),
        mean_radius,
    })
}

/// The wall at one place along the vessel.
struct Station {
    at: f64,
    radius: Vec<f64>,
    exit: Vec<Exit>,
}

/// Whether a ray leaves the vessel.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
enum Exit {
    /// It meets the wall.
    No,
    /// It meets a wall farther away than that of the vessel: as it does in an opening, if there is one beside it.
    Perhaps,
    /// It meets none.
    Yes,
}

/// The radius of the centerline, everywhere closed.
fn unmeasured(vessel: &Vessel, straightened: &Straightened) -> Result<Vec<Station>> {
    let length = straightened.length();
    let count = (length / STEP).ceil().max(1.0);
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

/// An error for a vessel whose radius nothing tells.
pub fn no_radius() -> Error {
    let found = "a vessel without radii, whose lumen could not be measured either";
    Error::new(
        ErrorKind::VesselTree,
        "radius of the vessel",
        found,
        "radii above 0 mm, or a lumen in the volume",
    )
}

/// The radius of the centerline at a share of its length, where it has one above 0.
fn radius_at(vessel: &Vessel, share: f64) -> Option<f64> {
    let lengths = vessel.arc_length();
    let place = LinePlace::at(lengths, share * lengths[lengths.len() - 1]);
    Some(place.value(vessel.radius()?)).filter(|radius| *radius > 0.0)
}

/// The wall at measured sections that are not nearer to each other than a step.
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
        if chosen.last().is_none_or(|last| profile.arc_length[n] - profile.arc_length[*last] >= STEP) {
            chosen.push(n);
        }
    }
    let station = |n: &usize| {
        let at = profile.arc_length[*n] * scale;
        let contour = polar(straightened, at, &profile.contour[*n]);
        let mut known: Vec<f64> = contour.iter().flatten().copied().collect();
        let own =
            median(&mut known).or_else(|| radius_at(vessel, at / straightened.length())).unwrap_or(usual);
        let told = Some(profile.levels[*n]).filter(|local| is_alike(*local, levels));
        // Where a branch leaves, the contour may reach into it.
        let is_branching = profile.flags[*n] & BRANCH != 0;
        let usual = |k: usize| if is_branching { own } else { contour[k].unwrap_or(own) };
        let reach = |k: usize| OPEN * usual(k);
        let falls = told.or(levels).map(|levels| rays.falls(at, levels, reach));
        let fall = |k: usize| falls.as_ref().map_or(Fall::Unknown, |falls| falls[k]);
        let radius = |k: usize| contour[k].unwrap_or_else(|| fall(k).radius().unwrap_or(own));
        let exit = |k: usize| match fall(k) {
            Fall::Open => Exit::Yes,
            Fall::Wall(away) if away > BESIDE_OPEN * usual(k) => Exit::Perhaps,
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

/// Whether the levels of lumen and surroundings of one section may stand for it: air beside a vessel under the skin, or bone, is not what
/// its wall is made of.
fn is_alike(local: [f64; 2], usual: Option<[f64; 2]>) -> bool {
    let contrast = |[lumen, around]: [f64; 2]| lumen - around;
    let ratio = contrast(local) / usual.map_or(contrast(local), contrast);
    ratio.is_finite() && (1.0 / MOST_UNLIKE..=MOST_UNLIKE).contains(&ratio)
}

/// The median of the measured radii, or of those of the centerline.
fn median_radius(vessel: &Vessel, profile: &Profile) -> Option<f64> {
    let half = profile.diameter_equivalent().into_iter().map(|diameter| diameter / 2.0);
    let mut measured: Vec<f64> = half.filter(|radius| radius.is_finite()).collect();
    median(&mut measured).or_else(|| known_radius(vessel))
}

/// The median levels of lumen and surroundings of the sections that tell them.
fn median_levels(profile: &Profile) -> Option<[f64; 2]> {
    let of = |n: usize| {
        let mut levels: Vec<f64> =
            profile.levels.iter().map(|pair| pair[n]).filter(|l| l.is_finite()).collect();
        median(&mut levels)
    };
    Some([of(0)?, of(1)?])
}

/// A contour as its farthest crossing in each direction from the middle of the vessel (mm), where it has one.
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

/// How far from the origin a ray crosses an edge, where it does.
fn crossing_of(direction: DVec2, a: DVec2, b: DVec2) -> Option<f64> {
    let [from, to] = [a, b].map(|end| direction.perp_dot(end));
    // Each corner belongs to one of its two edges.
    if (from >= 0.0) == (to >= 0.0) {
        return None;
    }
    Some(direction.dot(a.lerp(b, from / (from - to)))).filter(|away| *away > 0.0)
}

/// Where the wall is open: where rays surely leave, and from there on beside it where they perhaps leave, unless all of that is too
/// small.
fn openings(stations: &[Station]) -> Vec<bool> {
    let is_sure = |station: &Station, k: usize| f64::from(u8::from(station.exit[k] == Exit::Yes));
    let sure: Vec<bool> = quiet(stations, is_sure).into_iter().map(|share| share > 0.5).collect();
    let mut seen = vec![false; sure.len()];
    let mut open = vec![false; sure.len()];
    for seed in 0..sure.len() {
        if sure[seed] && !seen[seed] {
            seen[seed] = true;
            let opening = grown(seed, stations, &sure, &mut seen);
            let area =
                |n: &usize| STEP * TAU / DIRECTIONS as f64 * stations[n / DIRECTIONS].radius[n % DIRECTIONS];
            if opening.iter().map(area).sum::<f64>() >= SMALLEST_OPENING {
                opening.into_iter().for_each(|n| open[n] = true);
            }
        }
    }
    open
}

/// All entries that hang together with a sure one, each of which is marked as seen.
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

/// An image of the stations without specks: the median of three by three entries.
fn quiet(stations: &[Station], value: impl Fn(&Station, usize) -> f64 + Sync) -> Vec<f64> {
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
