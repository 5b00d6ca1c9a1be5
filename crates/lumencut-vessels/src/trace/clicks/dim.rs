//! Clicks in dim lumen, such as a false lumen that contrast medium hardly reaches. Their values are those of tissue, so
//! they are accepted only together with a click in clear lumen.

use glam::DVec3;

use crate::trace::clicks::checks::Clicks;
use crate::trace::clicks::closure::{DIM_HU, is_dim_lumen};
use crate::trace::lumen::lumen_model::{LumenModel, lower_median};
use crate::trace::lumen::surroundings::{Surroundings, noise, value_at};
use crate::voxels::Voxels;
use lumencut_core::error::Result;

/// The model of the clear lumen, and the clicks in dim lumen: those that the model refuses, and that may be dim lumen.
pub(crate) fn model_beside_dim(
    voxels: &Voxels,
    surroundings: &Surroundings,
    clicks: &Clicks,
) -> Result<(LumenModel, Vec<DVec3>)> {
    let all: Vec<DVec3> = clicks.vessels.iter().flatten().copied().collect();
    let refused = match surroundings.model(voxels, &all) {
        Ok(model) => return Ok((model, Vec::new())),
        Err(refused) => refused,
    };
    let (dim, clear): (Vec<DVec3>, Vec<DVec3>) =
        all.iter().partition(|click| value_at(voxels, **click) <= DIM_HU[1]);
    let is_in =
        |some: &[DVec3]| clicks.vessels.iter().all(|points| points.iter().any(|click| some.contains(click)));
    if !is_in(&clear) {
        return Err(refused);
    }
    let noise = lower_median(clear.iter().map(|click| noise(voxels, *click)).collect());
    let with = |click: &DVec3| surroundings.model(voxels, &[clear.as_slice(), &[*click]].concat());
    let (dim, taken): (Vec<DVec3>, Vec<DVec3>) = dim.into_iter().partition(|click| with(click).is_err());
    let model = surroundings.model(voxels, &[clear, taken].concat()).map_err(|_| refused.clone())?;
    let is_accepted = model.is_hounsfield && dim.iter().all(|click| is_dim_lumen(voxels, *click, noise));
    if is_accepted { Ok((model, dim)) } else { Err(refused) }
}
