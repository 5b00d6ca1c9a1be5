//! Draws the vessel walls as wires over a finished picture: rings across the vessels, and lines along them.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};
use lumencut_core::camera::Camera;
use lumencut_core::math::centerline_path::CenterlinePath;
use lumencut_core::math::frames::{Frames, MovingFrame};
use lumencut_core::settings::Settings;
use lumencut_core::vessel_tree::{Vessel, VesselTree};

/// Red, green and blue of the wires: silhouettes are yellow, and transfer functions red to white.
const COLOR: [f64; 3] = [60.0, 190.0, 255.0];
/// Corners of a ring, and most lines along a vessel, which run through corners.
const SIDES: usize = 12;
/// Distance between two rings (radii).
const RING_STEP: f64 = 1.5;
/// Least distances between two lines along a vessel, and between two rings (pixels): thin vessels have fewer.
const LINES_APART: f64 = 4.0;
const RINGS_APART: f64 = 8.0;
/// Share of the colour on the far side of a vessel.
const FAR_SIDE: f32 = 0.35;
/// Cosine up to which a wire at the outline of a vessel counts as near.
const GRAZING: f64 = 1e-6;
/// Half of the width of a wire (pixels).
const HALF_WIDTH: f64 = 0.5;

/// Draws the walls of a tree over a picture of `camera`: RGBA, not premultiplied by opacity.
pub(crate) fn draw_wireframe(image: &mut [[u8; 4]], camera: &Camera, tree: &VesselTree, settings: &Settings) {
    let mut cover = Cover { size: camera.size(), share: vec![0.0; image.len()] };
    for vessel in tree.vessels() {
        for wire in wires(vessel, camera, settings.unknown_radius) {
            cover.add(wire.ends.map(|end| pixel_of(camera, end)), wire.share);
        }
    }
    for (pixel, share) in image.iter_mut().zip(&cover.share) {
        *pixel = mixed(*pixel, f64::from(*share));
    }
}

/// A straight piece of a wire.
struct Wire {
    /// World positions (mm).
    ends: [DVec3; 2],
    /// Share of the colour.
    share: f32,
}

/// The wires of one vessel; none for a vessel without length.
fn wires(vessel: &Vessel, camera: &Camera, unknown_radius: f64) -> Vec<Wire> {
    let Ok(path) = CenterlinePath::new(vessel, 0.0) else { return Vec::new() };
    let (direction, side) = (camera.direction(), camera.pixel_spacing());
    let first = MovingFrame::looking(path.direction()[0], direction);
    let frames = Frames::new(&path, first);
    let corners = |at: f64| {
        let radius = radius_at(vessel, at, unknown_radius);
        let (middle, frame) = (path.at(at), frames.at(at));
        std::array::from_fn::<_, SIDES, _>(|side| {
            let (sine, cosine) = (TAU * side as f64 / SIDES as f64).sin_cos();
            let outward = frame.across * cosine + frame.ahead * sine;
            (middle + outward * radius, outward)
        })
    };
    let wire = |(from, a): (DVec3, DVec3), (to, b): (DVec3, DVec3)| {
        let is_near = (a + b).dot(direction) <= GRAZING;
        Wire { ends: [from, to], share: if is_near { 1.0 } else { FAR_SIDE } }
    };
    let mut wires = Vec::new();
    for at in rings(vessel, &path, unknown_radius, RINGS_APART * side) {
        let ring = corners(at);
        wires.extend((0..SIDES).map(|side| wire(ring[side], ring[(side + 1) % SIDES])));
    }
    let along: Vec<_> = path.arc_length().iter().map(|at| corners(*at)).collect();
    let radii = path.arc_length().iter().map(|at| radius_at(vessel, *at, unknown_radius));
    let mean = radii.sum::<f64>() / along.len() as f64;
    for pair in along.windows(2) {
        let lines = (0..SIDES).step_by(corners_between(mean / side));
        wires.extend(lines.map(|corner| wire(pair[0][corner], pair[1][corner])));
    }
    wires
}

/// How many corners apart the lines along a vessel of a radius (pixels) are.
fn corners_between(radius: f64) -> usize {
    let is_wide = |apart: &usize| TAU * radius * *apart as f64 / SIDES as f64 >= LINES_APART;
    [1, 2, 3, 4].into_iter().find(is_wide).unwrap_or(6)
}

/// Arc lengths of the rings (mm); both ends have one.
fn rings(vessel: &Vessel, path: &CenterlinePath, unknown_radius: f64, least: f64) -> Vec<f64> {
    let mut at = vec![0.0];
    for length in path.arc_length() {
        let step = least.max(RING_STEP * radius_at(vessel, *length, unknown_radius));
        if length - at[at.len() - 1] >= step {
            at.push(*length);
        }
    }
    at.push(path.length());
    at
}

/// The radius at an arc length (mm).
fn radius_at(vessel: &Vessel, at: f64, unknown_radius: f64) -> f64 {
    let lengths = vessel.arc_length();
    let next = lengths.partition_point(|length| *length <= at).clamp(1, lengths.len() - 1);
    let [from, to] = [next - 1, next].map(|i| match vessel.radius_or_zero(i) {
        0.0 => unknown_radius,
        radius => radius,
    });
    let step = lengths[next] - lengths[next - 1];
    let way = if step > 0.0 { ((at - lengths[next - 1]) / step).clamp(0.0, 1.0) } else { 0.0 };
    from + (to - from) * way
}

/// The place of a world point in a picture (pixels from its upper left corner).
fn pixel_of(camera: &Camera, world: DVec3) -> DVec2 {
    let view = camera.view_from_world(world) / camera.pixel_spacing();
    let [width, height] = camera.size().map(|n| n as f64);
    DVec2::new(width / 2.0 + view.x, height / 2.0 - view.y)
}

/// Share of the colour at each pixel; where wires cross, the largest.
struct Cover {
    size: [usize; 2],
    share: Vec<f32>,
}

impl Cover {
    /// Adds a straight line between two places (pixels), column by column, or row by row if it is steep.
    fn add(&mut self, [from, to]: [DVec2; 2], share: f32) {
        let step = to - from;
        let along = usize::from(step.y.abs() > step.x.abs());
        let across = 1 - along;
        // A line at 45° covers pixels up to this distance in a column.
        let reach = (HALF_WIDTH + 0.5) * std::f64::consts::SQRT_2;
        let [low, high] = [from[along].min(to[along]), from[along].max(to[along])];
        for n in self.pixels(along, low - reach, high + reach) {
            let way = if step[along] == 0.0 { 0.0 } else { (n as f64 + 0.5 - from[along]) / step[along] };
            let middle = from[across] + way.clamp(0.0, 1.0) * step[across];
            for m in self.pixels(across, middle - reach, middle + reach) {
                let [i, j] = if along == 0 { [n, m] } else { [m, n] };
                let place = DVec2::new(i as f64 + 0.5, j as f64 + 0.5);
                let cover = (HALF_WIDTH + 0.5 - distance(place, from, step)).clamp(0.0, 1.0) as f32;
                let held = &mut self.share[j * self.size[0] + i];
                *held = held.max(cover * share);
            }
        }
    }

    /// The pixels of the picture whose centres lie between two coordinates along an axis.
    fn pixels(&self, axis: usize, low: f64, high: f64) -> std::ops::Range<usize> {
        let bound = |x: f64| (x - 0.5).ceil().clamp(0.0, self.size[axis] as f64) as usize;
        bound(low)..bound(high)
    }
}

/// Distance of a place from the line between `from` and `from + step`.
fn distance(place: DVec2, from: DVec2, step: DVec2) -> f64 {
    let square = step.length_squared();
    let way = if square > 0.0 { ((place - from).dot(step) / square).clamp(0.0, 1.0) } else { 0.0 };
    place.distance(from + step * way)
}

/// A pixel with a share of the wires' colour over it.
fn mixed(pixel: [u8; 4], share: f64) -> [u8; 4] {
    if share == 0.0 {
        return pixel;
    }
    let below = f64::from(pixel[3]) / 255.0 * (1.0 - share);
    let opacity = share + below;
    let color = |n: usize| ((COLOR[n] * share + f64::from(pixel[n]) * below) / opacity).round() as u8;
    [color(0), color(1), color(2), (255.0 * opacity).round() as u8]
}

#[cfg(test)]
#[path = "tests/wireframe.rs"]
mod tests;
