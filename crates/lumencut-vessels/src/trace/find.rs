//! Finds all vessels of an angiography without a start point (seed). All scans use the same thresholds.

pub(crate) mod all_tracks;
pub(crate) mod bone;
pub mod bone_voxels;
pub(crate) mod candidates;
pub(crate) mod confidence;
pub(crate) mod doubtful;
pub(crate) mod flux;
pub mod found;
pub mod from_seed;
pub(crate) mod grid;
pub(crate) mod inside_wide;
pub(crate) mod links;
pub(crate) mod one_track;
pub mod one_vessel;
pub(crate) mod paint;
pub(crate) mod point_grid;
pub(crate) mod progress;
pub(crate) mod pyramid;
pub(crate) mod quantiles;
pub mod refusals;
pub(crate) mod scan;
pub(crate) mod section;
pub(crate) mod side_by_side;
pub mod track;
pub(crate) mod tubes;
pub(crate) mod vessel_level;
pub(crate) mod whole_vessels;

use crate::kind::Kind;
use crate::trace::find::doubtful::{doubted_where_scarce, is_angiography};
use crate::trace::find::found::{Below, Trees};
use crate::trace::find::grid::{Grid, VOXELS_PER_RADIUS};
use crate::trace::find::progress::Stages;
use crate::trace::find::scan::Scan;
use crate::voxels::Voxels;
use glam::DVec3;
use lumencut_core::error::Result;
use lumencut_core::progress::Progress;
use lumencut_core::stop::Stop;
use lumencut_core::volume::Volume;

/// Default of [`FindRequest::smallest_radius`] (mm); in fine voxels the radius for which they are just fine enough.
const SMALLEST_RADIUS: f64 = 1.0;

/// The rule of [`smallest_radius`] in words, for help texts and documentation.
pub const SMALLEST_RADIUS_WORDS: &str = "1 mm, or 1.3 voxel sides if that is less";

/// If no vessel is sure, this fraction of the smallest radius is tried, so that the refusal can say what it finds.
const LOWER: f64 = 0.7;

/// Which vessels to find.
pub struct FindRequest<'a> {
    /// A vessel ends where its radius stays below this (mm); [`smallest_radius`] if None.
    pub smallest_radius: Option<f64>,
    /// Called often; returns whether to stop.
    pub stop: Stop<'a>,
    /// Receives the progress, if given.
    pub progress: Option<&'a Progress>,
}

/// The smallest radius (mm) that is searched for by default.
pub fn smallest_radius(voxels: &Voxels) -> f64 {
    SMALLEST_RADIUS.min(VOXELS_PER_RADIUS * voxels.mean_side())
}

/// Finds all vessels of a volume, as connected parts; the most important part comes first.
pub fn find_vessels(volume: &Volume, request: &FindRequest) -> Result<Trees> {
    find_in(&Voxels::new(volume), request)
}

fn find_in(voxels: &Voxels, request: &FindRequest) -> Result<Trees> {
    let found = all(voxels, request)?;
    if found.sure_length() > 0.0 {
        return Ok(found);
    }
    let smallest_radius = LOWER * found.smallest_radius;
    let lower = FindRequest { smallest_radius: Some(smallest_radius), progress: None, ..*request };
    let length = all(voxels, &lower)?.sure_length();
    Ok(Trees { below: (length > 0.0).then_some(Below { smallest_radius, length }), ..found })
}

fn all(voxels: &Voxels, request: &FindRequest) -> Result<Trees> {
    let trees = trees(voxels, None, request)?;
    Ok(Trees { vessels: doubted_where_scarce(voxels, trees.vessels, trees.is_angiography), ..trees })
}

/// Finds all vessels of a volume. If a seed (mm, LPS) lies outside all of them, fainter ones around it are found too.
pub fn trees(voxels: &Voxels, seed: Option<DVec3>, request: &FindRequest) -> Result<Trees> {
    let stages = Stages::begin(request.progress);
    let smallest_radius = request.smallest_radius.unwrap_or_else(|| smallest_radius(voxels));
    let grid = Grid::over(voxels, smallest_radius);
    let Some(tubes::Tubes { scan, other, tracks, shapes }) =
        tubes::tubes(voxels, grid, seed, request.stop, stages)?
    else {
        let kind = Kind::of(voxels.polarity, false, 0.0);
        return Ok(Trees { smallest_radius, kind, ..Trees::default() });
    };
    let tracks = bone::judged(&scan, tracks, &shapes, request.stop)?;
    let is_angiography = is_angiography(&scan, &tracks, &shapes);
    let tracks = bone::left(tracks);
    let links = links::between(&scan, &tracks, request.stop, stages)?;
    let vessels = whole_vessels::of(&scan, &tracks, &links, smallest_radius, (request.stop, stages))?;
    stages.end();
    let Scan { level, contrast, noise, is_hounsfield, .. } = scan;
    let level = voxels.polarity.turned(level);
    let other = other.map(|[level, contrast]| [voxels.polarity.turned(level), contrast]);
    let kind = Kind::of(voxels.polarity, is_hounsfield, level);
    let is = Trees { is_angiography, kind, ..Trees::default() };
    Ok(Trees { vessels, level, contrast, other, noise, smallest_radius, ..is })
}

#[cfg(test)]
#[path = "find/tests/made.rs"]
mod made;

#[cfg(test)]
#[path = "find/tests/smallest_radius.rs"]
mod tests;
