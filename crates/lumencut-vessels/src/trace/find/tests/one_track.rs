use super::*;
use crate::trace::find::grid::Grid;
use crate::trace::find::made::{LEVEL, TISSUE, away, blurred, with_scan};

const SIZE: [usize; 3] = [70, 50, 50];
const TUBE: [DVec3; 2] = [DVec3::new(12.0, 22.0, 24.0), DVec3::new(58.0, 28.0, 24.0)];
const RADIUS: f64 = 3.0;

/// Points (mm) of the track from a position and direction in noisy 1 mm voxels. A painted lumen ends the track.
fn track(
    value: impl Fn(DVec3) -> f64,
    noise: f64,
    from: (DVec3, DVec3),
    painted: &[DVec3],
) -> Option<Vec<DVec3>> {
    with_scan(SIZE, 1.0, value, |scan| {
        let grid = Grid::over(scan.voxels, 1.0);
        let pyramid = Pyramid::new(scan.voxels, grid, [0.0, 400.0], &|| false).expect("levels");
        let mut paint = Paint::default();
        for place in painted {
            paint.lumen(0, pyramid.grid.grid_from_world.transform_point3(*place), RADIUS, &|_| false);
        }
        let tracker = Tracker {
            pyramid: &pyramid,
            levels_examined: pyramid.all(),
            paint: &paint,
            levels: &[LEVEL],
            floors: Floors { noise, contrast: LEVEL - TISSUE },
        };
        let candidate = Candidate {
            place: pyramid.grid.grid_from_world.transform_point3(from.0),
            direction: from.1.normalize(),
            radius: RADIUS,
            response: LEVEL - TISSUE,
            flux_radius: RADIUS,
            closure: 1.0,
            contrast_share: 1.0,
        };
        let points = tracker.track(&candidate, MOST_STEPS)?;
        Some(points.iter().map(|point| pyramid.grid.world(point.place)).collect())
    })
}

fn white(place: DVec3) -> f64 {
    let mixed = |n: u64| {
        let bits = place.to_array().iter().fold(n, |bits, side| {
            (bits ^ side.to_bits()).wrapping_mul(0x9E37_79B9_7F4A_7C15).rotate_left(29)
        });
        (bits.wrapping_mul(0xD6E8_FEB8_6659_FD93) >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    (1..5).map(mixed).sum::<f64>() * 3.0_f64.sqrt()
}

fn farthest(places: &[DVec3], line: &[DVec3]) -> f64 {
    places.iter().map(|place| away(*place, line)).fold(0.0, f64::max)
}

/// Asserts that a track follows a line and ends within a radius of its ends.
fn keeps_to(points: &[DVec3], line: &[DVec3], off: f64) {
    let within =
        |place: &&DVec3| [line[0], line[line.len() - 1]].iter().all(|end| place.distance(*end) > RADIUS);
    let inside: Vec<DVec3> = points.iter().filter(within).copied().collect();
    assert!(farthest(&inside, line) < off, "{}", farthest(&inside, line));
    assert!(farthest(line, points) < RADIUS, "{}", farthest(line, points));
    for (end, other) in [(0, points.len() - 1), (points.len() - 1, 0)] {
        let ends = [line[0], line[line.len() - 1]];
        let nearest =
            ends.into_iter().min_by(|a, b| a.distance(points[end]).total_cmp(&b.distance(points[end])));
        let nearest = nearest.expect("an end");
        assert!(points[end].distance(nearest) < RADIUS, "{} {nearest}", points[end]);
        assert!(points[other].distance(nearest) > RADIUS);
    }
}

#[test]
fn a_straight_tube_is_followed_in_its_middle_to_within_a_radius_of_its_ends_also_in_noise() {
    let start = (TUBE[0].lerp(TUBE[1], 0.4) + DVec3::Z, TUBE[1] - TUBE[0] + 10.0 * DVec3::Y);
    for (noise, off) in [(0.0, 0.3), (25.0, 0.7)] {
        let value = |place: DVec3| blurred(RADIUS - away(place, &TUBE)) + noise * white(place);
        keeps_to(&track(value, noise, start, &[]).expect("a track"), &TUBE, off);
    }
}

#[test]
fn a_helix_is_followed_through_all_its_turns() {
    let turn = |n: usize| {
        let angle = n as f64 * 0.1;
        DVec3::new(12.0 + 3.6 * angle, 25.0 + 12.0 * angle.cos(), 25.0 + 12.0 * angle.sin())
    };
    let line: Vec<DVec3> = (0..=125).map(turn).collect();
    let start = (line[60], line[61] - line[59]);
    let found = track(|place| blurred(RADIUS - away(place, &line)), 0.0, start, &[]).expect("a track");
    keeps_to(&found, &line, 0.6);
}

/// A straight vessel and its branch.
const STRAIGHT: [DVec3; 2] = [DVec3::new(8.0, 18.0, 25.0), DVec3::new(62.0, 18.0, 25.0)];
const BRANCH: [DVec3; 2] = [DVec3::new(32.0, 18.0, 25.0), DVec3::new(52.0, 42.0, 25.0)];

fn forked(place: DVec3, radius: f64) -> f64 {
    blurred((RADIUS - away(place, &STRAIGHT)).max(radius - away(place, &BRANCH)))
}

#[test]
fn past_a_narrower_branch_the_straight_vessel_is_followed() {
    let start = (STRAIGHT[0].lerp(STRAIGHT[1], 0.2), DVec3::X);
    let found = track(|place| forked(place, 0.5 * RADIUS), 0.0, start, &[]).expect("a track");
    keeps_to(&found, &STRAIGHT, 1.0);
}

#[test]
fn a_track_of_a_branch_ends_in_the_painted_lumen_of_its_parent() {
    let painted: Vec<DVec3> = (0..=54).map(|n| STRAIGHT[0] + DVec3::X * f64::from(n)).collect();
    let start = (BRANCH[0].lerp(BRANCH[1], 0.7), BRANCH[1] - BRANCH[0]);
    let found = track(|place| forked(place, RADIUS), 0.0, start, &painted).expect("a track");
    assert!(found[found.len() - 1].distance(BRANCH[1]) < RADIUS);
    // The track ends one step before the painted lumen.
    let met = away(found[0], &STRAIGHT);
    assert!(met > RADIUS - 1.0 && met < RADIUS + 2.0, "{met}");
}

#[test]
fn no_track_begins_or_runs_on_in_noise() {
    let place = |n: i32| DVec3::new(10.0 + f64::from(n % 10) * 5.0, 8.0 + f64::from(n / 10) * 6.5, 25.0);
    for number in 0..60 {
        let direction = DVec3::new(f64::from(number).cos(), f64::from(number).sin(), 0.3);
        let found = track(|at| TISSUE + 25.0 * white(at), 25.0, (place(number), direction), &[]);
        assert!(found.is_none_or(|points| points.len() < 4), "{number}");
    }
}
