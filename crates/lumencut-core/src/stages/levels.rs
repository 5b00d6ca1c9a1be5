//! Levels of detail: increasingly smooth copies of the tree, whose surfaces are smooth far from the vessels (paper
//! sections 3.1.4 and 3.2.2). Level k + 1 is the clamped cubic B-spline with uniform knots over the points of level
//! k, evaluated at half as many parameters. The ends stay exactly where they are, so branches stay connected. Radii
//! and arc lengths are filtered alike.

use glam::DVec4;

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

/// A control point of the spline: a point with its radius, and its arc length on the original vessel (mm).
type Control = (DVec4, f64);

fn smooth(vessel: &Vessel) -> Vessel {
    let points = vessel.points();
    let count = points.len().div_ceil(2).max(2);
    let last = points.len() - 1;
    let control = |i: usize| (points[i].extend(vessel.radius_or_zero(i)), vessel.arc_length()[i]);
    let controls: Vec<Control> = (0..=last).map(control).collect();
    let mut samples = Vec::with_capacity(count);
    samples.push(controls[0]);
    // Three points or fewer become the straight line between the two ends.
    if points.len() >= 4 {
        let spans = (points.len() - 3) as f64;
        samples.extend((1..count - 1).map(|j| spline(&controls, j as f64 / (count - 1) as f64 * spans)));
    }
    samples.push(controls[last]);
    let radius = vessel.radius().map(|_| samples.iter().map(|(s, _)| s.w.max(0.0)).collect());
    // Rounding must not make arc length fall along a level, because its pieces are searched by arc length.
    let rising = samples.iter().scan(0.0, |so_far: &mut f64, (_, arc_length)| {
        *so_far = so_far.max(*arc_length);
        Some(*so_far)
    });
    let arc_length = rising.collect();
    Vessel::coarser(samples.iter().map(|(s, _)| s.truncate()).collect(), radius, arc_length)
}

/// The clamped cubic B-spline with uniform knots at parameter `u` in [0, n − 3] (de Boor's algorithm).
fn spline(controls: &[Control], u: f64) -> Control {
    let spans = controls.len() - 3;
    let knot = |i: usize| i.saturating_sub(3).min(spans) as f64;
    // The span of u among all knots: knot(span) ≤ u < knot(span + 1).
    let span = (u as usize).min(spans - 1) + 3;
    let mut d: [Control; 4] = std::array::from_fn(|j| controls[span - 3 + j]);
    for round in 1..=3 {
        for j in (round..=3).rev() {
            let left = knot(span - 3 + j);
            let right = knot(span + 1 + j - round);
            d[j] = between(d[j - 1], d[j], (u - left) / (right - left));
        }
    }
    d[3]
}

fn between(from: Control, to: Control, t: f64) -> Control {
    (from.0.lerp(to.0, t), from.1 * (1.0 - t) + to.1 * t)
}
