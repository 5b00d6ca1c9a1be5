//! Small phantoms with closed-form answers: tubes in fat without noise, in voxels of 0.5 mm.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use lumencut_core::error::{Error, ErrorKind, Result};

use crate::curve::Curve;
use crate::lesion::{Calcification, Plaque, PlaqueKind, Stenosis, WHOLE_RING, narrowing};
use crate::network::{KnownVessel, Vasculature};
use crate::paint::{Grid, Scene};
use crate::tissue::FAT;
use crate::{Phantom, wall_thickness};

/// Voxel side (mm).
const SPACING: f64 = 0.5;

/// Thickness of the fat around the outermost wall (mm).
const MARGIN: f64 = 10.0;

/// A tube of radius 4 mm from (0, 0, −30) to (0, 0, 30), 60 segments.
pub fn straight_tube() -> Result<Phantom> {
    phantom("straight_tube", vec![line("tube", DVec3::NEG_Z * 30.0, DVec3::Z * 30.0, 60, 4.0)])
}

/// A tube of radius 3 mm along (20 cos t, 20 sin t, 30 t / 2π − 30), two turns, 240 segments.
pub fn helix() -> Result<Phantom> {
    let place = |u: f64| {
        let t = 2.0 * TAU * u;
        DVec3::new(20.0 * t.cos(), 20.0 * t.sin(), 60.0 * u - 30.0)
    };
    phantom("helix", vec![sampled("helix", place, 240, 3.0)])
}

/// Three tubes that meet at (0, 0, 0): a trunk of radius 5 mm from (0, 0, −30), two branches of radius 4 mm to (±20, 0, 30).
pub fn y_junction() -> Result<Phantom> {
    let branch = |name: &str, x: f64| line(name, DVec3::ZERO, DVec3::new(x, 0.0, 30.0), 36, 4.0);
    let trunk = line("trunk", DVec3::NEG_Z * 30.0, DVec3::ZERO, 30, 5.0);
    phantom("y_junction", vec![trunk, branch("right branch", -20.0), branch("left branch", 20.0)])
}

/// Two straight tubes of radius 3 mm that cross in the anterior view: along x at y = −10 (in front), along z at y = 10.
pub fn crossing() -> Result<Phantom> {
    let front = line("front", DVec3::new(-25.0, -10.0, 0.0), DVec3::new(25.0, -10.0, 0.0), 50, 3.0);
    let back = line("back", DVec3::new(0.0, 10.0, -25.0), DVec3::new(0.0, 10.0, 25.0), 50, 3.0);
    phantom("crossing", vec![front, back])
}

/// A closed trefoil knot of radius 3 mm: 10·(sin t + 2 sin 2t, −sin 3t, cos t − 2 cos 2t), 300 segments. It crosses itself three
/// times in the anterior view.
pub fn trefoil() -> Result<Phantom> {
    let place = |u: f64| {
        // Both ends get the same parameter, so that the knot closes exactly.
        let t = if u < 1.0 { TAU * u } else { 0.0 };
        let x = t.sin() + 2.0 * (2.0 * t).sin();
        let z = t.cos() - 2.0 * (2.0 * t).cos();
        DVec3::new(x, -(3.0 * t).sin(), z) * 10.0
    };
    phantom("trefoil", vec![sampled("knot", place, 300, 3.0)])
}

/// Two tubes of radius 3 mm with segments along the anterior viewing direction: "bend" runs up, 40 mm backwards along y, and up;
/// "end-on" runs along y.
pub fn collinear_run() -> Result<Phantom> {
    let leg = |from: DVec3, to: DVec3| line("bend", from, to, 30, 3.0);
    let (low, high) = (DVec3::new(-15.0, -20.0, 0.0), DVec3::new(-15.0, 20.0, 0.0));
    let mut bend = leg(low + DVec3::NEG_Z * 30.0, low);
    for next in [leg(low, high), leg(high, high + DVec3::Z * 30.0)] {
        bend.points.extend(&next.points[1..]);
        bend.lumen.extend(&next.lumen[1..]);
        bend.reference.extend(&next.reference[1..]);
        bend.wall.extend(&next.wall[1..]);
    }
    let end_on = line("end-on", DVec3::new(15.0, -20.0, 0.0), DVec3::new(15.0, 20.0, 0.0), 40, 3.0);
    phantom("collinear_run", vec![bend, end_on])
}

/// A tube of radius 4 mm from z = −30 to 30, 120 segments, narrowed by `percent` over 16 mm around z = 0 (see
/// [`Stenosis`]) by soft plaque. Fails with [`ErrorKind::Settings`] for a percentage outside [0, 100).
pub fn stenosis(percent: f64) -> Result<Phantom> {
    if !(0.0..100.0).contains(&percent) {
        let found = format!("{percent}");
        return Err(Error::new(ErrorKind::Settings, "percent", found, "at least 0 and below 100 percent"));
    }
    let length = 16.0;
    let mut tube = line("tube", DVec3::NEG_Z * 30.0, DVec3::Z * 30.0, 120, 4.0);
    for (lumen, point) in tube.lumen.iter_mut().zip(&tube.points) {
        *lumen *= 1.0 - percent / 100.0 * narrowing(point.z, length);
    }
    let ring = Plaque {
        vessel: 0,
        arc_length: 30.0,
        kind: PlaqueKind::Soft,
        angle: 0.0,
        length,
        angular_extent: WHOLE_RING,
        thickness: 4.0 * percent / 100.0,
        position: DVec3::ZERO,
    };
    let vasculature = Vasculature {
        vessels: vec![tube],
        stenoses: vec![Stenosis { vessel: 0, arc_length: 30.0, length, percent }],
        plaques: vec![ring],
        calcium: Vec::new(),
    };
    made("stenosis", vasculature)
}

/// A tube of radius 4 mm from z = −30 to 30 with a calcification outside the lumen at z = 0: 2 mm thick, 8 mm long, one radian
/// wide, to the patient's left (π/2).
pub fn calcified_wall() -> Result<Phantom> {
    let tube = line("tube", DVec3::NEG_Z * 30.0, DVec3::Z * 30.0, 60, 4.0);
    let calcium =
        Calcification { arc_length: 30.0, length: 8.0, angle: PI / 2.0, angular_extent: 1.0, thickness: 2.0 };
    let curve = Curve::of(tube.points.clone(), tube.reference.clone());
    let plaque = Plaque {
        vessel: 0,
        arc_length: calcium.arc_length,
        kind: PlaqueKind::Calcified,
        angle: calcium.angle,
        length: calcium.length,
        angular_extent: calcium.angular_extent,
        thickness: calcium.thickness,
        position: calcium.position(&curve, 4.0),
    };
    let vasculature = Vasculature {
        vessels: vec![tube],
        stenoses: Vec::new(),
        plaques: vec![plaque],
        calcium: calcium.rods(&curve, |_| 4.0),
    };
    made("calcified_wall", vasculature)
}

fn line(name: &str, from: DVec3, to: DVec3, segments: usize, radius: f64) -> KnownVessel {
    let place = |u: f64| if u < 1.0 { from + (to - from) * u } else { to };
    sampled(name, place, segments, radius)
}

/// A vessel of constant radius through `place` at equal parameter steps from 0 to 1.
fn sampled(name: &str, place: impl Fn(f64) -> DVec3, segments: usize, radius: f64) -> KnownVessel {
    let points = (0..=segments).map(|i| place(i as f64 / segments as f64)).collect();
    let radius = vec![radius; segments + 1];
    let wall = radius.iter().copied().map(wall_thickness).collect();
    KnownVessel { name: name.to_owned(), points, lumen: radius.clone(), reference: radius, wall }
}

fn phantom(name: &'static str, vessels: Vec<KnownVessel>) -> Result<Phantom> {
    made(name, Vasculature { vessels, ..Vasculature::default() })
}

fn made(name: &'static str, vasculature: Vasculature) -> Result<Phantom> {
    let grid = Grid::around(&vasculature.vessels, SPACING, MARGIN);
    let scene = Scene { background: FAT, ..Scene::default() };
    Phantom::of(name, (&grid, &scene), vasculature, &|| false)
}
