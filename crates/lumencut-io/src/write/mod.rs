//! Writers of vessels. `.vtp` and `.mrk.json` are read back bit-identically; `.vtk` keeps everything except names,
//! `.csv` and `.swc` keep what their format can hold. Numbers are written as the shortest decimals that restore them.
//! The first three formats carry the mark `LumencutVessels`, so that this crate does not join their lines again.
//! Groups are not written.

mod csv;
pub(crate) mod mrk_json;
mod swc;
mod vtk;
mod vtp;

pub use csv::{marked_cell, write_csv};
pub use mrk_json::write_mrk_json;
pub use swc::write_swc;
pub use vtk::write_vtk;
pub use vtp::write_vtp;

use crate::centerlines::{Limit, Line, check};
use crate::error::{Error, Result};
use crate::unit::Unit;

/// Name of the array, column or measurement that holds confidences.
const CONFIDENCE: &str = "Confidence";

/// Confidence of all points, which is 1 for vessels that were not traced. None if no vessel was traced.
fn confidences(vessels: &[Line]) -> Option<Vec<f64>> {
    vessels.iter().any(|vessel| vessel.confidence.is_some()).then(|| {
        let of = |vessel: &Line| vessel.confidence.clone().unwrap_or_else(|| vec![1.0; vessel.points.len()]);
        vessels.iter().flat_map(of).collect()
    })
}

/// Name of the array or measurement that marks points that a reader moved.
const BY_HAND: &str = "ByHand";

/// 1 for points that a reader moved, otherwise 0. None if none was moved.
fn moved(vessels: &[Line]) -> Option<Vec<f64>> {
    vessels.iter().any(|vessel| vessel.by_hand.is_some()).then(|| {
        let is_moved = |vessel: &Line, n: usize| vessel.by_hand.as_ref().is_some_and(|by_hand| by_hand[n]);
        let of = |vessel: &Line| -> Vec<f64> {
            (0..vessel.points.len()).map(|n| f64::from(is_moved(vessel, n))).collect()
        };
        vessels.iter().flat_map(of).collect()
    })
}

pub(crate) fn check_all(vessels: &[Line]) -> Result<()> {
    if vessels.is_empty() {
        return Err(Error::new("vessels", "none", "at least one vessel"));
    }
    for (index, vessel) in vessels.iter().enumerate() {
        check(vessel, index, &Limit::of(Some(Unit::Millimetre)))?;
        let count = vessel.points.len();
        let subject = || format!("points of line {index}");
        if count < 2 {
            return Err(Error::new(subject(), format!("{count} point(s)"), "at least 2 points"));
        }
        if let Some(i) = (1..count).find(|i| vessel.points[*i] == vessel.points[i - 1]) {
            let found = format!("point {i} equal to the one before");
            return Err(Error::new(subject(), found, "no two neighbours equal").mend("leave one of them out"));
        }
        if let Some(confidence) = vessel.confidence.as_ref().filter(|confidence| confidence.len() != count) {
            let found = format!("{} for {count} points", confidence.len());
            return Err(Error::new(format!("confidence of line {index}"), found, "one number per point"));
        }
        if let Some(by_hand) = vessel.by_hand.as_ref().filter(|by_hand| by_hand.len() != count) {
            let found = format!("{} for {count} points", by_hand.len());
            return Err(Error::new(format!("points by hand of line {index}"), found, "one for each point"));
        }
        if let Some(radius) = vessel.radius.as_ref().filter(|radius| radius.len() != count) {
            let found = format!("{} radii for {count} points", radius.len());
            return Err(Error::new(format!("radius of line {index}"), found, "one radius per point"));
        }
    }
    Ok(())
}
