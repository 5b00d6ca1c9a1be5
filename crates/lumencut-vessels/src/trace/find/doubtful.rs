//! Marks short parts, and all vessels of a scan that is not an angiography, as doubtful.

use crate::trace::find::bone::Shape;
use crate::trace::find::found::{FoundVessel, SURE};
use crate::trace::find::scan::Scan;
use crate::trace::find::track::{Track, TrackDoubt};
use crate::voxels::Voxels;
use glam::DVec3;
use lumencut_core::math::arc_length::arc_lengths;

/// An angiography has a part whose sure vessels have this length: mm, or a fraction of the scan's diagonal if less.
const LEAST_LENGTH: f64 = 100.0;
const OF_DIAGONAL: f64 = 0.3;

/// Minimum length of any part: mm, or a fraction of the diagonal if less. Shorter parts are as often specks of
/// calcium as vessels.
const LEAST_PART: f64 = 15.0;
const PART_OF_DIAGONAL: f64 = 0.15;

/// Pairs of minimum length (radii) and maximum elongation. Tubes satisfy one of them, bodies of tissue none.
const LONG_AND_ROUND: [[f64; 2]; 2] = [[10.0, 1.5], [6.0, 1.25]];

/// A length of this fraction of the diagonal suffices for any width, because a small volume cannot show more.
const LONG_OF_DIAGONAL: f64 = 0.5;

/// Upper level (HU) of muscle and of blood without contrast medium; 120 would exclude arteries of 115 HU.
const BLOOD: f64 = 75.0;

/// Whether sure, long, round tracks reach the minimum length. In CT they must also be brighter than blood
/// without contrast medium.
pub(crate) fn is_angiography(scan: &Scan, tracks: &[Track], shapes: &[Option<Shape>]) -> bool {
    let diagonal = diagonal(scan.voxels);
    let length = |(track, shape): (&Track, &Option<Shape>)| {
        let length = track.length();
        let is_tube = |shape: &Shape| {
            LONG_AND_ROUND.iter().any(|[radii, elongation]| {
                let least = (radii * track.radius()).min(LONG_OF_DIAGONAL * diagonal);
                length >= least && shape.elongation <= *elongation
            })
        };
        if track.confidence >= SURE && shape.as_ref().is_some_and(is_tube) { length } else { 0.0 }
    };
    let all: f64 = tracks.iter().zip(shapes).map(length).sum();
    let is_bright = !scan.is_hounsfield || scan.level > BLOOD;
    is_bright && all >= LEAST_LENGTH.min(OF_DIAGONAL * diagonal)
}

pub(crate) fn doubted_where_scarce(
    voxels: &Voxels,
    mut vessels: Vec<FoundVessel>,
    is_angiography: bool,
) -> Vec<FoundVessel> {
    let mut lengths = vec![0.0; vessels.len()];
    for vessel in vessels.iter().filter(|vessel| vessel.doubt.is_none()) {
        lengths[vessel.part] += arc_lengths(&vessel.line.points).last().copied().unwrap_or(0.0);
    }
    let diagonal = diagonal(voxels);
    let [least, least_part] =
        [LEAST_LENGTH.min(OF_DIAGONAL * diagonal), LEAST_PART.min(PART_OF_DIAGONAL * diagonal)];
    let is_scarce = !is_angiography || lengths.iter().all(|length| *length < least);
    for vessel in vessels.iter_mut().filter(|vessel| is_scarce || lengths[vessel.part] < least_part) {
        let doubt = if is_scarce { TrackDoubt::Scarce } else { TrackDoubt::Short };
        vessel.doubt = vessel.doubt.or(Some(doubt));
    }
    vessels
}

fn diagonal(voxels: &Voxels) -> f64 {
    let sides = DVec3::from_array(voxels.size.map(|count| count as f64));
    let of_axis = |a: usize| voxels.world_from_index.matrix3.col(a).length() * sides[a];
    DVec3::new(of_axis(0), of_axis(1), of_axis(2)).length()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::find::made::{straight_track, with_scan};
    use crate::trace::lines::centerline::Centerline;

    /// Doubts of vessels with these lengths (mm), each its own part, in a cube with a diagonal of 69.3 mm.
    fn doubts(lengths: &[f64]) -> Vec<Option<TrackDoubt>> {
        let vessel = |(part, length): (usize, &f64)| {
            let points = vec![DVec3::ZERO, DVec3::X * *length];
            let line = Centerline { points, radius: vec![1.0; 2], confidence: vec![0.9; 2] };
            FoundVessel { line, part, confidence: 0.9, doubt: None }
        };
        let vessels = lengths.iter().enumerate().map(vessel).collect();
        let found = with_scan([20; 3], 2.0, |_| 0.0, |scan| doubted_where_scarce(scan.voxels, vessels, true));
        found.into_iter().map(|vessel| vessel.doubt).collect()
    }

    #[test]
    fn all_is_doubtful_where_no_part_is_long_and_else_what_is_very_short() {
        assert_eq!(doubts(&[20.7, 10.0]), [Some(TrackDoubt::Scarce); 2]);
        assert_eq!(doubts(&[20.9, 10.5]), [None; 2]);
        // The limit of 0.15 of the diagonal is 10.4 mm.
        assert_eq!(doubts(&[20.9, 10.3]), [None, Some(TrackDoubt::Short)]);
        assert!(doubts(&[]).is_empty());
    }

    /// Whether a scan with this single track is an angiography, in a cube with a diagonal of 207.8 mm.
    fn shows(length: f64, radius: f64, elongation: f64, level_in_hounsfield: Option<f64>) -> bool {
        let track = straight_track(DVec3::ZERO, DVec3::X * length, radius);
        with_scan(
            [20; 3],
            6.0,
            |_| 0.0,
            |scan| {
                let is_hounsfield = level_in_hounsfield.is_some();
                let scan = Scan { is_hounsfield, level: level_in_hounsfield.unwrap_or(50.0), ..*scan };
                is_angiography(&scan, &[track], &[Some(Shape::even(elongation))])
            },
        )
    }

    #[test]
    fn an_angiography_has_tubes_that_are_long_and_round_and_in_a_ct_brighter_than_plain_blood() {
        // The limit of 0.3 of the diagonal is 62.4 mm.
        assert!(shows(65.0, 6.0, 1.4, None) && !shows(60.0, 6.0, 1.4, None));
        assert!(!shows(65.0, 7.0, 1.4, None) && !shows(65.0, 6.0, 1.6, None));
        // A rounder tube may be shorter.
        assert!(shows(65.0, 10.5, 1.2, None) && !shows(65.0, 11.5, 1.2, None));
        // A length of half the diagonal suffices for any width.
        assert!(shows(104.5, 12.0, 1.4, None) && !shows(103.0, 12.0, 1.4, None));
        assert!(shows(65.0, 6.0, 1.4, Some(80.0)) && !shows(65.0, 6.0, 1.4, Some(70.0)));
    }

    #[test]
    fn in_what_is_no_angiography_all_is_doubtful() {
        let line = Centerline {
            points: vec![DVec3::ZERO, DVec3::X],
            radius: vec![1.0; 2],
            confidence: vec![0.9; 2],
        };
        let vessel = FoundVessel { line, part: 0, confidence: 0.9, doubt: None };
        let found = with_scan(
            [20; 3],
            0.05,
            |_| 0.0,
            |scan| {
                [true, false].map(|is| doubted_where_scarce(scan.voxels, vec![vessel.clone()], is)[0].doubt)
            },
        );
        assert_eq!(found, [None, Some(TrackDoubt::Scarce)]);
    }
}
