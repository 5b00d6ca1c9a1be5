use super::*;
use crate::trace::find::links::between;
use crate::trace::find::made::{away, blurred, straight_track, turned, with_scan, with_threads};
use crate::trace::find::track::TrackDoubt;
use crate::trace::lumen::refine::STEP;
use glam::DVec3;
use std::sync::atomic::{AtomicUsize, Ordering};

const SIZE: [usize; 3] = [140, 100, 40];
const SIDE: f64 = 0.5;

fn at(x: f64, y: f64) -> DVec3 {
    DVec3::new(x, y, 10.0)
}

fn tube(from: DVec3, to: DVec3, radius: f64) -> ([DVec3; 2], Track) {
    ([from, to], straight_track(from, to, radius))
}

fn found(tubes: &[([DVec3; 2], Track)], tracks: &[Track], smallest_radius: f64) -> Vec<FoundVessel> {
    let value = |place: DVec3| {
        let depths = tubes.iter().map(|(line, track)| track.radius() - away(place, line));
        blurred(depths.fold(f64::MIN, f64::max))
    };
    with_scan(SIZE, SIDE, value, |scan| {
        let links = between(scan, tracks, &|| false, Stages::begin(None)).expect("links");
        of(scan, tracks, &links, smallest_radius, (&|| false, Stages::begin(None))).expect("vessels")
    })
}

fn of_tubes(tubes: &[([DVec3; 2], Track)]) -> Vec<FoundVessel> {
    let tracks: Vec<Track> = tubes.iter().map(|(_, track)| track.clone()).collect();
    found(tubes, &tracks, 0.5)
}

fn ends(vessel: &FoundVessel) -> [DVec3; 2] {
    [vessel.line.points[0], vessel.line.points[vessel.line.points.len() - 1]]
}

fn passes(vessel: &FoundVessel, place: DVec3) -> bool {
    vessel.line.points.contains(&place)
}

fn length(vessel: &FoundVessel) -> f64 {
    vessel.line.points.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
}

/// A trunk with a radius of 3 mm, and arms with radii of 2.2 and 1.5 mm.
fn y_of_tubes() -> Vec<([DVec3; 2], Track)> {
    vec![
        tube(at(3.0, 25.0), at(30.0, 25.0), 3.0),
        tube(at(32.0, 25.5), at(64.0, 36.0), 2.2),
        tube(at(33.0, 23.0), at(62.0, 8.0), 1.5),
    ]
}

#[test]
fn a_trunk_goes_on_with_its_wider_arm_and_the_other_one_begins_on_it() {
    let vessels = of_tubes(&y_of_tubes());
    assert_eq!(vessels.len(), 2, "{:?}", vessels.iter().map(ends).collect::<Vec<_>>());
    let [main, branch] = [&vessels[0], &vessels[1]];
    assert!(ends(main)[0].distance(at(3.0, 25.0)) < 1.5, "{:?}", ends(main));
    assert!(ends(main)[1].distance(at(64.0, 36.0)) < 1.5, "{:?}", ends(main));
    assert!(passes(main, ends(branch)[0]) && ends(branch)[1].distance(at(62.0, 8.0)) < 1.5);
    assert!((length(main) - 61.0).abs() < 2.0 && (length(branch) - 36.0).abs() < 4.0);
    for vessel in &vessels {
        let FoundVessel { line, part, confidence, doubt } = vessel;
        assert_eq!((*part, *doubt), (0, None));
        assert!((0.8..0.9001).contains(confidence), "{confidence}");
        assert!(
            line.points.windows(2).all(|pair| pair[0] != pair[1] && pair[0].distance(pair[1]) <= STEP + 1e-9)
        );
        assert!(line.points.len() == line.radius.len() && line.points.len() == line.confidence.len());
    }
    let on_trunk = main.line.points.iter().position(|point| point.x > 15.0).expect("a point");
    assert!(
        (main.line.points[on_trunk].y - 25.0).abs() < 0.1 && (main.line.radius[on_trunk] - 3.0).abs() < 0.15
    );
    let last = branch.line.radius[branch.line.radius.len() - 20];
    assert!((last - 1.5).abs() < 0.15, "{last}");
}

#[test]
fn vessels_are_the_same_for_any_order_and_direction_of_tracks_and_any_number_of_threads() {
    let tubes = y_of_tubes();
    let bits = |vessels: &[FoundVessel]| -> Vec<[u64; 3]> {
        let points = vessels.iter().flat_map(|vessel| vessel.line.points.iter());
        points.map(|point| point.to_array().map(f64::to_bits)).collect()
    };
    let tracks: Vec<Track> = tubes.iter().map(|(_, track)| track.clone()).collect();
    let [one, two] = [1, 2].map(|count| with_threads(count, || bits(&found(&tubes, &tracks, 0.5))));
    assert_eq!(one, two);
    let other = [turned(tracks[2].clone()), tracks[0].clone(), turned(tracks[1].clone())];
    assert_eq!(bits(&found(&tubes, &other, 0.5)), one);
}

#[test]
fn two_runs_that_a_narrow_one_joins_are_whole_and_so_is_that() {
    let vessels = of_tubes(&[
        tube(at(3.0, 12.0), at(66.0, 12.0), 3.0),
        tube(at(3.0, 36.0), at(66.0, 36.0), 2.5),
        tube(at(35.0, 14.0), at(35.0, 34.0), 1.2),
    ]);
    assert_eq!(vessels.len(), 3);
    let mut lengths: Vec<f64> = vessels.iter().map(length).collect();
    lengths.sort_unstable_by(f64::total_cmp);
    assert!((lengths[0] - 24.0).abs() < 1.0 && lengths[1] > 61.0, "{lengths:?}");
    let bar = vessels.iter().min_by(|a, b| length(a).total_cmp(&length(b))).expect("a bar");
    for end in ends(bar) {
        assert_eq!(vessels.iter().filter(|vessel| passes(vessel, end)).count(), 2);
    }
    assert!(vessels.iter().all(|vessel| vessel.part == 0));
}

#[test]
fn a_cycle_is_closed_to_the_bit() {
    let corners = [at(15.0, 8.0), at(55.0, 8.0), at(55.0, 40.0), at(15.0, 40.0), at(15.0, 8.0)];
    let mut tubes: Vec<([DVec3; 2], Track)> =
        corners.windows(2).map(|pair| tube(pair[0], pair[1], 2.0)).collect();
    // Checks that all ends except the root lie on other vessels.
    let check = |tubes: &[([DVec3; 2], Track)], expected: f64, free: usize| {
        let vessels = of_tubes(tubes);
        assert_eq!(vessels.iter().map(|vessel| vessel.part).max(), Some(0));
        let whole: f64 = vessels.iter().map(length).sum();
        assert!((whole - expected).abs() < 10.0, "{whole}");
        let all: Vec<DVec3> = vessels.iter().flat_map(ends).collect();
        let passing = |end: &DVec3| vessels.iter().filter(|vessel| passes(vessel, *end)).count();
        assert_eq!(all.iter().filter(|end| passing(end) < 2).count(), free, "{all:?}");
    };
    check(&tubes, 144.0, 0);
    tubes.push(tube(at(2.0, 24.0), at(14.0, 24.0), 2.5));
    check(&tubes, 156.0, 1);
}

#[test]
fn loose_tracks_are_parts_of_their_own_the_most_important_first() {
    let vessels =
        of_tubes(&[tube(at(5.0, 10.0), at(30.0, 10.0), 1.2), tube(at(5.0, 38.0), at(60.0, 38.0), 3.0)]);
    assert_eq!(vessels.iter().map(|vessel| vessel.part).collect::<Vec<_>>(), [0, 1]);
    assert!(length(&vessels[0]) > 53.0 && length(&vessels[1]) < 26.0);
}

#[test]
fn narrow_branches_and_bumps_are_left_out_and_vessels_end_where_they_are_narrow() {
    let mut tubes = y_of_tubes();
    let tracks: Vec<Track> = tubes.iter().map(|(_, track)| track.clone()).collect();
    assert_eq!(found(&tubes, &tracks, 1.8).len(), 1);
    assert!(found(&tubes, &tracks, 3.5).is_empty());
    tubes.push(tube(at(15.0, 25.0), at(15.0, 29.5), 1.0));
    assert_eq!(of_tubes(&tubes).len(), 2);
    // A tube with a radius of 2.5 mm that continues with a radius of 1.2 mm.
    let steps = [tube(at(3.0, 25.0), at(35.0, 25.0), 2.5), tube(at(35.0, 25.0), at(66.0, 25.0), 1.2)];
    let tracks = steps.clone().map(|(_, track)| track);
    let whole = found(&steps, &tracks, 0.5);
    assert!(whole.len() == 1 && length(&whole[0]) > 60.0);
    let wide = found(&steps, &tracks, 1.8);
    assert!(wide.len() == 1 && (length(&wide[0]) - 32.0).abs() < 3.0, "{}", length(&wide[0]));
}

#[test]
fn a_sure_stretch_beyond_a_doubtful_one_stays_sure() {
    let mut tubes = vec![tube(at(2.0, 25.0), at(30.0, 25.0), 2.5), tube(at(31.0, 25.0), at(66.0, 25.0), 2.4)];
    (tubes[0].1.confidence, tubes[0].1.doubt) = (0.5, Some(TrackDoubt::BrightSides));
    let vessels = of_tubes(&tubes);
    assert_eq!(vessels.len(), 2);
    assert_eq!(
        vessels.iter().map(|vessel| vessel.doubt).collect::<Vec<_>>(),
        [Some(TrackDoubt::BrightSides), None]
    );
    assert_eq!(ends(&vessels[0])[1], ends(&vessels[1])[0]);
    // A short doubtful part is not split off.
    tubes[0] = tube(at(2.0, 25.0), at(18.0, 25.0), 1.5);
    tubes[1] = tube(at(28.0, 25.0), at(66.0, 25.0), 1.5);
    tubes.push(tube(at(19.0, 25.0), at(27.0, 25.0), 1.5));
    (tubes[2].1.confidence, tubes[2].1.doubt) = (0.5, Some(TrackDoubt::Short));
    let vessels = of_tubes(&tubes);
    assert!(vessels.len() == 1 && vessels[0].doubt.is_none());
}

#[test]
fn nothing_makes_no_vessels_and_work_stops_where_it_is_asked_to() {
    assert!(of_tubes(&[]).is_empty());
    let (_, track) = tube(at(3.0, 25.0), at(30.0, 25.0), 3.0);
    let stopped = with_scan(
        SIZE,
        SIDE,
        |_| 0.0,
        |scan| of(scan, std::slice::from_ref(&track), &[], 0.5, (&|| true, Stages::begin(None))).map(|_| ()),
    );
    assert!(stopped.is_err());
}

#[test]
fn making_vessels_whole_asks_whether_to_stop_for_every_track_in_each_step() {
    // The tubes are parallel and do not touch.
    let line = |n: usize| [5.0, 65.0].map(|x| at(x, 3.0 + 6.0 * n as f64));
    let tracks: Vec<Track> = (0..8).map(line).map(|[from, to]| straight_track(from, to, 1.5)).collect();
    let lines: Vec<[DVec3; 2]> = (0..8).map(line).collect();
    let value =
        |place: DVec3| blurred(lines.iter().map(|line| 1.5 - away(place, line)).fold(f64::MIN, f64::max));
    with_scan(SIZE, SIDE, value, |scan| {
        // Number of calls of `stop` if it returns true from call `first` on, and whether the work was finished.
        let work = |first: usize| {
            let asked = AtomicUsize::new(0);
            let stop = || asked.fetch_add(1, Ordering::Relaxed) >= first;
            let is_whole = of(scan, &tracks, &[], 0.5, (&stop, Stages::begin(None))).is_ok();
            (asked.load(Ordering::Relaxed), is_whole)
        };
        let (whole, is_whole) = work(usize::MAX);
        // Seven stages call `stop`: stubs, importance, roots, lines, attachment, ends and trimming.
        assert!(is_whole && whole >= 7 * tracks.len(), "{whole}");
        for first in 0..whole {
            assert!(!work(first).1, "{first} of {whole}");
        }
    });
}
