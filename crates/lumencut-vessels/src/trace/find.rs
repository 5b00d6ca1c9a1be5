//! Finds all vessels of an angiography without a start point (seed). All scans use the same thresholds.

pub(crate) mod all_tracks;
pub(crate) mod bone;
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

use crate::trace::find::doubtful::{doubted_where_scarce, is_angiography};
use crate::trace::find::found::Trees;
use crate::trace::find::progress::Stages;
use crate::trace::find::scan::Scan;
use crate::voxels::Voxels;
use glam::DVec3;
use lumencut_core::error::Result;
use lumencut_core::progress::Progress;
use lumencut_core::stop::Stop;
use lumencut_core::volume::Volume;

/// Default of [`FindRequest::smallest_radius`] (mm).
pub const SMALLEST_RADIUS: f64 = 1.0;

/// Which vessels to find.
pub struct FindRequest<'a> {
    /// A vessel ends where its radius stays below this (mm).
    pub smallest_radius: f64,
    /// Called often; returns whether to stop.
    pub stop: Stop<'a>,
    /// Receives the progress, if given.
    pub progress: Option<&'a Progress>,
}

/// Finds all vessels of a volume, as connected parts; the most important part comes first.
pub fn find_vessels(volume: &Volume, request: &FindRequest) -> Result<Trees> {
    let voxels = &Voxels::new(volume);
    let trees = trees(voxels, None, request)?;
    Ok(Trees { vessels: doubted_where_scarce(voxels, trees.vessels, trees.is_angiography), ..trees })
}

/// Finds all vessels of a volume. If a seed (mm, LPS) lies outside all of them, fainter ones around it are found too.
pub fn trees(voxels: &Voxels, seed: Option<DVec3>, request: &FindRequest) -> Result<Trees> {
    let stages = Stages::begin(request.progress);
    let Some(tubes::Tubes { scan, tracks, shapes }) = tubes::tubes(voxels, seed, request, stages)? else {
        return Ok(Trees {
            vessels: Vec::new(),
            level: 0.0,
            contrast: 0.0,
            noise: 0.0,
            is_angiography: false,
        });
    };
    let tracks = bone::judged(&scan, tracks, &shapes, request.stop)?;
    let is_angiography = is_angiography(&scan, &tracks, &shapes);
    let tracks = bone::left(tracks);
    let links = links::between(&scan, &tracks, request.stop, stages)?;
    let vessels = whole_vessels::of(&scan, &tracks, &links, request, stages)?;
    stages.end();
    let Scan { level, contrast, noise, .. } = scan;
    Ok(Trees { vessels, level, contrast, noise, is_angiography })
}

#[cfg(test)]
#[path = "find/tests/made.rs"]
mod made;
