use super::*;
use crate::trace::find::grid::Grid;
use crate::trace::find::made::{LEVEL, TISSUE, away, blurred, straight_track, with_scan};

const LINE: [DVec3; 2] = [DVec3::new(4.0, 20.0, 20.0), DVec3::new(56.0, 20.0, 20.0)];

/// Confidence and doubt of a track on the test line, shortened to `length` mm, in voxels of 1 mm.
fn judged(value: impl Fn(DVec3) -> f64, radius: f64, length: f64) -> (f64, Option<TrackDoubt>) {
    with_scan([60, 40, 40], 1.0, value, |scan| {
        let grid = Grid::over(scan.voxels, 0.5);
        let pyramid = Pyramid::new(scan.voxels, grid, [0.0, 400.0], &|| false).expect("levels");
        let track = straight_track(LINE[0], LINE[0] + DVec3::X * length, radius);
        let usual = UsualVessels { level: LEVEL, contrast: LEVEL - TISSUE };
        confidence(&pyramid, scan.voxels, &track.points, &usual)
    })
}

fn tube(place: DVec3) -> f64 {
    blurred(2.0 - away(place, &LINE))
}

#[test]
fn nothing_speaks_against_a_tube_and_a_short_one_is_doubtful_as_short() {
    assert_eq!(judged(tube, 2.0, 50.0), (1.0, None));
    // A length of five radii is halfway between the limits of two and eight radii.
    let (sure, doubt) = judged(tube, 2.0, 10.0);
    assert!((sure - (0.6 * 0.5 * 0.5_f64.ln()).exp()).abs() < 1e-9, "{sure}");
    assert_eq!(doubt, Some(TrackDoubt::Short));
}

#[test]
fn what_is_bright_all_around_is_no_vessel() {
    let within = |place: DVec3| if away(place, &LINE) > 3.0 { 450.0 } else { tube(place) };
    let (sure, doubt) = judged(within, 2.0, 50.0);
    assert!(sure < 0.1, "{sure}");
    assert_eq!(doubt, Some(TrackDoubt::BrightSides));
}

#[test]
fn struts_around_a_wide_tube_are_excused_and_around_a_narrow_one_they_are_not() {
    let in_struts = |radius: f64| {
        move |place: DVec3| {
            let depth = radius - away(place, &LINE);
            if (-1.5..0.0).contains(&depth) { 900.0 } else { blurred(depth) }
        }
    };
    let wide = judged(in_struts(7.0), 7.0, 50.0).0;
    let narrow = judged(in_struts(2.0), 2.0, 50.0).0;
    assert!(wide > 0.5 && narrow < 0.2, "{wide} {narrow}");
}

#[test]
fn a_radius_that_jumps_is_doubtful_as_rough() {
    let mut points = straight_track(LINE[0], LINE[1], 2.0).points;
    let even: Vec<&TrackPoint> = points.iter().collect();
    assert_eq!(radius_roughness(&even, 2.0), 0.0);
    for (n, point) in points.iter_mut().enumerate() {
        point.radius = if n % 2 == 0 { 1.5 } else { 2.5 };
    }
    // Steps of size 1 with alternating sign have the standard deviation 1, which is half of the radius.
    let jumping: Vec<&TrackPoint> = points.iter().collect();
    assert!((radius_roughness(&jumping, 2.0) - 0.5).abs() < 1e-3);
}

#[test]
fn bone_that_touches_a_narrow_tube_on_some_sides_does_not_count() {
    let touched = |radius: f64| {
        move |place: DVec3| {
            let depth = radius - away(place, &LINE);
            let is_aside = place.y - LINE[0].y > 0.45 * away(place, &LINE);
            if depth < -1.0 && is_aside { 900.0 } else { blurred(depth) }
        }
    };
    assert_eq!(judged(touched(2.0), 2.0, 50.0), (1.0, None));
    let (sure, doubt) = judged(touched(5.0), 5.0, 50.0);
    assert!(sure < 0.9 && doubt == Some(TrackDoubt::BrightSides), "{sure} {doubt:?}");
}
