//! Smooth curves with radii through anatomical way points; positions on them are given as arc lengths.

use std::f64::consts::TAU;

use glam::DVec3;

use lumencut_core::math::arc_length::LinePlace;

use crate::random::uniform;

/// x, y, z (mm, LPS) and radius (mm).
pub(crate) type WayPoint = [f64; 4];

const SAMPLES_PER_SPAN: usize = 64;

#[derive(Clone, Debug)]
pub(crate) struct Curve {
    points: Vec<DVec3>,
    radius: Vec<f64>,
    arc: Vec<f64>,
}

impl Curve {
    /// The centripetal Catmull-Rom spline through at least two way points; it starts and ends exactly at the outermost ones.
    pub(crate) fn through(way: &[WayPoint]) -> Self {
        let place = |i: usize| DVec3::new(way[i][0], way[i][1], way[i][2]);
        let last = way.len() - 1;
        let mut points = vec![place(0)];
        let mut radius = vec![way[0][3]];
        for i in 0..last {
            // Beyond an end, the neighbouring point is reflected in the end point.
            let before = if i == 0 { place(0) * 2.0 - place(1) } else { place(i - 1) };
            let after = if i + 1 == last { place(last) * 2.0 - place(last - 1) } else { place(i + 2) };
            let span = [before, place(i), place(i + 1), after];
            for j in 1..=SAMPLES_PER_SPAN {
                let t = j as f64 / SAMPLES_PER_SPAN as f64;
                let end = j == SAMPLES_PER_SPAN;
                points.push(if end { place(i + 1) } else { catmull_rom(span, t) });
                let blend = t * t * (3.0 - 2.0 * t);
                radius.push(way[i][3] + blend * (way[i + 1][3] - way[i][3]));
            }
        }
        Self::of(points, radius)
    }

    /// The polyline through `points`.
    pub(crate) fn of(points: Vec<DVec3>, radius: Vec<f64>) -> Self {
        let mut arc = Vec::with_capacity(points.len());
        let mut length = 0.0;
        for (i, p) in points.iter().enumerate() {
            if i > 0 {
                length += p.distance(points[i - 1]);
            }
            arc.push(length);
        }
        Self { points, radius, arc }
    }

    /// Adds slight bends of about `amplitude` mm that vanish at both ends.
    pub(crate) fn winding(self, amplitude: f64, seed: u64) -> Self {
        let length = self.length();
        let waves = (length / 45.0).max(0.5);
        let phase = |n: u64| TAU * uniform(seed, n);
        let bend = |s: f64| {
            let u = s / length;
            let wave = |n: u64, f: f64| (TAU * waves * f * u + phase(n)).sin();
            let shape = DVec3::new(
                wave(1, 1.0) + 0.5 * wave(2, 1.9),
                wave(3, 0.9) + 0.5 * wave(4, 2.1),
                0.4 * wave(5, 1.1),
            );
            shape * (amplitude * (4.0 * u * (1.0 - u)).max(0.0).sqrt())
        };
        let last = self.points.len() - 1;
        let bent = |i: usize| match i {
            0 => self.points[0],
            i if i == last => self.points[last],
            i => self.points[i] + bend(self.arc[i]),
        };
        let points = (0..=last).map(bent).collect();
        Self::of(points, self.radius)
    }

    pub(crate) fn length(&self) -> f64 {
        self.arc[self.arc.len() - 1]
    }

    /// Point and radius at arc length `s` (mm), exact at both ends.
    pub(crate) fn at(&self, s: f64) -> (DVec3, f64) {
        let place = LinePlace::at(&self.arc, s);
        (place.point(&self.points), place.value(&self.radius))
    }

    /// Unit tangent at arc length `s` (mm).
    pub(crate) fn tangent(&self, s: f64) -> DVec3 {
        let s = s.clamp(0.0, self.length());
        (self.at(s + 0.5).0 - self.at(s - 0.5).0).normalize_or(DVec3::Z)
    }

    /// Arc length of the sample nearest to `point` (mm).
    pub(crate) fn nearest_arc_length(&self, point: DVec3) -> f64 {
        let far = |i: &usize| self.points[*i].distance_squared(point);
        let nearest = (0..self.points.len()).min_by(|a, b| far(a).total_cmp(&far(b)));
        nearest.map_or(0.0, |i| self.arc[i])
    }
}

/// The centripetal Catmull-Rom spline between the two middle points at `t` in [0, 1] (Barry and Goldman).
fn catmull_rom(p: [DVec3; 4], t: f64) -> DVec3 {
    let knot = |i: usize| p[i].distance(p[i + 1]).sqrt().max(1e-9);
    let k = [0.0, knot(0), knot(0) + knot(1), knot(0) + knot(1) + knot(2)];
    let t = k[1] + t * (k[2] - k[1]);
    let mix = |a: DVec3, b: DVec3, from: f64, to: f64| a.lerp(b, (t - from) / (to - from));
    let a = [0, 1, 2].map(|i| mix(p[i], p[i + 1], k[i], k[i + 1]));
    let b = [0, 1].map(|i| mix(a[i], a[i + 1], k[i], k[i + 2]));
    mix(b[0], b[1], k[1], k[2])
}

#[cfg(test)]
mod tests {
    use super::*;

    const WAY: [WayPoint; 4] =
        [[0.0, 0.0, 0.0, 4.0], [10.0, 5.0, 3.0, 3.5], [20.0, 0.0, 9.0, 3.0], [40.0, 1.0, 2.0, 2.0]];

    #[test]
    fn the_curve_meets_every_way_point() {
        let curve = Curve::through(&WAY);
        for w in WAY {
            let point = DVec3::new(w[0], w[1], w[2]);
            let (nearest, radius) = curve.at(curve.nearest_arc_length(point));
            assert_eq!(nearest, point);
            assert!((radius - w[3]).abs() < 1e-12);
        }
    }

    #[test]
    fn winding_leaves_the_ends_in_place() {
        let curve = Curve::through(&WAY);
        let bent = curve.clone().winding(3.0, 5);
        assert_eq!(bent.at(0.0), curve.at(0.0));
        assert_eq!(bent.at(bent.length()), curve.at(curve.length()));
        let middle = curve.at(curve.length() / 2.0).0;
        assert!(bent.at(bent.nearest_arc_length(middle)).0.distance(middle) > 0.01);
    }

    #[test]
    fn a_straight_spline_has_its_chord_length() {
        let curve = Curve::through(&[[0.0, 0.0, 0.0, 1.0], [3.0, 0.0, 0.0, 1.0], [10.0, 0.0, 0.0, 1.0]]);
        assert!((curve.length() - 10.0).abs() < 1e-9);
        assert!(curve.tangent(4.0).distance(DVec3::X) < 1e-9);
    }
}
