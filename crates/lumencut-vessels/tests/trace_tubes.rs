//! Traces vessels along circles, where the distance of a place from the axis is known exactly.
#![allow(clippy::unwrap_used)]

use std::f64::consts::PI;

use glam::{DAffine3, DMat3, DVec3};
use lumencut_core::error::Result;
use lumencut_core::volume::{Volume, Voxels};
use lumencut_scenes::random::Random;
use lumencut_vessels::trace::clicks::Traced;
use lumencut_vessels::trace::clicks::checks::Clicks;
use lumencut_vessels::trace::clicks::tracer::Tracer;
use lumencut_vessels::trace::ways::region::Stopper;

use crate::scans::noise;

const LUMEN: f64 = 350.0;
const TISSUE: f64 = 50.0;
const FAT: f64 = -100.0;
const BEND: f64 = 30.0;

/// The place at an angle on the circle of radius `BEND` (mm) in a tilted plane, moved outwards and upwards (mm).
fn on(angle: f64, outwards: f64, upwards: f64) -> DVec3 {
    tilt() * DVec3::new((BEND + outwards) * angle.cos(), upwards, (BEND + outwards) * angle.sin())
}

fn tilt() -> DMat3 {
    DMat3::from_rotation_x(0.4) * DMat3::from_rotation_y(0.3)
}

/// The angle of a place, and its distances outwards and upwards from the circle (mm).
fn seen(place: DVec3) -> [f64; 3] {
    let flat = tilt().transpose() * place;
    [flat.z.atan2(flat.x), flat.x.hypot(flat.z) - BEND, flat.y]
}

fn away(place: DVec3) -> f64 {
    let [_, outwards, upwards] = seen(place);
    outwards.hypot(upwards)
}

/// The share of a structure within a signed distance (mm), with an edge as wide as in scans.
fn share(depth: f64) -> f64 {
    1.0 / (1.0 + (-4.0 * depth).exp())
}

struct Scan {
    size: [usize; 3],
    affine: DAffine3,
    values: Vec<i16>,
}

impl Scan {
    /// Voxels with these sides (mm, as columns); `value` is that of the angle and distances of `seen`.
    fn new(sides: DMat3, value: impl Fn([f64; 3]) -> f64) -> Self {
        let size = [0, 1, 2].map(|a| (2.0 * (BEND + 12.0) / sides.col(a)[a]).ceil() as usize);
        let last = DVec3::from(size.map(|n| (n - 1) as f64));
        let affine = DAffine3::from_mat3_translation(sides, -(sides * last / 2.0));
        let mut random = Random::new(7);
        let mut voxel = |n: usize| {
            let index = [n % size[0], n / size[0] % size[1], n / (size[0] * size[1])].map(|c| c as f64);
            (value(seen(affine.transform_point3(index.into()))) + 20.0 * noise(&mut random)).round() as i16
        };
        let values = (0..size.iter().product()).map(&mut voxel).collect();
        Self { size, affine, values }
    }

    fn volume(&self) -> Volume<'_> {
        lumencut_scenes::volumes::volume(Voxels::I16(&self.values), self.size, self.affine)
    }

    fn traced(&self, clicks: &[DVec3]) -> Result<Traced> {
        traced(&self.volume(), &Clicks { vessels: vec![clicks.to_vec()], ..Clicks::default() })
    }
}

fn traced(volume: &Volume, clicks: &Clicks) -> Result<Traced> {
    Tracer::default().trace(volume, clicks, &|| false, None).map(|mut lines| lines.remove(0))
}

fn even(side: f64) -> DMat3 {
    DMat3::from_diagonal(DVec3::splat(side))
}

fn lumen([angle, outwards, upwards]: [f64; 3], radius: f64) -> f64 {
    let end = BEND * (angle - 0.2).min(PI - 0.2 - angle);
    share((radius - outwards.hypot(upwards)).min(end))
}

const ENDS: [f64; 2] = [0.3, PI - 0.3];

fn errors(line: &Traced) -> [f64; 2] {
    let off: Vec<f64> = line.line.points.iter().map(|point| away(*point)).collect();
    [off.iter().sum::<f64>() / off.len() as f64, off.into_iter().fold(0.0, f64::max)]
}

fn narrowed(angle: f64, healthy: f64, percent: f64) -> f64 {
    let along = (BEND * (angle - PI / 2.0)).abs().min(6.0);
    healthy * (1.0 - percent / 100.0 * (0.5 + 0.5 * (PI * along / 6.0).cos()))
}

#[test]
fn a_tube_with_a_stenosis_is_traced_within_a_twentieth_of_a_millimetre() {
    let scan = Scan::new(even(0.6), |at| TISSUE + (LUMEN - TISSUE) * lumen(at, narrowed(at[0], 3.0, 45.0)));
    let line = scan.traced(&ENDS.map(|angle| on(angle, 0.0, 0.0))).unwrap();
    let [mean, most] = errors(&line);
    assert!(mean <= 0.05 && most <= 0.25, "{mean} {most}");
    assert!(line.line.points.windows(2).all(|two| two[0].distance(two[1]) <= 0.5 + 1e-9));
    let wrong = |n: usize| (line.line.radius[n] - narrowed(seen(line.line.points[n])[0], 3.0, 45.0)).abs();
    let count = line.line.points.len();
    assert!((0..count).map(wrong).sum::<f64>() / (count as f64) < 0.05);
    assert!(line.line.confidence.iter().all(|confidence| *confidence > 0.8));
    assert!(!line.bridged.contains(&true));
    let moved = [on(0.3, 1.8, 0.6), on(1.5, -0.8, -0.6), on(PI - 0.3, -1.2, 1.2)];
    let line = scan.traced(&moved).unwrap();
    let count = line.line.points.len();
    assert!(line.line.points[3..count - 3].iter().all(|point| away(*point) < 0.1));
}

#[test]
fn what_lies_in_and_beside_vessels_does_not_lead_the_line_astray() {
    let scene = |what: &str, at: [f64; 3]| {
        let [angle, outwards, upwards] = at;
        let tube = |out: f64, up: f64, radius: f64| share(radius - (outwards - out).hypot(upwards - up));
        let is_middle = (0.9..2.2).contains(&angle);
        let percent = if what == "stenosis" { 80.0 } else { 0.0 };
        let level = if what == "fading" { LUMEN - 50.0 * angle } else { LUMEN };
        let inside = lumen(at, narrowed(angle, 2.5, percent));
        let around = match what {
            "bone" if is_middle => TISSUE + 1100.0 * tube(8.5, 0.0, 6.0),
            "vein" => TISSUE + 280.0 * tube(0.0, 7.5, 4.0),
            _ => TISSUE,
        };
        let value = around + (level - around) * inside;
        let is_strut = what == "stent" && is_middle && (BEND * angle / 3.0).fract() < 0.5;
        if is_strut && (outwards.hypot(upwards) - 2.6).abs() < 0.4 { 1600.0 } else { value }
    };
    for what in ["stenosis", "bone", "vein", "stent", "fading"] {
        let scan = Scan::new(even(0.6), |at| scene(what, at));
        for angles in [vec![0.3, PI - 0.3], vec![0.3, 1.2, PI - 0.3]] {
            let clicks: Vec<DVec3> = angles.iter().map(|angle| on(*angle, 0.0, 0.0)).collect();
            let [mean, most] = errors(&scan.traced(&clicks).unwrap());
            assert!(mean < 0.08 && most < 0.25, "{what}, {} clicks: {mean} {most}", clicks.len());
        }
    }
}

#[test]
fn any_affine_grid_will_do_in_any_order_of_its_axes() {
    let plain = |at| TISSUE + (LUMEN - TISSUE) * lumen(at, 2.5);
    let clicks = ENDS.map(|angle| on(angle, 0.0, 0.0));
    for (spacing, shear, farthest) in
        [([0.6, 0.6, 0.6], 0.3, 0.25), ([0.5, 0.5, 1.5], 0.0, 0.25), ([0.4, 0.4, 3.0], 0.2, 0.35)]
    {
        let mut sides = DMat3::from_diagonal(DVec3::from(spacing));
        sides.z_axis.y = shear * spacing[2];
        let [_, most] = errors(&Scan::new(sides, plain).traced(&clicks).unwrap());
        assert!(most < farthest, "{spacing:?}: {most}");
    }
    let scan = Scan::new(even(0.7), plain);
    let first = scan.traced(&clicks).unwrap();
    let floats: Vec<f32> = scan.values.iter().map(|value| f32::from(*value)).collect();
    let other = lumencut_scenes::volumes::volume(Voxels::F32(&floats), scan.size, scan.affine);
    let clicks = Clicks { vessels: vec![clicks.to_vec()], ..Clicks::default() };
    assert_eq!(traced(&other, &clicks).unwrap(), first);
    let [ni, nj, nk] = scan.size;
    let exchanged = DMat3::from_cols(DVec3::Z, DVec3::Y, DVec3::X);
    let affine = scan.affine * DAffine3::from_mat3(exchanged);
    let turned = Volume::new(Voxels::I16(&scan.values), [nk, nj, ni], [ni * nj, ni, 1], affine).unwrap();
    assert!(errors(&traced(&turned, &clicks).unwrap())[1] < errors(&first)[1] + 0.02);
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let scan = Scan::new(even(0.8), |at| FAT + (LUMEN - FAT) * lumen(at, 2.5));
    let of = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| scan.traced(&ENDS.map(|angle| on(angle, 0.0, 0.0))).unwrap())
    };
    assert_eq!(of(1), of(3));
}

#[test]
fn a_stopper_in_one_way_around_a_loop_leaves_the_other_one() {
    let scan = Scan::new(even(0.8), |[_, outwards, upwards]| {
        TISSUE + (LUMEN - TISSUE) * share(2.3 - outwards.hypot(upwards))
    });
    let ends = [on(0.0, 0.0, 0.0), on(PI, 0.0, 0.0)];
    let side = |line: &Traced| seen(line.line.points[line.line.points.len() / 2])[0].signum();
    let clicks = Clicks { vessels: vec![ends.to_vec()], ..Clicks::default() };
    let first = side(&traced(&scan.volume(), &clicks).unwrap());
    let stoppers = vec![Stopper { center: on(first * PI / 2.0, 0.0, 0.0), radius: 4.0 }];
    let line = traced(&scan.volume(), &Clicks { stoppers, ..clicks }).unwrap();
    assert_eq!(side(&line), -first);
    assert!(errors(&line)[1] < 1.0);
}

#[test]
fn a_short_gap_in_the_contrast_is_passed() {
    let scan = Scan::new(even(0.6), |at| {
        let is_gap = (BEND * (at[0] - PI / 2.0)).abs() < 1.5;
        TISSUE + if is_gap { 0.0 } else { (LUMEN - TISSUE) * lumen(at, 2.5) }
    });
    let line = scan.traced(&ENDS.map(|angle| on(angle, 0.0, 0.0))).unwrap();
    assert!(errors(&line)[1] < 0.5 && !line.bridged.contains(&true), "{:?}", errors(&line));
}
