//! Traces the lines of a vessel mask. The voxels of the mask are held only while it is traced.

use std::collections::HashSet;

use crate::mask_grid::{Grid, MaskPlace, place_of, placed_note};
use crate::mask_notes::notes;
use glam::DVec3;
use lumencut_core::error::{Error, ErrorKind};
use lumencut_core::scene::VolumeKey;
use lumencut_core::volume::Volume;
use lumencut_vessels::trace::lines::centerline::Centerline;
use lumencut_vessels::trace::lumen::refine::STEP;
use lumencut_vessels::trace::mask::grey_values::GreyValues;
use lumencut_vessels::trace::mask::{MaskRequest, TracedMask, trace_mask};
use lumencut_vessels::trace::skeleton::PARENT_RADII;
use lumencut_vessels::trace::skeleton::mask_vessels::MaskVessel;
use lumencut_vessels::voxels::Voxels;

use crate::study::failure::{Failure, Result};
use crate::study::held_volume::{HeldMask, HeldVolume, VolumeHeader, no_volume};
use crate::study::lines::{Line, NamedLine};
use crate::study::open_study::Study;
use crate::study::tracing::Watch;
use crate::study::voxels::Stored;

/// A volume with more distinct values than this is a scan, not a mask.
const MOST_LABELS: usize = 1000;

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MaskLines {
    /// The lines, named by label; without names if the mask has only one label.
    pub lines: Vec<NamedLine>,
    pub(crate) notes: Vec<String>,
}

impl Study {
    /// Fails with an error of kind `volume` if a volume with this header is no mask of the open scan.
    pub fn check_mask(&self, header: &str) -> Result<()> {
        let scan = self.content.held.as_ref().ok_or_else(no_volume)?;
        place_of(&VolumeHeader::read(header)?.grid(), &Grid::from(&scan.volume()?))?;
        Ok(())
    }

    /// Allocates memory for a mask, whose voxels then follow as bytes. Fails with an error of kind `volume` if no
    /// scan is open, memory is insufficient, or the grid does not suit that of the scan.
    pub fn begin_mask(&mut self, header: &str) -> Result<()> {
        self.mask = None;
        self.check_mask(header)?;
        let header = VolumeHeader::read(header)?;
        self.mask = Some(HeldMask { held: header.held()?, label_names: header.label_names });
        Ok(())
    }

    /// `count` writable bytes of the mask's voxels from `offset` on. Fails with an error of kind `volume` if the
    /// bytes lie beyond the end of the mask.
    pub fn mask_bytes(&mut self, offset: usize, count: usize) -> Result<&mut [u8]> {
        HeldVolume::bytes(self.mask.as_mut().map(|mask| &mut mask.held), offset, count)
    }

    /// Frees the memory of the mask.
    pub fn end_mask(&mut self) {
        self.mask = None;
    }

    pub(crate) fn trace_mask(&mut self, watch: Watch) -> Result<MaskLines> {
        let HeldMask { held, label_names } = self.mask.take().ok_or_else(no_mask)?;
        let scan = self.content.held.as_ref().ok_or_else(no_volume)?;
        let volume = scan.volume()?.with_polarity(self.content.polarity);
        let place = place_of(&Grid::from(&held.volume()?), &Grid::from(&volume))?;
        let mut all_notes: Vec<String> = place.iter().map(|_| placed_note(held.size, scan.size)).collect();
        let mask = place.map_or(Ok(None), |place| placed(&held, &place, scan).map(Some))?.unwrap_or(held);
        check_labels(&mask.stored)?;
        let traced = traced(&mask.volume()?, &volume, watch)?;
        all_notes.extend(notes(&traced, &mask.volume()?, true));
        drop(mask);
        let several = traced.vessels.iter().any(|vessel| vessel.label != traced.vessels[0].label);
        let added = traced.vessels.into_iter().map(|vessel| {
            let numbered = || if several { format!("label {}", vessel.label) } else { String::new() };
            let name = label_names.get(&vessel.label).cloned().unwrap_or_else(numbered);
            Ok(NamedLine { line: self.lines.add(line_of(vessel))?, name })
        });
        Ok(MaskLines { lines: added.collect::<Result<_>>()?, notes: all_notes })
    }
}

/// The mask on the volume's grid; 0 outside the mask.
fn placed(mask: &HeldVolume, place: &MaskPlace, volume: &HeldVolume) -> Result<HeldVolume> {
    let [ni, nj, nk] = volume.size;
    let strides = [1, ni, ni * nj];
    let along = |axis: usize, index: usize| {
        let own = place.axes[axis];
        let ahead = if place.forward[own] { index } else { mask.size[axis] - 1 - index };
        strides[own] * (place.low[own] + ahead)
    };
    let [mi, mj, mk] = mask.size;
    let columns = (0..mk).flat_map(|k| (0..mj).map(move |j| (j, k)));
    let at = columns.flat_map(|(j, k)| {
        let start = along(1, j) + along(2, k);
        (0..mi).map(move |i| start + along(0, i))
    });
    let stored = mask.stored.placed(ni * nj * nk, at)?;
    Ok(HeldVolume {
        stored,
        size: volume.size,
        world_from_index: volume.world_from_index,
        key: VolumeKey::default(),
        scan: mask.scan.clone(),
    })
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

fn check_labels(stored: &Stored) -> Result<()> {
    let is_scan = match stored {
        Stored::U8(_) => return Ok(()),
        Stored::U16(values) => has_many(values.iter().map(|value| u32::from(*value))),
        Stored::I16(values) => has_many(values.iter().map(|value| *value as u32)),
        Stored::F32(values) => has_many(values.iter().map(|value| value.to_bits())),
    };
    if is_scan {
        let expected = format!("a mask with at most {MOST_LABELS} labels");
        let error = Error::new(ErrorKind::Volume, "mask", "more distinct values, as in a scan", expected);
        return Err(error.mend("open the segmentation of the vessels, or open the file as a scan").into());
    }
    Ok(())
}

/// Whether there are too many distinct values. It is fast if equal values follow each other.
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
    Failure { kind: "volume", ..Failure::of_message("mask", &"none", "a mask that was read") }
}
