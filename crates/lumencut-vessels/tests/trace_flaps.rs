//! Tests that lines stay in their lumen in closed-form aortas with two lumens and a flap between them.
#![allow(clippy::unwrap_used)]

use glam::{DAffine3, DVec3};
use lumencut_core::error::Result;
use lumencut_core::volume::{Volume, Voxels};
use lumencut_vessels::trace::clicks::Traced;
use lumencut_vessels::trace::clicks::checks::Clicks;
use lumencut_vessels::trace::clicks::doubts::Doubted;
use lumencut_vessels::trace::clicks::tracer::Tracer;
use lumencut_vessels::trace::lines::centerline::Centerline;
use lumencut_vessels::voxels;

const SIZE: [usize; 3] = [36, 36, 88];
const SIDE: f64 = 0.75;
const RADIUS: f64 = 10.0;
const LENGTH: f64 = SIDE * 88.0;

const BLUR: f64 = 1.0 / 2.355;

/// A tube of 20 mm along z. A flap, which turns by 40° along the tube, parts it into two lumens.
struct Aorta {
    flap: f64,
    levels: [f64; 2],
    dim: Option<f64>,
    outside: f64,
}

const AORTA: Aorta = Aorta { flap: 0.8, levels: [350.0; 2], dim: None, outside: -100.0 };

fn share(distance: f64) -> f64 {
    1.0 / (1.0 + (-1.702 * distance / BLUR).exp())
}

fn beside_flap(place: DVec3) -> f64 {
    let (sin, cos) = (40.0_f64.to_radians() * (place.z / LENGTH - 0.5)).sin_cos();
    place.x * cos + place.y * sin
}

impl Aorta {
    fn value(&self, place: DVec3) -> f64 {
        let [first, mut second] = self.levels;
        if let Some(dim) = self.dim {
            let middle = share((place.z - 24.0) / 4.0) * share((42.0 - place.z) / 4.0);
            second += (dim - second) * middle;
        }
        let s = beside_flap(place);
        let [before, after] = [share(-s - self.flap / 2.0), share(s - self.flap / 2.0)];
        let blood = before * first + after * second + (1.0 - before - after) * 45.0;
        let r = place.truncate().length();
        let [lumen, wall] = [share(RADIUS - r), share(RADIUS + 1.5 - r)];
        lumen * blood + (wall - lumen) * 45.0 + (1.0 - wall) * self.outside
    }

    fn voxels(&self) -> Vec<i16> {
        let mut seed = 11u32;
        let mut uniform = || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(seed >> 16) / 65536.0 - 0.5
        };
        let value = |n: usize| {
            let index = [n % SIZE[0], n / SIZE[0] % SIZE[1], n / (SIZE[0] * SIZE[1])].map(|c| c as f64);
            let deviate: f64 = (0..12).map(|_| uniform()).sum();
            (self.value(affine().transform_point3(index.into())) + 25.0 * deviate).round() as i16
        };
        (0..SIZE.iter().product()).map(value).collect()
    }

    fn with<T>(&self, work: impl FnOnce(&Volume) -> T) -> T {
        let voxels = self.voxels();
        let strides = [1, SIZE[0], SIZE[0] * SIZE[1]];
        work(&Volume::new(Voxels::I16(&voxels), SIZE, strides, affine()).unwrap())
    }

    fn line(&self, clicks: &[DVec3]) -> Result<Traced> {
        self.with(|volume| traced(volume, clicks))
    }

    fn doubts(&self, traced: &Traced, clicks: &[DVec3]) -> Vec<String> {
        let doubted = Doubted { line: &traced.line, bridged: &traced.bridged, clicks };
        let doubts = self.with(|volume| doubted.doubts(&voxels::Voxels::new(volume)));
        doubts.into_iter().map(|doubt| doubt.words).collect()
    }
}

fn affine() -> DAffine3 {
    DAffine3::from_translation(DVec3::new(-17.5 * SIDE, -17.5 * SIDE, 0.0))
        * DAffine3::from_scale(DVec3::splat(SIDE))
}

fn traced(volume: &Volume, clicks: &[DVec3]) -> Result<Traced> {
    let clicks = Clicks { vessels: vec![clicks.to_vec()], ..Clicks::default() };
    Tracer::default().trace(volume, &clicks, &|| false, None).map(|mut lines| lines.remove(0))
}

fn inside(lumen: f64, z: f64) -> DVec3 {
    let (sin, cos) = (40.0_f64.to_radians() * (z / LENGTH - 0.5)).sin_cos();
    DVec3::new(cos, sin, 0.0) * (lumen * 0.5 * RADIUS) + DVec3::Z * z
}

fn is_within(lumen: f64, line: &Traced) -> bool {
    line.line.points.iter().all(|place| lumen * beside_flap(*place) > 0.0)
}

#[test]
fn lines_between_clicks_in_one_lumen_stay_in_it_though_a_flap_is_as_thin_as_a_voxel() {
    for flap in [0.5, 0.8] {
        let aorta = Aorta { flap, ..AORTA };
        for lumen in [-1.0, 1.0] {
            let clicks = [inside(lumen, 6.0), inside(lumen, 60.0)];
            let line = aorta.line(&clicks).unwrap();
            assert!(is_within(lumen, &line), "{flap} {lumen}");
            assert_eq!(aorta.doubts(&line, &clicks), Vec::<String>::new());
        }
    }
}

#[test]
fn a_line_into_another_lumen_is_refused_or_told() {
    for aorta in [Aorta { levels: [450.0, 200.0], ..AORTA }, AORTA] {
        let clicks = [inside(-1.0, 6.0), inside(1.0, 60.0)];
        let Ok(line) = aorta.line(&clicks) else { continue };
        assert_ne!(aorta.doubts(&line, &clicks), Vec::<String>::new(), "{:?}", aorta.levels);
    }
}

#[test]
fn a_line_through_a_flap_between_lumens_of_equal_brightness_is_told_where_it_crosses() {
    for flap in [0.5, 0.8] {
        let points: Vec<DVec3> =
            (0..=100).map(|n| inside(-1.0, 15.0).lerp(inside(1.0, 50.0), f64::from(n) / 100.0)).collect();
        let line = Centerline { points, radius: vec![6.0; 101], confidence: vec![1.0; 101] };
        let doubted = Doubted { line: &line, bridged: &[], clicks: &[] };
        let doubts = Aorta { flap, ..AORTA }.with(|volume| doubted.doubts(&voxels::Voxels::new(volume)));
        let told = doubts.iter().find(|doubt| doubt.words.contains("crosses a dark sheet")).unwrap();
        let length = line.points[0].distance(line.points[100]);
        assert!((told.at.unwrap() - length / 2.0).abs() < 2.0, "{told:?}");
    }
}

#[test]
fn a_dim_middle_of_a_false_lumen_is_passed_as_a_guess() {
    let aorta = Aorta { levels: [450.0, 300.0], dim: Some(84.0), ..AORTA };
    let clicks = [inside(1.0, 6.0), inside(1.0, 60.0)];
    let line = aorta.line(&clicks).unwrap();
    assert!(is_within(1.0, &line));
    let is_guess = |z: f64| {
        let away = |n: &usize| (line.line.points[*n].z - z).abs();
        let nearest = (0..line.bridged.len()).min_by(|a, b| away(a).total_cmp(&away(b))).unwrap();
        line.bridged[nearest]
    };
    assert_eq!([10.0, 33.0, 56.0].map(is_guess), [false, true, false]);
    let doubts = aorta.doubts(&line, &clicks);
    assert!(doubts.iter().any(|words| words.contains("no clear lumen is seen there (about 9")), "{doubts:?}");
}

#[test]
fn a_click_in_dim_lumen_needs_a_clear_one_beside_it_and_tissue_stays_refused() {
    let aorta = Aorta { levels: [450.0, 300.0], dim: Some(84.0), ..AORTA };
    let [clear, dim] = [inside(1.0, 6.0), inside(1.0, 33.0)];
    let line = aorta.line(&[clear, dim]).unwrap();
    assert!(is_within(1.0, &line));
    let doubts = aorta.doubts(&line, &[clear, dim]);
    assert!(doubts.iter().any(|words| words.contains("the line is a guess")), "{doubts:?}");
    aorta.with(|volume| assert!(Tracer::default().check_click(volume, dim).is_err()));
    assert!(aorta.line(&[dim, inside(1.0, 36.0)]).is_err());
    assert!(aorta.line(&[inside(-1.0, 6.0), dim]).is_err());
    let muscle = Aorta { outside: 84.0, ..AORTA };
    assert!(muscle.line(&[clear, DVec3::new(-12.6, -12.6, 33.0)]).is_err());
}

#[test]
fn a_line_much_longer_than_the_distance_of_its_clicks_is_told() {
    let leg = |lumen: f64| (0..=80).map(move |n| inside(lumen, 10.0 + 0.5 * f64::from(n)));
    let points: Vec<DVec3> = leg(-1.0).chain(leg(1.0).rev()).collect();
    let count = points.len();
    let line = Centerline { points, radius: vec![4.0; count], confidence: vec![1.0; count] };
    let told = |first: usize, last: usize| {
        let clicks = [line.points[first], line.points[last]];
        let doubted = Doubted { line: &line, bridged: &[], clicks: &clicks };
        let doubts = AORTA.with(|volume| doubted.doubts(&voxels::Voxels::new(volume)));
        doubts.iter().any(|doubt| doubt.words.contains("mm long between points 10 mm apart"))
    };
    assert!(told(0, count - 1));
    assert!(!told(0, 80));
}
