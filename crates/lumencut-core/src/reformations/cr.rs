//! Centerline Reformation (CR): every pixel takes the depth of the nearest projected centerline. But within a
//! disc around a vessel in front, it takes the depth of that vessel.
//!
//! After Mistelbauer, Varchola, Bouzari, Starinsky, Köchl, Schernthaner, Fleischmann, Gröller and Šrámek,
//! "Centerline Reformations of Complex Vascular Structures", IEEE Pacific Visualization Symposium 2012.
//! docs/method/reformations.md states what is taken from it and what had to be decided.

mod chains;
mod nearest;
mod row;
mod stretch;
mod view;

use rayon::prelude::*;

pub(super) use self::nearest::nearest_slots;
use self::row::CrRow;
pub use self::view::CrParameters;
use self::view::CrView;
use super::found::{Found, expect_lengths, work};
use crate::error::Result;
use crate::frame::Frame;
use crate::math::lanes::dispatch;
use crate::pipeline::Request;
use crate::scene::LeveledTree;

/// The position of every pixel of a view by CR. The settings `centerline_smoothing`, `unknown_radius` and the
/// silhouettes apply; there are neither levels of detail nor a depth filter. Fails with
/// [`crate::error::ErrorKind::Settings`] for a setting or threshold outside its range,
/// [`crate::error::ErrorKind::VesselTree`] for a vessel without length.
pub fn cr(tree: &LeveledTree, parameters: &CrParameters, request: &Request) -> Result<Frame> {
    request.settings.check()?;
    parameters.check()?;
    let levels = tree.levels(0, request.settings.centerline_smoothing);
    expect_lengths(&levels[0])?;
    let (work, view) = (work(request), CrView::new(&levels[0], parameters, request));
    let (mut found, chunk) = (Found::nothing(work.pixels()), work.tile_row());
    let Found { depth, vessel, sheet, .. } = &mut found;
    let rows = depth.par_chunks_mut(chunk).zip(vessel.par_chunks_mut(chunk)).zip(sheet.par_chunks_mut(chunk));
    rows.enumerate().try_for_each(|(row, ((depth, vessel), sheet))| {
        work.begin(depth.len())?;
        dispatch(work.isa, CrRow { view: &view, row, depth, vessel, sheet });
        Ok(())
    })?;
    found.folded = Vec::new();
    found.into_frame(request)
}
