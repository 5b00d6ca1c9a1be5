//! The surface through several curves: each curve runs by shares of its length, a line runs across all of them.

use glam::DVec3;

use super::line::{Line, Spline};
use crate::error::{Error, ErrorKind, Result};
use crate::math::centerline_path::CenterlinePath;

/// Closest distance at which two curves count as crossing (mm).
const CROSSING: f64 = 1e-3;
/// Shares of the length within which curves may meet: they may begin or end at one point.
const NEAR_ENDS: f64 = 1e-6;

/// The surface; between neighbouring nodes every curve is straight.
pub(super) struct Surface {
    /// Shares of the lengths, from 0 to 1.
    shares: Vec<f64>,
    /// For each node, the spline across all curves.
    nodes: Vec<Spline>,
}

impl Surface {
    /// The surface through curves in their order; a curve that runs against the one before is turned. Fails with
    /// [`ErrorKind::VesselTree`] for less than two curves, and for neighbouring curves that cross.
    pub(super) fn new(curves: &[CenterlinePath]) -> Result<Self> {
        let wrong = |found: String, expected: &str| {
            Err(Error::new(ErrorKind::VesselTree, "curves of the flattening", found, expected))
        };
        if curves.len() < 2 {
            return wrong(format!("{} curve", curves.len()), "two or more curves");
        }
        let mut turned: Vec<Vec<(f64, DVec3)>> = Vec::new();
        for curve in curves {
            let along = shares_of(curve);
            let is_against = turned.last().is_some_and(|before| runs_against(before, &along));
            turned.push(if is_against { reversed(&along) } else { along });
        }
        for (number, pair) in turned.windows(2).enumerate() {
            if crosses(&pair[0], &pair[1]) {
                let found = format!("curves {number} and {} that cross", number + 1);
                return wrong(found, "curves next to each other");
            }
        }
        let mut shares: Vec<f64> = turned.iter().flatten().map(|(share, _)| *share).chain([0.5]).collect();
        shares.sort_by(f64::total_cmp);
        shares.dedup_by(|a, b| *a - *b < 1e-12);
        let across = |t: &f64| Spline::new(turned.iter().map(|curve| point_of(curve, *t)).collect());
        let nodes = shares.iter().map(across).collect();
        Ok(Self { shares, nodes })
    }

    /// The shares of all nodes.
    pub(super) fn shares(&self) -> &[f64] {
        &self.shares
    }

    /// The points of all nodes at a place of their splines.
    pub(super) fn curve(&self, place: f64) -> Vec<DVec3> {
        self.nodes.iter().map(|node| node.at(place).0).collect()
    }

    /// The line across all curves at a share of their lengths.
    pub(super) fn line(&self, share: f64) -> Line {
        let (next, way) = self.node(share);
        Line::new(Spline::between(&self.nodes[next - 1], &self.nodes[next], way))
    }

    /// How a line moves with the share: its derivative along the curves at a place of the line.
    pub(super) fn along(&self, share: f64, place: f64) -> DVec3 {
        let (next, _) = self.node(share);
        let step = self.nodes[next].at(place).0 - self.nodes[next - 1].at(place).0;
        step / (self.shares[next] - self.shares[next - 1])
    }

    /// The node after a share, and the way to it from the node before (0 to 1).
    fn node(&self, share: f64) -> (usize, f64) {
        let next = self.shares.partition_point(|t| *t <= share).clamp(1, self.shares.len() - 1);
        let [low, high] = [self.shares[next - 1], self.shares[next]];
        (next, (share - low) / (high - low))
    }
}

/// The points of a curve with their shares of its length.
fn shares_of(curve: &CenterlinePath) -> Vec<(f64, DVec3)> {
    let lengths = curve.arc_length().iter().map(|at| at / curve.length());
    lengths.zip(curve.points().iter().copied()).collect()
}

fn reversed(curve: &[(f64, DVec3)]) -> Vec<(f64, DVec3)> {
    curve.iter().rev().map(|(share, point)| (1.0 - share, *point)).collect()
}

/// Whether the ends of a curve lie closer to those of another one if it is turned.
fn runs_against(before: &[(f64, DVec3)], curve: &[(f64, DVec3)]) -> bool {
    let ends = |curve: &[(f64, DVec3)]| [curve[0].1, curve[curve.len() - 1].1];
    let ([a, b], [c, d]) = (ends(before), ends(curve));
    a.distance(d) + b.distance(c) < a.distance(c) + b.distance(d)
}

fn point_of(curve: &[(f64, DVec3)], share: f64) -> DVec3 {
    let next = curve.partition_point(|(t, _)| *t <= share).clamp(1, curve.len() - 1);
    let [(low, a), (high, b)] = [curve[next - 1], curve[next]];
    a + (b - a) * ((share - low) / (high - low)).clamp(0.0, 1.0)
}

/// Whether two curves meet anywhere but at ends of both.
fn crosses(one: &[(f64, DVec3)], other: &[(f64, DVec3)]) -> bool {
    let is_end = |share: f64| !(NEAR_ENDS..=1.0 - NEAR_ENDS).contains(&share);
    one.windows(2).any(|a| {
        other.windows(2).any(|b| {
            let (distance, [s, t]) = closest([a[0].1, a[1].1], [b[0].1, b[1].1]);
            let share = |pair: &[(f64, DVec3)], way: f64| pair[0].0 + (pair[1].0 - pair[0].0) * way;
            distance < CROSSING && !(is_end(share(a, s)) && is_end(share(b, t)))
        })
    })
}

/// The distance of two segments, and the places of the closest points on them (0 to 1).
fn closest([a, b]: [DVec3; 2], [c, d]: [DVec3; 2]) -> (f64, [f64; 2]) {
    let (u, v, w) = (b - a, d - c, a - c);
    let [uu, uv, vv, uw, vw] = [u.dot(u), u.dot(v), v.dot(v), u.dot(w), v.dot(w)];
    let determinant = uu * vv - uv * uv;
    let free = if determinant > 1e-12 * uu * vv { (uv * vw - vv * uw) / determinant } else { 0.0 };
    let on_other = |s: f64| ((uv * s + vw) / vv).clamp(0.0, 1.0);
    let on_one = |t: f64| ((uv * t - uw) / uu).clamp(0.0, 1.0);
    let s = on_one(on_other(free.clamp(0.0, 1.0)));
    let t = on_other(s);
    ((a + u * s).distance(c + v * t), [s, t])
}
