//! Centerlines of all branches that one seed reaches.

pub mod seed_branches;
pub mod seed_doubts;
pub mod seed_tree;
pub mod seed_ways;

use glam::{DAffine3, DVec3};

use crate::trace::lines::centerline::Centerline;
use crate::trace::lines::nearest_point::nearest_point;
use crate::trace::lumen::cross_section::Probe;
use crate::trace::lumen::lumen_model::{LumenModel, in_words};
use crate::trace::lumen::refine::{STEP, refined};
use crate::trace::lumen::surroundings::Surroundings;
use crate::trace::lumen::tube::{Sections, Usual};
use crate::trace::seed::seed_branches::Search;
use crate::trace::seed::seed_tree::{SeedBranch, SeenVessel};
use crate::trace::seed::seed_ways::Ways;
use crate::trace::skeleton::foreground::Foreground;
use crate::trace::skeleton::mask_vessels::MaskVessel;
use crate::trace::skeleton::{PARENT_RADII, Skeletonization, skeleton};
use crate::trace::ways::flood::{Flood, bounds};
use crate::trace::ways::region::{Region, Strictness};
use crate::voxels::Voxels;
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::math::arc_length::arc_lengths;
use lumencut_core::progress::Progress;
use lumencut_core::stop::Stop;
use lumencut_core::volume::{self, Volume};
use rayon::prelude::*;

/// The most voxels that a flood may have.
const MOST_VOXELS: usize = 30_000_000;

/// With how many rays a cross-section is looked at.
const RAYS: usize = 24;

/// How far a line may move from the middle of the flood (mm, or in radii where that is more), and how many times as long it may
/// become.
const STRAYED: f64 = 1.5;
const STRAYED_RADII: f64 = 0.5;
const ASTRAY: f64 = 1.25;

/// How far around the seed the tissue is looked at (mm): the widest vessel must not fill it.
const SURROUNDINGS: f64 = 80.0;

/// A vessel has more voxels.
const LEAST_VOXELS: usize = 10;

/// How long the steps of the work take for each voxel of the flood in comparison: ways, branches, centerlines.
const COSTS: [usize; 3] = [1, 12, 3];

/// Where branches end unless somebody asks for another radius (mm).
pub const SMALLEST_RADIUS: f64 = 1.0;

/// What is traced, and how.
pub struct SeedRequest<'a> {
    /// A point in the lumen (mm, LPS).
    pub seed: DVec3,
    /// Branches end where they are narrower from there on (mm).
    pub smallest_radius: f64,
    /// Asked whether to stop.
    pub stop: Stop<'a>,
    /// Told how far the work is.
    pub progress: Option<&'a Progress>,
}

/// The branches that a seed reaches, the doubtful ones last.
///
/// # Errors
/// [`ErrorKind::Tracing`] for a seed outside the volume or in no lumen, where its lumen fills too much of the volume, and
/// where no tube is to be seen around it; [`ErrorKind::Interrupted`].
pub fn trace_from(volume: &Volume, request: &SeedRequest) -> Result<Vec<SeedBranch>> {
    let voxels = &Voxels::new(volume);
    let (model, start) = lumen_at(voxels, request.seed)?;
    let Some(flood) = Flood::from(voxels, &model, start, MOST_VOXELS, request.stop)? else {
        return Err(floods(request.seed, &model));
    };
    let begin = |stage: usize| {
        if let Some(progress) = request.progress {
            progress.begin_stage(COSTS[stage]);
        }
    };
    if let Some(progress) = request.progress {
        progress.expect_views(1);
        progress.begin_view(COSTS.into_iter(), flood.count());
    }
    begin(0);
    let mut region = Region::new(voxels.size, model, Vec::new(), Strictness::Lumen);
    let mut ways = Ways::new(&flood, voxels, &mut region, request.stop)?;
    drop(region);
    begin(1);
    let told = |count: usize| {
        if let Some(progress) = request.progress {
            progress.begin_pixels(count);
        }
    };
    let smallest_radius = request.smallest_radius;
    let search = Search { voxels, model: &model, flood: &flood, smallest_radius, stop: request.stop };
    let kept = search.branches(&mut ways, &told)?;
    drop(ways);
    if kept.len() < LEAST_VOXELS {
        return Err(no_tube(request, &model, flood.count()));
    }
    begin(2);
    let traced = traced(voxels, &model, &flood, &kept, request)?;
    let usual = Usual::of(&model);
    let probe = Probe { voxels, model: &model, rays: RAYS };
    let seen = |vessel: MaskVessel| {
        let line = Centerline { points: vessel.points, radius: vessel.radius, confidence: Vec::new() };
        let confidence = Sections::along(&probe, &line).confidence(&usual);
        let vessel = MaskVessel { points: line.points, radius: line.radius, ..vessel };
        SeenVessel { vessel, confidence }
    };
    let vessels = seed_tree::wide_enough(traced, smallest_radius);
    if vessels.is_empty() {
        return Err(no_tube(request, &model, flood.count()));
    }
    let branches = seed_tree::branches(vessels.into_par_iter().map(seen).collect(), request.seed);
    if let Some(progress) = request.progress {
        progress.end_view();
    }
    Ok(branches)
}

/// The error for a seed whose lumen fills too much of the volume.
fn floods(seed: DVec3, model: &LumenModel) -> Error {
    let [least, most] = bounds(model);
    let found =
        format!("more than {MOST_VOXELS} voxels from {least:.0} to {most:.0} that are joined with it");
    let expected =
        format!("vessels, brighter than the tissue around them, which has up to {:.0}", model.tissue);
    let error = Error::new(ErrorKind::Tracing, format!("seed {}", in_words(seed)), found, expected);
    error.mend("put the seed into the middle of a vessel with contrast medium").at(seed, model.low)
}

/// The error for a seed around which nothing is a vessel.
fn no_tube(request: &SeedRequest, model: &LumenModel, count: usize) -> Error {
    let value = model.low;
    let found = format!("{count} voxels like the {value:.0} there, which are nowhere a tube");
    let expected = format!("a vessel with a radius of {} mm or more", request.smallest_radius);
    let error = Error::new(ErrorKind::Tracing, format!("seed {}", in_words(request.seed)), found, expected);
    let error = error.mend("put the seed into the middle of a vessel, or trace between two points along it");
    error.at(request.seed, value)
}

/// The model of the lumen around the seed, and the voxel of the seed.
fn lumen_at(voxels: &Voxels, seed: DVec3) -> Result<(LumenModel, [i32; 3])> {
    let Some(start) = voxels.voxel_at(seed).filter(|_| seed.is_finite()) else {
        let found = format!("{}, outside the volume", in_words(seed));
        return Err(Error::new(ErrorKind::Tracing, "seed", found, "a point within the volume"));
    };
    let model = Surroundings::within(voxels, &[seed], SURROUNDINGS).model(voxels, &[seed])?;
    Ok((model, start))
}

/// The centerlines of the voxels of the branches.
fn traced(
    voxels: &Voxels,
    model: &LumenModel,
    flood: &Flood,
    kept: &[u32],
    request: &SeedRequest,
) -> Result<Vec<MaskVessel>> {
    let (mut low, mut high) = ([i32::MAX; 3], [0; 3]);
    for &number in kept {
        let voxel = flood.voxel(number);
        for a in 0..3 {
            low[a] = low[a].min(voxel[a] - 1);
            high[a] = high[a].max(voxel[a] + 1);
        }
    }
    let size: [usize; 3] = std::array::from_fn(|a| (high[a] - low[a] + 1).max(0) as usize);
    let strides = [1, size[0], size[0] * size[1]];
    let mut cells = vec![0_u8; size.iter().product()];
    for &number in kept {
        let voxel = flood.voxel(number);
        let place: usize = (0..3).map(|a| (voxel[a] - low[a]) as usize * strides[a]).sum();
        cells[place] = 1;
    }
    let shift = DAffine3::from_translation(DVec3::from_array(low.map(f64::from)));
    let mask = Volume::new(volume::Voxels::U8(&cells), size, strides, voxels.world_from_index * shift)?;
    let refine = |points: &[DVec3], _: &[f64]| {
        let line = refined(voxels, model, points, request.stop)?;
        let strays = line.points.iter().zip(&line.radius).any(|(point, radius)| {
            let far = STRAYED.max(STRAYED_RADII * radius);
            point.distance(points[nearest_point(points, *point)]) > far
        });
        let is_faithful = !strays && length(&line.points) <= ASTRAY * length(points) + STRAYED;
        Ok(is_faithful.then_some(line))
    };
    let how = Skeletonization {
        parent_radii: PARENT_RADII,
        step: STEP,
        refine: Some(&refine),
        stop: request.stop,
        begin: &|_| (),
    };
    Ok(skeleton(Foreground::new(&mask, None, request.stop)?, &how)?.vessels)
}

fn length(points: &[DVec3]) -> f64 {
    arc_lengths(points).last().copied().unwrap_or(0.0)
}
