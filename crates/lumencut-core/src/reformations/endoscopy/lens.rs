//! What an eye in a vessel sees: where it is, how it looks, and the direction of each pixel.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use crate::camera::{MAX_PIXELS, MAX_SIZE};
use crate::error::{Error, ErrorKind, Result};
use crate::math::centerline_path::CenterlinePath;
use crate::named::Named;
use crate::reformations::cpr::Straightened;

/// The eye looks at a place this many radii ahead, at least [`AHEAD_MM`].
const AHEAD_RADII: f64 = 2.0;
const AHEAD_MM: f64 = 5.0;

/// How directions become pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lens {
    /// Straight lines stay straight.
    Perspective,
    /// Angles from the middle are distances in the image, within a circle.
    Fisheye,
}

impl Named for Lens {
    const NAMES: &'static [(&'static str, Self)] =
        &[("perspective", Self::Perspective), ("fisheye", Self::Fisheye)];
}

impl Lens {
    /// The field of view if none is given (radians).
    pub fn usual_field_of_view(self) -> f64 {
        match self {
            Self::Perspective => 100_f64.to_radians(),
            Self::Fisheye => PI,
        }
    }

    /// The largest field of view (radians).
    fn widest(self) -> f64 {
        match self {
            Self::Perspective => 170_f64.to_radians(),
            Self::Fisheye => 2.0 * PI,
        }
    }
}

/// A lens, its image, and its field of view across the smaller side.
#[derive(Clone, Copy, Debug)]
pub struct LensImage {
    lens: Lens,
    size: [usize; 2],
    half: f64,
}

impl LensImage {
    /// Fails with [`ErrorKind::Camera`] for an image without pixels or with too many, and a field of view (radians) that the
    /// lens cannot have.
    pub fn new(lens: Lens, size: [usize; 2], field_of_view: f64) -> Result<Self> {
        let camera = |subject: &str, found, expected: String| {
            Err(Error::new(ErrorKind::Camera, subject, found, expected))
        };
        if size.contains(&0) || size.iter().any(|n| *n > MAX_SIZE) || size[0] * size[1] > MAX_PIXELS {
            let found = format!("{} × {} pixels", size[0], size[1]);
            let expected =
                format!("at least one pixel, at most {MAX_SIZE} along each side and {MAX_PIXELS} in all");
            return camera("size of the endoscopy", found, expected);
        }
        if !(field_of_view > 0.0 && field_of_view <= lens.widest()) {
            let expected = format!("above 0 and at most {:.4} rad", lens.widest());
            return camera("field_of_view of the endoscopy", format!("{field_of_view} rad"), expected);
        }
        Ok(Self { lens, size, half: field_of_view / 2.0 })
    }

    pub(super) fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Direction to the right, upwards and ahead (unit) at an image position; None outside the circle of a fisheye.
    pub(super) fn direction(&self, pixel: DVec2) -> Option<DVec3> {
        let [width, height] = self.size.map(|n| n as f64);
        let place = DVec2::new(2.0 * pixel.x + 1.0 - width, height - 1.0 - 2.0 * pixel.y) / width.min(height);
        match self.lens {
            Lens::Perspective => Some((place * self.half.tan()).extend(1.0).normalize()),
            Lens::Fisheye => {
                let (sine, cosine) = (place.length() * self.half).sin_cos();
                let is_within = place.length() <= 1.0;
                is_within.then(|| (place.normalize_or_zero() * sine).extend(cosine))
            }
        }
    }

    /// The image position of a direction to the right, upwards and ahead; None outside the image.
    pub(super) fn pixel(&self, direction: DVec3) -> Option<DVec2> {
        let aside = direction.truncate();
        let place = match self.lens {
            Lens::Perspective => (direction.z > 0.0).then(|| aside / (direction.z * self.half.tan())),
            Lens::Fisheye => {
                let angle = aside.length().atan2(direction.z);
                (angle <= self.half).then(|| aside.normalize_or_zero() * (angle / self.half))
            }
        }?;
        let [width, height] = self.size.map(|n| n as f64);
        let scaled = place * width.min(height);
        let pixel = DVec2::new(scaled.x + width - 1.0, height - 1.0 - scaled.y) / 2.0;
        let is_within = |at: f64, count: f64| (-0.5..=count - 0.5).contains(&at);
        (is_within(pixel.x, width) && is_within(pixel.y, height)).then_some(pixel)
    }
}

/// An eye on the centerline of a vessel.
#[derive(Clone, Copy, Debug)]
pub struct Eye {
    /// Arc length (mm).
    pub at: f64,
    /// The radius of the lumen there (mm).
    pub radius: f64,
    /// World position (mm, LPS).
    pub position: DVec3,
    /// Unit vectors to the right, upwards and ahead.
    pub axes: [DVec3; 3],
}

impl Eye {
    /// An eye at an arc length (mm) of a path that looks along `smooth`, the same path smoothed. At `roll` 0 (radians) the viewer
    /// of the straightened vessel is upwards; the picture turns clockwise with the roll. Fails with [`ErrorKind::Camera`] for a
    /// place beyond the vessel, and a roll that is not finite.
    pub fn new(
        [path, smooth]: [&CenterlinePath; 2],
        straightened: &Straightened,
        [at, radius, roll]: [f64; 3],
        is_backwards: bool,
    ) -> Result<Self> {
        let length = path.length();
        if !(0.0..=length).contains(&at) {
            let expected = format!("0 to {length:.4} mm, the length of the vessel");
            return Err(Error::new(ErrorKind::Camera, "at of the endoscopy", format!("{at} mm"), expected));
        }
        if !roll.is_finite() {
            let found = format!("{roll} rad");
            return Err(Error::new(ErrorKind::Camera, "roll of the endoscopy", found, "a finite angle"));
        }
        let ahead_by = (AHEAD_RADII * radius).max(AHEAD_MM) * if is_backwards { -1.0 } else { 1.0 };
        let on_smooth = |at: f64| smooth.at(at * smooth.length() / length);
        let frame = straightened.frame(at);
        let along = if is_backwards { -frame.tangent } else { frame.tangent };
        let ahead = (on_smooth(at + ahead_by) - on_smooth(at)).try_normalize().unwrap_or(along);
        let up = (-frame.ahead).reject_from_normalized(ahead).normalize_or(ahead.any_orthonormal_vector());
        let right = ahead.cross(up);
        let (sine, cosine) = roll.sin_cos();
        let axes = [right * cosine + up * sine, up * cosine - right * sine, ahead];
        Ok(Self { at, radius, position: path.at(at), axes })
    }

    pub(super) fn world(&self, direction: DVec3) -> DVec3 {
        let [right, up, ahead] = self.axes;
        right * direction.x + up * direction.y + ahead * direction.z
    }

    pub(super) fn seen(&self, world: DVec3) -> DVec3 {
        DVec3::from_array(self.axes.map(|axis| axis.dot(world)))
    }
}
