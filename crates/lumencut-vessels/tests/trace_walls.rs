//! Tests that lines through the wall between two vessels are reported, in a closed-form artery of 3 mm next to a vein of 5 mm
//! with the same brightness.
#![allow(clippy::unwrap_used)]

use std::f64::consts::PI;

use glam::{DAffine3, DVec3};
use lumencut_core::volume::{Volume, Voxels};
use lumencut_vessels::trace::clicks::checks::Clicks;
use lumencut_vessels::trace::clicks::doubts::Doubted;
use lumencut_vessels::trace::clicks::tracer::Tracer;
use lumencut_vessels::trace::lines::centerline::Centerline;
use lumencut_vessels::trace::lumen::wall_crossing::wall_crossings;
use lumencut_vessels::voxels;

const SIZE: [usize; 3] = [34, 22, 84];
const SIDE: f64 = 0.6;
const LENGTH: f64 = SIDE * 84.0;
const BLUR: f64 = 0.8 / 2.355;
const LUMEN: f64 = 340.0;

/// Radii of the artery and of the vein (mm).
const RADII: [f64; 2] = [1.5, 2.5];

/// An artery with a stenosis in the middle, and a vein beside it. Walls have 45 HU.
struct Pair {
    gap: Option<f64>,
    stenosis: f64,
    noise: f64,
}

fn artery(z: f64) -> DVec3 {
    DVec3::new(3.0 * (PI * z / LENGTH).sin() - 5.5, 0.0, z)
}

fn share(distance: f64) -> f64 {
    1.0 / (1.0 + (-1.702 * distance / BLUR).exp())
}

impl Pair {
    fn value(&self, place: DVec3) -> f64 {
        let axis = artery(place.z);
        let middle = (-0.5 * ((place.z - LENGTH / 2.0) / 3.0).powi(2)).exp();
        let away = place.distance(axis);
        let mut lumen = share(RADII[0] * (1.0 - self.stenosis * middle) - away);
        let mut wall = share(RADII[0] + 0.7 - away);
        if let Some(gap) = self.gap {
            let away = place.distance(axis + DVec3::X * (RADII[0] + gap + RADII[1]));
            let is_there = share((place.z - 7.0) / 2.0) * share((LENGTH - 7.0 - place.z) / 2.0);
            lumen += is_there * share(RADII[1] - away);
            wall = wall.max(is_there * share(RADII[1] + 0.5 - away));
        }
        -80.0 + (45.0 + 80.0) * wall.max(lumen.min(1.0)) + (LUMEN - 45.0) * lumen.min(1.0)
    }

    fn with<T>(&self, work: impl FnOnce(&Volume) -> T) -> T {
        let affine = DAffine3::from_translation(DVec3::new(-16.5 * SIDE, -10.5 * SIDE, 0.0))
            * DAffine3::from_scale(DVec3::splat(SIDE));
        let mut seed = 5u32;
        let mut uniform = || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(seed >> 16) / 65536.0 - 0.5
        };
        let value = |n: usize| {
            let index = [n % SIZE[0], n / SIZE[0] % SIZE[1], n / (SIZE[0] * SIZE[1])].map(|c| c as f64);
            let deviate: f64 = (0..12).map(|_| uniform()).sum();
            (self.value(affine.transform_point3(index.into())) + self.noise * deviate).round() as i16
        };
        let voxels: Vec<i16> = (0..SIZE.iter().product()).map(value).collect();
        work(&Volume::new(Voxels::I16(&voxels), SIZE, [1, SIZE[0], SIZE[0] * SIZE[1]], affine).unwrap())
    }
}

fn doubts(volume: &Volume, line: &Centerline, clicks: &[DVec3]) -> Vec<String> {
    let doubted = Doubted { line, bridged: &[], clicks };
    doubted.doubts(&voxels::Voxels::new(volume)).into_iter().map(|doubt| doubt.words).collect()
}

#[test]
fn a_line_between_clicks_in_an_artery_stays_in_it_or_is_told_to_leave_it() {
    for (gap, stenosis) in [(0.3, 0.0), (0.3, 0.7), (0.45, 0.5), (0.6, 0.7)] {
        let pair = Pair { gap: Some(gap), stenosis, noise: 20.0 };
        pair.with(|volume| {
            let ends = [artery(3.0), artery(LENGTH - 3.0)];
            let clicks = Clicks { vessels: vec![ends.to_vec()], ..Clicks::default() };
            let Ok(mut lines) = Tracer::default().trace(volume, &clicks, &|| false, None) else { return };
            let line = lines.remove(0).line;
            let is_inside = line.points.iter().all(|place| place.distance(artery(place.z)) < 1.8);
            let told = doubts(volume, &line, &ends);
            assert_eq!(is_inside, told.is_empty(), "{gap} {stenosis}: {told:?}");
        });
    }
}

/// A line along the artery, moved sideways.
fn aside(by: &dyn Fn(f64) -> f64) -> Centerline {
    let places = (12..=176).map(|n| f64::from(n) * LENGTH / 188.0);
    let points: Vec<DVec3> = places.map(|z| artery(z) + DVec3::X * by(z)).collect();
    let count = points.len();
    Centerline { points, radius: vec![1.5; count], confidence: vec![1.0; count] }
}

/// A line that leaves the artery for the vein between two levels (mm).
fn through_vein(gap: f64, [from, to]: [f64; 2]) -> Centerline {
    aside(&|z| (RADII[0] + gap + RADII[1]) * share((z - from) / 8.0) * share((to - z) / 8.0))
}

#[test]
fn distant_crossings_are_doubts_of_their_own() {
    Pair { gap: Some(0.6), stenosis: 0.0, noise: 20.0 }.with(|volume| {
        let line = through_vein(0.6, [12.0, 39.0]);
        let doubted = Doubted { line: &line, bridged: &[], clicks: &[] };
        let doubts = doubted.doubts(&voxels::Voxels::new(volume));
        let crossed: Vec<_> = doubts.iter().filter(|doubt| doubt.words.contains("dark sheet")).collect();
        let [first, second] = crossed[..] else { panic!("{doubts:?}") };
        assert!(second.at.unwrap() - first.at.unwrap() > 20.0, "{crossed:?}");
        assert!(crossed.iter().all(|doubt| doubt.words.starts_with("Doubtful at ")), "{crossed:?}");
    });
}

#[test]
fn a_line_through_a_vein_is_told_from_where_it_leaves_its_artery_and_the_axis_is_silent() {
    for gap in [0.3, 0.6] {
        let pair = Pair { gap: Some(gap), stenosis: 0.0, noise: 20.0 };
        let to_vein = through_vein(gap, [15.0, 35.0]);
        pair.with(|volume| {
            let told = doubts(volume, &to_vein, &[]);
            assert!(told.iter().any(|words| words.contains("crosses a dark sheet")), "{told:?}");
            assert_eq!(doubts(volume, &aside(&|_| 0.0), &[]), Vec::<String>::new());
        });
    }
}

#[test]
fn the_throat_of_a_stenosis_is_no_wall() {
    for stenosis in [0.5, 0.7, 0.8] {
        let pair = Pair { gap: None, stenosis, noise: 20.0 };
        let points: Vec<DVec3> = (8..=92).map(|n| artery(f64::from(n) * LENGTH / 100.0)).collect();
        let count = points.len();
        let line = Centerline { points, radius: vec![1.5; count], confidence: vec![1.0; count] };
        pair.with(|volume| {
            assert_eq!(wall_crossings(&voxels::Voxels::new(volume), &line), [], "{stenosis}");
        });
    }
}
