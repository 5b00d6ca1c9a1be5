//! The outside of a wall that is thick because of thrombus or plaque, as in an aneurysm: the border between a layer of
//! soft tissue around the lumen and the fat or lung around it. It is never the lumen.

pub(crate) mod border;
pub(crate) mod closed_path;
pub mod found;
pub(crate) mod outline;
pub(crate) mod polar_map;

use glam::DVec3;
use rayon::prelude::*;

use crate::measure::outer::border::{Layer, Levels};
use crate::measure::outer::found::{Outer, OuterWall};
use crate::measure::section::SectionPlane;
use crate::measure::section::blur::Blur;
use crate::voxels::Voxels;
use lumencut_core::error::Result;
use lumencut_core::math::statistics::median;
use lumencut_core::stop::{Stop, go_on};

/// An outer wall is similar over at least this length (mm).
const LEAST_LENGTH_MM: f64 = 5.0;

/// Maximum gap within that length (mm).
const GAP_MM: f64 = 2.0;

/// Maximum relative difference of a diameter from the median within `LEAST_LENGTH_MM`.
const SIMILAR: f64 = 0.1;

/// A section as the search for its outer wall needs it.
pub(crate) struct Inner<'a> {
    pub place: &'a SectionPlane,
    /// Contour of the lumen (mm, LPS).
    pub contour: &'a [DVec3],
    /// Level of the lumen, in the volume's unit.
    pub lumen: f64,
    /// Why no outer wall is searched here, if so.
    pub none: Option<OuterWall>,
}

/// Finds the outer walls of the sections of a vessel. `middle` is the level of the layer in HU, if it is known.
pub(crate) fn outer_walls(
    voxels: &Voxels,
    (inner, middle): (&[Inner], Option<[f64; 2]>),
    blur: &Blur,
    stop: Stop,
) -> Result<Vec<Outer>> {
    let find = |one: &Inner| {
        go_on(stop)?;
        let Some(middle) = middle else { return Ok(Outer::none(OuterWall::NoLevel)) };
        if let Some(why) = one.none {
            return Ok(Outer::none(why));
        }
        let width = blur.width(one.place);
        let layer = Layer { voxels, place: one.place, levels: Levels::of(one.lumen, middle), width };
        Ok(layer.outer(one.contour).unwrap_or_else(Outer::none))
    };
    let mut found: Vec<Outer> = inner.par_iter().map(find).collect::<Result<_>>()?;
    let at: Vec<f64> = inner.iter().map(|one| one.place.at).collect();
    leave_out_uneven(&at, &mut found);
    Ok(found)
}

fn leave_out_uneven(at: &[f64], found: &mut [Outer]) {
    let diameters: Vec<f64> = found.iter().map(|one| one.diameter[0]).collect();
    let uneven = is_uneven(at, &diameters, (LEAST_LENGTH_MM, SIMILAR, GAP_MM));
    for (one, _) in found.iter_mut().zip(uneven).filter(|(_, is_uneven)| *is_uneven) {
        *one = Outer::none(OuterWall::Uneven);
    }
}

/// Which diameters differ from the median within `length` mm by more than the fraction `similar`, or belong to a stretch
/// shorter than that, across gaps up to `gap` mm. NaN is no diameter.
pub(crate) fn is_uneven(at: &[f64], diameters: &[f64], (length, similar, gap): (f64, f64, f64)) -> Vec<bool> {
    let is_unlike = |n: usize| {
        let near = |m: &usize| (at[*m] - at[n]).abs() <= length;
        let around = (0..at.len()).filter(near).map(|m| diameters[m]);
        let middle = median(&mut around.filter(|diameter| diameter.is_finite()).collect::<Vec<f64>>());
        middle.is_some_and(|middle| (diameters[n] / middle - 1.0).abs() > similar)
    };
    let mut uneven: Vec<bool> = (0..at.len()).map(is_unlike).collect();
    let even: Vec<usize> = (0..at.len()).filter(|n| diameters[*n].is_finite() && !uneven[*n]).collect();
    for run in even.chunk_by(|a, b| at[*b] - at[*a] <= gap) {
        let ends = run.last().map_or(0.0, |last| at[*last] - at[run[0]]);
        for n in run {
            uneven[*n] = ends < length;
        }
    }
    uneven
}

#[cfg(test)]
#[path = "outer/tests/outer.rs"]
mod tests;
