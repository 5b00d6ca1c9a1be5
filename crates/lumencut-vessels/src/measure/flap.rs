//! True and false lumen of a dissected vessel: two contours of one section, parted by a flap. The flap is a thin dark
//! sheet through the vessel, which may be too thin to be as dark as a wall.

pub(crate) mod basins;
pub(crate) mod edges;
pub mod found;
pub(crate) mod outlines;
pub(crate) mod pair;
pub(crate) mod plane_map;

use rayon::prelude::*;

use crate::measure::flap::found::{Flap, LumenPair};
use crate::measure::flap::pair::{PairLevels, Search};
use crate::measure::outer::is_uneven;
use crate::measure::section::SectionPlane;
use crate::measure::section::blur::Blur;
use crate::voxels::Voxels;
use lumencut_core::error::Result;
use lumencut_core::stop::{Stop, go_on};

/// Two lumens are similar over at least this length (mm).
const LEAST_LENGTH_MM: f64 = 10.0;

/// Maximum gap within that length (mm).
pub(crate) const GAP_MM: f64 = 4.0;

/// Maximum relative difference of the diameter of a lumen from the median within `LEAST_LENGTH_MM`.
const SIMILAR: f64 = 0.12;

/// The other lumen moves at most by this fraction of its diameter from one section to the next, besides the distance.
const MOVES: f64 = 0.5;

/// Flaps are searched at this distance (mm), and in between next to those that are found.
const EVERY_MM: f64 = 2.0;

/// A section as the search for a flap needs it.
pub(crate) struct OnLine<'a> {
    pub place: &'a SectionPlane,
    /// Level of the lumen, in the volume's unit.
    pub lumen: f64,
    /// Why no flap is searched here, if so.
    pub none: Option<Flap>,
}

/// Finds the two lumens of each section. `flap` is the level of a flap in HU, if it is known; `noise` that of a voxel.
pub(crate) fn lumen_pairs(
    voxels: &Voxels,
    (sections, flap): (&[OnLine], Option<[f64; 2]>),
    (blur, noise): (&Blur, f64),
    stop: Stop,
) -> Result<Vec<LumenPair>> {
    let Some(flap) = flap else { return Ok(vec![LumenPair::none(Flap::NoLevel); sections.len()]) };
    let find = |one: &OnLine| {
        go_on(stop)?;
        if let Some(why) = one.none {
            return Ok(LumenPair::none(why));
        }
        let levels = PairLevels { lumen: one.lumen, flap, noise };
        let search = Search { voxels, place: one.place, levels, blur };
        Ok(search.pair().unwrap_or_else(LumenPair::none))
    };
    let at: Vec<f64> = sections.iter().map(|one| one.place.at).collect();
    let first = at.first().copied().unwrap_or(0.0);
    let every = at.partition_point(|at| *at < first + EVERY_MM).max(1);
    let some: Vec<LumenPair> = sections.par_iter().step_by(every).map(find).collect::<Result<_>>()?;
    let between = |n: usize| {
        let around = [n / every, n.div_ceil(every).min(some.len() - 1)];
        let nearest = &some[around[usize::from(2 * (n % every) > every)]];
        match n % every {
            0 => Ok(nearest.clone()),
            _ if around.iter().any(|n| some[*n].found == Flap::Seen) => find(&sections[n]),
            _ => Ok(LumenPair::none(sections[n].none.unwrap_or(nearest.found))),
        }
    };
    let mut found: Vec<LumenPair> =
        (0..sections.len()).into_par_iter().map(between).collect::<Result<_>>()?;
    leave_out_uneven(&at, &mut found);
    Ok(found)
}

fn leave_out_uneven(at: &[f64], found: &mut [LumenPair]) {
    for lumen in 0..2 {
        let diameters: Vec<f64> = found.iter().map(|pair| pair.areas[lumen][0].sqrt()).collect();
        let uneven = is_uneven(at, &diameters, (LEAST_LENGTH_MM, SIMILAR, GAP_MM));
        for (pair, _) in found.iter_mut().zip(uneven).filter(|(_, is_uneven)| *is_uneven) {
            *pair = LumenPair::none(Flap::Uneven);
        }
    }
    leave_out_changing(at, found);
}

/// Leaves out stretches shorter than `LEAST_LENGTH_MM` that show the same other lumen: neighbours come and go.
fn leave_out_changing(at: &[f64], found: &mut [LumenPair]) {
    let seen: Vec<usize> = (0..found.len()).filter(|n| found[*n].found == Flap::Seen).collect();
    let is_same = |a: &usize, b: &usize| {
        let gap = at[*b] - at[*a];
        gap <= GAP_MM && found[*a].other_moves(&found[*b]) <= gap + MOVES * found[*a].other_diameter()
    };
    let runs: Vec<Vec<usize>> = seen.chunk_by(is_same).map(<[usize]>::to_vec).collect();
    let is_short = |run: &&Vec<usize>| at[run[run.len() - 1]] - at[run[0]] < LEAST_LENGTH_MM;
    for n in runs.iter().filter(is_short).flatten() {
        found[*n] = LumenPair::none(Flap::Uneven);
    }
}

#[cfg(test)]
#[path = "flap/tests/flap.rs"]
mod tests;
