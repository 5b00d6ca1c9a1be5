//! Timing for the benches: the median and the minimum of repeated runs, printed as Markdown tables.
#![allow(dead_code)]

use std::time::Instant;

use glam::DVec3;
use lumencut_core::camera::Camera;
use lumencut_core::vessel_tree::VesselTree;

/// What repeated runs took (ms).
#[derive(Clone, Copy, Debug)]
pub struct Times {
    pub median: f64,
    pub minimum: f64,
}

/// Runs `work` once to warm up and then `runs` times.
pub fn time(runs: usize, mut work: impl FnMut()) -> Times {
    work();
    let mut times: Vec<f64> = (0..runs).map(|_| once(&mut work)).collect();
    times.sort_by(f64::total_cmp);
    Times { median: times[runs / 2], minimum: times[0] }
}

fn once(work: &mut impl FnMut()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64() * 1e3
}

/// One row of a Markdown table.
pub fn row<S: AsRef<str>>(cells: impl IntoIterator<Item = S>) {
    let cells: Vec<_> = cells.into_iter().map(|c| c.as_ref().to_owned()).collect();
    println!("| {} |", cells.join(" | "));
}

/// The head of a Markdown table.
pub fn head(title: &str, cells: &[&str]) {
    println!("\n{title}\n");
    row(cells);
    row(cells.iter().map(|_| "---"));
}

/// The view of `tree` along `direction` in which it just fits into 512 × 512 pixels.
pub fn fitted(tree: &VesselTree, direction: DVec3) -> Camera {
    let (low, high) = tree.bounds();
    let extent = (high - low).length() / 1.2;
    let up = if direction.cross(DVec3::Z).length() < 0.1 { DVec3::Y } else { DVec3::Z };
    let camera = Camera::new((low + high) * 0.5, direction, up, [512, 512], extent / 512.0);
    camera.expect("a direction that is not zero and a tree with an extent")
}
