//! x

#![allow(clippy::unwrap_used)]

use glam::DVec3;
use lumencut_core::camera::Camera;
use lumencut_core::math::lanes::Isa;
use lumencut_core::phantom::random_tree::random_tree;
use lumencut_core::pipeline::Renderer;
use lumencut_core::settings::Settings;
use lumencut_core::stages::View;
use lumencut_core::stages::depth::depth;
use lumencut_core::stages::distance::distance;
use std::time::Instant;
fn main() {
    let go: &(dyn Fn() -> bool + Sync) = &|| false;
    let a: Vec<String> = std::env::args().collect();
    let (v, s, step): (usize, usize, f64) = match a[1].as_str() {
        "a" => (31, 160, 1.5),
        "b" => (124, 160, 1.5),
        _ => (31, 640, 0.4),
    };
    let n: usize = a[2].parse().unwrap();
    let tree = random_tree(7, v, s, step, 150.0).unwrap();
    let settings = Settings { lumen_first: a.len() > 3, ..Settings::default() };
    let isa = Isa::widest();
    let mut renderer = Renderer::new(tree.clone());
    let camera = Camera::new(DVec3::ZERO, DVec3::new(0.1, 1.0, 0.2), DVec3::Z, [512, 512], 0.6).unwrap();
    let view = View { camera: &camera, isa, stop: go };
    let (mut d, mut z, mut ve) = (vec![0f32; 512 * 512], vec![0f32; 512 * 512], vec![0i32; 512 * 512]);
    let (mut td, mut tz, mut tp) = (vec![], vec![], vec![]);
    for _ in 0..n {
        let t0 = Instant::now();
        let cut = renderer.project(&camera, &settings);
        let t1 = Instant::now();
        distance(&view, cut.finest(), &mut d).unwrap();
        let t2 = Instant::now();
        depth(&view, &cut, &d, &mut z, &mut ve).unwrap();
        let t3 = Instant::now();
        tp.push((t1 - t0).as_secs_f64() * 1e3);
        td.push((t2 - t1).as_secs_f64() * 1e3);
        tz.push((t3 - t2).as_secs_f64() * 1e3);
    }
    let med = |t: &mut Vec<f64>| {
        t.sort_by(f64::total_cmp);
        (t[0], t[n / 2])
    };
    println!(
        "segs {} proj {:.2?} dist {:.2?} depth {:.2?}",
        tree.segment_count(),
        med(&mut tp),
        med(&mut td),
        med(&mut tz)
    );
}
