//! Traces the centerlines of a mask, as vessels that meet in common points.

pub mod grey_values;
pub(crate) mod labels;
pub(crate) mod mask_gaps;

use crate::trace::mask::labels::parted;
use crate::trace::mask::mask_gaps::{Gap, bridge, gaps};
use crate::trace::skeleton::foreground::Foreground;
use crate::trace::skeleton::mask_refinement::Refine;
use crate::trace::skeleton::mask_vessels::MaskVessel;
use crate::trace::skeleton::{COSTS, Skeleton, Skeletonization, skeleton};
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::progress::Progress;
use lumencut_core::stop::Stop;
use lumencut_core::volume::Volume;

/// How to trace a mask.
pub struct MaskRequest<'a> {
    /// The values of the mask that are lumen; if None, all values except 0.
    pub labels: Option<&'a [i64]>,
    /// Minimum length of a branch, in radii of its parent vessel.
    pub parent_radii: f64,
    /// Maximum distance between neighbouring points (mm).
    pub step: f64,
    /// Maximum width of a gap across which a bridge is built (mm).
    pub bridge: f64,
    /// Function that refines each vessel in a volume, if given.
    pub refine: Option<Refine<'a>>,
    /// Called often; returns whether to stop.
    pub stop: Stop<'a>,
    /// Receives the progress, if given.
    pub progress: Option<&'a Progress>,
}

/// The vessels of a mask, and findings about the mask.
pub struct TracedMask {
    /// Vessels. Those that meet share bit-identical end points.
    pub vessels: Vec<MaskVessel>,
    /// Gaps in the lumen, the narrowest first.
    pub gaps: Vec<Gap>,
    /// Number of filled cavities, and of the voxels in them.
    pub filled: [usize; 2],
    /// Number of connected components of the lumen.
    pub pieces: usize,
}

/// Traces the lumen of a mask. Errors: [`ErrorKind::Volume`] for a mask without lumen or background, with
/// fractional values, of one slice, or with no part longer than wide; [`ErrorKind::Interrupted`].
pub fn trace_mask(mask: &Volume, request: &MaskRequest) -> Result<TracedMask> {
    let begin = |step: usize| {
        if let Some(progress) = request.progress {
            progress.begin_stage(COSTS[step]);
        }
    };
    if let Some(progress) = request.progress {
        progress.expect_views(1);
        progress.begin_view(COSTS.into_iter(), 1);
    }
    begin(0);
    let foreground = Foreground::new(mask, request.labels, request.stop)?;
    let MaskRequest { parent_radii, step, refine, stop, .. } = *request;
    let how = Skeletonization { parent_radii, step, refine, stop, begin: &begin };
    let Skeleton { vessels, filled, pieces, voxels } = skeleton(foreground, &how)?;
    let mut vessels: Vec<MaskVessel> =
        vessels.iter().flat_map(|vessel| parted(vessel, mask, request.labels)).collect();
    let mut gaps = gaps(&vessels, stop)?;
    bridge(&mut vessels, &mut gaps, request.bridge, step);
    if let Some(progress) = request.progress {
        progress.end_view();
    }
    if vessels.is_empty() {
        let found = format!("lumen of {voxels} voxels that is never longer than wide");
        return Err(Error::new(ErrorKind::Volume, "mask", found, "a vessel"));
    }
    Ok(TracedMask { vessels, gaps, filled, pieces })
}
