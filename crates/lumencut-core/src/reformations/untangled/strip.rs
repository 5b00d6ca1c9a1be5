//! One piece of a vessel as a strip of the image: the strip's direction, and the world lines across it.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec2, DVec3};

use super::pieces::Piece;
use crate::camera::Camera;

/// Minimum sine of the angle to the view at which a vessel's direction defines the line across it.
const MIN_VIEW_SINE: f64 = 0.1;

const SMOOTHING_ACROSS_MM: f64 = 2.0;

const CUT_OFF_SIGMAS: f64 = 4.0;

/// Largest factor by which a line across a sharp corner is lengthened, to end where its neighbours end.
pub(super) const LONGEST_MITRE: f64 = 3.0;

/// A vector shorter than this has no direction.
const MIN_DIRECTION_LENGTH: f64 = 1e-9;

#[derive(Clone, Debug)]
pub(super) struct Strip {
    /// The direction of each segment in the image (radians, unwrapped).
    theta: Vec<f64>,
    /// For each station, the vector 1 mm to the right along the vessel; longer at corners.
    pub across: Vec<DVec3>,
}

impl Strip {
    pub(super) fn new(piece: &Piece, camera: &Camera, smoothing: f64) -> Self {
        let directions: Vec<DVec3> =
            piece.points.windows(2).map(|ends| (ends[1] - ends[0]).normalize_or_zero()).collect();
        let seen: Vec<DVec3> =
            directions.iter().map(|t| DVec3::new(t.dot(camera.right()), t.dot(camera.up()), 0.0)).collect();
        let smoothed = smooth(&piece.at, &seen, smoothing);
        let theta = unwrapped(&smoothed.iter().map(|seen| seen.truncate()).collect::<Vec<_>>());
        let lines: Vec<DVec3> = directions
            .iter()
            .zip(&theta)
            .map(|(tangent, theta)| {
                let own = camera.direction().cross(*tangent);
                let (sine, cosine) = theta.sin_cos();
                let is_end_on = own.length() < MIN_VIEW_SINE;
                if is_end_on { camera.right() * sine - camera.up() * cosine } else { own.normalize() }
            })
            .collect();
        let lines = smooth(&piece.at, &lines, SMOOTHING_ACROSS_MM);
        let across = (0..piece.at.len()).map(|n| across(&directions, &lines, n)).collect();
        Self { theta, across }
    }

    /// The stations (mm) from the start of growth, with the share `stiffness` of the piece's bends kept.
    pub(super) fn bent(&self, piece: &Piece, is_reversed: bool, stiffness: f64) -> Vec<DVec2> {
        let last = self.theta.len() - 1;
        let first = if is_reversed { self.theta[last] } else { self.theta[0] };
        let mut place = DVec2::ZERO;
        let mut places = vec![place];
        for (n, theta) in self.theta.iter().enumerate() {
            let bent = first + stiffness * (theta - first);
            place += DVec2::from_angle(bent) * (piece.at[n + 1] - piece.at[n]);
            places.push(place);
        }
        if is_reversed {
            places.iter_mut().for_each(|at| *at -= place);
        }
        places
    }
}

/// The vector 1 mm to the right of each station in the image; longer at corners.
pub(super) fn normals(places: &[DVec2]) -> Vec<DVec2> {
    let along: Vec<DVec2> = places.windows(2).map(|ends| (ends[1] - ends[0]).normalize_or_zero()).collect();
    let normal = |n: usize| {
        let (before, after) = (along[n.saturating_sub(1)], along[n.min(along.len() - 1)]);
        let middle = (before + after).try_normalize().unwrap_or(after);
        DVec2::new(middle.y, -middle.x) / middle.dot(after).max(1.0 / LONGEST_MITRE)
    };
    (0..places.len()).map(normal).collect()
}

/// The vector across a vessel at a station: perpendicular to the vessel, and longer at corners.
fn across(directions: &[DVec3], lines: &[DVec3], n: usize) -> DVec3 {
    let (first, second) = (n.saturating_sub(1), n.min(lines.len() - 1));
    let (before, after) = (directions[first], directions[second]);
    let tangent = (before + after).try_normalize().unwrap_or(after);
    let line = (lines[first] + lines[second]).reject_from_normalized(tangent);
    let line = if line.length() < MIN_DIRECTION_LENGTH {
        tangent.any_orthonormal_vector()
    } else {
        line.normalize()
    };
    let slope = line.dot(after);
    line / (1.0 - slope * slope).max(0.0).sqrt().max(1.0 / LONGEST_MITRE)
}

/// The angles of directions, each within half a turn of the previous one. A segment along the view takes its
/// neighbour's angle; if all run along the view, the vessel runs downwards.
fn unwrapped(directions: &[DVec2]) -> Vec<f64> {
    let known = |d: &DVec2| d.length() > MIN_DIRECTION_LENGTH;
    let mut last = directions.iter().find(|d| known(d)).map_or(-FRAC_PI_2, |d| d.to_angle());
    let mut angles = Vec::with_capacity(directions.len());
    for direction in directions {
        if known(direction) {
            let turn = (direction.to_angle() - last + PI).rem_euclid(TAU) - PI;
            last += turn;
        }
        angles.push(last);
    }
    angles
}

/// Values of segments, smoothed along the vessel by a Gaussian of `sigma` mm, with weights by length.
fn smooth(at: &[f64], values: &[DVec3], sigma: f64) -> Vec<DVec3> {
    if sigma <= 0.0 {
        return values.to_vec();
    }
    let middles: Vec<f64> = at.windows(2).map(|ends| f64::midpoint(ends[0], ends[1])).collect();
    let reach = CUT_OFF_SIGMAS * sigma;
    let mut first = 0;
    let mean = |middle: &f64| {
        while middles[first] < middle - reach {
            first += 1;
        }
        let (mut sum, mut weight) = (DVec3::ZERO, 0.0);
        for other in (first..middles.len()).take_while(|other| middles[*other] <= middle + reach) {
            let distance = middles[other] - middle;
            let share = (at[other + 1] - at[other]) * (-0.5 * (distance / sigma).powi(2)).exp();
            sum += values[other] * share;
            weight += share;
        }
        sum / weight
    };
    middles.iter().map(mean).collect()
}
