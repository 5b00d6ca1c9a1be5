use super::*;
use crate::trace::find::made::{LEVEL, TISSUE, blurred, straight_track, with_scan, with_threads};
use glam::DVec3;

const SIZE: [usize; 3] = [80, 60, 60];
const SIDE: f64 = 0.5;

/// A tube of 3 mm along y at the left, a plate of 2 mm across x on the right, 25 mm apart.
fn tube_and_plate(place: DVec3) -> f64 {
    let tube = 3.0 - (place.x - 8.0).hypot(place.z - 15.0);
    let plate = 1.0 - (place.x - 33.0).abs();
    blurred(tube.max(plate))
}

fn along_y(x: f64, z: f64, radius: f64) -> Track {
    straight_track(DVec3::new(x, 3.0, z), DVec3::new(x, 26.0, z), radius)
}

#[test]
fn a_plate_is_left_out_and_a_tube_stays_for_any_number_of_threads() {
    let tracks = vec![along_y(8.0, 15.0, 3.0), along_y(33.0, 15.0, 1.2), along_y(33.0, 10.0, 1.2)];
    let judge = || {
        with_scan(SIZE, SIDE, tube_and_plate, |scan| judged(scan, tracks.clone(), &|| false).expect("tracks"))
    };
    let found = judge();
    assert_eq!(found.len(), 1);
    assert_eq!((found[0].confidence, found[0].doubt), (0.9, None));
    let [one, two] = [1, 2].map(|count| with_threads(count, judge));
    assert_eq!(one[0].confidence.to_bits(), two[0].confidence.to_bits());
}

/// What is left of a tube that is so many times as long as wide (1.5 mm) across: alone, and between plates 6 and 10 mm away.
fn alone_and_among_plates(times: f64) -> [Vec<Track>; 2] {
    let scene = |place: DVec3| {
        let tube = 1.5 - (place.x - 8.0).hypot((place.z - 15.0) / times);
        let plates = 1.0 - (place.x - 14.0).abs().min((place.x - 18.0).abs());
        blurred(tube.max(plates))
    };
    let tube = along_y(8.0, 15.0, 1.5);
    let plates = [along_y(14.0, 15.0, 1.2), along_y(18.0, 15.0, 1.2)];
    [vec![tube.clone()], [&[tube][..], &plates].concat()]
        .map(|tracks| with_scan(SIZE, SIDE, scene, |scan| judged(scan, tracks, &|| false).expect("tracks")))
}

#[test]
fn flat_neighbours_are_held_against_an_oval_tube_and_not_against_a_round_one() {
    let [alone, among] = alone_and_among_plates(1.0);
    assert_eq!((alone[0].confidence, alone[0].doubt), (0.9, None));
    assert_eq!((among.len(), among[0].confidence, among[0].doubt), (1, 0.9, None));
    let [alone, among] = alone_and_among_plates(1.8);
    assert_eq!((alone[0].confidence, alone[0].doubt), (0.9, None));
    assert!(among.is_empty(), "{}", among.len());
}

#[test]
fn doubts_take_confidence_between_their_limits() {
    let even = Shape { level: LEVEL, elongation: 1.1, spread: 0.05, is_marrow: false };
    let after = |shape: Shape, radius: f64| {
        let mut track = along_y(8.0, 15.0, radius);
        with_scan([4, 4, 4], SIDE, |_| TISSUE, |scan| judge(scan, &mut track, shape));
        ((track.confidence * 1000.0).round() as i32, track.doubt)
    };
    assert_eq!(after(even, 3.0), (900, None));
    // A doubt of 1.45 is half way from 1.2 to 1.7.
    let flat = Shape { elongation: 1.2 + 0.7 * 1.45, ..even };
    assert_eq!(after(flat, 3.0), (450, Some(TrackDoubt::Flat)));
    let uneven = Shape { spread: 0.14 + 0.10 * 1.45, ..even };
    assert_eq!(after(uneven, 3.0), (450, Some(TrackDoubt::Uneven)));
    let both = Shape { elongation: 1.2 + 0.7 * 0.725, spread: 0.14 + 0.10 * 0.725, ..even };
    assert_eq!(after(both, 3.0).0, 450);
    assert_eq!(after(Shape { elongation: 1.2 + 0.7 * 1.1, ..even }, 3.0), (900, None));
    assert_eq!(after(Shape { elongation: 9.0, ..even }, 3.0), (0, Some(TrackDoubt::Flat)));
    let pale = Shape { level: LEVEL - 0.65 * (LEVEL - TISSUE), ..even };
    assert_eq!(after(pale, 6.0), (135, Some(TrackDoubt::PaleAndWide)));
    assert_eq!(after(pale, 4.0), (900, None));
    assert_eq!(after(Shape { is_marrow: true, ..even }, 3.0), (135, Some(TrackDoubt::Uneven)));
}

#[test]
fn judging_stops_where_it_is_asked_to() {
    let stopped = with_scan(SIZE, SIDE, tube_and_plate, |scan| {
        judged(scan, vec![along_y(8.0, 15.0, 3.0)], &|| true).map(|_| ())
    });
    assert!(stopped.is_err());
}
