//! Measures vessels of known width, with known blur and noise.
#![allow(clippy::unwrap_used)]

use std::f64::consts::PI;

use glam::{DMat3, DVec2, DVec3};
use lumencut_core::vessel_tree::Vessel;
use lumencut_vessels::measure::model::ellipse::Ellipse;
use lumencut_vessels::measure::profile::cross_section::{CrossSection, section_place};
use lumencut_vessels::measure::profile::measuring::measure;
use lumencut_vessels::measure::profile::request::MeasureRequest;
use lumencut_vessels::measure::profile::{Profile, Source};
use lumencut_vessels::measure::section::flags::RECENTERED;
use lumencut_vessels::measure::wall::WallRequest;

use crate::scans::{FWHM, LUMEN, NOISE, Scan, TISSUE, Tube, UPRIGHT, even, mean, narrowed, profile};

fn round(diameter: f64, length: f64, tube: Tube, fwhm: Option<f64>) -> Profile {
    let scan = scan(diameter, length, tube);
    profile(&scan.volume(), tube.line(length), fwhm, WallRequest::Automatic).unwrap()
}

fn scan(diameter: f64, length: f64, tube: Tube) -> Scan {
    let side = (2.5 * (diameter + 9.0)).ceil() as usize;
    let share = tube.disc(diameter, 0.0);
    let layers = (2.5 * (length + 4.0)) as usize;
    Scan::new([side, side, layers], tube.sides, NOISE, |place| TISSUE + (LUMEN - TISSUE) * share(place))
}

fn bias(profile: &Profile, diameter: f64) -> f64 {
    100.0 * (mean(&profile.diameter_equivalent()) / diameter - 1.0)
}

#[test]
fn narrow_vessels_have_no_bias_by_the_blur_and_their_scatter_is_the_stated_uncertainty() {
    for (diameter, most) in [(4.0, 2.0), (2.4, 2.0), (1.6, 5.0), (1.2, 5.0)] {
        let profile = round(diameter, 36.0, UPRIGHT, Some(FWHM));
        assert!(bias(&profile, diameter).abs() <= most, "{diameter}: {} %", bias(&profile, diameter));
        let off = profile.diameter_equivalent();
        let off =
            off.iter().zip(&profile.uncertainty).map(|(found, told)| ((found - diameter) / told).powi(2));
        let scatter = mean(&off.collect::<Vec<_>>()).sqrt();
        assert!((0.4..1.6).contains(&scatter), "{diameter}: {scatter}");
    }
}

#[test]
fn a_wide_vessel_is_measured_to_a_part_of_a_voxel() {
    let profile = round(6.0, 30.0, UPRIGHT, Some(FWHM));
    assert!((mean(&profile.diameter_equivalent()) - 6.0).abs() < 0.015);
    assert!((profile.noise / NOISE - 1.0).abs() < 0.1, "{}", profile.noise);
    for n in 0..profile.len() {
        assert!((profile.diameter_equivalent()[n] - 6.0).abs() < 0.08);
        assert!((profile.inscribed_radius[n] - 3.0).abs() < 0.3, "{}", profile.inscribed_radius[n]);
        assert!(profile.center[n].truncate().length() < 0.06);
        assert_eq!(profile.flags[n], 0);
        assert_eq!(profile.contour[n].len(), 64);
        assert!(profile.contour[n].iter().all(|point| (point.distance(profile.center[n]) - 3.0).abs() < 0.5));
        let ellipse = PI / 4.0 * profile.diameter_min[n] * profile.diameter_max[n];
        assert!((profile.area[n] - ellipse).abs() < 1e-9);
        assert!(profile.normal[n].distance(DVec3::Z) < 1e-9);
    }
    for (level, truth) in [LUMEN, TISSUE].into_iter().enumerate() {
        let found: Vec<f64> = profile.levels.iter().map(|levels| levels[level]).collect();
        assert!((mean(&found) - truth).abs() < 3.0, "{}", mean(&found));
    }
    assert!(profile.arc_length.windows(2).all(|two| two[1] > two[0] && two[1] - two[0] <= 0.5 + 1e-9));
    assert_eq!(profile.arc_length[0], 0.0);
    assert!((profile.length() - 30.0).abs() < 1e-9);
}

#[test]
fn a_narrow_part_takes_its_level_from_the_wide_one() {
    let (scan, line) = narrowed(70.0);
    let profile = profile(&scan.volume(), line, Some(FWHM), WallRequest::Automatic).unwrap();
    assert!((profile.diameter_at(30.0).unwrap().0 - 1.5).abs() < 0.15);
    let level = profile.levels[profile.len() / 2][0];
    assert!((level / LUMEN - 1.0).abs() < 0.03, "{level}");
}

#[test]
fn ellipses_are_measured_on_oblique_sheared_and_uneven_grids() {
    let grids = [
        (even(0.4), DVec3::new(1.0, -0.7, 0.9)),
        (DMat3::from_diagonal(DVec3::new(0.4, 0.4, 1.0)), DVec3::new(1.0, 0.1, 0.3)),
        (
            DMat3::from_cols_array_2d(&[[0.4, 0.0, 0.0], [0.0, 0.4, 0.0], [0.0, 0.28, 0.8]]),
            DVec3::new(0.2, 0.1, 1.0),
        ),
    ];
    for (sides, along) in grids {
        let tube = Tube { along: along.normalize(), sides, fwhm: FWHM };
        let share = tube.share(Ellipse { center: DVec2::ZERO, mean: 2.25, stretch: DVec2::new(0.75, 0.0) });
        let extent = 13.0 + 16.0 * tube.along.abs();
        let size = (0..3).map(|a| (extent[a] / sides.col(a)[a]).ceil() as usize).collect::<Vec<_>>();
        let value = |place| TISSUE + (LUMEN - TISSUE) * share(place);
        let scan = Scan::new([size[0], size[1], size[2]], sides, NOISE, value);
        let profile = profile(&scan.volume(), tube.line(16.0), Some(FWHM), WallRequest::Automatic).unwrap();
        let [long, short] = [mean(&profile.diameter_max), mean(&profile.diameter_min)];
        assert!((long / 6.0 - 1.0).abs() < 0.03 && (short / 3.0 - 1.0).abs() < 0.03, "{long} {short}");
    }
}

#[test]
fn dark_lumens_are_lumens_too() {
    let share = UPRIGHT.disc(3.0, 0.0);
    let scan = Scan::new([30, 30, 60], even(0.4), NOISE, |place| 280.0 - 260.0 * share(place));
    let profile = profile(&scan.volume(), UPRIGHT.line(20.0), Some(FWHM), WallRequest::Automatic).unwrap();
    assert!(bias(&profile, 3.0).abs() < 2.0);
    assert!(profile.levels.iter().all(|levels| levels[0] < 60.0 && levels[1] > 240.0));
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let of = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| round(4.0, 12.0, UPRIGHT, Some(FWHM)))
    };
    let [one, three] = [1, 3].map(of);
    assert_eq!((one.area, one.contour, one.uncertainty), (three.area, three.contour, three.uncertainty));
}

#[test]
fn the_point_spread_is_estimated_on_wide_vessels_and_assumed_for_narrow_ones() {
    let wide = round(6.0, 20.0, Tube { fwhm: 1.1, ..UPRIGHT }, None);
    assert!((wide.fwhm / 1.1 - 1.0).abs() < 0.1, "{}", wide.fwhm);
    assert!(matches!(wide.fwhm_source, Source::Estimated { .. }));
    let narrow = round(1.2, 20.0, UPRIGHT, None);
    assert_eq!(narrow.fwhm, 0.85);
    let Source::Assumed { from } = narrow.fwhm_source else { panic!("{:?}", narrow.fwhm_source) };
    assert!(from.ends_with("as no vessel is wide enough to estimate it"), "{from}");
}

#[test]
fn short_stretches_tell_no_point_spread() {
    let scan = scan(5.0, 26.0, UPRIGHT);
    let of = |length| profile(&scan.volume(), UPRIGHT.line(length), None, WallRequest::Automatic).unwrap();
    let Source::Assumed { from } = of(2.0).fwhm_source else { panic!("estimated") };
    assert!(
        from.ends_with("as free, round stretches of wide vessels are too short to estimate it"),
        "{from}"
    );
    assert!((of(8.0).fwhm / FWHM - 1.0).abs() < 0.1);
}

#[test]
fn all_vessels_of_a_tree_are_measured_with_the_point_spread_of_its_wide_vessels() {
    let [wide, narrow] = [UPRIGHT.disc(6.0, -4.8), UPRIGHT.disc(3.0, 5.6)];
    let value = |place| TISSUE + (LUMEN - TISSUE) * (wide(place) + narrow(place));
    let scan = Scan::new([60, 30, 60], even(0.4), NOISE, value);
    let beside = |x: f64, first: usize| {
        let points = UPRIGHT.line(20.0)[first..].iter().map(|point| *point + DVec3::X * x).collect();
        Vessel::new(points, None).unwrap()
    };
    let wall = WallRequest::Automatic;
    let of = |vessel: &Vessel, tree: &[Vessel]| {
        let request = MeasureRequest { step: 0.5, fwhm: None, wall, tree, stop: &|| false };
        measure(&scan.volume(), vessel, &request).unwrap()
    };
    let tree = [beside(-4.8, 0), beside(5.6, 0)];
    let [first, second] = [&tree[0], &tree[1]].map(|vessel| of(vessel, &tree));
    assert_eq!((first.fwhm, &first.fwhm_source), (second.fwhm, &second.fwhm_source));
    assert!((first.fwhm / FWHM - 1.0).abs() < 0.1, "{}", first.fwhm);
    assert!((mean(&second.diameter_equivalent()) / 3.0 - 1.0).abs() < 0.03);
    let stubs = [beside(-4.8, 39), beside(5.6, 39)];
    assert!(matches!(of(&tree[0], &[]).fwhm_source, Source::Estimated { .. }));
    assert_eq!(of(&tree[0], &stubs).fwhm, 0.85);
}

#[test]
fn a_sharp_wall_does_not_pass_for_a_blurred_one() {
    for diameter in [4.0, 5.0, 6.0, 8.0, 10.0] {
        for noise in [0.0, 20.0] {
            let value = |place: DVec3| if place.truncate().length() <= diameter / 2.0 { 300.0 } else { 0.0 };
            let scan = Scan::new([25; 3], even(1.0), noise, value);
            let profile = profile(&scan.volume(), UPRIGHT.line(20.0), None, WallRequest::Off).unwrap();
            assert!(bias(&profile, diameter).abs() < 5.0, "{diameter}: {}", bias(&profile, diameter));
            assert!((profile.fwhm - 1.2).abs() < 1e-9, "{}", profile.fwhm);
            let Source::Assumed { from } = profile.fwhm_source else { panic!("estimated") };
            assert!(
                from.starts_with("1.2 sides of a voxel, as the walls of wide vessels are sharper"),
                "{from}"
            );
        }
    }
}

#[test]
fn a_line_beside_the_middle_is_recentred_and_where_it_is_outside_that_is_said() {
    let scan = scan(4.0, 20.0, UPRIGHT);
    let of = |moved: &dyn Fn(usize) -> f64| {
        let line = UPRIGHT.line(20.0).into_iter().enumerate().map(|(n, point)| point + DVec3::X * moved(n));
        profile(&scan.volume(), line.collect(), Some(FWHM), WallRequest::Automatic).unwrap()
    };
    let beside = of(&|_| 1.2);
    assert!(bias(&beside, 4.0).abs() < 2.0);
    assert!((0..beside.len()).all(|n| beside.flags[n] == 0 && beside.center[n].x.abs() < 0.1));
    let leaving = of(&|n| 2.8 * n as f64 / 40.0);
    let outside: Vec<usize> = (0..leaving.len()).filter(|n| leaving.flags[*n] & RECENTERED != 0).collect();
    assert!((leaving.arc_length[outside[0]] - 20.0 * 2.0 / 2.8).abs() < 1.5);
    assert_eq!(outside.last(), Some(&(leaving.len() - 1)));
    assert!(leaving.center.iter().all(|center| center.x.abs() < 0.3));
}

#[test]
fn cross_sections_lie_across_the_vessel_with_the_left_of_the_patient_on_the_right() {
    let tube = Tube { along: DVec3::new(0.0, 0.5, 1.0).normalize(), ..UPRIGHT };
    let share = tube.disc(5.0, 0.0);
    let scan = Scan::new([35, 60, 60], tube.sides, 0.0, |place| TISSUE + (LUMEN - TISSUE) * share(place));
    let vessel = Vessel::new(tube.line(14.0), None).unwrap();
    let place = section_place(&vessel, 7.0, None).unwrap();
    let section = CrossSection::new(&scan.volume(), place, 12.0, 0.2).unwrap();
    assert_eq!(section.pixels, 60);
    assert!(section.place.normal.distance(tube.along) < 1e-9);
    let positions = section.positions();
    assert!(positions.iter().all(|position| position.dot(tube.along).abs() < 1e-9));
    assert!(positions[59].x > positions[0].x && positions[59 * 60].y > positions[0].y);
    let inside = section.value.iter().filter(|value| f64::from(**value) > (LUMEN + TISSUE) / 2.0).count();
    assert!((inside as f64 * 0.04 / (PI * 2.5 * 2.5) - 1.0).abs() < 0.05);
}
