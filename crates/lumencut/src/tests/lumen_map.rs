use glam::{DAffine3, DMat3};
use lumencut_core::reformations::Wall;
use lumencut_core::stop::NEVER;
use lumencut_core::volume::Voxels as Samples;

use super::*;

const SIZE: [usize; 3] = [64, 64, 81];
const FRONT: View = View { up: DVec3::Z, angle: 0.0, normal: None };

/// A lumen of 4 mm radius with the value 300, a 1 mm crust of 900 on its posterior side, and 0 elsewhere.
fn values() -> Vec<f32> {
    let each = |n: usize| {
        let [i, j] = [n % 64, n / 64 % 64].map(|index| index as f64 * 0.5 - 16.0);
        match i.hypot(j) {
            away if away <= 4.0 => 300.0,
            away if away <= 5.0 && j > 2.0 => 900.0,
            _ => 0.0,
        }
    };
    (0..SIZE.iter().product()).map(each).collect()
}

fn with<T>(values: &[f32], described: impl FnOnce(&Volume) -> T) -> T {
    let affine = DAffine3::from_mat3_translation(DMat3::IDENTITY * 0.5, DVec3::new(-16.0, -16.0, 0.0));
    described(&Volume::new(Samples::F32(values), SIZE, [1, 64, 4096], affine).expect("a volume"))
}

fn path() -> Arc<CenterlinePath> {
    let line = Vessel::new(vec![DVec3::new(0.0, 0.0, 40.0), DVec3::ZERO], None).expect("a vessel");
    Arc::new(CenterlinePath::new(&line, 0.0).expect("a path"))
}

fn found() -> FoundWall {
    let wall = Wall::new(vec![0.0, 40.0], vec![4.0; 4], vec![false; 4]).expect("a wall");
    FoundWall { wall: Arc::new(wall), levels: Some([300.0, 0.0]), mean_radius: 4.0 }
}

const REQUEST: MapRequest = MapRequest {
    pixel_spacing: 0.25,
    angle: Some(0.0),
    overlap: 0.0,
    band: [-1.0, 3.0],
    calcium_level: None,
};

#[test]
fn calcium_is_as_thick_as_it_is() {
    let values = values();
    let (map, thick) = with(&values, |volume| {
        let map = lumen_map(volume, &path(), &FRONT, &found(), (&REQUEST, NEVER)).expect("a map");
        let thick = thickness(volume, &map, (REQUEST.band, 600.0), NEVER).expect("values");
        (map, thick)
    });
    let row = map.size()[1] / 2 * map.size()[0];
    let at = |degrees: f64| thick[row + map.column(degrees.to_radians()).round() as usize];
    assert!((at(90.0) - 1.0).abs() <= 0.3, "{} mm at the back", at(90.0));
    assert_eq!([at(-90.0), at(0.0), at(170.0)], [0.0; 3]);
}

#[test]
fn the_cut_lies_opposite_to_the_calcium() {
    let values = values();
    let map = with(&values, |volume| {
        lumen_map(volume, &path(), &FRONT, &found(), (&MapRequest { angle: None, ..REQUEST }, NEVER))
            .expect("a map")
    });
    assert!((map.parameters().angle.to_degrees() - 90.0).abs() < 5.0, "{}", map.parameters().angle);
    let plain = with(&[0.0; SIZE[0] * SIZE[1] * SIZE[2]], |volume| {
        lumen_map(volume, &path(), &FRONT, &found(), (&MapRequest { angle: None, ..REQUEST }, NEVER))
            .expect("a map")
    });
    assert_eq!(plain.parameters().angle, 0.0);
}

#[test]
fn branches_open_where_they_leave_the_wall() {
    let map = with(&values(), |volume| {
        lumen_map(volume, &path(), &FRONT, &found(), (&REQUEST, NEVER)).expect("a map")
    });
    let vessel = |points: &[[f64; 3]]| {
        Vessel::new(points.iter().map(|point| DVec3::from_array(*point)).collect(), None).expect("a vessel")
    };
    let to_the_left: Vec<[f64; 3]> = (0..60).map(|n| [f64::from(n) * 0.5, 0.0, 25.0]).collect();
    let to_the_front: Vec<[f64; 3]> = (0..60).map(|n| [0.0, f64::from(-n) * 0.5, 10.0]).rev().collect();
    let far = [[20.0, 0.0, 20.0], [30.0, 0.0, 20.0]];
    let itself = [[0.0, 0.0, 40.0], [0.0, 0.0, 0.0]];
    let tree = [&to_the_left[..], &far, &itself, &to_the_front].map(vessel);
    let found = ostia(&walls(&map), &tree);
    assert_eq!(found.iter().map(|ostium| ostium.vessel).collect::<Vec<_>>(), [0, 3]);
    assert!((found[0].at - 15.0).abs() < 1e-9 && found[0].around.abs() < 1e-9);
    assert!((found[1].at - 30.0).abs() < 1e-9 && (found[1].around.to_degrees() + 90.0).abs() < 1e-9);
    assert!((found[0].point.x - 4.5).abs() < 1e-9);
}

#[test]
fn calcium_is_brighter_than_the_lumen() {
    assert_eq!(calcium_level([300.0, 50.0]), 425.0);
    assert_eq!(calcium_level([60.0, 20.0]), 130.0);
}
