//! Hierarchy against brute force in one run.

#![allow(clippy::unwrap_used)]

use std::time::Instant;

use glam::DVec3;
use lumencut_core::brute_force;
use lumencut_core::camera::Camera;
use lumencut_core::math::lanes::Isa;
use lumencut_core::phantom::random_tree::random_tree;
use lumencut_core::pipeline::Renderer;
use lumencut_core::settings::Settings;
use lumencut_core::stages::View;
use lumencut_core::stages::depth::depth;
use lumencut_core::stages::distance::distance;

fn median(mut f: impl FnMut(), n: usize) -> f64 {
    let mut t: Vec<f64> = (0..n)
        .map(|_| {
            let s = Instant::now();
            f();
            s.elapsed().as_secs_f64() * 1e3
        })
        .collect();
    t.sort_by(f64::total_cmp);
    t[n / 2]
}

fn main() {
    let go: &(dyn Fn() -> bool + Sync) = &|| false;
    for (vessels, segments, step) in [(31, 160, 1.5), (124, 160, 1.5), (31, 640, 0.4)] {
        let tree = random_tree(7, vessels, segments, step, 150.0).unwrap();
        let settings = Settings::default();
        for isa in Isa::available() {
            let mut renderer = Renderer::new(tree.clone()).with_isa(isa);
            let camera =
                Camera::new(DVec3::ZERO, DVec3::new(0.1, 1.0, 0.2), DVec3::Z, [512, 512], 0.6).unwrap();
            let view = View { camera: &camera, isa, stop: go };
            let (mut d, mut z, mut v) = (vec![0f32; 512 * 512], vec![0f32; 512 * 512], vec![0i32; 512 * 512]);
            let tp = median(
                || {
                    renderer.project(&camera, &settings);
                },
                41,
            );
            let cut = renderer.project(&camera, &settings);
            let td = median(|| distance(&view, cut.finest(), &mut d).unwrap(), 41);
            let tz = median(|| depth(&view, &cut, &d, &mut z, &mut v).unwrap(), 41);
            let bd = median(|| brute_force::distance(&view, cut.finest(), &mut d).unwrap(), 3);
            let (mut bz, mut bv) = (z.clone(), v.clone());
            let bb = median(|| brute_force::depth(&view, &cut, &d, &mut bz, &mut bv).unwrap(), 3);
            let differ = z.iter().zip(&bz).filter(|(a, b)| a.to_bits() != b.to_bits()).count();
            let vdiffer = v.iter().zip(&bv).filter(|(a, b)| a != b).count();
            println!(
                "{:?} segs {} proj {tp:.2} dist {td:.2} depth {tz:.2} sum {:.2} brute {bd:.1}+{bb:.1} ratio {:.1} differ {differ} {vdiffer}",
                isa,
                tree.segment_count(),
                tp + td + tz,
                (bd + bb) / (tp + td + tz)
            );
        }
    }
}
