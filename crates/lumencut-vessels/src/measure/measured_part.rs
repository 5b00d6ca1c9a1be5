//! The part of a vessel that can be measured: all of it, or the longest stretch that has a wall where the whole has none.

use super::place::Place;
use super::scale::Scale;
use crate::voxels::Voxels;
use lumencut_core::error::Result;

/// A vessel without a wall is looked at in pieces of this length (mm), or longer ones where they would be more than so many.
const PIECE: f64 = 10.0;
const MOST_PIECES: usize = 40;

/// A shorter stretch (pieces) does not tell what a lumen looks like.
const LEAST_PIECES: usize = 2;

/// Where a vessel is measured, and what its lumen looks like there.
#[derive(Clone, Copy, Debug)]
pub struct MeasuredPart {
    /// What lumen and surroundings look like.
    pub scale: Scale,
    /// Where it begins and ends (arc lengths, mm).
    pub ends: [f64; 2],
}

impl MeasuredPart {
    /// The part of a vessel whose lumen differs from its surroundings. `radius` is about that of the vessel (mm), where known.
    ///
    /// Where the vessel as a whole has a wall that is all of it. A line that runs on where nothing tells lumen from tissue has none
    /// as a whole, though much of it may: then it is the longest stretch of pieces each of which has a wall, and that has one itself.
    ///
    /// # Errors
    /// That of the whole vessel ([`Scale::of`]) where no stretch of 20 mm has a wall either.
    pub fn of(voxels: &Voxels, places: &[Place], radius: Option<f64>) -> Result<Self> {
        let whole = Scale::of(voxels, places, radius);
        match whole {
            Ok(scale) => Ok(Self { scale, ends: ends(places) }),
            Err(error) => longest(voxels, places, radius).ok_or(error),
        }
    }

    /// Whether a place lies in it.
    pub fn holds(&self, place: &Place) -> bool {
        (self.ends[0]..=self.ends[1]).contains(&place.at)
    }

    /// The stretches of these places that lie before and behind it (arc lengths, mm).
    pub fn left_out(&self, places: &[Place]) -> Vec<[f64; 2]> {
        let [first, last] = ends(places);
        let beside = [[first, self.ends[0]], [self.ends[1], last]];
        beside.into_iter().filter(|[from, to]| from < to).collect()
    }
}

fn ends(places: &[Place]) -> [f64; 2] {
    [places.first(), places.last()].map(|place| place.map_or(0.0, |place| place.at))
}

fn longest(voxels: &Voxels, places: &[Place], radius: Option<f64>) -> Option<MeasuredPart> {
    let [first, last] = ends(places);
    let count = (((last - first) / PIECE).round() as usize).clamp(1, MOST_PIECES);
    let pieces: Vec<&[Place]> = places.chunks(places.len().div_ceil(count)).collect();
    let has_wall: Vec<bool> = pieces.iter().map(|piece| Scale::of(voxels, piece, radius).is_ok()).collect();
    (LEAST_PIECES..=pieces.len()).rev().find_map(|length| {
        let mut begins =
            (0..=pieces.len() - length).filter(|n| has_wall[*n..n + length].iter().all(|is| *is));
        begins.find_map(|n| {
            let from: usize = pieces[..n].iter().map(|piece| piece.len()).sum();
            let count: usize = pieces[n..n + length].iter().map(|piece| piece.len()).sum();
            let stretch = &places[from..from + count];
            Scale::of(voxels, stretch, radius).ok().map(|scale| MeasuredPart { scale, ends: ends(stretch) })
        })
    })
}
