//! Times of untangled CPR (layout, positions) for trees of 9, 50 and 200 vessels, about 512 × 1024 pixels.

use glam::DVec3;
use lumencut_core::camera::Camera;
use lumencut_core::error::Result;
use lumencut_core::reformations::Layout;
use lumencut_core::reformations::untangled::{Untangled, UntangledParameters};
use lumencut_core::stop::NEVER;
use lumencut_core::vessel_tree::{Vessel, VesselTree};
use lumencut_scenes::timing::{head, row, time};

const RUNS: usize = 11;

const PIXELS: f64 = 512.0 * 1024.0;

fn direction(n: usize) -> DVec3 {
    let z = 1.0 - 2.0 * ((n as f64 * 0.754_877_666).fract());
    let around = n as f64 * 2.399_963_229;
    let across = (1.0 - z * z).sqrt();
    DVec3::new(across * around.cos(), across * around.sin(), z)
}

/// A binary tree of vessels, each 40 mm long in steps of 1 mm.
fn tree(count: usize) -> Result<VesselTree> {
    let mut vessels = Vec::new();
    let mut waiting = std::collections::VecDeque::from([(DVec3::ZERO, DVec3::NEG_Z, 6.0)]);
    while let (true, Some((mut at, mut along, radius))) = (vessels.len() < count, waiting.pop_front()) {
        let bend = direction(vessels.len()) * 0.02;
        let mut points = vec![at];
        for _ in 0..40 {
            at += along;
            along = (along + bend).normalize();
            points.push(at);
        }
        let radii = vec![radius; points.len()];
        vessels.push(Vessel::new(points, Some(radii))?);
        for side in 0..2 {
            let turned = along + direction(2 * vessels.len() + side) * 0.8;
            waiting.push_back((at, turned.normalize(), f64::max(radius * 0.75, 1.0)));
        }
    }
    VesselTree::new(vessels)
}

fn main() -> Result<()> {
    head(
        "Median and, in brackets, fastest milliseconds",
        &["vessels", "pixels", "overlapping", "laying out", "where the pixels look", "both"],
    );
    let camera = Camera::new(DVec3::ZERO, DVec3::Y, DVec3::Z, [8, 8], 1.0)?;
    for count in [9, 50, 200] {
        let tree = tree(count)?;
        let go_on = || false;
        let made = |spacing| Untangled::new(&tree, &camera, UntangledParameters::new(spacing), &go_on);
        let [width, height] = made(1.0)?.size();
        let spacing = ((width * height) as f64 / PIXELS).sqrt();
        let laid_out = time(RUNS, || drop(made(spacing).expect("a layout")));
        let both = time(RUNS, || drop(made(spacing).and_then(|made| made.curved(NEVER)).expect("places")));
        let layout = made(spacing)?;
        let [width, height] = layout.size();
        let cell = |times: [f64; 2]| format!("{:.1} ({:.1})", times[0], times[1]);
        row([
            count.to_string(),
            format!("{width} × {height}"),
            layout.overlaps().len().to_string(),
            cell([laid_out.median, laid_out.minimum]),
            cell([both.median - laid_out.median, both.minimum - laid_out.minimum]),
            cell([both.median, both.minimum]),
        ]);
    }
    Ok(())
}
