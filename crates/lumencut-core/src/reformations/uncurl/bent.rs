//! A partly straightened vessel, and the map from the space around it to that around the true vessel.

use glam::{DQuat, DVec3};

use crate::camera::Camera;
use crate::math::centerline_path::CenterlinePath;
use crate::math::frames::{Frames, MovingFrame};

/// A vessel begins along the view if the tangent of the angle between them is below this.
const ALONG_VIEW: f64 = 0.05;

const PARALLEL: f64 = 1e-12;

#[derive(Clone, Copy, Debug)]
struct Turning {
    at: f64,
    /// Rotation vector per mm (radians per mm) of the true frame relative to the bent one.
    undone: DVec3,
    from_bent: DQuat,
}

/// A bent vessel. In its rotation-minimising frame the true vessel turns at a rate equal to its curvature; the bent
/// vessel turns at that rate times 1 − `amount`. So the rotation from the bent frame to the true one contains
/// `amount` of each true turn.
#[derive(Clone, Debug)]
pub(super) struct Bent {
    turnings: Vec<Turning>,
    /// The points, placed in front of the camera (mm, LPS).
    pub points: Vec<DVec3>,
}

impl Bent {
    /// The vessel bent by `amount`, from 0 (as it is) to 1 (straight). The vessel bends about its middle. The line
    /// from its first to its last point turns to downwards in the image, and its middle moves to that of the image.
    /// At 1 the vessel is seen as the straightened CPR whose viewer at the first point is as near as possible to the
    /// camera.
    pub(super) fn new(path: &CenterlinePath, camera: &Camera, amount: f64) -> Self {
        let first = path.direction()[0];
        let frames = Frames::new(path, MovingFrame::looking(first, ahead_at(first, camera)));
        let middle = path.length() / 2.0;
        let mut bent = Self { turnings: turnings(&frames, amount), points: Vec::new() };
        bent.turn(bent.true_from_bent(middle));
        bent.lay(path);
        bent.turn(placed([path.points(), &bent.points], &frames.at(middle), camera, amount));
        bent.lay(path);
        bent.shift(path, camera, amount);
        bent
    }

    /// The rotation from space around the bent vessel to space around the true one at an arc length (mm).
    #[inline]
    pub(super) fn true_from_bent(&self, at: f64) -> DQuat {
        let turning = &self.turnings[self.turnings.partition_point(|turning| turning.at <= at).max(1) - 1];
        if turning.undone == DVec3::ZERO {
            return turning.from_bent;
        }
        DQuat::from_scaled_axis(turning.undone * (at - turning.at)) * turning.from_bent
    }

    pub(super) fn stations(&self) -> impl Iterator<Item = f64> {
        self.turnings.iter().map(|turning| turning.at)
    }

    fn lay(&mut self, path: &CenterlinePath) {
        let mut point = path.points()[0];
        self.points = vec![point];
        for (direction, ends) in path.direction().iter().zip(path.arc_length().windows(2)) {
            // In the middle of a segment, the tangent is the segment's direction.
            let middle = f64::midpoint(ends[0], ends[1]);
            point += self.true_from_bent(middle).inverse() * *direction * (ends[1] - ends[0]);
            self.points.push(point);
        }
    }

    fn turn(&mut self, by: DQuat) {
        for turning in &mut self.turnings {
            turning.from_bent *= by.inverse();
        }
    }

    fn shift(&mut self, path: &CenterlinePath, camera: &Camera, amount: f64) {
        let [here, own] =
            [&self.points[..], path.points()].map(|points| (points[0] + points[points.len() - 1]) / 2.0);
        let by = camera.center().lerp(own, 1.0 - amount) - here;
        self.points.iter_mut().for_each(|point| *point += by);
    }
}

/// The direction of view at the first point of a vessel; from below if the vessel begins along the view.
fn ahead_at(first: DVec3, camera: &Camera) -> DVec3 {
    let aside = first.cross(camera.direction()).length();
    if aside > ALONG_VIEW * first.dot(camera.direction()).abs() { camera.direction() } else { camera.up() }
}

fn turnings(frames: &Frames, amount: f64) -> Vec<Turning> {
    let stations = frames.stations();
    let mut from_bent = DQuat::IDENTITY;
    let mut turnings: Vec<Turning> = Vec::with_capacity(stations.len());
    for (n, station) in stations.iter().enumerate() {
        if n > 0 {
            let before = &stations[n - 1];
            let end = before.frame_at(station.at);
            from_bent = DQuat::from_scaled_axis(before.turn * amount * (station.at - before.at)) * from_bent;
            // Between stations the frames turn at a constant rate, up to a remainder of third order, added here.
            let rest = rotation(&station.frame) * rotation(&end).inverse();
            from_bent = DQuat::from_scaled_axis(shorter(rest).to_scaled_axis() * amount) * from_bent;
        }
        turnings.push(Turning { at: station.at, undone: station.turn * amount, from_bent });
    }
    turnings
}

fn rotation(frame: &MovingFrame) -> DQuat {
    DQuat::from_mat3(&glam::DMat3::from_cols(frame.across, frame.tangent, frame.ahead))
}

fn shorter(rotation: DQuat) -> DQuat {
    if rotation.w < 0.0 { -rotation } else { rotation }
}

/// The rotation that places a bent vessel: the share `amount` of the turn of its chord to downwards, and of
/// the turn about the chord to face the camera. `frame` is that in the vessel's middle.
fn placed([own, bent]: [&[DVec3]; 2], frame: &MovingFrame, camera: &Camera, amount: f64) -> DQuat {
    let chord =
        |points: &[DVec3]| (points[points.len() - 1] - points[0]).try_normalize().unwrap_or(frame.tangent);
    let (from, down) = (chord(own), -camera.up());
    let target = DQuat::from_scaled_axis(turn(from, down, camera) * amount) * from;
    let to_target = DQuat::from_scaled_axis(turn(chord(bent), target, camera));
    let straight = DQuat::from_scaled_axis(turn(frame.tangent, down, camera)) * frame.ahead;
    let wanted = camera.direction();
    let about = straight.cross(wanted).dot(down).atan2(straight.dot(wanted));
    DQuat::from_axis_angle(target, about * amount) * to_target
}

/// The smallest rotation vector (radians) between two directions; opposite ones turn about the view.
fn turn(from: DVec3, to: DVec3, camera: &Camera) -> DVec3 {
    let axis = from.cross(to);
    let angle = axis.length().atan2(from.dot(to));
    axis.try_normalize().filter(|_| axis.length() >= PARALLEL).unwrap_or(camera.direction()) * angle
}
