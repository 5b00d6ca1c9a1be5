//! The measurable part of a vessel: the entire vessel, or the longest part with a visible wall.

use super::SectionPlane;
use super::scale::Scale;
use crate::voxels::Voxels;
use lumencut_core::error::Result;

/// Length of the pieces that are checked (mm), and their maximum number.
const PIECE: f64 = 10.0;
const MOST_PIECES: usize = 40;

/// Minimum number of consecutive pieces with a wall; shorter parts do not show the lumen reliably.
const LEAST_PIECES: usize = 2;

#[derive(Clone, Copy, Debug)]
pub(crate) struct MeasuredPart {
    pub scale: Scale,
    /// Start and end of the part (arc lengths, mm).
    pub ends: [f64; 2],
}

impl MeasuredPart {
    /// Finds the measurable part; `radius` is the approximate radius (mm), if known. If no wall is found for
    /// the vessel as a whole, the part is the longest run of 10 mm pieces that show one.
    pub(crate) fn of(voxels: &Voxels, places: &[SectionPlane], radius: Option<f64>) -> Result<Self> {
        let whole = Scale::of(voxels, places, radius);
        match whole {
            Ok(scale) => Ok(Self { scale, ends: ends(places) }),
            Err(error) => longest(voxels, places, radius).ok_or(error),
        }
    }

    pub(crate) fn holds(&self, place: &SectionPlane) -> bool {
        (self.ends[0]..=self.ends[1]).contains(&place.at)
    }

    /// The parts of the vessel before and after the measured one (arc lengths, mm).
    pub(crate) fn left_out(&self, places: &[SectionPlane]) -> Vec<[f64; 2]> {
        let [first, last] = ends(places);
        let beside = [[first, self.ends[0]], [self.ends[1], last]];
        beside.into_iter().filter(|[from, to]| from < to).collect()
    }
}

fn ends(places: &[SectionPlane]) -> [f64; 2] {
    [places.first(), places.last()].map(|place| place.map_or(0.0, |place| place.at))
}

fn longest(voxels: &Voxels, places: &[SectionPlane], radius: Option<f64>) -> Option<MeasuredPart> {
    let [first, last] = ends(places);
    let count = (((last - first) / PIECE).round() as usize).clamp(1, MOST_PIECES);
    let pieces: Vec<&[SectionPlane]> = places.chunks(places.len().div_ceil(count)).collect();
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
