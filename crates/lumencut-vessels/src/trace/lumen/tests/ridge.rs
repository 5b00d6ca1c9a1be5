use std::f64::consts::TAU;

use glam::DAffine3;
use lumencut_core::volume::{self, Volume};

use super::*;

const BEND: f64 = 30.0;
const RADIUS: f64 = 6.0;

/// Distances from the middle (mm) before and after, along a line of chords in half a torus, without its ends.
fn off(corners: usize) -> [f64; 2] {
    let size = [78, 44, 20];
    let origin = DVec3::new(-38.5, -6.5, -9.5);
    let from_middle = |place: DVec3| (place.x.hypot(place.y) - BEND).hypot(place.z);
    let value = |n: usize| {
        let index = [n % size[0], n / size[0] % size[1], n / (size[0] * size[1])];
        let inside = RADIUS - from_middle(origin + DVec3::from_array(index.map(|c| c as f64)));
        (300.0 * (inside + 0.5).clamp(0.0, 1.0)) as f32
    };
    let values: Vec<f32> = (0..size.iter().product()).map(value).collect();
    let world = DAffine3::from_translation(origin);
    let strides = [1, size[0], size[0] * size[1]];
    let volume = Volume::new(volume::Voxels::F32(&values), size, strides, world).expect("a volume");
    let corner = |n: usize| {
        BEND * {
            let (sin, cos) = (TAU / 2.0 * n as f64 / corners as f64).sin_cos();
            DVec3::new(cos, sin, 0.0)
        }
    };
    let points = in_even_steps(&(0..=corners).map(corner).collect::<Vec<_>>(), 0.5);
    let line = Centerline { radius: vec![RADIUS; points.len()], confidence: vec![1.0; points.len()], points };
    let worst = |line: &Centerline| {
        let inner = &line.points[24..line.points.len() - 24];
        inner.iter().map(|point| from_middle(*point)).fold(0.0, f64::max)
    };
    let moved = on_ridge(&Voxels::new(&volume), 0.0, line.clone(), &|| false).expect("a line");
    [worst(&line), worst(&moved)]
}

#[test]
fn chords_in_a_bend_move_to_the_middle() {
    let [before, after] = off(4);
    assert!(before > 2.0 && after < 0.1 * RADIUS, "{before} {after}");
}

#[test]
fn a_line_near_the_middle_stays() {
    let [before, after] = off(40);
    assert!(before == after && after < 0.1, "{before} {after}");
}
