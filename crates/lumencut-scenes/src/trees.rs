//! Makes vessels and trees from literal points.

use std::f64::consts::TAU;

use glam::DVec3;
use lumencut_core::vessel_tree::{Vessel, VesselTree};

/// A vessel of constant radius (mm).
pub fn vessel(points: &[[f64; 3]], radius: f64) -> Vessel {
    let points: Vec<DVec3> = points.iter().map(|p| DVec3::from_array(*p)).collect();
    let radii = vec![radius; points.len()];
    Vessel::new(points, Some(radii)).unwrap()
}

pub fn tree(vessels: Vec<Vessel>) -> VesselTree {
    VesselTree::new(vessels).unwrap()
}

/// A trefoil knot that extends about 60 mm to each side of its middle.
pub fn trefoil(points: usize) -> VesselTree {
    let knot = |i: usize| {
        let t = i as f64 / points as f64 * TAU;
        let (x, y) = (t.sin() + 2.0 * (2.0 * t).sin(), t.cos() - 2.0 * (2.0 * t).cos());
        [20.0 * x, -20.0 * (3.0 * t).sin(), 20.0 * y]
    };
    tree(vec![vessel(&(0..=points).map(knot).collect::<Vec<_>>(), 4.0)])
}

/// The same vessels with every segment split into four.
pub fn finer(tree: &VesselTree) -> VesselTree {
    let finer = tree.vessels().iter().map(|v| {
        let last = v.points().len() - 2;
        let between = |n: usize| {
            let i = (n / 4).min(last);
            let t = n as f64 / 4.0 - i as f64;
            let radius = v.radius_or_zero(i) * (1.0 - t) + v.radius_or_zero(i + 1) * t;
            (v.points()[i].lerp(v.points()[i + 1], t), radius)
        };
        let (points, radii) = (0..=(last + 1) * 4).map(between).unzip();
        Vessel::new(points, Some(radii)).unwrap()
    });
    VesselTree::new(finer.collect()).unwrap()
}
