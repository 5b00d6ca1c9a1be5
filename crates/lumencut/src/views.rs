//! The six standard views; fits, rotates, zooms and pans views. Every function returns a new camera. Points are in
//! world space (LPS, mm).

use glam::{DMat3, DVec3};
use lumencut_core::camera::Camera;
use lumencut_core::error::{Error, ErrorKind, Result};
use lumencut_core::math::centerline_path::CenterlinePath;
use lumencut_core::reformations::uncurl::Uncurl;
use lumencut_core::vessel_tree::Vessel;

use crate::fused;
use crate::text::shortest;
use std::sync::Arc;

/// The margin of a fitted view on each side, as a fraction of the image.
pub(crate) const MARGIN: f64 = 0.06;

/// The smallest pixel spacing of a fitted view (mm).
pub(crate) const FINEST: f64 = 1e-3;

/// A standard view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NamedView {
    /// The patient's side on which the viewer stands.
    pub name: &'static str,
    /// Unit vector from the viewer into the scene (LPS).
    pub direction: DVec3,
    /// Unit vector upwards in the image (LPS).
    pub up: DVec3,
}

/// The six standard views.
pub const VIEWS: [NamedView; 6] = [
    NamedView { name: "anterior", direction: DVec3::Y, up: DVec3::Z },
    NamedView { name: "posterior", direction: DVec3::NEG_Y, up: DVec3::Z },
    NamedView { name: "left", direction: DVec3::NEG_X, up: DVec3::Z },
    NamedView { name: "right", direction: DVec3::X, up: DVec3::Z },
    NamedView { name: "superior", direction: DVec3::NEG_Z, up: DVec3::NEG_Y },
    NamedView { name: "inferior", direction: DVec3::Z, up: DVec3::NEG_Y },
];

/// The standard view of this name. Fails with [`ErrorKind::Camera`] for an unknown name.
pub fn named(name: &str) -> Result<NamedView> {
    VIEWS.into_iter().find(|view| view.name == name).ok_or_else(|| {
        let expected = format!("one of {}", VIEWS.map(|view| view.name).join(", "));
        Error::new(ErrorKind::Camera, "name of the view", format!("'{name}'"), expected)
    })
}

/// An axis of rotation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Axis {
    /// From feet to head.
    Superior,
    /// Upwards in the image.
    Up,
    /// Rightwards in the image.
    Right,
    /// Away from the viewer.
    Direction,
    /// A vector of any length (LPS), as the axis.
    World(DVec3),
}

impl Axis {
    /// The axis with this name: `superior`, `up`, `right` or `direction`. Fails with [`ErrorKind::Camera`] for an
    /// unknown name.
    pub fn named(name: &str) -> Result<Self> {
        match name {
            "superior" => Ok(Self::Superior),
            "up" => Ok(Self::Up),
            "right" => Ok(Self::Right),
            "direction" => Ok(Self::Direction),
            _ => {
                let expected = "superior, up, right or direction";
                Err(Error::new(ErrorKind::Camera, "axis of the rotation", format!("'{name}'"), expected))
            }
        }
    }

    fn of(self, camera: &Camera) -> DVec3 {
        match self {
            Self::Superior => DVec3::Z,
            Self::Up => camera.up(),
            Self::Right => camera.right(),
            Self::Direction => camera.direction(),
            Self::World(vector) => vector,
        }
    }
}

/// The camera moved and zoomed so that all points just fit. Direction, up and size stay. Fails with
/// [`ErrorKind::Camera`] without points, or for an invalid view.
pub fn fitted(camera: &Camera, points: &[DVec3]) -> Result<Camera> {
    let camera = centered(camera, points)?.with_axes(camera.direction(), camera.right(), camera.up())?;
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for point in points {
        for (axis, coordinate) in in_plane(&camera, *point).into_iter().enumerate() {
            low[axis] = low[axis].min(coordinate);
            high[axis] = high[axis].max(coordinate);
        }
    }
    let [x, y] = [0, 1].map(|axis| (low[axis] + high[axis]) / 2.0);
    let center = camera.center() + fused::combined(camera.right(), x, camera.up(), y);
    let extent = [0, 1].map(|axis| high[axis] - low[axis]);
    let spacing = spacing_for(&camera, extent, 1.0 - 2.0 * MARGIN);
    Camera::new(center, camera.direction(), camera.up(), camera.size(), spacing)
}

/// The camera at the centre of the points' bounding box, at 1 mm per pixel.
pub(crate) fn centered(camera: &Camera, points: &[DVec3]) -> Result<Camera> {
    if points.is_empty() {
        return Err(Error::new(ErrorKind::Camera, "scene of the view", "no points", "one or more"));
    }
    let (low, high) =
        points.iter().fold((DVec3::MAX, DVec3::MIN), |(low, high), p| (low.min(*p), high.max(*p)));
    Camera::new((low + high) / 2.0, camera.direction(), camera.up(), camera.size(), 1.0)
}

/// How far a point lies to the right of and above the camera's center (mm).
pub(crate) fn in_plane(camera: &Camera, point: DVec3) -> [f64; 2] {
    let offset = point - camera.center();
    [fused::dot(offset, camera.right()), fused::dot(offset, camera.up())]
}

/// The pixel spacing (mm) at which in-plane lengths (mm) fill `part` of the image.
pub(crate) fn spacing_for(camera: &Camera, lengths: [f64; 2], part: f64) -> f64 {
    let [across, upwards] = [0, 1].map(|axis| lengths[axis] / (camera.size()[axis] as f64 * part));
    across.max(upwards).max(FINEST)
}

/// The camera rotated about its center by an angle (radians), counterclockwise if the axis points at the observer.
/// Fails with [`ErrorKind::Camera`] for a non-finite angle, or an invalid axis.
pub fn rotated(camera: &Camera, angle: f64, axis: Axis) -> Result<Camera> {
    let turn = rotation(axis.of(camera), angle)?;
    let [direction, up] = [camera.direction(), camera.up()].map(|vector| fused::product(&turn, vector));
    Camera::new(camera.center(), direction, up, camera.size(), camera.pixel_spacing())
}

/// The rotation about an axis (LPS) by an angle (radians).
pub(crate) fn rotation(axis: DVec3, angle: f64) -> Result<DMat3> {
    let largest = axis.abs().max_element();
    if !(angle.is_finite() && axis.is_finite() && largest > 0.0) {
        let found = format!("angle {} about [{}]", shortest(angle), axis.to_array().map(shortest).join(", "));
        return Err(Error::new(
            ErrorKind::Camera,
            "rotation of the camera",
            found,
            "a finite angle and axis",
        ));
    }
    let scaled = axis / largest;
    let unit = scaled / fused::dot(scaled, scaled).sqrt();
    let cross = DMat3::from_cols(
        DVec3::new(0.0, unit.z, -unit.y),
        DVec3::new(-unit.z, 0.0, unit.x),
        DVec3::new(unit.y, -unit.x, 0.0),
    );
    let squared = fused::matrices(&(cross * (1.0 - angle.cos())), &cross);
    Ok((DMat3::IDENTITY + cross * angle.sin()) + squared)
}

/// The camera magnified about its center by a positive factor. Fails with [`ErrorKind::Camera`] for another factor,
/// or a spacing out of range.
pub fn zoomed(camera: &Camera, factor: f64) -> Result<Camera> {
    if !(factor.is_finite() && factor > 0.0) {
        let expected = "a number above 0";
        return Err(Error::new(ErrorKind::Camera, "factor of the zoom", shortest(factor), expected));
    }
    let spacing = camera.pixel_spacing() / factor;
    Camera::new(camera.center(), camera.direction(), camera.up(), camera.size(), spacing)
}

/// The camera moved right and up in its plane (mm). Fails with [`ErrorKind::Camera`] for non-finite or too large
/// distances.
pub fn panned(camera: &Camera, right: f64, up: f64) -> Result<Camera> {
    if !(right.is_finite() && up.is_finite()) {
        let found = format!("[{}, {}]", shortest(right), shortest(up));
        return Err(Error::new(ErrorKind::Camera, "shift of the camera", found, "finite distances in mm"));
    }
    let center = camera.center() + right * camera.right() + up * camera.up();
    Camera::new(center, camera.direction(), camera.up(), camera.size(), camera.pixel_spacing())
}

/// The fraction of the image that the vessel fills.
const FILLED_FRACTION: f64 = 0.9;

/// Number of sampled amounts from 0 to 1.
const SAMPLED_AMOUNTS: usize = 17;

/// The camera centred on a vessel that shows all of it at every amount of uncurling. Direction, up and size stay.
/// Fails with [`lumencut_core::error::ErrorKind::VesselTree`] for a vessel without length,
/// [`lumencut_core::error::ErrorKind::Settings`] for an invalid smoothing (mm).
pub fn fitted_uncurling(camera: &Camera, vessel: &Vessel, smoothing: f64) -> Result<Camera> {
    let path = Arc::new(CenterlinePath::new(vessel, smoothing)?);
    let middle = fitted(camera, vessel.points())?;
    let mut reach = [0.0f64; 2];
    for step in 0..SAMPLED_AMOUNTS {
        let amount = step as f64 / (SAMPLED_AMOUNTS - 1) as f64;
        let extent = Uncurl::new(Arc::clone(&path), middle, amount, None)?.extent();
        reach = [reach[0].max(extent.x), reach[1].max(extent.y)];
    }
    let spacing = spacing_for(&middle, reach.map(|side| 2.0 * side), FILLED_FRACTION);
    let made = Camera::new(middle.center(), middle.direction(), middle.up(), middle.size(), spacing)?;
    made.with_axes(middle.direction(), middle.right(), middle.up())
}

#[cfg(test)]
#[path = "tests/views.rs"]
mod tests;
