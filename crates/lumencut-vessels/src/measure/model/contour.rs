//! Finds the contour of a lumen on rays, and corrects it for the shift caused by blur.

use glam::{DVec2, DVec3};

use super::ellipse::{Boundary, Ellipse};
use super::{Model, ThreeLevels};
use crate::measure::section::SectionPlane;
use crate::measure::section::rays::{RAYS, Ray, direction};
use lumencut_core::math::lanes::{FAN, Isa, Kernel, dispatch};
use lumencut_core::math::statistics::median;

/// A wall farther from the ellipse than this (radii, or mm if larger) belongs to another structure.
const MAX_OFFSET: (f64, f64) = (0.5, 0.5);

pub(crate) trait Shares: Sync {
    fn shares(&self, x: &[f32; FAN], y: &[f32; FAN]) -> [f32; FAN];
}

impl Shares for Boundary {
    #[inline(always)]
    fn shares(&self, x: &[f32; FAN], y: &[f32; FAN]) -> [f32; FAN] {
        self.blurred(x, y).value
    }
}

impl Shares for ThreeLevels {
    #[inline(always)]
    fn shares(&self, x: &[f32; FAN], y: &[f32; FAN]) -> [f32; FAN] {
        self.modelled(x, y).share
    }
}

struct SharesAt<'a, S> {
    shares: &'a S,
    x: &'a [f32; FAN],
    y: &'a [f32; FAN],
}

impl<S: Shares> Kernel for SharesAt<'_, S> {
    type Output = [f32; FAN];

    #[inline(always)]
    fn run(self) -> [f32; FAN] {
        self.shares.shares(self.x, self.y)
    }
}

/// Distance (mm) from the centre to the wall on each ray: where the volume crosses `level`. The blurred model
/// predicts by how much blur shifts this crossing, which is corrected. Rays without a plausible crossing use
/// the ellipse.
pub(crate) fn wall(ellipse: &Ellipse, values: &impl Shares, rays: &[Ray], level: f64) -> Vec<f64> {
    let walls: Vec<f64> = (0..RAYS)
        .map(|n| {
            let own = ellipse.radius_towards(direction(n));
            let ray = &rays[n];
            let seen = ray.edge.filter(|edge| *edge < ray.limit).and_then(|edge| {
                let blurred = crossing(values, ellipse.center, direction(n), level, own)?;
                Some(own + edge - blurred)
            });
            let most = (MAX_OFFSET.0 * own).max(MAX_OFFSET.1);
            seen.filter(|wall| (wall - own).abs() <= most && *wall > 0.0).unwrap_or(own)
        })
        .collect();
    without_spikes(&walls, |n| ellipse.radius_towards(direction(n)))
}

/// Removes spikes of one or two rays: a running median of five rays smooths the ratio of the wall to `own`.
fn without_spikes(walls: &[f64], own: impl Fn(usize) -> f64) -> Vec<f64> {
    let shares: Vec<f64> = walls.iter().enumerate().map(|(n, wall)| wall / own(n)).collect();
    (0..RAYS)
        .map(|n| {
            let mut five: [f64; 5] = std::array::from_fn(|m| shares[(n + RAYS + m - 2) % RAYS]);
            median(&mut five).unwrap_or(1.0) * own(n)
        })
        .collect()
}

/// Wall distances where the rays end (at edges or bright material); None if too few end. `width` is the blur (mm).
pub(crate) fn wall_by_rays(rays: &[Ray], width: f64) -> Option<Vec<f64>> {
    let end = |ray: &Ray| ray.edge.or_else(|| ray.bright_at.map(|_| within_rim(ray.rim, width)));
    let mut ends: Vec<f64> = rays.iter().filter_map(end).collect();
    if ends.len() < RAYS / 2 {
        return None;
    }
    let middle = median(&mut ends)?;
    // Some rays escape between the struts of a stent, so their length is limited.
    let walls: Vec<f64> = rays.iter().map(|ray| end(ray).unwrap_or(middle).min(1.5 * middle)).collect();
    Some(without_spikes(&without_spikes(&walls, |_| middle), |_| middle))
}

/// Inner edge of a bright rim, such as a stent strut. The visible width of the rim is corrected for blur.
fn within_rim([begins, ends]: [f64; 2], width: f64) -> f64 {
    let seen = ends - begins;
    let true_width = (seen * seen - width * width).max(0.0).sqrt();
    f64::midpoint(begins, ends) - 0.5 * true_width
}

/// Distance (mm) along a ray at which the blurred model crosses `level`, searched near the model's boundary.
fn crossing(shares: &impl Shares, center: DVec2, direction: DVec2, level: f64, own: f64) -> Option<f64> {
    let reach = 0.6 * own + 0.4;
    let first = (own - reach).max(0.0);
    let step = (own + reach - first) / (FAN - 1) as f64;
    let at = |n: usize| first + n as f64 * step;
    let x = std::array::from_fn(|n| (center.x + direction.x * at(n)) as f32);
    let y = std::array::from_fn(|n| (center.y + direction.y * at(n)) as f32);
    let kernel = SharesAt { shares, x: &x, y: &y };
    let values = dispatch(Isa::widest(), kernel).map(f64::from);
    let n = (1..FAN).find(|n| values[*n] < level && values[n - 1] >= level)?;
    Some(at(n) - step * (level - values[n]) / (values[n - 1] - values[n]))
}

/// Root mean square of the relative differences between the wall and the ellipse.
pub(crate) fn irregularity(ellipse: &Ellipse, wall: &[f64]) -> f64 {
    let off = |n: usize| (wall[n] / ellipse.radius_towards(direction(n)) - 1.0).powi(2);
    ((0..RAYS).map(off).sum::<f64>() / RAYS as f64).sqrt()
}

pub(crate) fn points(place: &SectionPlane, center: DVec2, wall: &[f64]) -> Vec<DVec3> {
    (0..RAYS).map(|n| place.point(center + direction(n) * wall[n])).collect()
}

/// Ellipse with the area, centroid and second moments of the polygon; None if the polygon is degenerate.
pub(crate) fn ellipse_within(center: DVec2, wall: &[f64]) -> Option<Ellipse> {
    let corner = |n: usize| direction(n % RAYS) * wall[n % RAYS];
    let (mut area, mut first, mut xx, mut xy, mut yy) = (0.0, DVec2::ZERO, 0.0, 0.0, 0.0);
    for n in 0..RAYS {
        let [a, b] = [corner(n), corner(n + 1)];
        let triangle = 0.5 * a.perp_dot(b);
        area += triangle;
        first += (a + b) * (triangle / 3.0);
        xx += triangle / 6.0 * (a.x * a.x + a.x * b.x + b.x * b.x);
        yy += triangle / 6.0 * (a.y * a.y + a.y * b.y + b.y * b.y);
        xy += triangle / 12.0 * (2.0 * a.x * a.y + 2.0 * b.x * b.y + a.x * b.y + b.x * a.y);
    }
    let middle = first / area;
    let [xx, yy, xy] =
        [xx / area - middle.x * middle.x, yy / area - middle.y * middle.y, xy / area - middle.x * middle.y];
    // A filled ellipse with the matrix S has the covariance S² / 4.
    let root = (xx * yy - xy * xy).max(0.0).sqrt();
    let scale = 2.0 / (xx + yy + 2.0 * root).sqrt();
    let ellipse = Ellipse {
        center: center + middle,
        mean: 0.5 * scale * (xx + yy + 2.0 * root),
        stretch: DVec2::new(0.5 * (xx - yy), xy) * scale,
    };
    let is_one = area > 0.0 && ellipse.mean.is_finite() && ellipse.semi_axes()[0] > 0.0;
    is_one.then_some(ellipse)
}

/// Radius (mm) of the inscribed ball at each centre: the distance to the nearest wall point of this section
/// and its neighbours. NaN if they have no wall.
pub(crate) fn inscribed(at: &[f64], centers: &[DVec3], contours: &[Vec<DVec3>]) -> Vec<f64> {
    (0..at.len())
        .map(|n| {
            let mut nearest = distance(centers[n], &contours[n]);
            for step in [-1, 1] {
                let mut m = n;
                while let Some(next) = m.checked_add_signed(step).filter(|next| *next < at.len()) {
                    // All walls from this section on are farther away than the nearest one so far.
                    if nearest.is_nan() || (at[next] - at[n]).abs() > nearest {
                        break;
                    }
                    m = next;
                    nearest = nearest.min(distance(centers[n], &contours[m]));
                }
            }
            nearest
        })
        .collect()
}

fn distance(center: DVec3, contour: &[DVec3]) -> f64 {
    contour.iter().map(|point| point.distance(center)).fold(f64::NAN, f64::min)
}

#[cfg(test)]
#[path = "tests/contour.rs"]
mod tests;
