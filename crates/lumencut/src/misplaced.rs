//! Detects centerlines read in the wrong space or unit.

use glam::DVec3;
use lumencut_io::{Space, Unit};

use crate::extent::Extent;
use crate::placement::Judge;
use crate::places::{CoordinateSystem, Reading, mm, places, readings};

/// Whether points in LPS and mm lie outside the volume in every space and unit.
pub fn fits_nowhere(points: &[DVec3], volume: &Extent) -> bool {
    let is_outside = |reading: &Reading| match reading.place.unit {
        Unit::Millimetre => reading.inside == 0,
        _ => reading.fits() == 0,
    };
    readings(points, &places(&Space::ALL, &Unit::ALL), volume).iter().all(is_outside)
}

/// The space and unit in which points fit better.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Misplaced {
    /// The finding, in words.
    pub found: String,
    /// The space and unit that fit points read as LPS in mm. If the space is RAS, points that were read as RAS fit as LPS.
    pub meant: CoordinateSystem,
}

/// A better space and unit for points read as LPS in mm. They may bring twice as many points, and a tenth of all more, into the
/// volume, as when cm were read as mm. Or points are inside in both spaces, but clearly look like lumen only if x and y are
/// negated. Points that span only a few voxels are ignored.
pub fn better_place(points: &[DVec3], volume: &Judge) -> Option<Misplaced> {
    better_by_extent(points, &volume.extent).or_else(|| mirrored_by_values(points, volume))
}

fn better_by_extent(points: &[DVec3], volume: &Extent) -> Option<Misplaced> {
    let mut candidates = places(&Space::ALL, &Unit::ALL);
    // The likeliest mistakes come first, since of equally good candidates the first wins.
    candidates.sort_by_key(|place| place.unit != Unit::Millimetre);
    let readings = readings(points, &candidates, volume);
    let as_read = readings[0];
    let best = readings.iter().rev().max_by_key(|reading| reading.fits())?;
    let total = points.len();
    if !best.is_clearly_better_than(as_read.fits(), total) {
        return None;
    }
    let size = if as_read.is_plausible { String::new() } else { format!(", {} across", mm(as_read.across)) };
    let found = format!(
        "{} of {total} points lie inside the volume as read{size}, but {} {}",
        as_read.inside,
        best.inside,
        best.place.mistaken(),
    );
    Some(Misplaced { found, meant: best.place })
}

fn mirrored_by_values(points: &[DVec3], volume: &Judge) -> Option<Misplaced> {
    let found = readings(points, &places(&Space::ALL, &[Unit::Millimetre]), &volume.extent);
    let [as_read, mirrored] = found[..] else { return None };
    if mirrored.fits() == 0 || !mirrored.is_as_good_as(as_read.fits()) {
        return None;
    }
    let (few, count) = ((volume.lumen)(as_read.place), (volume.lumen)(mirrored.place));
    count.is_evident_over(few).then(|| {
        let how = mirrored.place.mistaken();
        let found = format!(
            "of {} sampled points, {} look like lumen as read, but {} {how}",
            count.of, few.like_lumen, count.like_lumen,
        );
        Misplaced { found, meant: mirrored.place }
    })
}
