//! Parts that are short, and scans that show no vessels: what looks like some there is doubtful as a whole.

use crate::trace::find::found::FoundVessel;
use crate::trace::find::track::TrackDoubt;
use crate::voxels::Voxels;
use glam::DVec3;
use lumencut_core::math::arc_length::arc_lengths;

/// Some part of an angiography has sure vessels of this length (mm), or of this share of the diagonal of a smaller volume.
const LEAST_LENGTH: f64 = 100.0;
const OF_DIAGONAL: f64 = 0.3;

/// A part whose sure vessels are shorter together is a speck of calcium as often as a vessel: the same two numbers.
const LEAST_PART: f64 = 15.0;
const PART_OF_DIAGONAL: f64 = 0.15;

/// The same vessels: those of short parts doubtful, and all where no part of them has sure vessels as long as those of an angiography.
pub fn doubted_where_scarce(voxels: &Voxels, mut vessels: Vec<FoundVessel>) -> Vec<FoundVessel> {
    let mut lengths = vec![0.0; vessels.len()];
    for vessel in vessels.iter().filter(|vessel| vessel.doubt.is_none()) {
        lengths[vessel.part] += arc_lengths(&vessel.line.points).last().copied().unwrap_or(0.0);
    }
    let diagonal = diagonal(voxels);
    let [least, least_part] =
        [LEAST_LENGTH.min(OF_DIAGONAL * diagonal), LEAST_PART.min(PART_OF_DIAGONAL * diagonal)];
    let is_scarce = lengths.iter().all(|length| *length < least);
    for vessel in vessels.iter_mut().filter(|vessel| is_scarce || lengths[vessel.part] < least_part) {
        let doubt = if is_scarce { TrackDoubt::Scarce } else { TrackDoubt::Short };
        vessel.doubt = vessel.doubt.or(Some(doubt));
    }
    vessels
}

/// The length of the diagonal of a volume (mm).
fn diagonal(voxels: &Voxels) -> f64 {
    let sides = DVec3::from_array(voxels.size.map(|count| count as f64));
    let of_axis = |a: usize| voxels.world_from_index.matrix3.col(a).length() * sides[a];
    DVec3::new(of_axis(0), of_axis(1), of_axis(2)).length()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::find::made::with_scan;
    use crate::trace::lines::centerline::Centerline;

    /// The doubts of vessels of some lengths (mm) in one part each, in a cube of 40 mm, whose diagonal is 69.3 mm.
    fn doubts(lengths: &[f64]) -> Vec<Option<TrackDoubt>> {
        let vessel = |(part, length): (usize, &f64)| {
            let points = vec![DVec3::ZERO, DVec3::X * *length];
            let line = Centerline { points, radius: vec![1.0; 2], confidence: vec![0.9; 2] };
            FoundVessel { line, part, confidence: 0.9, doubt: None }
        };
        let vessels = lengths.iter().enumerate().map(vessel).collect();
        let found = with_scan([20; 3], 2.0, |_| 0.0, |scan| doubted_where_scarce(scan.voxels, vessels));
        found.into_iter().map(|vessel| vessel.doubt).collect()
    }

    #[test]
    fn all_is_doubtful_where_no_part_is_long_and_else_what_is_very_short() {
        assert_eq!(doubts(&[20.7, 10.0]), [Some(TrackDoubt::Scarce); 2]);
        assert_eq!(doubts(&[20.9, 10.5]), [None; 2]);
        // 0.15 of the diagonal are 10.4 mm.
        assert_eq!(doubts(&[20.9, 10.3]), [None, Some(TrackDoubt::Short)]);
        assert!(doubts(&[]).is_empty());
    }
}
