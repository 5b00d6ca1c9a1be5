//! draft
use glam::{DAffine3, DVec3};
use lumencut_core::camera::Camera;
use lumencut_core::math::blocks::{Blocks, HUGE};
use lumencut_core::math::lanes::Isa;
use lumencut_core::math::ray::{IndexFromView, RayGrid};
use lumencut_core::stages::Work;
use lumencut_core::stages::along_rays::{AlongRays, Reduction, ViewRays, along_rays};
use lumencut_core::volume::Voxels;
use lumencut_scenes::volumes::volume;

fn cpu() -> f64 {
    let s = std::fs::read_to_string("/proc/self/stat").unwrap();
    let f: Vec<&str> = s.rsplit(')').next().unwrap().split_whitespace().collect();
    (f[11].parse::<f64>().unwrap() + f[12].parse::<f64>().unwrap()) * 10.0
}
fn phantoms() {
    for (name, make) in lumencut_scenes::workloads::WORKLOADS {
        let phantom = make(0, 1.0).unwrap();
        let volume = phantom.volume().unwrap();
        let blocks = Blocks::new(&volume, &|| false).unwrap();
        for (what, toward) in [("front", DVec3::Y), ("oblique", DVec3::new(-0.6, 0.7, 0.4))] {
            let camera = lumencut_scenes::views::fitted(&phantom.tree, toward, 512);
            for (reduction, limit) in [(Reduction::Largest, 800.0), (Reduction::Smallest, -200.0), (Reduction::Mean, HUGE)] {
                let work = Work { size: [512, 512], isa: Isa::widest(), stop: &|| false };
                let to = IndexFromView::new(&volume, &camera);
                let along = AlongRays { size: [512, 512], volume: &volume, blocks: Some(&blocks), reduction, limit, step: to.voxel() };
                let mut values = vec![0.0; 512 * 512];
                let (t, w) = (cpu(), std::time::Instant::now());
                along_rays(&work, &along, &ViewRays { to, rays: RayGrid::fine(&camera), chord: |_| [-1e9, 1e9] }, &mut values).unwrap();
                println!("{name} {what} {reduction:?} {} ms cpu {:.0} wall; spacing {:.2}", cpu() - t, w.elapsed().as_secs_f64() * 1e3, camera.pixel_spacing());
            }
        }
    }
}
fn main() {
    phantoms();
    let n = 256usize;
    let mut st = 88_172_645_463_325_252u64;
    let mut next = || { st ^= st << 13; st ^= st >> 7; st ^= st << 17; (st >> 11) as f64 / (1u64 << 53) as f64 };
    let gauss: Vec<i16> = (0..n*n*n).map(|_| { let s: f64 = (0..12).map(|_| next()).sum::<f64>() - 6.0; (100.0 + 200.0 * s) as i16 }).collect();
    let uniform: Vec<i16> = (0..n*n*n).map(|_| (next() * 2000.0 - 1000.0) as i16).collect();
    let place = DAffine3::from_scale_rotation_translation(DVec3::splat(0.5), Default::default(), DVec3::splat(-63.75));
    for (name, v) in [("gauss", &gauss), ("uniform", &uniform)] {
        let volume = volume(Voxels::I16(v), [n; 3], place);
        let blocks = Blocks::new(&volume, &|| false).unwrap();
        let d = DVec3::new(0.39, 0.9, -0.2).normalize();
        for (what, dir) in [("oblique", d), ("front", DVec3::Y)] {
            let right = dir.cross(DVec3::Z).normalize();
            let camera = Camera::new(DVec3::ZERO, dir, right.cross(dir), [512, 512], 0.35).unwrap();
            for isa in Isa::available().into_iter().rev().take(1) {
              for reduction in [Reduction::Largest, Reduction::Mean] {
                let work = Work { size: [512, 512], isa, stop: &|| false };
                let to = IndexFromView::new(&volume, &camera);
                let along = AlongRays { size: [512, 512], volume: &volume, blocks: Some(&blocks), reduction, limit: HUGE, step: to.voxel() };
                let mut values = vec![0.0; 512 * 512];
                let t = cpu();
                along_rays(&work, &along, &ViewRays { to, rays: RayGrid::fine(&camera), chord: |_| [-1e9, 1e9] }, &mut values).unwrap();
                println!("{name} {what} {isa:?} {reduction:?} {} ms cpu", cpu() - t);
              }
            }
        }
    }
}
