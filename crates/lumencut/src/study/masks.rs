//! The lines of a mask of vessels that comes beside the volume: its voxels are held as long as it is traced.

use std::collections::HashSet;

use crate::mask_notes::{check_same_grid, notes};
use glam::DVec3;
use lumencut_core::error::{Error, ErrorKind};
use lumencut_core::volume::Volume;
use lumencut_vessels::trace::lines::centerline::Centerline;
use lumencut_vessels::trace::lumen::refine::STEP;
use lumencut_vessels::trace::mask::grey_values::GreyValues;
use lumencut_vessels::trace::mask::{MaskRequest, TracedMask, trace_mask};
use lumencut_vessels::trace::skeleton::PARENT_RADII;
use lumencut_vessels::trace::skeleton::mask_vessels::MaskVessel;
use lumencut_vessels::voxels::Voxels;

use crate::study::failure::{Failure, Result};
use crate::study::held_volume::VolumeHeader;
use crate::study::held_volume::{HeldVolume, no_volume};
use crate::study::lines::{Line, NamedLine};
use crate::study::open_study::Study;
use crate::study::tracing::Watch;
use crate::study::voxels::Stored;

/// A volume with more values is a scan and no mask.
const MOST_LABELS: usize = 1000;

/// The lines of a mask, and what was odd about it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MaskLines {
    /// The lines, each with the name of its label; empty where the mask has one alone.
    pub lines: Vec<NamedLine>,
    /// One sentence each.
    pub notes: Vec<String>,
}

impl Study {
    /// Makes room for a mask; its voxels follow as bytes.
    ///
    /// # Errors
    /// `volume` where no scan is open that it could belong to, where there is no memory for it, and for an invalid grid.
    pub fn begin_mask(&mut self, header: &str) -> Result<()> {
        self.mask = None;
        self.content.held.as_ref().ok_or_else(no_volume)?;
        self.mask = Some(VolumeHeader::read(header)?.held()?);
        Ok(())
    }

    /// The bytes of the voxels of the mask from `offset` on, `count` of them, to be written.
    ///
    /// # Errors
    /// `volume` where the mask ends before.
    pub fn mask_bytes(&mut self, offset: usize, count: usize) -> Result<&mut [u8]> {
        HeldVolume::bytes(self.mask.as_mut(), offset, count)
    }

    /// Forgets the mask; its memory is free again.
    pub fn end_mask(&mut self) {
        self.mask = None;
    }

    /// The lines of the mask, refined by the values of the volume. The mask is forgotten, whatever comes of it.
    ///
    /// # Errors
    /// `volume` for an invalid mask, or one that lies elsewhere than the volume, `interrupted`.
    pub(crate) fn trace_mask(&mut self, watch: Watch) -> Result<MaskLines> {
        let mask = self.mask.take().ok_or_else(no_mask)?;
        let volume = self.content.held.as_ref().ok_or_else(no_volume)?.volume()?;
        check_same_grid(&mask.volume()?, &volume)?;
        check_labels(&mask.stored)?;
        let traced = traced(&mask.volume()?, &volume, watch)?;
        let notes = notes(&traced, &mask.volume()?, true);
        drop(mask);
        let several = traced.vessels.iter().any(|vessel| vessel.label != traced.vessels[0].label);
        let added = traced.vessels.into_iter().map(|vessel| {
            let name = if several { format!("label {}", vessel.label) } else { String::new() };
            Ok(NamedLine { line: self.lines.add(line_of(vessel))?, name })
        });
        Ok(MaskLines { lines: added.collect::<Result<_>>()?, notes })
    }
}

fn traced(mask: &Volume, volume: &Volume, Watch { stop, progress }: Watch) -> Result<TracedMask> {
    let voxels = Voxels::new(volume);
    let values = GreyValues { voxels: &voxels, stop };
    let refine = |points: &[DVec3], radius: &[f64]| values.refined(points, radius);
    let request = MaskRequest {
        labels: None,
        parent_radii: PARENT_RADII,
        step: STEP,
        bridge: 0.0,
        refine: Some(&refine),
        stop,
        progress: Some(progress),
    };
    Ok(trace_mask(mask, &request)?)
}

fn line_of(vessel: MaskVessel) -> Line {
    let MaskVessel { points, radius, confidence, is_bridge, .. } = vessel;
    let bridged = Some(vec![is_bridge; points.len()]);
    Line { bridged, ..Line::from(Centerline { points, radius, confidence }) }
}

/// Refuses a mask with as many values as a scan has.
fn check_labels(stored: &Stored) -> Result<()> {
    let is_scan = match stored {
        Stored::U8(_) => return Ok(()),
        Stored::U16(values) => has_many(values.iter().map(|value| u32::from(*value))),
        Stored::I16(values) => has_many(values.iter().map(|value| *value as u32)),
        Stored::F32(values) => has_many(values.iter().map(|value| value.to_bits())),
    };
    if is_scan {
        let expected = format!("a mask with at most {MOST_LABELS} labels");
        let error = Error::new(ErrorKind::Volume, "mask", "more different values, as a scan has", expected);
        return Err(error.mend("open the segmentation of the vessels, or open the file as a scan").into());
    }
    Ok(())
}

/// Whether there are more different values than labels may be; most are as the one before.
fn has_many(values: impl Iterator<Item = u32>) -> bool {
    let mut different = HashSet::new();
    let mut last = None;
    for value in values {
        if last != Some(value) {
            last = Some(value);
            different.insert(value);
            if different.len() > MOST_LABELS {
                return true;
            }
        }
    }
    false
}

fn no_mask() -> Failure {
    Failure { kind: "volume", ..Failure::of_message("mask", &"none", "one that was read") }
}
