//! An ellipse blurred by a Gaussian, which is the image of a lumen with a sharp wall.
//!
//! Green's theorem turns the integral of the Gaussian over the ellipse into one along its boundary. Let r be
//! the vector from a point to the boundary. The divergence of the field r (1 - exp(-r²/2)) / (2 π r²) is the
//! Gaussian of standard deviation 1. The integrand is periodic and smooth, so the trapezoidal rule converges
//! exponentially (Trefethen and Weideman 2014, doi:10.1137/130932132). The derivatives with respect to the
//! shape are also integrals of Gaussians along the boundary.

use std::f64::consts::{PI, TAU};
use std::sync::OnceLock;

use glam::{DMat2, DVec2};

use lumencut_core::math::lanes::FAN;

/// Number of shape parameters: centre (2), mean semi-axis, stretch (2).
pub(crate) const SHAPE: usize = 5;

/// Maximum distance between nodes, in standard deviations of the blur; keeps the error below 0.001 %.
const NODE_DISTANCE: f64 = 1.3;

const FEWEST_NODES: usize = 12;

/// Squared distance (in blur standard deviations) beyond which the exponential is below single precision.
const FAR_AWAY: f32 = 64.0;

/// Maximum number of nodes, enough for a lumen whose radius is 40 times the blur.
const MOST_NODES: usize = 400;

/// An ellipse: the points centre + S (cos t, sin t), where S = [[mean + x, y], [y, mean - x]] and (x, y) is
/// `stretch`. Unlike two axes and an angle, these parameters have no singularity at a circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipse {
    /// Centre (mm).
    pub center: DVec2,
    /// Mean of the semi-axes (mm).
    pub mean: f64,
    /// Half of the difference between the semi-axes (mm), as a vector whose angle is twice that of the longer one.
    pub stretch: DVec2,
}

impl Ellipse {
    /// A circle of radius `radius` (mm).
    pub fn circle(center: DVec2, radius: f64) -> Self {
        Self { center, mean: radius, stretch: DVec2::ZERO }
    }

    pub(crate) fn from_parameters(p: &[f64]) -> Option<Self> {
        let ellipse = Self { center: DVec2::new(p[0], p[1]), mean: p[2], stretch: DVec2::new(p[3], p[4]) };
        (ellipse.semi_axes()[0] > 0.0).then_some(ellipse)
    }

    /// The shape parameters, in the order in which derivatives are stored.
    pub fn parameters(&self) -> [f64; SHAPE] {
        [self.center.x, self.center.y, self.mean, self.stretch.x, self.stretch.y]
    }

    /// The shorter and the longer semi-axis (mm).
    pub fn semi_axes(&self) -> [f64; 2] {
        let half = self.stretch.length();
        [self.mean - half, self.mean + half]
    }

    /// Vectors (mm) from the centre to one end of the shorter axis and to one end of the longer axis.
    pub fn half_axes(&self) -> [DVec2; 2] {
        let [short, long] = self.semi_axes();
        let direction = DVec2::from_angle(0.5 * self.stretch.y.atan2(self.stretch.x));
        [direction.perp() * short, direction * long]
    }

    /// Area (mm²).
    pub fn area(&self) -> f64 {
        PI * (self.mean * self.mean - self.stretch.length_squared())
    }

    pub(crate) fn equivalent_diameter(&self) -> f64 {
        2.0 * (self.area() / PI).max(0.0).sqrt()
    }

    /// The ellipse with both semi-axes multiplied by `by`.
    #[must_use]
    pub fn scaled(&self, by: f64) -> Self {
        Self { center: self.center, mean: self.mean * by, stretch: self.stretch * by }
    }

    /// Interpolates from this ellipse (`share` = 0) to `other` (`share` = 1).
    #[must_use]
    pub fn towards(&self, other: &Self, share: f64) -> Self {
        Self {
            center: self.center.lerp(other.center, share),
            mean: self.mean + share * (other.mean - self.mean),
            stretch: self.stretch.lerp(other.stretch, share),
        }
    }

    /// Largest difference (mm) between a parameter of this ellipse and that of the other.
    pub fn differs(&self, other: &Self) -> f64 {
        let [own, others] = [self, other].map(Self::parameters);
        own.iter().zip(&others).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }

    fn matrix(&self) -> DMat2 {
        let DVec2 { x, y } = self.stretch;
        DMat2::from_cols(DVec2::new(self.mean + x, y), DVec2::new(y, self.mean - x))
    }

    /// Distance (mm) from the centre to the boundary in the direction of a unit vector.
    pub fn radius_towards(&self, direction: DVec2) -> f64 {
        1.0 / (self.matrix().inverse() * direction).length().max(1e-12)
    }
}

/// A Gaussian blur in a plane, stored as the matrix that maps it to standard deviation 1 in all directions.
#[derive(Clone, Copy, Debug)]
pub struct Whitening(pub DMat2);

impl Whitening {
    /// Computes the matrix as the inverse square root of a positive definite covariance (mm²).
    pub fn new(covariance: DMat2) -> Self {
        let (a, b, d) = (covariance.x_axis.x, covariance.x_axis.y, covariance.y_axis.y);
        // The square root of a 2 × 2 matrix is (C + √det) / √(trace + 2 √det).
        let root = (a * d - b * b).max(0.0).sqrt();
        let scale = (a + d + 2.0 * root).sqrt();
        let square_root = DMat2::from_cols(DVec2::new(a + root, b), DVec2::new(b, d + root)) * (1.0 / scale);
        Self(square_root.inverse())
    }
}

/// A node of the boundary in whitened space; `tangent` and `outwards` are divided by the number of nodes.
#[derive(Clone, Copy, Debug)]
struct Node {
    place: [f32; 2],
    tangent: [f32; 2],
    outwards: [f32; SHAPE],
}

/// The boundary of an ellipse in the space where the blur has standard deviation 1.
#[derive(Clone, Debug)]
pub struct Boundary {
    nodes: Vec<Node>,
    whitening: [f32; 3],
    center: [f32; 2],
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Blurred {
    /// Blurred value at each point, from 0 outside the ellipse to 1 inside.
    pub value: [f32; FAN],
    /// Derivatives of each value (1/mm), in the order of [`Ellipse::parameters`].
    pub slopes: [[f32; FAN]; SHAPE],
}

impl Boundary {
    /// The boundary of `ellipse` in the space where the blur has standard deviation 1.
    pub fn new(ellipse: &Ellipse, Whitening(whitening): Whitening) -> Self {
        let matrix = ellipse.matrix();
        let needed = TAU * longest(whitening * matrix).max(1e-9) / NODE_DISTANCE;
        let count = (needed.ceil() as usize).clamp(FEWEST_NODES, MOST_NODES);
        let share = 1.0 / count as f64;
        let scale = whitening.determinant() * share;
        let nodes = circle(count).iter().map(|&(sin, cos)| {
            let place = matrix * DVec2::new(cos, sin);
            let tangent = matrix * DVec2::new(-sin, cos);
            let outwards = |way: DVec2| (way.perp_dot(tangent) * scale) as f32;
            Node {
                place: (whitening * place).as_vec2().to_array(),
                tangent: (whitening * tangent * share).as_vec2().to_array(),
                outwards: [
                    outwards(DVec2::X),
                    outwards(DVec2::Y),
                    outwards(DVec2::new(cos, sin)),
                    outwards(DVec2::new(cos, -sin)),
                    outwards(DVec2::new(sin, cos)),
                ],
            }
        });
        Self {
            nodes: nodes.collect(),
            whitening: [whitening.x_axis.x as f32, whitening.x_axis.y as f32, whitening.y_axis.y as f32],
            center: ellipse.center.as_vec2().to_array(),
        }
    }

    /// Blurred values and their derivatives at sixteen points (mm). Not inlined on the web, to save code size.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    #[cfg_attr(target_arch = "wasm32", inline(never))]
    pub(crate) fn blurred(&self, x: &[f32; FAN], y: &[f32; FAN]) -> Blurred {
        let [xx, xy, yy] = self.whitening;
        let mut place = [[0.0; FAN]; 2];
        for l in 0..FAN {
            let (dx, dy) = (x[l] - self.center[0], y[l] - self.center[1]);
            place[0][l] = xx * dx + xy * dy;
            place[1][l] = xy * dx + yy * dy;
        }
        let mut sum = Blurred { value: [0.0; FAN], slopes: [[0.0; FAN]; SHAPE] };
        for node in &self.nodes {
            let mut squares = [0.0; FAN];
            let mut is_near = false;
            for l in 0..FAN {
                let dx = node.place[0] - place[0][l];
                let dy = node.place[1] - place[1][l];
                squares[l] = dx * dx + dy * dy;
                is_near |= squares[l] < FAR_AWAY;
            }
            if !is_near {
                // At distances beyond FAR_AWAY, the exponential is negligible compared with 1.
                for l in 0..FAN {
                    let dx = node.place[0] - place[0][l];
                    let dy = node.place[1] - place[1][l];
                    sum.value[l] += 1.0 / squares[l] * (dx * node.tangent[1] - dy * node.tangent[0]);
                }
                continue;
            }
            for l in 0..FAN {
                let dx = node.place[0] - place[0][l];
                let dy = node.place[1] - place[1][l];
                let square = squares[l];
                let bell = exponential(-0.5 * square);
                let near = 0.5 + square * (-0.125 + square * (1.0 / 48.0));
                let far = (1.0 - bell) / square;
                let field = if square < 0.03 { near } else { far };
                sum.value[l] += field * (dx * node.tangent[1] - dy * node.tangent[0]);
                sum.slopes[0][l] += bell * node.outwards[0];
                sum.slopes[1][l] += bell * node.outwards[1];
                sum.slopes[2][l] += bell * node.outwards[2];
                sum.slopes[3][l] += bell * node.outwards[3];
                sum.slopes[4][l] += bell * node.outwards[4];
            }
        }
        sum
    }

    /// Blurred value at one point (mm), between 0 and 1.
    pub fn value(&self, place: DVec2) -> f64 {
        f64::from(self.blurred(&[place.x as f32; FAN], &[place.y as f32; FAN]).value[0])
    }
}

type Circle = Box<[(f64, f64)]>;

/// Sine and cosine at `count` even steps around a circle, cached for each count.
fn circle(count: usize) -> &'static [(f64, f64)] {
    static CIRCLES: [OnceLock<Circle>; MOST_NODES + 1] = [const { OnceLock::new() }; MOST_NODES + 1];
    let share = 1.0 / count as f64;
    CIRCLES[count].get_or_init(|| (0..count).map(|n| (TAU * n as f64 * share).sin_cos()).collect())
}

fn longest(matrix: DMat2) -> f64 {
    let (x, y) = (matrix.x_axis, matrix.y_axis);
    let half = 0.5 * (x.length_squared() + y.length_squared());
    let difference = 0.5 * (x.length_squared() - y.length_squared());
    (half + difference.hypot(x.dot(y))).sqrt()
}

/// exp(x) for x ≤ 0 with a relative error of 2e-6: a power of two from exponent bits, times a polynomial.
#[inline(always)]
fn exponential(x: f32) -> f32 {
    /// 1.5 · 2²³. The last bit of a float of this size has the value 1, so adding it rounds to an integer.
    const ONES: f32 = 12_582_912.0;
    const LN_2: f32 = std::f32::consts::LN_2;
    let power = if x > -80.0 { x } else { -80.0 } * std::f32::consts::LOG2_E;
    let rounded = power + ONES;
    let f = power - (rounded - ONES);
    // Taylor series of 2^f for |f| ≤ 1/2.
    let tail = 0.009_618_13 + f * 0.001_333_36;
    let part = 1.0 + f * (LN_2 + f * (0.240_226_5 + f * (0.055_504_11 + f * tail)));
    // 2 to the power of the integer part, from its exponent bits.
    part * f32::from_bits(rounded.to_bits().wrapping_add(127) << 23)
}

#[cfg(test)]
#[path = "tests/ellipse.rs"]
mod tests;
