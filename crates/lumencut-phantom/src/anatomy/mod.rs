//! Anatomy of the workloads in world space (mm, LPS): a tall adult lying supine. Each region is a file of coordinates for
//! vessels, bones and soft tissue.

mod abdomen;
mod abdominal_vessels;
mod cervical_vessels;
mod head;
mod leg_vessels;
mod legs;
mod neck;
mod spine;
mod torso;

use glam::{Vec2, Vec3};

use super::curve::WayPoint;
use super::network::Vasculature;
use super::shape::{Section, Shape};
use super::tissue::Solid;

pub(super) use abdomen::abdomen;
pub(super) use legs::lower_extremities;
pub(super) use neck::neck;

pub(super) struct Anatomy {
    pub(super) vasculature: Vasculature,
    pub(super) solids: Vec<Solid>,
    pub(super) background: f32,
}

type Branch<const N: usize> = (&'static str, [WayPoint; N]);

/// The sign of x and the name of each side of the patient.
const SIDES: [(f64, &str); 2] = [(-1.0, "right"), (1.0, "left")];

fn rod(from: [f32; 3], to: [f32; 3], radius: [f32; 2]) -> Shape {
    Shape::Rod { ends: [Vec3::from(from), Vec3::from(to)], radius }
}

fn ellipsoid(center: [f32; 3], axes: [f32; 3]) -> Shape {
    Shape::Ellipsoid { center: Vec3::from(center), axes: Vec3::from(axes) }
}

fn plate(corners: [[f32; 3]; 3], radius: f32) -> Shape {
    Shape::Plate { corners: corners.map(Vec3::from), radius }
}

/// A shape from ellipses [z, centre x, centre y, half axis x, half axis y], sorted by z.
fn profile(rows: &[[f32; 5]]) -> Shape {
    let section =
        |[z, x, y, rx, ry]: [f32; 5]| Section { z, center: Vec2::new(x, y), axes: Vec2::new(rx, ry) };
    Shape::Profile(rows.iter().copied().map(section).collect())
}

fn chain(knots: &[[f32; 4]]) -> Vec<Shape> {
    let link = |pair: &[[f32; 4]]| {
        let [a, b] = [pair[0], pair[1]];
        rod([a[0], a[1], a[2]], [b[0], b[1], b[2]], [a[3], b[3]])
    };
    knots.windows(2).map(link).collect()
}

fn both_sides(shapes: Vec<Shape>) -> Vec<Shape> {
    let mirror = |v: Vec3| Vec3::new(-v.x, v.y, v.z);
    let mirrored = |shape: &Shape| match shape {
        Shape::Ellipsoid { center, axes } => Shape::Ellipsoid { center: mirror(*center), axes: *axes },
        Shape::Rod { ends, radius } => Shape::Rod { ends: ends.map(mirror), radius: *radius },
        Shape::Plate { corners, radius } => Shape::Plate { corners: corners.map(mirror), radius: *radius },
        Shape::Profile(sections) => {
            let flip = |s: &Section| Section { center: Vec2::new(-s.center.x, s.center.y), ..*s };
            Shape::Profile(sections.iter().map(flip).collect())
        }
    };
    let others: Vec<Shape> = shapes.iter().map(mirrored).collect();
    shapes.into_iter().chain(others).collect()
}

/// The way points of the left side, mirrored if `side` is −1 (right).
fn on_side<const N: usize>(side: f64, way: [WayPoint; N]) -> [WayPoint; N] {
    way.map(|[x, y, z, radius]| [side * x, y, z, radius])
}
