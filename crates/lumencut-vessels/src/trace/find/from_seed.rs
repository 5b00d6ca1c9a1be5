//! Chooses the vessels that belong to a seed, among the vessels that were found without a seed.

use glam::DVec3;

use crate::trace::find::found::{FoundVessel, Trees};
use crate::trace::find::track::TrackDoubt;
use crate::trace::find::{FindRequest, refusals, trees};
use crate::voxels::Voxels;
use lumencut_core::error::Result;
use lumencut_core::volume::Volume;

/// A seed selects a vessel within this many radii, or within one voxel if that is larger.
pub(crate) const SELECT_RADII: f64 = 1.5;

#[derive(Clone, Copy, Debug, PartialEq)]
struct Near {
    vessel: usize,
    point: DVec3,
    distance: f64,
    radii: f64,
}

/// Finds the vessels of the connected part that contains a seed (mm, LPS); they do not depend on the seed. If
/// the seed lies outside all vessels, fainter ones around it are found too. Errors: those of [`trees`];
/// `ErrorKind::Tracing` for a seed outside the volume, in no vessel, or in a part without a sure vessel.
pub fn find_from(volume: &Volume, seed: DVec3, request: &FindRequest) -> Result<Trees> {
    let voxels = Voxels::new(volume);
    if !seed.is_finite() || voxels.voxel_at(seed).is_none() {
        return Err(refusals::outside(seed));
    }
    let trees = trees(&voxels, Some(seed), request)?;
    if trees.vessels.is_empty() {
        return Err(refusals::no_vessel(&trees));
    }
    let side = voxels.mean_side();
    let (kind, place) = (trees.kind, (seed, voxels.shown_at(seed)));
    match part_at(&trees, seed, side) {
        Ok(part) => sure(only(trees, part)).map_err(|doubt| refusals::only_doubtful(place, kind, doubt)),
        Err((nearest, distance)) => Err(refusals::not_here(place, kind, nearest, distance)),
    }
}

/// The connected part whose vessel is nearest to a seed in radii, preferably a sure one. The search radius is
/// at least `voxel` mm. Errors: if no vessel is in reach, the nearest vessel point and its distance (mm).
pub fn part_at(trees: &Trees, seed: DVec3, voxel: f64) -> std::result::Result<usize, (DVec3, f64)> {
    let sure_parts: Vec<usize> =
        trees.vessels.iter().filter(|vessel| vessel.doubt.is_none()).map(|vessel| vessel.part).collect();
    let vessel = vessel_at(trees, seed, voxel, |vessel| sure_parts.contains(&vessel.part))?;
    Ok(trees.vessels[vessel].part)
}

/// The vessel nearest to a position in radii, preferably one that `comes_first` accepts. The search radius is
/// at least `voxel` mm. Errors: if no vessel is in reach, the nearest vessel point and its distance (mm).
pub(crate) fn vessel_at(
    trees: &Trees,
    place: DVec3,
    voxel: f64,
    comes_first: impl Fn(&FoundVessel) -> bool,
) -> std::result::Result<usize, (DVec3, f64)> {
    let near: Vec<Near> = trees
        .vessels
        .iter()
        .enumerate()
        .map(|(number, vessel)| near(number, vessel, place, voxel / SELECT_RADII))
        .collect();
    let within = |is_first: bool| {
        near.iter()
            .filter(|near| near.radii <= SELECT_RADII && comes_first(&trees.vessels[near.vessel]) == is_first)
            .min_by(|a, b| a.radii.total_cmp(&b.radii))
    };
    within(true).or_else(|| within(false)).map(|near| near.vessel).ok_or_else(|| {
        let nearest = near.iter().min_by(|a, b| a.distance.total_cmp(&b.distance));
        nearest.map_or((place, f64::INFINITY), |near| (near.point, near.distance))
    })
}

/// The point of a vessel that is nearest to the seed, measured in radii; radii below `least` mm count as `least`.
fn near(vessel: usize, found: &FoundVessel, seed: DVec3, least: f64) -> Near {
    let line = &found.line;
    let of = |n: usize| {
        let [from, to] = [line.points[n], line.points[n + 1]];
        let along = to - from;
        let share =
            ((seed - from).dot(along) / along.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let point = from.lerp(to, share);
        let radius = line.radius[n] + (line.radius[n + 1] - line.radius[n]) * share;
        let distance = seed.distance(point);
        Near { vessel, point, distance, radii: distance / radius.max(least) }
    };
    let none = Near { vessel, point: seed, distance: f64::INFINITY, radii: f64::INFINITY };
    let nearer = |a: Near, b: Near| if b.radii < a.radii { b } else { a };
    (0..line.points.len().saturating_sub(1)).map(of).fold(none, nearer)
}

fn only(trees: Trees, part: usize) -> Trees {
    let vessels = trees.vessels.into_iter().filter(|vessel| vessel.part == part);
    Trees { vessels: vessels.map(|vessel| FoundVessel { part: 0, ..vessel }).collect(), ..trees }
}

fn sure(trees: Trees) -> std::result::Result<Trees, TrackDoubt> {
    let doubts: Vec<_> = trees.vessels.iter().map(|vessel| vessel.doubt).collect();
    match doubts.first() {
        Some(Some(doubt)) if !doubts.contains(&None) => Err(*doubt),
        _ => Ok(trees),
    }
}
