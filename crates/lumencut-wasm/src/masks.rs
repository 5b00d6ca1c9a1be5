//! The lines of a mask of vessels that comes beside the volume: its voxels are held as long as it is traced.

use glam::DVec3;
use lumencut::error::{Error, ErrorKind};
use lumencut::mask_notes::{check_same_grid, notes};
use lumencut::trace::grey_values::GreyValues;
use lumencut::trace::mask::{Request, TracedMask, trace_mask};
use lumencut::trace::mask_vessels::MaskVessel;
use lumencut::trace::refine::Centerline;
use lumencut::trace::voxels::Voxels;
use lumencut::volume::Volume;
use serde::Serialize;

use crate::failure::{Failure, Result};
use crate::files::VolumeHeader;
use crate::lines::{Line, NamedLine};
use crate::session::{Session, no_volume};
use crate::study::Held;
use crate::tracing::Watch;
use crate::voxels::Stored;

/// How long a branch must be to stay (radii of its parent), and how far apart points are (mm).
const PARENT_RADII: f64 = 2.0;
const STEP: f64 = 0.5;

/// A volume with more values is a scan and no mask.
const MOST_LABELS: usize = 1000;

/// The lines of a mask, and what was odd about it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MaskLines {
    /// The lines, each with the name of its label; empty where the mask has one alone.
    pub lines: Vec<NamedLine>,
    /// One sentence each.
    pub notes: Vec<String>,
}

impl Session {
    /// Makes room for a mask; its voxels follow as bytes.
    ///
    /// # Errors
    /// `volume` where no scan is open that it could belong to, where there is no memory for it, and for a grid that is none.
    pub fn begin_mask(&mut self, header: &str) -> Result<()> {
        self.mask = None;
        self.study.held.as_ref().ok_or_else(no_volume)?;
        self.mask = Some(VolumeHeader::read(header)?.held()?);
        Ok(())
    }

    /// The bytes of the voxels of the mask from `offset` on, `count` of them, to be written.
    ///
    /// # Errors
    /// `volume` where the mask ends before.
    pub fn mask_bytes(&mut self, offset: usize, count: usize) -> Result<&mut [u8]> {
        Held::bytes(self.mask.as_mut(), offset, count)
    }

    /// Forgets the mask; its memory is free again.
    pub fn end_mask(&mut self) {
        self.mask = None;
    }

    /// The lines of the mask, refined by the values of the volume. The mask is forgotten, whatever comes of it.
    ///
    /// # Errors
    /// `volume` for a mask that is none or lies elsewhere than the volume, `interrupted`.
    pub fn trace_mask(&mut self, watch: Watch) -> Result<MaskLines> {
        let mask = self.mask.take().ok_or_else(no_mask)?;
        let volume = self.study.held.as_ref().ok_or_else(no_volume)?.volume()?;
        check_same_grid(&mask.volume()?, &volume)?;
        let mask = Held { stored: labels(mask.stored)?, ..mask };
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
    let request = Request {
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

/// The voxels as labels: floats that are all whole numbers become integers.
fn labels(stored: Stored) -> Result<Stored> {
    let whole = match &stored {
        Stored::F32(values) => {
            let fits = |value: &f32| value.fract() == 0.0 && (0.0..=65535.0).contains(value);
            if let Some(odd) = values.iter().find(|value| !fits(value)) {
                let expected = "whole numbers from 0 to 65535, 0 for background";
                return Err(refused(format!("a voxel of {odd}"), expected));
            }
            Stored::U16(values.iter().map(|value| *value as u16).collect())
        }
        _ => stored,
    };
    let mut is_there = vec![false; 1 << 16];
    match &whole {
        Stored::U8(values) => values.iter().for_each(|value| is_there[usize::from(*value)] = true),
        Stored::U16(values) => values.iter().for_each(|value| is_there[usize::from(*value)] = true),
        Stored::I16(values) => values.iter().for_each(|value| is_there[usize::from(*value as u16)] = true),
        Stored::F32(_) => {}
    }
    let count = is_there.into_iter().filter(|is_there| *is_there).count();
    if count > MOST_LABELS {
        let expected = format!("a mask with at most {MOST_LABELS} labels");
        return Err(refused(format!("{count} different values, as a scan has"), &expected));
    }
    Ok(whole)
}

fn refused(found: String, expected: &str) -> Failure {
    let error = Error::new(ErrorKind::Volume, "mask", found, expected);
    error.mend("open the segmentation of the vessels, or open the file as a scan").into()
}

fn no_mask() -> Failure {
    Failure { kind: "volume", ..Failure::of_message("mask", &"none", "one that was read") }
}
