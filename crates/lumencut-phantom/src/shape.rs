//! Simple solids, described by signed distances (mm, negative inside).

use glam::{Vec2, Vec3};

/// An axial ellipse at height `z`; [`Shape::Profile`] interpolates smoothly between ellipses.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Section {
    pub(crate) z: f32,
    pub(crate) center: Vec2,
    pub(crate) axes: Vec2,
}

/// A solid in world space (mm, LPS).
#[derive(Clone, Debug)]
pub(crate) enum Shape {
    Ellipsoid { center: Vec3, axes: Vec3 },
    Rod { ends: [Vec3; 2], radius: [f32; 2] },
    Plate { corners: [Vec3; 3], radius: f32 },
    Profile(Vec<Section>),
}

pub(crate) enum Cut<'a> {
    Solid(&'a Shape),
    Ellipse { center: Vec2, axes: Vec2 },
}

impl Shape {
    /// The cross-section at height `z`, and a rectangle that contains it with a margin of `reach` mm; `None` if `z` is outside.
    pub(crate) fn cut(&self, z: f32, reach: f32) -> Option<(Cut<'_>, [Vec2; 2])> {
        if let Shape::Profile(sections) = self {
            let (center, axes) = section_at(sections, z)?;
            return Some((Cut::Ellipse { center, axes }, [center - axes - reach, center + axes + reach]));
        }
        let (low, high) = self.bounds();
        let near = z > low.z - reach && z < high.z + reach;
        near.then(|| (Cut::Solid(self), [low.truncate() - reach, high.truncate() + reach]))
    }

    fn bounds(&self) -> (Vec3, Vec3) {
        match self {
            Shape::Ellipsoid { center, axes } => (*center - *axes, *center + *axes),
            Shape::Rod { ends: [a, b], radius } => {
                ((*a - radius[0]).min(*b - radius[1]), (*a + radius[0]).max(*b + radius[1]))
            }
            Shape::Plate { corners: [a, b, c], radius } => {
                (a.min(*b).min(*c) - *radius, a.max(*b).max(*c) + *radius)
            }
            Shape::Profile(_) => (Vec3::MIN, Vec3::MAX),
        }
    }
}

impl Cut<'_> {
    /// The signed distance of `p`. It is exact for plates and for rods of constant radius, and otherwise accurate near the surface.
    #[inline(always)]
    pub(crate) fn distance(&self, p: Vec3) -> f32 {
        match self {
            Cut::Ellipse { center, axes } => {
                let q = p.truncate() - *center;
                round_distance((q / *axes).length(), (q / (*axes * *axes)).length())
            }
            Cut::Solid(Shape::Ellipsoid { center, axes }) => {
                let q = p - *center;
                round_distance((q / *axes).length(), (q / (*axes * *axes)).length())
            }
            Cut::Solid(Shape::Rod { ends, radius }) => {
                let (d, t) = distance_to_line(p, ends[0], ends[1]);
                d - (radius[0] + t * (radius[1] - radius[0]))
            }
            Cut::Solid(Shape::Plate { corners, radius }) => distance_to_triangle(p, corners) - radius,
            Cut::Solid(Shape::Profile(_)) => f32::MAX,
        }
    }
}

/// Distance to an ellipse or ellipsoid by one Newton step; `scaled` is the length of q / axes, `slope` that of q / axes².
#[inline(always)]
fn round_distance(scaled: f32, slope: f32) -> f32 {
    scaled * (scaled - 1.0) / slope.max(1e-9)
}

/// The distance of `p` from the segment a–b, and the position of the nearest point on it (0 at a, 1 at b).
#[inline(always)]
pub(crate) fn distance_to_line(p: Vec3, a: Vec3, b: Vec3) -> (f32, f32) {
    let (e, q) = (b - a, p - a);
    let t = (q.dot(e) / e.length_squared().max(1e-12)).clamp(0.0, 1.0);
    ((q - e * t).length(), t)
}

fn distance_to_triangle(p: Vec3, [a, b, c]: &[Vec3; 3]) -> f32 {
    let normal = (*b - *a).cross(*c - *a);
    let inside = |from: Vec3, to: Vec3| (to - from).cross(normal).dot(p - from) <= 0.0;
    if inside(*a, *b) && inside(*b, *c) && inside(*c, *a) {
        return (p - *a).dot(normal).abs() / normal.length().max(1e-12);
    }
    let edge = |from: &Vec3, to: &Vec3| distance_to_line(p, *from, *to).0;
    edge(a, b).min(edge(b, c)).min(edge(c, a))
}

/// The interpolated ellipse at height `z`, or `None` above or below all sections.
fn section_at(sections: &[Section], z: f32) -> Option<(Vec2, Vec2)> {
    let above = sections.iter().position(|s| s.z >= z)?;
    let b = sections[above];
    if above == 0 {
        return (b.z <= z).then_some((b.center, b.axes));
    }
    let at = |i: usize| sections[i.min(sections.len() - 1)];
    let span = [at(above.saturating_sub(2)), at(above - 1), b, at(above + 1)];
    let t = (z - span[1].z) / (b.z - span[1].z).max(1e-6);
    let blend = |f: fn(&Section) -> Vec2| hermite(span.map(|s| (s.z, f(&s))), t);
    Some((blend(|s| s.center), blend(|s| s.axes).max(Vec2::splat(0.5))))
}

/// Cubic Hermite interpolation between the two middle values at `t` in [0, 1].
fn hermite(v: [(f32, Vec2); 4], t: f32) -> Vec2 {
    let gap = v[2].0 - v[1].0;
    let slope = |i: usize, j: usize| (v[j].1 - v[i].1) * (gap / (v[j].0 - v[i].0).max(1e-6));
    let (m1, m2) = (slope(0, 2), slope(1, 3));
    let (t2, t3) = (t * t, t * t * t);
    v[1].1 * (2.0 * t3 - 3.0 * t2 + 1.0)
        + m1 * (t3 - 2.0 * t2 + t)
        + v[2].1 * (3.0 * t2 - 2.0 * t3)
        + m2 * (t3 - t2)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn distance(shape: &Shape, p: Vec3) -> f32 {
        shape.cut(p.z, 100.0).map_or(f32::MAX, |(cut, _)| cut.distance(p))
    }

    #[test]
    fn spheres_rods_and_plates_know_their_distance() {
        let sphere = Shape::Ellipsoid { center: Vec3::ZERO, axes: Vec3::splat(5.0) };
        assert!((distance(&sphere, Vec3::new(0.0, 8.0, 0.0)) - 3.0).abs() < 1e-4);
        let rod = Shape::Rod { ends: [Vec3::ZERO, Vec3::Z * 10.0], radius: [2.0, 4.0] };
        assert!((distance(&rod, Vec3::new(5.0, 0.0, 5.0)) - 2.0).abs() < 1e-5);
        let plate = Shape::Plate { corners: [Vec3::ZERO, Vec3::X * 9.0, Vec3::Y * 9.0], radius: 1.0 };
        assert!((distance(&plate, Vec3::new(2.0, 2.0, 5.0)) - 4.0).abs() < 1e-5);
        assert!((distance(&plate, Vec3::new(-3.0, 0.0, 0.0)) - 2.0).abs() < 1e-5);
    }

    #[test]
    fn a_profile_meets_its_sections() {
        let section = |z: f32, x: f32| Section { z, center: Vec2::ZERO, axes: Vec2::new(x, 20.0) };
        let shape = Shape::Profile(vec![section(0.0, 10.0), section(10.0, 30.0), section(30.0, 20.0)]);
        assert!(distance(&shape, Vec3::new(30.0, 0.0, 10.0)).abs() < 1e-3);
        assert!(distance(&shape, Vec3::new(10.0, 0.0, 0.0)).abs() < 1e-3);
        assert!(shape.cut(-1.0, 5.0).is_none() && shape.cut(31.0, 5.0).is_none());
    }
}
