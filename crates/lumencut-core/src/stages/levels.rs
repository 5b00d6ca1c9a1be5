//! Levels of detail: ever smoother copies of the tree, whose surfaces run calmly far from the vessels
//! (paper sections 3.1.4 and 3.2.2).
//!
//! Level k + 1 is the clamped cubic B-spline with uniform knots over the points of level k, evaluated at half
//! as many parameters. The ends stay exactly where they are, so branches stay connected.

use glam::{DVec3, DVec4};

use crate::vessel_tree::{Vessel, VesselTree};

/// `tree` and its `count` levels of detail, finest first.
pub fn levels(tree: &VesselTree, count: usize) -> Vec<VesselTree> {
    let mut levels = vec![tree.clone()];
    for k in 0..count {
        let coarser = levels[k].vessels().iter().map(smooth).collect();
        levels.push(VesselTree::from_checked(coarser));
    }
    levels
}

/// The next coarser level of one vessel.
fn smooth(vessel: &Vessel) -> Vessel {
    let points = vessel.points();
    let count = points.len().div_ceil(2).max(2);
    let last = points.len() - 1;
    let controls: Vec<DVec4> = (0..=last).map(|i| points[i].extend(vessel.radius_or_zero(i))).collect();
    let mut samples = Vec::with_capacity(count);
    samples.push(controls[0]);
    // Three points or fewer become the two ends: the straight line between them.
    if points.len() >= 4 {
        let spans = (points.len() - 3) as f64;
        samples.extend((1..count - 1).map(|j| spline(&controls, j as f64 / (count - 1) as f64 * spans)));
    }
    samples.push(controls[last]);
    let radius = vessel.radius().map(|_| samples.iter().map(|s| s.w.max(0.0)).collect());
    Vessel::from_checked(samples.iter().map(|s| DVec3::new(s.x, s.y, s.z)).collect(), radius)
}

/// The clamped cubic B-spline with uniform knots at parameter `u` in [0, n − 3] (de Boor's algorithm).
fn spline(controls: &[DVec4], u: f64) -> DVec4 {
    let spans = controls.len() - 3;
    let knot = |i: usize| i.saturating_sub(3).min(spans) as f64;
    // The span of u, counted among all knots: knot(span) ≤ u < knot(span + 1).
    let span = (u as usize).min(spans - 1) + 3;
    let mut d: [DVec4; 4] = std::array::from_fn(|j| controls[span - 3 + j]);
    for round in 1..=3 {
        for j in (round..=3).rev() {
            let left = knot(span - 3 + j);
            let right = knot(span + 1 + j - round);
            d[j] = d[j - 1].lerp(d[j], (u - left) / (right - left));
        }
    }
    d[3]
}
