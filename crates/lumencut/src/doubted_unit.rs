//! Detects centerlines read in the wrong unit: their size is implausible, or they fit the volume better in another unit.

use std::cmp::Reverse;

use glam::DVec3;
use lumencut_io::Unit;

use crate::lumen_points::Judge;
use crate::places::{CoordinateSystem, LARGEST, Reading, SMALLEST, across, mm, places, readings};

/// A unit that may be wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Doubt {
    /// The finding, in words.
    pub found: String,
    /// Units that fit better, the likeliest first; may be empty.
    pub units: Vec<Unit>,
}

/// Describes evidence against the unit in which the points of a file are read.
pub(crate) fn doubted_unit(
    points: &[DVec3],
    place: CoordinateSystem,
    volume: Option<&Judge>,
) -> Option<Doubt> {
    match volume {
        Some(volume) => doubted_by_volume(points, place, volume),
        None => doubted_by_size(points, place),
    }
}

fn doubted_by_size(points: &[DVec3], place: CoordinateSystem) -> Option<Doubt> {
    let bare = across(points);
    let is_size = |unit: &Unit| (SMALLEST..=LARGEST).contains(&(bare * unit.in_mm()));
    if is_size(&place.unit) {
        return None;
    }
    let units: Vec<Unit> = Unit::ALL.into_iter().filter(is_size).collect();
    let sizes = units.iter().map(|unit| format!(", {} in {}", mm(bare * unit.in_mm()), unit.name()));
    let size = mm(bare * place.unit.in_mm());
    let found = format!("the lines are {size} across in {}{}", place.unit.name(), sizes.collect::<String>());
    Some(Doubt { found, units })
}

fn doubted_by_volume(points: &[DVec3], place: CoordinateSystem, volume: &Judge) -> Option<Doubt> {
    let all = readings(points, &places(&[place.space], &Unit::ALL), &volume.extent);
    let as_read = all.iter().find(|reading| reading.place == place)?;
    let mut others: Vec<&Reading> =
        all.iter().filter(|other| other.place != place && other.fits() > 0 && !other.is_short()).collect();
    others.sort_by_key(|other| Reverse(other.fits()));
    others.retain(|other| is_likelier(other, as_read, points.len(), volume));
    let is_no_size = !as_read.is_plausible || as_read.across > LARGEST;
    if others.is_empty() && !is_no_size {
        return None;
    }
    let reading_words = |reading: &Reading| {
        format!(
            "{} across in {}, with {} of {} points inside the volume",
            mm(reading.across),
            reading.place.unit.name(),
            reading.inside,
            points.len()
        )
    };
    let instead: String = others.iter().map(|other| format!("; {}", reading_words(other))).collect();
    let found = format!("the lines are {}{instead}", reading_words(as_read));
    Some(Doubt { found, units: others.iter().map(|other| other.place.unit).collect() })
}

/// Whether another unit is likelier than the one in which the points were read.
fn is_likelier(other: &Reading, as_read: &Reading, total: usize, volume: &Judge) -> bool {
    if other.is_clearly_better_than(as_read.fits(), total) {
        return true;
    }
    let is_alike = other.is_as_good_as(as_read.fits());
    let by_values = || (volume.lumen)(other.place).is_evident_over((volume.lumen)(as_read.place));
    is_alike && (as_read.is_short() || by_values())
}
