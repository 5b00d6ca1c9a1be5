use glam::{DAffine3, DMat3};
use lumencut_core::reformations::cpr::View;
use lumencut_core::stop::NEVER;
use lumencut_core::volume::Voxels as Samples;

use super::*;

const SIZE: [usize; 3] = [64, 64, 81];

/// A lumen of 4 mm radius with the value 300 along z, and a branch of 2 mm radius along x at z = 20 mm.
fn values() -> Vec<f32> {
    let each = |n: usize| {
        let [x, y, z] =
            [n % 64, n / 64 % 64, n / 4096].map(|index| index as f64 * 0.5).map(|place| place - 16.0);
        let is_branch = x > 0.0 && y.hypot(z - 4.0) <= 2.0;
        if x.hypot(y) <= 4.0 || is_branch { 300.0 } else { 0.0 }
    };
    (0..SIZE.iter().product()).map(each).collect()
}

fn volume(values: &[f32]) -> Volume<'_> {
    let affine = DAffine3::from_mat3_translation(DMat3::IDENTITY * 0.5, DVec3::new(-16.0, -16.0, 0.0));
    Volume::new(Samples::F32(values), SIZE, [1, 64, 4096], affine).expect("a volume")
}

fn inside(aside: f64) -> Inside {
    let line =
        Vessel::new(vec![DVec3::new(aside, 0.0, 40.0), DVec3::new(aside, 0.0, 0.0)], None).expect("a vessel");
    of(&line, 4.0)
}

fn of(line: &Vessel, radius: f64) -> Inside {
    let path = Arc::new(CenterlinePath::new(line, 0.0).expect("a path"));
    let view = View { up: DVec3::Z, angle: 0.0, normal: None };
    let straightened = Straightened::new(Arc::clone(&path), &view).expect("a space");
    let wall = Wall::new(vec![0.0, 40.0], vec![radius; 4], vec![false; 4]).expect("a wall");
    let found = FoundWall { wall: Arc::new(wall), levels: Some([300.0, 0.0]), mean_radius: radius };
    Inside::new((path, straightened), &found, None).expect("an inside")
}

const REQUEST: EndoscopyRequest = EndoscopyRequest {
    at: 10.0,
    lens: Lens::Perspective,
    field_of_view: Some(1.8),
    size: [41, 41],
    roll: 0.0,
    is_backwards: false,
};

#[test]
fn a_mouth_is_seen_ahead_of_the_eye_only() {
    let (values, branch) = (values(), [DVec3::new(0.0, 0.0, 20.0), DVec3::new(15.0, 0.0, 20.0)]);
    let volume = volume(&values);
    let inside = inside(0.0);
    let points = (0..=30).map(|n| branch[0].lerp(branch[1], f64::from(n) / 30.0)).collect();
    let tree = [Vessel::new(points, None).expect("a vessel")];
    let ostia = inside.ostia(&tree);
    assert!(ostia.len() == 1 && (ostia[0].at - 20.0).abs() < 0.5);
    let seen = |at: f64, is_backwards: bool| {
        let made =
            inside.seen(&volume, &EndoscopyRequest { at, is_backwards, ..REQUEST }, NEVER).expect("a view");
        inside.mouth(&made, &ostia[0])
    };
    // The vessel runs downwards, so the patient's left is on the left of a viewer who looks along it.
    let mouth = seen(10.0, false).expect("a mouth");
    let expected = 20.0 - 4.0 / 10.0 / 0.9_f64.tan() * 20.5;
    assert!((mouth.x - expected).abs() < 0.7 && (mouth.y - 20.0).abs() < 0.1, "{mouth}, {expected}");
    assert_eq!([seen(25.0, false), seen(10.0, true)], [None; 2]);
    assert!(seen(30.0, true).is_some());
}

#[test]
fn an_eye_outside_the_lumen_is_doubted() {
    let values = values();
    let volume = volume(&values);
    let doubts = |aside: f64| {
        let inside = inside(aside);
        let made = inside.seen(&volume, &REQUEST, NEVER).expect("a view");
        inside.doubts(&volume, made.eye())
    };
    assert_eq!(doubts(0.0), [""; 0]);
    let words = doubts(9.0).join("");
    assert!(
        words.contains("10 mm along the vessel is outside the lumen: found 0; expected at least 150"),
        "{words}"
    );
}

#[test]
fn calcium_is_white_and_what_has_no_wall_transparent() {
    let inside = inside(0.0);
    let [tissue, calcium, none] =
        [0, 1, 2].map(|n| inside.picture(&[1.0, 1.0, f32::NAN], &[0.0, 900.0, 0.0])[n]);
    assert!(tissue[0] > tissue[2] + 50 && calcium.iter().all(|byte| *byte > 230), "{tissue:?}, {calcium:?}");
    assert_eq!(none, [0; 4]);
}

#[test]
fn a_flight_keeps_its_speed_and_slows_down_in_bends() {
    let straight = inside(0.0).flight([5.0, 35.0], 10.0, 4.0).expect("a flight");
    assert!(
        straight.len() == 13
            && straight.iter().enumerate().all(|(n, at)| (at - 5.0 - 2.5 * n as f64).abs() < 1e-9)
    );
    let back = inside(0.0).flight([35.0, 5.0], 10.0, 4.0).expect("a flight");
    assert!((back[1] - 32.5).abs() < 1e-9);
    for (places, speed) in
        [([5.0, 5.0], 10.0), ([5.0, 50.0], 10.0), ([5.0, 35.0], 0.0), ([5.0, 35.0], f64::NAN)]
    {
        assert!(inside(0.0).flight(places, speed, 4.0).is_err(), "{places:?}, {speed}");
    }
    // A half circle of 10 mm radius takes at least 3 s.
    let turns = (0..=180).map(|n| f64::from(n).to_radians());
    let points = turns.map(|t| DVec3::new(t.cos(), 0.0, t.sin()) * 10.0).collect();
    let bend = of(&Vessel::new(points, None).expect("a vessel"), 1.0);
    let places = bend.flight([0.0, bend.length()], 100.0, 20.0).expect("a flight");
    assert!((50..=66).contains(&places.len()), "{} frames", places.len());
}
