use super::*;
use crate::trace::find::found::SURE;
use crate::trace::find::made::{LEVEL, TISSUE, blurred, straight_track, with_scan, with_threads};
use glam::DVec3;
use lumencut_core::progress::Progress;

const SIZE: [usize; 3] = [80, 60, 60];
const SIDE: f64 = 0.5;

/// A tube with a radius of 3 mm along y, and a plate 2 mm thick; their axes are 25 mm apart.
fn tube_and_plate(place: DVec3) -> f64 {
    let tube = 3.0 - (place.x - 8.0).hypot(place.z - 15.0);
    let plate = 1.0 - (place.x - 33.0).abs();
    blurred(tube.max(plate))
}

fn judged_in(scan: &Scan, tracks: Vec<Track>) -> Vec<Track> {
    let shapes = shapes(scan, &tracks, &|| false, Stages::begin(None)).expect("shapes");
    left(judged(scan, tracks, &shapes, &|| false).expect("tracks"))
}

fn along_y(x: f64, z: f64, radius: f64) -> Track {
    straight_track(DVec3::new(x, 3.0, z), DVec3::new(x, 26.0, z), radius)
}

#[test]
fn a_plate_is_left_out_and_a_tube_stays_for_any_number_of_threads() {
    let tracks = vec![along_y(8.0, 15.0, 3.0), along_y(33.0, 15.0, 1.2), along_y(33.0, 10.0, 1.2)];
    let judge = || with_scan(SIZE, SIDE, tube_and_plate, |scan| judged_in(scan, tracks.clone()));
    let found = judge();
    assert_eq!(found.len(), 1);
    // Half of the doubts are excused, because the inside looks like lumen.
    assert_eq!((found[0].confidence, found[0].doubt), (0.9_f64.sqrt(), None));
    let [one, two] = [1, 2].map(|count| with_threads(count, judge));
    assert_eq!(one[0].confidence.to_bits(), two[0].confidence.to_bits());
}

/// A tube with a radius of 1.5 mm, elongated by `times`: without neighbours, and between plates 6 and 10 mm away.
fn alone_and_among_plates(times: f64) -> [Vec<Track>; 2] {
    let scene = |place: DVec3| {
        let tube = 1.5 - (place.x - 8.0).hypot((place.z - 15.0) / times);
        let plates = 1.0 - (place.x - 14.0).abs().min((place.x - 18.0).abs());
        blurred(tube.max(plates))
    };
    let tube = along_y(8.0, 15.0, 1.5);
    let plates = [along_y(14.0, 15.0, 1.2), along_y(18.0, 15.0, 1.2)];
    [vec![tube.clone()], [&[tube][..], &plates].concat()]
        .map(|tracks| with_scan(SIZE, SIDE, scene, |scan| judged_in(scan, tracks)))
}

#[test]
fn flat_neighbours_are_held_against_an_oval_tube_and_not_against_a_round_one() {
    let [alone, among] = alone_and_among_plates(1.0);
    assert_eq!(alone[0].doubt, None);
    assert_eq!((among.len(), among[0].confidence, among[0].doubt), (1, alone[0].confidence, None));
    let [alone, among] = alone_and_among_plates(1.8);
    assert!(alone[0].confidence >= 0.9 && alone[0].doubt.is_none());
    assert!(among.iter().all(|track| track.confidence < SURE && track.doubt == Some(TrackDoubt::Flat)));
}

/// Confidence (in thousandths) and doubt of a sure track after the check for bone.
fn after(shape: Shape, radius: f64) -> (i32, Option<TrackDoubt>) {
    let mut track = along_y(8.0, 15.0, radius);
    with_scan([4, 4, 4], SIDE, |_| TISSUE, |scan| judge(scan, &mut track, shape));
    ((track.confidence * 1000.0).round() as i32, track.doubt)
}

fn below(share: f64) -> f64 {
    LEVEL - share * (LEVEL - TISSUE)
}

/// An even shape, but paler than vessels, so that no doubt is excused.
const EVEN_AND_PALE: Shape =
    Shape { level: LEVEL - 0.3 * (LEVEL - TISSUE), elongation: 1.1, spread: 0.05, is_marrow: false };

#[test]
fn doubts_take_confidence_between_their_limits() {
    let even = EVEN_AND_PALE;
    assert_eq!(after(even, 3.0), (900, None));
    // If doubt rises from 1.2 to 1.7, confidence falls from 0.9 to 0; a doubt of 1.45 is halfway.
    let flat = Shape { elongation: 1.2 + 0.7 * 1.45, ..even };
    assert_eq!(after(flat, 3.0), (450, Some(TrackDoubt::Flat)));
    let uneven = Shape { spread: 0.14 + 0.10 * 1.45, ..even };
    assert_eq!(after(uneven, 3.0), (450, Some(TrackDoubt::Uneven)));
    let both = Shape { elongation: 1.2 + 0.7 * 0.725, spread: 0.14 + 0.10 * 0.725, ..even };
    assert_eq!(after(both, 3.0).0, 450);
    assert_eq!(after(Shape { elongation: 1.2 + 0.7 * 1.1, ..even }, 3.0), (900, None));
    assert_eq!(after(Shape { elongation: 9.0, ..even }, 3.0), (0, Some(TrackDoubt::Flat)));
    // Darker than vessels by half of the contrast, a track loses half of the 85 % that an organ loses.
    assert_eq!(after(Shape { level: below(0.5), ..even }, 6.0), (518, Some(TrackDoubt::PaleAndWide)));
    assert_eq!(after(Shape { level: below(0.65), ..even }, 6.0), (135, Some(TrackDoubt::PaleAndWide)));
    assert_eq!(after(Shape { level: below(0.65), ..even }, 4.0), (900, None));
    assert_eq!(after(Shape { level: below(0.3), ..even }, 13.0), (900, None));
    assert_eq!(after(Shape { level: below(0.3), ..even }, 15.0), (135, Some(TrackDoubt::PaleAndWide)));
    assert_eq!(after(Shape { is_marrow: true, ..even }, 3.0), (135, Some(TrackDoubt::Uneven)));
}

#[test]
fn a_wide_even_lumen_as_bright_as_vessels_may_be_flat_and_marrow_may_not() {
    let flat = Shape { level: LEVEL, elongation: 2.5, ..EVEN_AND_PALE };
    // Half of the doubts are excused, so the confidence is the square root of 0.9.
    assert_eq!(after(flat, 3.0), (949, None));
    // A wide flat track is a body of even tissue.
    assert_eq!(after(flat, 8.0).0, 0);
    assert_eq!(after(Shape { elongation: 1.4, ..flat }, 8.0), (949, None));
    assert_eq!(after(Shape { level: below(0.2), ..flat }, 3.0).0, 0);
    assert_eq!(after(Shape { spread: 0.11, ..flat }, 3.0).0, 0);
    assert_eq!(after(Shape { is_marrow: true, ..flat }, 3.0).0, 0);
    // A track with a radius of two voxels is too narrow to show whether its inside is even.
    assert_eq!(after(flat, 2.0 * SIDE).0, 0);
}

#[test]
fn the_usual_level_is_that_of_round_and_even_tracks() {
    let scene = |place: DVec3| {
        let bone = 9.0 - (place.x - 28.0).hypot(place.z - 15.0);
        let tube = 3.0 - (place.x - 8.0).hypot(place.z - 15.0);
        let bone = 0.7 * (blurred(bone) - TISSUE) * (1.0 + 0.5 * (2.0 * place.x).sin());
        blurred(tube) + bone
    };
    let tracks = [along_y(8.0, 15.0, 3.0), along_y(28.0, 15.0, 8.0)];
    let found = with_scan(SIZE, SIDE, scene, |scan| {
        let shapes = shapes(scan, &tracks, &|| false, Stages::begin(None)).expect("shapes");
        let of = |n: usize| lumen_level(scan, &tracks[n..=n], &shapes[n..=n]);
        (lumen_level(scan, &tracks, &shapes), of(0), of(1))
    });
    assert!(found.0.is_some());
    assert_eq!((found.0, found.2), (found.1, None));
}

#[test]
fn judging_stops_where_it_is_asked_to() {
    let stopped = with_scan(SIZE, SIDE, tube_and_plate, |scan| {
        shapes(scan, &[along_y(8.0, 15.0, 3.0)], &|| true, Stages::begin(None)).map(|_| ())
    });
    assert!(stopped.is_err());
}

#[test]
fn a_wide_track_that_is_broken_by_other_sections_is_doubtful_and_a_narrow_one_is_not() {
    // Every fifth section does not look like a tube.
    let broken = |radius: f64| {
        let mut track = along_y(8.0, 15.0, radius);
        track.points.iter_mut().step_by(5).for_each(|point| point.is_good = false);
        with_scan([4, 4, 4], SIDE, |_| TISSUE, |scan| judge(scan, &mut track, EVEN_AND_PALE));
        track
    };
    let wide = broken(5.5 * SIDE);
    let share = wide.points.iter().filter(|point| point.is_good).count() as f64 / wide.points.len() as f64;
    let left = 1.0 - (0.95 - share) / 0.2 * 0.85;
    assert!((wide.confidence - 0.9 * left).abs() < 1e-9 && wide.confidence < SURE, "{}", wide.confidence);
    assert_eq!(wide.doubt, Some(TrackDoubt::Open));
    let narrow = broken(2.5 * SIDE);
    assert_eq!((narrow.confidence, narrow.doubt), (0.9, None));
}

#[test]
fn judging_tells_how_far_it_is() {
    let progress = Progress::default();
    let tracks = [along_y(8.0, 15.0, 3.0), along_y(33.0, 15.0, 1.2)];
    with_scan(SIZE, SIDE, tube_and_plate, |scan| {
        shapes(scan, &tracks, &|| false, Stages::begin(Some(&progress))).expect("shapes")
    });
    assert_eq!(progress.share(), 0.07);
}
