//! Writers of vessels. What `.vtp` and `.mrk.json` hold is read back to the bit, with nothing joined or left
//! out; `.vtk` keeps all but names, `.csv` and `.swc` what tables and nodes can hold.
//!
//! Coordinates and radii stand in the shortest decimals that give the same numbers back. The first three
//! are marked as vessels already (`LumencutVessels`), so that no reader of this crate joins their lines anew;
//! other programs pass over the mark. Groups are not written: they tell which lines are one vessel.

mod cell;
mod csv;
pub(crate) mod mrk_json;
mod swc;
mod vtk;
mod vtp;

pub use cell::marked_cell;
pub use csv::write_csv;
pub use mrk_json::write_mrk_json;
pub use swc::write_swc;
pub use vtk::write_vtk;
pub use vtp::write_vtp;

use crate::centerlines::{Limit, Line, check};
use crate::error::{Error, Result};
use crate::unit::Unit;

/// The array, column or measurement of how sure the points are.
const CONFIDENCE: &str = "Confidence";

/// The confidence of all points, one vessel after the other; none where no vessel was traced, and 1 for the points of
/// vessels that were not.
fn confidences(vessels: &[Line]) -> Option<Vec<f64>> {
    vessels.iter().any(|vessel| vessel.confidence.is_some()).then(|| {
        let of = |vessel: &Line| vessel.confidence.clone().unwrap_or_else(|| vec![1.0; vessel.points.len()]);
        vessels.iter().flat_map(of).collect()
    })
}

/// Checks that reading gives every vessel back.
///
/// # Errors
/// Where there is no vessel, or one is not what a [`Line`] is.
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
        if let Some(radius) = vessel.radius.as_ref().filter(|radius| radius.len() != count) {
            let found = format!("{} radii for {count} points", radius.len());
            return Err(Error::new(format!("radius of line {index}"), found, "one radius per point"));
        }
    }
    Ok(())
}
