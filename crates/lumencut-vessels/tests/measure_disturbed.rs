//! Measures vessels next to calcium, metal, other vessels and branches, and lines without walls.
#![allow(clippy::unwrap_used)]

use glam::DVec3;
use lumencut_core::error::ErrorKind;
use lumencut_core::vessel_tree::Vessel;
use lumencut_vessels::measure::profile::Profile;
use lumencut_vessels::measure::profile::measuring::measure;
use lumencut_vessels::measure::profile::request::MeasureRequest;
use lumencut_vessels::measure::section::flags::{BRANCH, CALCIUM, METAL, NEIGHBOR};
use lumencut_vessels::measure::wall::WallRequest;

use crate::scans::{FWHM, LUMEN, NOISE, Scan, TISSUE, Tube, UPRIGHT, even, mean, profile};

fn with(diameter: f64, more: impl Fn(DVec3) -> f64) -> Profile {
    let share = UPRIGHT.disc(diameter, 0.0);
    let value = |place| TISSUE + (LUMEN - TISSUE) * share(place) + more(place);
    let scan = Scan::new([40, 40, 60], even(0.4), NOISE, value);
    profile(&scan.volume(), UPRIGHT.line(20.0), Some(FWHM), WallRequest::Automatic).unwrap()
}

fn bias(profile: &Profile, diameter: f64) -> f64 {
    100.0 * (mean(&profile.diameter_equivalent()) / diameter - 1.0)
}

fn flagged(profile: &Profile, flags: u32) -> f64 {
    profile.flags.iter().filter(|found| **found & flags != 0).count() as f64 / profile.len() as f64
}

#[test]
fn calcium_in_the_wall_is_no_lumen() {
    let calcium = UPRIGHT.disc(1.6, 2.85);
    let profile = with(4.0, |place| 1050.0 * calcium(place));
    assert!(flagged(&profile, CALCIUM) > 0.9);
    assert!(bias(&profile, 4.0).abs() < 8.0, "{}", bias(&profile, 4.0));
}

#[test]
fn a_stent_is_metal_and_no_place_in_it_is_suggested() {
    let [outer, inner] = [6.8, 6.0].map(|diameter| UPRIGHT.disc(diameter, 0.0));
    let profile = with(6.0, |place| 2950.0 * (outer(place) - inner(place)));
    assert_eq!(flagged(&profile, METAL), 1.0);
    assert!(bias(&profile, 6.0).abs() < 12.0, "{}", bias(&profile, 6.0));
    assert_eq!(profile.narrowest(), None);
    assert!(profile.none_safe().unwrap() & METAL != 0);
}

#[test]
fn a_neighbour_at_a_millimetre_is_flagged_and_harms_little() {
    let other = UPRIGHT.disc(4.0, 5.0);
    let profile = with(4.0, |place| (LUMEN - TISSUE) * other(place));
    assert!(flagged(&profile, NEIGHBOR) > 0.9);
    assert!(bias(&profile, 4.0).abs() < 5.0, "{}", bias(&profile, 4.0));
}

const OF_BYTES: Tube = Tube { sides: even(0.5), fwhm: 0.9, ..UPRIGHT };

fn of_bytes(value: impl Fn(DVec3) -> f64) -> Profile {
    let scan = Scan::new([28, 28, 84], OF_BYTES.sides, 1.5, value);
    scan.of_bytes(|volume| profile(volume, OF_BYTES.line(38.0), None, WallRequest::Automatic).unwrap())
}

#[test]
fn what_is_brighter_than_lumen_by_more_than_its_noise_is_no_lumen() {
    for (diameter, x, more) in [(1.4, 2.3, 44.0), (6.0, 0.0, 35.0), (4.0, -1.0, 35.0)] {
        let [lumen, plaque] = [OF_BYTES.disc(6.0, 0.0), OF_BYTES.disc(diameter, x)];
        let within = |place: DVec3| if place.z.abs() < 3.0 { more * plaque(place) } else { 0.0 };
        let profile = of_bytes(|place| 5.0 + 115.0 * lumen(place) + within(place));
        for n in 0..profile.len() {
            let away = (profile.arc_length[n] - 19.0).abs();
            assert!(away > 2.0 || profile.flags[n] & (CALCIUM | METAL) != 0, "{x}: {away}");
            assert!(away <= 5.0 || profile.flags[n] == 0, "{x}: {away} {}", profile.flags[n]);
        }
    }
}

#[test]
fn contrast_medium_that_mixes_and_an_edge_that_is_enhanced_are_lumen() {
    let [plain, wider] = [0.9_f64, 2.01].map(|fwhm| Tube { fwhm, ..OF_BYTES }.disc(6.0, 0.0));
    for overshoot in [0.0, 1.0] {
        let share = |place| plain(place) + overshoot * (plain(place) - wider(place));
        let profile = of_bytes(|place| 5.0 + 115.0 * (1.0 + 0.15 * (place.z / 10.0).tanh()) * share(place));
        assert_eq!(flagged(&profile, u32::MAX), 0.0);
        assert!(bias(&profile, 6.0).abs() < 1.5, "{overshoot}: {}", bias(&profile, 6.0));
    }
}

#[test]
fn sections_within_a_junction_are_left_out() {
    let branch = Tube { along: DVec3::X, ..UPRIGHT }.disc(3.0, 0.0);
    let main = UPRIGHT.disc(4.0, 0.0);
    let share = |place: DVec3| main(place).max(if place.x > 0.0 { branch(place) } else { 0.0 });
    let scan = Scan::new([55, 28, 65], even(0.4), NOISE, |place| TISSUE + (LUMEN - TISSUE) * share(place));
    let line = UPRIGHT.line(22.0);
    let vessel =
        |points: &[DVec3], radius| Vessel::new(points.to_vec(), Some(vec![radius; points.len()])).unwrap();
    let side: Vec<DVec3> = (0..=20).map(|n| DVec3::X * 0.5 * f64::from(n)).collect();
    let tree = [vessel(&line[..23], 2.0), vessel(&line[22..], 2.0), vessel(&side, 1.5)];
    let wall = WallRequest::Automatic;
    let request = MeasureRequest { step: 0.5, fwhm: Some(FWHM), wall, tree: &tree, stop: &|| false };
    let profile = measure(&scan.volume(), &Vessel::new(line, None).unwrap(), &request).unwrap();
    let marked: Vec<f64> = (0..profile.len())
        .filter(|n| profile.flags[*n] & BRANCH != 0)
        .map(|n| profile.arc_length[n])
        .collect();
    assert!((marked[0] - 9.5).abs() <= 1.5 && (marked[marked.len() - 1] - 12.5).abs() <= 1.5, "{marked:?}");
    assert!(profile.widest().unwrap().diameter < 4.5);
    let free: Vec<f64> = (0..profile.len())
        .filter(|n| profile.flags[*n] == 0)
        .map(|n| profile.diameter_equivalent()[n])
        .collect();
    assert!((mean(&free) / 4.0 - 1.0).abs() < 0.02, "{}", mean(&free));
}

#[test]
fn a_line_that_leaves_its_vessel_is_measured_as_far_as_there_is_a_wall() {
    let share = UPRIGHT.disc(6.0, 0.0);
    let tube = Tube { sides: even(0.8), ..UPRIGHT };
    let of = |end: f64| {
        let inside = |place: DVec3| if place.z < end { share(place) } else { 0.0 };
        let scan =
            Scan::new([30, 30, 175], tube.sides, NOISE, |place| TISSUE + (LUMEN - TISSUE) * inside(place));
        profile(&scan.volume(), tube.line(130.0), Some(FWHM), WallRequest::Automatic).unwrap()
    };
    let cut = of(-10.0);
    let [[from, to]] = cut.without_wall[..] else { panic!("{:?}", cut.without_wall) };
    assert!((45.0..=56.0).contains(&from) && (to - 130.0).abs() < 1e-9, "{from} {to}");
    for n in 0..cut.len() {
        let at = cut.arc_length[n];
        assert!(at >= 45.0 || cut.area[n].is_finite());
        assert!(at >= 40.0 || (cut.diameter_equivalent()[n] - 6.0).abs() < 0.3);
        assert!(at <= from + 1.0 || cut.area[n].is_nan());
    }
    assert_eq!(of(f64::MAX).without_wall, Vec::<[f64; 2]>::new());
}

#[test]
fn a_line_without_any_wall_is_refused_with_both_levels() {
    let scan = Scan::new([30, 30, 60], even(1.0), 20.0, |_| 341.5);
    let error = profile(&scan.volume(), UPRIGHT.line(56.0), None, WallRequest::Automatic).unwrap_err();
    assert_eq!(error.kind, ErrorKind::Measuring);
    assert!(error.found.starts_with("no wall around it: 33"), "{error}");
}
