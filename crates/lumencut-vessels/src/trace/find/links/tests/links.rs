use super::*;
use crate::trace::find::made::{LEVEL, away, blurred, straight_track, turned, with_scan, with_threads};
use glam::DVec3;

const SIZE: [usize; 3] = [120, 60, 40];
const SIDE: f64 = 0.5;

fn at(x: f64, y: f64) -> DVec3 {
    DVec3::new(x, y, 10.0)
}

fn linked(tubes: &[(&[DVec3], f64)], tracks: &[Track]) -> Vec<Link> {
    let value = |place: DVec3| {
        let depths = tubes.iter().map(|(line, radius)| radius - away(place, line));
        blurred(depths.fold(f64::MIN, f64::max))
    };
    with_scan(SIZE, SIDE, value, |scan| between(scan, tracks, &|| false, Stages::begin(None)).expect("links"))
}

fn joined(links: &[Link]) -> Vec<[usize; 2]> {
    let mut pairs: Vec<[usize; 2]> =
        links.iter().map(|link| [link.from[0].min(link.to[0]), link.from[0].max(link.to[0])]).collect();
    pairs.sort_unstable();
    pairs
}

#[test]
fn ends_with_a_gap_between_them_are_linked_through_lumen_alone() {
    let tracks = |gap: f64| {
        [
            straight_track(at(5.0, 15.0), at(25.0, 15.0), 1.0),
            straight_track(at(25.0 + gap, 15.0), at(50.0, 15.0), 1.0),
        ]
    };
    let whole: &[(&[DVec3], f64)] = &[(&[at(0.0, 15.0), at(60.0, 15.0)], 1.0)];
    for gap in [0.5, 2.0, 3.5] {
        let links = linked(whole, &tracks(gap));
        assert_eq!(joined(&links), [[0, 1]], "{gap} mm");
        let link = links[0];
        let length = tracks(gap)[0].points[40].place.distance(tracks(gap)[1].points[0].place);
        assert!((length - gap).abs() < 1e-9 && link.level > 0.8, "{gap} mm: {link:?}");
        assert!((link.gap - (gap - 1.0).max(0.0)).abs() < 1e-9, "{gap} mm: {link:?}");
    }
    let broken: &[(&[DVec3], f64)] =
        &[(&[at(0.0, 15.0), at(25.0, 15.0)], 1.0), (&[at(28.5, 15.0), at(60.0, 15.0)], 1.0)];
    assert!(linked(broken, &tracks(3.5)).is_empty());
}

#[test]
fn ends_that_lead_to_each_other_are_bridged_over_sixteen_radii_and_others_are_not() {
    // For a radius of 1 mm, the wall may be 3 mm away, or more if the end points at it.
    let tracks = |gap: f64, beside: f64| {
        [
            straight_track(at(5.0, 15.0), at(25.0, 15.0), 1.0),
            straight_track(at(25.0 + gap, 15.0 + beside), at(55.0, 15.0 + beside), 1.0),
        ]
    };
    let whole: &[(&[DVec3], f64)] = &[(&[at(0.0, 15.0), at(60.0, 15.0)], 1.0)];
    for gap in [4.5, 15.5] {
        assert_eq!(joined(&linked(whole, &tracks(gap, 0.0))), [[0, 1]], "{gap} mm");
    }
    assert!(linked(whole, &tracks(16.5, 0.0)).is_empty());
    // An end that would pass 4 mm beside its target is not linked.
    let plate: &[(&[DVec3], f64)] = &[(&[at(0.0, 17.0), at(60.0, 17.0)], 8.0)];
    assert_eq!(joined(&linked(plate, &tracks(6.0, 1.0))), [[0, 1]]);
    assert!(linked(plate, &tracks(6.0, 4.0)).is_empty());
    let wider = [tracks(9.0, 0.0)[0].clone(), straight_track(at(34.0, 15.0), at(55.0, 15.0), 1.7)];
    assert!(linked(whole, &wider).is_empty());
}

#[test]
fn doubtful_tracks_and_other_levels_are_not_linked() {
    let whole: &[(&[DVec3], f64)] = &[(&[at(0.0, 15.0), at(60.0, 15.0)], 1.4)];
    let tracks = [
        straight_track(at(5.0, 15.0), at(25.0, 15.0), 1.4),
        straight_track(at(27.0, 15.0), at(50.0, 15.0), 1.4),
    ];
    let mut doubtful = tracks.clone();
    doubtful[1].confidence = 0.29;
    assert!(linked(whole, &doubtful).is_empty());
    let mut darker = tracks.clone();
    for point in &mut darker[1].points {
        (point.level, point.contrast) = (LEVEL - 130.0, 120.0);
    }
    assert!(linked(whole, &darker).is_empty());
    // A track as narrow as a voxel is darker than its lumen.
    for point in &mut darker[1].points {
        point.radius = 0.9;
    }
    assert_eq!(linked(whole, &darker).len(), 1);
    assert_eq!(linked(whole, &tracks).len(), 1);
}

#[test]
fn a_turn_of_sixty_degrees_is_the_most_but_within_the_other_lumen() {
    for (degrees, count) in [(50.0_f64, 1), (75.0, 0)] {
        // The end is perpendicular to the first track and to the path to that track.
        let start =
            at(20.0, 15.0) + 3.0 * DVec3::new(degrees.to_radians().cos(), degrees.to_radians().sin(), 0.0);
        let before = [at(3.0, 15.0), at(20.0, 15.0)];
        let across = [start, start + 8.0 * DVec3::Z];
        let tracks = [straight_track(before[0], before[1], 1.0), straight_track(across[0], across[1], 1.0)];
        let way = [before[1], start];
        let links = linked(&[(&before, 1.2), (&way, 1.2), (&across, 1.2)], &tracks);
        assert_eq!(links.len(), count, "{degrees}°");
    }
    // Inside a wide track any turn is allowed.
    let wide = [at(20.0, 3.0), at(20.0, 27.0)];
    let links = linked(
        &[(&wide, 4.0), (&[at(20.0, 15.0), at(50.0, 15.0)], 1.0)],
        &[straight_track(wide[0], wide[1], 4.0), straight_track(at(18.0, 15.0), at(50.0, 15.0), 1.0)],
    );
    assert_eq!(joined(&links), [[0, 1]]);
}

#[test]
fn tracks_are_linked_once_in_small_loops_and_twice_in_large_ones() {
    // Two tracks in one lumen (radius 3 mm) form a loop of 24 mm.
    let tube: &[(&[DVec3], f64)] = &[(&[at(0.0, 15.0), at(60.0, 15.0)], 3.0)];
    let pair = [
        straight_track(at(20.0, 14.5), at(32.0, 14.5), 3.0),
        straight_track(at(20.0, 15.5), at(32.0, 15.5), 3.0),
    ];
    assert_eq!(joined(&linked(tube, &pair)), [[0, 1]]);
    // A square whose sides are 20 mm long.
    let corners = [at(10.0, 5.0), at(30.0, 5.0), at(30.0, 25.0), at(10.0, 25.0), at(10.0, 5.0)];
    let tracks: Vec<Track> = corners.windows(2).map(|pair| straight_track(pair[0], pair[1], 1.0)).collect();
    assert_eq!(joined(&linked(&[(&corners, 1.0)], &tracks)), [[0, 1], [0, 3], [1, 2], [2, 3]]);
}

#[test]
fn the_side_of_a_track_is_linked_with_a_wider_one_across_and_not_along() {
    // A trunk leads from a wide vessel to the middle of a narrow one.
    let wide = [at(10.0, 2.0), at(10.0, 28.0)];
    let arms = [DVec3::new(18.0, 15.0, 2.0), DVec3::new(18.0, 15.0, 18.0)];
    let trunk = [at(10.0, 15.0), at(18.0, 15.0)];
    let tracks = [straight_track(wide[0], wide[1], 4.0), straight_track(arms[0], arms[1], 1.5)];
    let links = linked(&[(&wide, 4.0), (&arms, 1.5), (&trunk, 1.5)], &tracks);
    assert_eq!(joined(&links), [[0, 1]]);
    let narrow = tracks[1].points[links[0].from[1]];
    assert!((narrow.place.z - 10.0).abs() < 1.1, "{narrow:?}");
    assert!(linked(&[(&wide, 4.0), (&arms, 1.5)], &tracks).is_empty());
    // A vein that touches an artery along its course forms another tree.
    let beside = [at(15.4, 2.0), at(15.4, 28.0)];
    let tracks = [tracks[0].clone(), straight_track(beside[0] + DVec3::Y, beside[1] - DVec3::Y, 2.0)];
    assert!(linked(&[(&wide, 4.0), (&beside, 2.0)], &tracks).is_empty());
}

#[test]
fn links_are_the_same_for_any_order_and_direction_of_tracks_and_any_number_of_threads() {
    let corners = [at(10.0, 5.0), at(30.0, 5.0), at(30.0, 25.0), at(50.0, 25.0)];
    let tracks: Vec<Track> = corners.windows(2).map(|pair| straight_track(pair[0], pair[1], 1.0)).collect();
    let places = |tracks: &[Track]| {
        let place = |[t, n]: [usize; 2]| tracks[t].points[n].place.to_array().map(f64::to_bits);
        let links = linked(&[(&corners, 1.0)], tracks);
        let mut ends: Vec<_> = links
            .iter()
            .map(|link| {
                let mut ends = [place(link.from), place(link.to)];
                ends.sort_unstable();
                ends
            })
            .collect();
        ends.sort_unstable();
        ends
    };
    let expected = places(&tracks);
    assert_eq!(expected.len(), 2);
    let other = [turned(tracks[2].clone()), tracks[0].clone(), turned(tracks[1].clone())];
    assert_eq!(places(&other), expected);
    let [one, two] = [1, 2].map(|count| with_threads(count, || linked(&[(&corners, 1.0)], &tracks)));
    assert_eq!(one, two);
}
