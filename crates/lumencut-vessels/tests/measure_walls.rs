//! Measures arteries with walls in fat and muscle: the lumen without the wall, and the wall itself.
#![allow(clippy::unwrap_used)]

use glam::{DVec2, DVec3};
use lumencut_vessels::measure::model::ellipse::Ellipse;
use lumencut_vessels::measure::profile::{Profile, Source};
use lumencut_vessels::measure::section::flags::CALCIUM;
use lumencut_vessels::measure::wall::{WallRequest, WallSource};

use crate::scans::{Scan, Tube, UPRIGHT, even, mean, profile};

const FAT: f64 = -90.0;
const MUSCLE: f64 = 55.0;
const LUMEN: f64 = 350.0;
const FWHM: f64 = 0.9;

#[derive(Clone, Copy)]
struct Artery {
    diameter: f64,
    thickness: f64,
    wall: f64,
    around: [f64; 2],
    fwhm: f64,
    unit: [f64; 2],
    calcium: f64,
}

const ARTERY: Artery = Artery {
    diameter: 3.0,
    thickness: 0.8,
    wall: 45.0,
    around: [FAT; 2],
    fwhm: FWHM,
    unit: [1.0, 0.0],
    calcium: 0.0,
};

impl Artery {
    fn measured(&self, fwhm: Option<f64>, wall: WallRequest) -> Profile {
        let tube = Tube { sides: even(0.5), fwhm: self.fwhm, ..UPRIGHT };
        let lumen = tube.disc(self.diameter, 0.0);
        let enclosed = tube.disc(self.diameter + 2.0 * self.thickness, 0.0);
        let calcium = tube.share(Ellipse::circle(DVec2::X * (0.5 * self.diameter + 0.4), 0.9));
        let [factor, offset] = self.unit;
        let value = |place: DVec3| {
            let around = self.around[usize::from(place.x > 0.0)];
            let inside = (LUMEN - self.wall) * lumen(place) + (self.wall - around) * enclosed(place);
            let is_plaque = place.z.abs() < 3.0;
            let value = around + inside + if is_plaque { self.calcium * calcium(place) } else { 0.0 };
            // Air in a corner, as in every scan of the body.
            let value = if place.z < -12.0 && place.x < -8.0 && place.y < -8.0 { -1000.0 } else { value };
            value * factor + offset
        };
        let side = (2.0 * (self.diameter + 2.0 * self.thickness + 14.0)) as usize;
        let scan = Scan::new([side, side, 52], tube.sides, 20.0 * factor.abs(), value);
        profile(&scan.volume(), tube.line(22.0), fwhm, wall).unwrap()
    }

    fn automatic(&self) -> Profile {
        self.measured(Some(self.fwhm), WallRequest::Automatic)
    }
}

fn diameter(profile: &Profile) -> f64 {
    mean(&profile.diameter_equivalent())
}

#[test]
fn an_artery_in_fat_is_measured_without_its_wall() {
    for diameter in [1.5_f64, 2.0, 3.0, 6.0, 12.0] {
        let artery = Artery { diameter, thickness: 0.45 * diameter.sqrt(), ..ARTERY };
        let error = self::diameter(&artery.automatic()) - diameter;
        let most = if diameter >= 2.0 * FWHM { (0.03 * diameter).max(0.1) } else { 0.15 };
        assert!(error.abs() < most, "{diameter}: {error}");
        if (2.0..=6.0).contains(&diameter) {
            let without = artery.measured(Some(FWHM), WallRequest::Off);
            assert!(self::diameter(&without) - diameter > 0.35, "{diameter}");
        }
    }
}

#[test]
fn the_wall_is_measured_too_and_the_parts_make_up_the_uncertainty() {
    let profile = ARTERY.automatic();
    let seen: Vec<usize> = (0..profile.len()).filter(|n| profile.wall[*n][0].is_finite()).collect();
    assert!(10 * seen.len() > 9 * profile.len());
    let of =
        |values: &[[f64; 2]], part: usize| mean(&seen.iter().map(|n| values[*n][part]).collect::<Vec<_>>());
    assert!((of(&profile.wall, 0) - 0.8).abs() < 0.15, "{}", of(&profile.wall, 0));
    assert!((of(&profile.diameter_outer, 0) - 4.6).abs() < 0.3, "{}", of(&profile.diameter_outer, 0));
    assert!(
        seen.iter().all(|n| profile.diameter_outer[*n][1] > profile.wall[*n][1] && profile.wall[*n][1] > 0.0)
    );
    for (parts, uncertainty) in profile.uncertainty_parts.iter().zip(&profile.uncertainty) {
        let squares = [parts.noise, parts.point_spread, parts.wall, parts.lumen, parts.surroundings];
        let sum: f64 = squares.iter().map(|part| part * part).sum();
        assert!((sum.sqrt() - uncertainty).abs() < 1e-9);
        assert!(parts.point_spread == 0.0 && parts.wall > 0.005);
    }
    assert_eq!(profile.wall_source, WallSource::Hounsfield);
}

#[test]
fn fat_on_one_side_and_muscle_on_the_other_leave_the_lumen() {
    let profile = Artery { diameter: 4.0, around: [FAT, MUSCLE], ..ARTERY }.automatic();
    assert!((diameter(&profile) - 4.0).abs() < 0.1, "{}", diameter(&profile));
}

#[test]
fn walls_as_bright_as_muscle_are_not_separated_and_add_to_the_uncertainty() {
    let profile = Artery { diameter: 4.0, wall: MUSCLE, around: [MUSCLE; 2], ..ARTERY }.automatic();
    assert_eq!(profile.wall_source, WallSource::AsBright);
    assert!(profile.wall.iter().chain(&profile.diameter_outer).all(|pair| pair[0].is_nan()));
    assert!((diameter(&profile) - 4.0).abs() < 0.06, "{}", diameter(&profile));
    let unsure: Vec<f64> = profile.uncertainty_parts.iter().map(|parts| parts.wall.abs()).collect();
    assert!(unsure.iter().all(|part| *part > 0.01), "{unsure:.4?}");
}

#[test]
fn an_assumed_point_spread_is_uncertain() {
    let artery = Artery { diameter: 1.4, thickness: 0.5, fwhm: 0.6, ..ARTERY };
    let profile = artery.measured(None, WallRequest::Automatic);
    assert!(matches!(profile.fwhm_source, Source::Assumed { .. }));
    assert!(profile.uncertainty_parts.iter().all(|parts| parts.point_spread > 0.01));
}

#[test]
fn the_source_of_the_wall_is_that_of_the_request_and_the_unit() {
    let of = |artery: &Artery, wall| artery.measured(Some(FWHM), wall);
    let given = WallRequest::Level([30.0, 10.0]);
    assert_eq!(of(&ARTERY, given).wall_source, WallSource::Given([30.0, 10.0]));
    assert_eq!(of(&ARTERY, WallRequest::Off).wall_source, WallSource::NotAsked);
    let dark = Artery { unit: [-1.0, 300.0], ..ARTERY };
    let profile = of(&dark, WallRequest::Automatic);
    assert_eq!(profile.wall_source, WallSource::DarkLumen);
    assert!(profile.wall.iter().all(|wall| wall[0].is_nan()));
    let other = Artery { unit: [0.5, 500.0], ..ARTERY };
    assert_eq!(of(&other, WallRequest::Automatic).wall_source, WallSource::OtherUnit);
    let [one, two] = [of(&other, WallRequest::Level([522.5, 12.5])), ARTERY.automatic()];
    for (n, diameter) in one.diameter_equivalent().into_iter().enumerate() {
        assert!((diameter - two.diameter_equivalent()[n]).abs() < 0.01);
    }
}

#[test]
fn no_wall_is_measured_beside_calcium() {
    let profile = Artery { diameter: 4.0, calcium: 1000.0, ..ARTERY }.automatic();
    let calcified: Vec<bool> = profile.flags.iter().map(|flags| flags & CALCIUM != 0).collect();
    assert!(calcified.iter().filter(|is| **is).count() > 5);
    for (wall, is_calcified) in profile.wall.iter().zip(&calcified) {
        assert!(!is_calcified || wall[0].is_nan());
    }
    let free = (0..profile.len()).filter(|n| !calcified[*n]);
    let seen = free.clone().filter(|n| profile.wall[*n][0].is_finite()).count();
    assert!(10 * seen > 8 * free.count());
}
