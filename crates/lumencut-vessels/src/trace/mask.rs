//! Centerlines of a mask: from its voxels to vessels that meet in common points.

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

/// What is traced, and how.
pub struct MaskRequest<'a> {
    /// The values that stand for lumen; without them every value but 0.
    pub labels: Option<&'a [i64]>,
    /// How long a branch must be to stay, in radii of its parent.
    pub parent_radii: f64,
    /// The largest distance between neighbouring points (mm).
    pub step: f64,
    /// The widest gap that is bridged (mm).
    pub bridge: f64,
    /// What moves each vessel into the middle of what the volume shows, and measures its radius there.
    pub refine: Option<Refine<'a>>,
    /// Asked whether to stop.
    pub stop: Stop<'a>,
    /// Told how far the work is.
    pub progress: Option<&'a Progress>,
}

/// The vessels of a mask, and what was found on the way.
pub struct TracedMask {
    /// The vessels; those that meet share their end points to the bit.
    pub vessels: Vec<MaskVessel>,
    /// Between which vessels lumen is missing, the narrowest gap first.
    pub gaps: Vec<Gap>,
    /// How many cavities were filled, and how many voxels they had.
    pub filled: [usize; 2],
    /// How many pieces the lumen has, whose voxels touch nowhere.
    pub pieces: usize,
}

/// The centerlines of the lumen of a mask.
///
/// # Errors
/// [`ErrorKind::Volume`] for a mask without lumen or background, of floats, of one slice, or whose lumen has no
/// part that is longer than wide; [`ErrorKind::Interrupted`] where the caller asks to stop.
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
        let found = format!("lumen of {voxels} voxels that is nowhere longer than wide");
        return Err(Error::new(ErrorKind::Volume, "mask", found, "a vessel"));
    }
    Ok(TracedMask { vessels, gaps, filled, pieces })
}
